// SPDX-License-Identifier: BSD-3-Clause
/// Files of HDF5 that all ranks write together, by its own way over MPI.
#pragma once

#include <mpi.h>

#include <memory>

#include "engine/shared_lists.hpp"

namespace breccia {

/// All ranks of the communicator call it together. UserError on all of them.
std::unique_ptr<SharedFile> shared_hdf5(const std::string& path, std::size_t bytes_ahead, MPI_Comm comm);

}  // namespace breccia
