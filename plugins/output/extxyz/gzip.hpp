// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace breccia {

/// The text as a file of gzip, without name or time: the same text, the same bytes. std::bad_alloc without memory.
std::string gzipped(std::string_view text);

}  // namespace breccia
