// SPDX-License-Identifier: BSD-3-Clause
/// The curves of a run as one HDF5 file, for who would rather not read text.
#pragma once

#include <filesystem>

#include "breccia/services.hpp"

namespace breccia {

/// An array of 64-bit numbers for each curve, by its name, with the attributes `unit` (SI, "1" for a pure number) and
/// `description`; NaN where nothing was measured. The same curves, the same bytes. The file appears whole. UserError,
/// CannotWrite, std::bad_alloc.
void write_curves_hdf5(const std::filesystem::path& file, const Curves& curves);

}  // namespace breccia
