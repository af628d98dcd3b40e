// SPDX-License-Identifier: BSD-3-Clause
/// The cross-section of a bond of cement between two grains: a disc of radius R_b = lambda min(r_i, r_j), in two
/// dimensions a strip 2 R_b broad and as thick as the specimen.
/// Source: Potyondy, Cundall (2004), Int. J. Rock Mech. Min. Sci. 41, 1329-1364, section 2.2.
#pragma once

#include <numbers>

#include "breccia/contact_law.hpp"

namespace breccia {

class BondSection {
 public:
  struct Of {
    double radius, area;      ///< R_b [m], A [m2]
    double bending, torsion;  ///< I about an axis in the plane of the section, J [m4]
  };

  BondSection(double radius_multiplier, const Assembly& a)
      : multiplier_(radius_multiplier),
        disc_(a.dimension == 2 ? 0 : std::numbers::pi),
        breadth_(a.dimension == 2 ? 2 * a.thickness : 0) {}

  BRECCIA_KERNEL Of between(double radius_i, double radius_j) const {
    const double radius = multiplier_ * (radius_i < radius_j ? radius_i : radius_j), square = radius * radius;
    Of s;
    s.radius = radius;
    s.area = radius * (disc_ * radius + breadth_);
    s.bending = square * radius * (0.25 * disc_ * radius + breadth_ * (1.0 / 3));
    s.torsion = 0.5 * disc_ * square * square;
    return s;
  }
  BRECCIA_KERNEL double twists() const { return disc_ > 0 ? 1.0 : 0.0; }  ///< 0 in a plane

 private:
  double multiplier_;      // lambda
  double disc_, breadth_;  // pi, or 0 in a plane; 2 t there [m], else 0
};

}  // namespace breccia
