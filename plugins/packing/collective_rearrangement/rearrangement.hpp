// SPDX-License-Identifier: BSD-3-Clause
/// Spheres of given radii pushed apart, all at once, until they overlap as little as they can.
///
/// Energy: 1/2 sum over overlapping pairs of (1 - d/s)^2, s = r_i + r_j. The radii grow from a fraction in steps; at
/// each size the energy is minimised with FIRE (Bitzek et al. 2006, Phys. Rev. Lett. 97, 170201), each sphere with a
/// mass of 1/r^2, so that small and large ones move at the same pace measured in their own radii; a large one among
/// many small ones is heavier by as much as they make it stiffer. Walls are rigid.
///
/// After that the nearest pairs can be drawn together: the same energy over a set of pairs that holds all overlapping
/// ones and those with the smallest gaps, now counting gaps as well (the objective of Labra and Oñate 2009 with the
/// radii kept).
#pragma once

#include <cstdint>
#include <vector>

#include "breccia/services.hpp"
#include "region.hpp"

namespace breccia::collective_rearrangement {

struct Spheres {
  std::vector<Vec3> x;    // [m]
  std::vector<double> r;  // [m]
  std::size_t size() const { return r.size(); }
};

struct Settings {
  int max_iterations = 0;  ///< at the final size
  double tolerance = 0;    ///< ends when 50 iterations lower the energy by less than this share
  int threads = 1;
};

struct Outcome {
  bool converged = false;
  std::size_t iterations = 0;
};

class Rearrangement {
 public:
  /// `space` knows after which lengths it repeats itself.
  Rearrangement(const Region& region, const Space& space, std::vector<double> radii, std::uint64_t seed,
                const Settings& settings, Host& host);
  Outcome run();
  /// Draws this many pairs toward touching each other.
  Outcome close(std::size_t pairs);
  const Spheres& spheres() const { return s_; }

 private:
  Outcome relax(double scale, int max_iterations, double tolerance);
  void find_neighbours();
  void find_mobilities();
  void find_nearest(std::size_t pairs);
  void forces(double scale);
  bool advance(double step, double mixing, double ratio);
  void confine(std::size_t i, const Vec3& wanted);

  const Region& region_;
  const Space& space_;
  Settings settings_;
  Host& host_;
  Spheres s_;
  std::vector<Vec3> velocity_, force_, listed_at_;
  std::vector<std::vector<Index>> near_;
  std::vector<double> energy_of_;
  std::vector<double> mobility_;        // 1/mass, in units in which a pair's energy is a pure number [m2]
  std::vector<double> room_;            // how far a sphere can move before the walls must be looked at again [m]
  std::vector<std::uint8_t> touching_;  // walls that a sphere is to touch, as bits
  double energy_ = 0, largest_energy_ = 0, skin_ = 0;
  bool closing_ = false;  // gaps count too, and `near_` is the set of pairs to be drawn together
};

}  // namespace breccia::collective_rearrangement
