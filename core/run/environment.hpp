// SPDX-License-Identifier: BSD-3-Clause
/// What the results do not depend on, and a reader wants to know: who built the program, and where it runs.
#pragma once

#include "breccia/param_spec.hpp"

namespace breccia {

/// For the section `environment` of summary.json: breccia, commit (empty outside a repository; with `-dirty` when the
/// sources differ from it), compiler, build, host, system, processor. Texts alone.
Json environment();

}  // namespace breccia
