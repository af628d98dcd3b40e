// SPDX-License-Identifier: BSD-3-Clause
/// The inside of a closed surface mesh.
#pragma once

#include "config.hpp"
#include "region.hpp"

namespace breccia::collective_rearrangement {

/// For use by so many OpenMP threads at a time. UserError when the file cannot be read or its surface is not closed.
/// Without VTK only .stl is read.
std::unique_ptr<Region> read_mesh(const MeshConfig& config, int threads);

}  // namespace breccia::collective_rearrangement
