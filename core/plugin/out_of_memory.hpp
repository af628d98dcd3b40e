// SPDX-License-Identifier: BSD-3-Clause
/// What a user is told when there is no more memory: how much there was, why not more, and what it was for.
#pragma once

#include <cstddef>
#include <string>

namespace breccia {

/// From now on the texts say how large the specimen is.
void memory_is_for(std::size_t particles, std::size_t bonds);

/// "there is not enough memory: ...". To be called where std::bad_alloc is caught.
std::string out_of_memory();

/// An exception cannot leave a parallel region: without memory in there the program ends with that text and exit code 1
/// instead of the C++ library's own words, as if it had been killed: what was written stays for `--resume`. Ends it at
/// once when there is less memory than it can begin with.
void end_plainly_without_memory();

}  // namespace breccia
