// SPDX-License-Identifier: BSD-3-Clause
/// One frame in the extended XYZ format: the number of particles, a line about the frame, a line for each particle.
#pragma once

#include <span>
#include <string>

#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia::extxyz {

enum class Precision { single_precision, double_precision };

/// Columns have the names by which OVITO knows what they are. Particles are in the order of the packing, so that a
/// reader that knows no ids finds the same particle in the same row of each frame. Numbers are as short as they can be
/// and still come back with the same bits. UserError for a field of another length, or of a name that is taken.
std::string frame_text(const SimulationView& view, std::span<const Field> fields, Precision precision);

}  // namespace breccia::extxyz
