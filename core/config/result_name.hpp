// SPDX-License-Identifier: BSD-3-Clause
/// Names that become the name of a folder below results/, or of a file in one.
#pragma once

#include <string>

namespace breccia {

/// Empty for a name that stays where it is put, on any file system; else why it does not: "is empty", ...
std::string why_not_a_file_name(const std::string& name);

}  // namespace breccia
