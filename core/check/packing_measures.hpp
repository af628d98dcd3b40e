// SPDX-License-Identifier: BSD-3-Clause
/// A finished packing, measured from its particles alone.
#pragma once

#include <optional>

#include "breccia/packing.hpp"
#include "breccia/packing_tools/container.hpp"

namespace breccia {

struct PackingMeasures {
  double mean = 0, deviation = 0, least = 0, most = 0;  ///< of the radii [m]
  double solid = 0;                                     ///< sum of the particles' own volumes [m3]
  double overlap = 0;                                   ///< largest, over the sum of the radii
  double nearest = 0;  ///< distance of the two nearest centres, over the smallest radius
  std::optional<double>
      overhang;  ///< by which a particle reaches out of the container, over its radius; negative within
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< of the centres [m]
  bool orderly = false;  ///< the centres lie on few lines: an arrangement that no chance was at work in
};

/// Of particles whose numbers are finite and whose radii are positive; there is one at the least.
PackingMeasures measure_packing(const PackedParticles& packed, const PackingRequest& request,
                                const std::optional<Container>& container);

/// What of these the report calls by a name that is known.
std::optional<double> measured_as(const std::string& name, const PackedParticles& packed, const PackingMeasures& m);

bool same_packing(const PackedParticles& a, const PackedParticles& b);  ///< bit by bit
/// The particles of both, one behind the other.
PackedParticles joined(PackedParticles first, const PackedParticles& second);
bool same_report(const PackedParticles& a, const PackedParticles& b);  ///< and what else is no list

}  // namespace breccia
