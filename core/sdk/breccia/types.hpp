// SPDX-License-Identifier: BSD-3-Clause
/// Basic types shared by the core and by every plugin. All quantities are SI.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace breccia {

using Vec3 = Eigen::Vector3d;  ///< unaligned 24-byte vector: arrays of it are VTK's layout
using Mat3 = Eigen::Matrix3d;
using Index = std::uint32_t;  ///< a particle, pair, bond or wall; 32 bits keep the pair list small

/// What became of the cohesive bond of a pair. The values are part of the file format.
enum class BondState : std::uint8_t {
  unbonded = 0,  ///< touching or nearby, never glued
  intact = 1,
  broken_tension = 2,
  broken_shear = 3,
  broken_combined = 4  ///< by a criterion that mixes modes, for laws that have one
};

constexpr bool is_broken(BondState s) { return s >= BondState::broken_tension; }

/// Degrees of freedom of a particle, as bits: a set bit holds that velocity component at its value.
namespace dof {
constexpr std::uint8_t x = 1, y = 2, z = 4, rx = 8, ry = 16, rz = 32;
constexpr std::uint8_t translation = x | y | z, rotation = rx | ry | rz, all = translation | rotation;
constexpr std::uint8_t out_of_plane = z | rx | ry;  ///< held in two dimensions
}  // namespace dof

}  // namespace breccia
