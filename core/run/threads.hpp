// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace breccia {

/// UserError when the system does not give this many threads. OpenMP's library would end the program by itself, with
/// words of its own, in the middle of a run.
void refuse_without_threads(int threads);

}  // namespace breccia
