// SPDX-License-Identifier: BSD-3-Clause
#include "cut.hpp"

#include <random>

#include "report.hpp"

namespace breccia::collective_rearrangement {

namespace {
constexpr int places = 1000;

/// `depth`: of each sphere where the region is not moved. Only near the boundary a move can matter.
std::vector<std::size_t> inside(const Spheres& all, const std::vector<double>& depth, const Region& region,
                                const Vec3& place) {
  std::vector<std::size_t> kept;
  const double moved = place.norm();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (depth[i] > moved || (depth[i] >= -moved && region.depth(all.x[i] - place) >= 0)) kept.push_back(i);
  return kept;
}

Spheres taken(const Spheres& all, const std::vector<std::size_t>& kept, const Vec3& place) {
  Spheres s;
  for (const std::size_t i : kept) {
    s.x.push_back(all.x[i] - place);
    s.r.push_back(all.r[i]);
  }
  return s;
}
}  // namespace

Cut cut_out(const Spheres& all, const Region& region, double margin, bool ends, int dimension, std::size_t wanted,
            double wanted_solid, std::uint64_t seed) {
  std::mt19937_64 generator(seed + 1);
  const auto uniform = [&] { return 2 * double(generator() >> 11) * 0x1p-53 - 1; };
  const Vec3 axis = region.axis();
  std::vector<double> depth(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) depth[i] = region.depth(all.x[i]);
  Cut best;
  std::size_t best_miss = all.size() + 1;
  double best_solid = 0, mean_number = 0;
  for (int k = 0; k < places; ++k) {
    Vec3 place = 0.5 * margin * Vec3(uniform(), uniform(), uniform()) / std::sqrt(3.0);
    if (dimension == 2) place.z() = 0;
    if (!ends) place -= place.dot(axis) * axis;
    const std::vector<std::size_t> kept = inside(all, depth, region, place);
    mean_number += double(kept.size()) / places;
    const std::size_t miss = kept.size() > wanted ? kept.size() - wanted : wanted - kept.size();
    if (miss > best_miss) continue;
    Spheres s = taken(all, kept, place);
    const double solid = std::abs(solid_measure(s.r, dimension) - wanted_solid);
    if (miss == best_miss && solid >= best_solid) continue;
    best.spheres = std::move(s);
    best_miss = miss;
    best_solid = solid;
  }
  best.mean_number = mean_number;
  return best;
}

Spheres cut_at(const Spheres& all, const Region& region, const Vec3& place) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (region.depth(all.x[i] - place) >= 0) kept.push_back(i);
  return taken(all, kept, place);
}

}  // namespace breccia::collective_rearrangement
