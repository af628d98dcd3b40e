// SPDX-License-Identifier: BSD-3-Clause
/// Discs that touch two or three given curves: discs and walls of a packing in the plane.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "breccia/types.hpp"

namespace breccia::tangent_discs {

using Vec2 = Eigen::Vector2d;

/// What a disc may touch. A disc: its centre and r > 0. A round wall, touched from inside: its centre and r = minus its
/// radius, so that for both a touching disc of radius s has its centre |r + s| away. A straight wall: unit normal
/// toward the inside, and r = the normal's product with any point of the wall. Lengths in metres.
struct Curve {
  Vec2 at;
  double r;
  bool straight;

  /// Of a point on the free side.
  double distance(const Vec2& x) const {
    if (straight) return at.dot(x) - r;
    const double d = std::sqrt((x - at).squaredNorm());
    return r < 0 ? -r - d : d - r;
  }
};

struct Disc {
  Vec2 x;    // [m]
  double r;  // [m]
};

/// The disc of radius r that touches a and b, on the given side (1: left, -1: right) of the way from a to b, or of the
/// straight one along its wall. Two straight walls have one inside: side 1. False when there is none.
bool touching(const Curve& a, const Curve& b, int side, double r, Disc& out);

/// The side of a and b on which a disc that touches both has its centre x.
int side_of(const Curve& a, const Curve& b, const Vec2& x);

/// The discs that touch a, b and c on their free sides (problem of Apollonius): at most two, written to out.
int touching(const Curve& a, const Curve& b, const Curve& c, Disc* out);

/// Newton steps until the disc touches two (its radius kept) or three curves to rounding.
void polish(std::span<const Curve> touched, Disc& disc);

}  // namespace breccia::tangent_discs
