// SPDX-License-Identifier: BSD-3-Clause
#include "check/law_ways.hpp"

#include <fmt/format.h>

#include <cmath>

namespace breccia {

Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> n;
  return Vec3(n(random), n(random), n(random)).normalized();
}

Vec3 in_plane(const Vec3& vector, int dimension) { return dimension == 2 ? Vec3(vector.x(), vector.y(), 0) : vector; }

Vec3 about_plane(const Vec3& axis, int dimension) { return dimension == 2 ? Vec3(0, 0, axis.z()) : axis; }

std::vector<Way> ways(bool bonded, int dimension) {
  std::mt19937_64 random(7);
  std::vector<Way> all;
  if (bonded) all.push_back({"tension", Vec3(1, 0, 0)});
  all.push_back({"compression", Vec3(-1, 0, 0)});
  const double pressed = bonded ? 0 : -0.3;  // what is not bonded must be pressed
  for (int k = 0; k < 3; ++k) {
    const double angle = 0.4 + 2.1 * k;
    const Vec3 across(0, std::cos(angle), std::sin(angle));
    all.push_back(
        {fmt::format("shear along (0, {:.2f}, {:.2f})", across.y(), across.z()), across + Vec3(pressed, 0, 0)});
    all.push_back({fmt::format("bending about (0, {:.2f}, {:.2f})", across.y(), across.z()), Vec3(pressed, 0, 0),
                   -across, across});
  }
  if (dimension == 3) all.push_back({"twist", Vec3(pressed, 0, 0), Vec3(-1, 0, 0), Vec3(1, 0, 0)});
  for (int k = 0; k < 4; ++k) {
    Vec3 shift = random_direction(random);
    if (!bonded) shift.x() = -std::abs(shift.x());
    all.push_back(
        {fmt::format("motion of all kinds, no. {}", k + 1), shift, random_direction(random), random_direction(random)});
  }
  for (Way& w : all) {
    w.bonded = bonded;
    w.shift = in_plane(w.shift, dimension);
    w.turn_i = about_plane(w.turn_i, dimension);
    w.turn_j = about_plane(w.turn_j, dimension);
  }
  return all;
}

std::string bonded_text(bool bonded) { return bonded ? "bonded pair" : "contact without a bond"; }

PairMotion motion(const Way& way, double amplitude, double share, double dt) {
  PairMotion m;
  const double rate = amplitude * share / dt;
  m.velocity_j = rate * checked_radius * way.shift;
  m.spin_i = rate * way.turn_i;
  m.spin_j = rate * way.turn_j;
  return m;
}

}  // namespace breccia
