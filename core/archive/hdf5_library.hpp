// SPDX-License-Identifier: BSD-3-Clause
/// The library that calls HDF5, loaded when it is first asked for: HDF5 brings some thirty others.
#pragma once

#include <cstddef>

namespace breccia {

/// HDF5 does not survive that memory ends while it is at work: std::bad_alloc when there is none for a file of so many
/// bytes.
void hdf5_needs_memory(std::size_t bytes);

/// One of the library's `extern "C"` functions. UserError where it cannot be loaded.
void* hdf5_symbol(const char* name);
template <class F>
F* hdf5_function(const char* name) {
  return reinterpret_cast<F*>(hdf5_symbol(name));
}

}  // namespace breccia
