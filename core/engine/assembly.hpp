// SPDX-License-Identifier: BSD-3-Clause
/// From a packing to particles in spatial order.
#pragma once

#include "breccia/packing.hpp"
#include "engine/rank_link.hpp"
#include "model/state.hpp"

namespace breccia {

struct Material {
  double density;  // [kg/m3]
  std::string name = "material";
};

/// Those of a packing, and which of them each of its particles is made of: all of the first where `of_particle` is
/// empty.
struct Materials {
  std::vector<Material> list;
  std::vector<std::uint8_t> of_particle;
  static constexpr std::size_t most = 255;
  Materials() = default;
  Materials(double density) : list{{density}} {}  ///< one for all
};

/// Particles of the packing, in Morton order so that neighbours are near in memory; masses of spheres, or of discs of
/// the given thickness in two dimensions (held in the plane z = 0). UserError for an empty packing, a value that is
/// not finite or a radius that is not positive. `link`: each rank has a piece of the packing and of `of_particle`, one
/// behind the other in the order of the ranks, and gets its share of the rows; null where there is but one.
State assemble(const PackedParticles& packing, const Materials& materials, int dimension, double thickness,
               RankLink* link = nullptr);

}  // namespace breccia
