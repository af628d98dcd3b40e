// SPDX-License-Identifier: BSD-3-Clause
#include "quality.hpp"

#include <algorithm>
#include <cmath>

#include "size_correlation.hpp"

namespace breccia::labra_onate {

namespace {

void measure_radii(const std::vector<double>& r, Quality& q) {
  for (const double x : r) q.radius_mean += x / double(r.size());
  double square = 0;
  for (const double x : r) square += (x - q.radius_mean) * (x - q.radius_mean);
  q.radius_deviation = std::sqrt(square / double(r.size()));
  q.radius_min = *std::min_element(r.begin(), r.end());
  q.radius_max = *std::max_element(r.begin(), r.end());
}

void measure_pairs(const Spheres& s, const NeighbourSet& set, Quality& q) {
  q.neighbours = 2 * double(set.pairs()) / double(s.size());
  if (set.pairs() == 0) return;
  std::size_t overlaps = 0, gaps = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    for (const Index j : set.row(i)) {
      if (j < i) continue;
      const Vec3 d = s.x[j] - s.x[i];
      const double gap = d.norm() / (s.r[i] + s.r[j]) - 1;
      if (gap < 0) {
        ++overlaps;
        q.mean_overlap -= gap;
        q.max_overlap = std::max(q.max_overlap, -gap);
      } else {
        ++gaps;
        q.mean_gap += gap;
        q.max_gap = std::max(q.max_gap, gap);
      }
      q.misfit += gap * gap;
      if (d.squaredNorm() > 0) q.fabric += d.cwiseAbs2() / d.squaredNorm();
    }
  }
  q.mean_overlap /= double(std::max<std::size_t>(overlaps, 1));
  q.mean_gap /= double(std::max<std::size_t>(gaps, 1));
  q.misfit = std::sqrt(q.misfit / double(set.pairs()));
  q.fabric /= double(set.pairs());
}

void measure_walls(const Spheres& s, const Container& box, const NeighbourSet& set, Quality& q) {
  std::size_t tangent = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    std::array<WallDistance, Container::max_walls> walls;
    const std::size_t count = box.walls(s.x[i], walls);
    bool near = false, touches = true;
    for (std::size_t w = 0; w < count; ++w) {
      const double gap = walls[w].distance / s.r[i] - 1;
      if (gap > std::max(set.tolerance, NeighbourFinder::wall_gap)) continue;
      near = true;
      const bool here = std::abs(gap) < 1e-3;
      touches = touches && here;
      q.touching[w] += here ? 1 : 0;
    }
    q.at_wall += near ? 1 : 0;
    tangent += near && touches ? 1 : 0;
  }
  q.tangent = q.at_wall > 0 ? double(tangent) / double(q.at_wall) : 0;
}

}  // namespace

Quality measure(const Spheres& s, const Container& box, const NeighbourSet& set) {
  Quality q;
  q.porosity = 1 - solid_measure(s.r, box.dimension()) / box.measure();
  q.tolerance = set.tolerance;
  measure_radii(s.r, q);
  measure_pairs(s, set, q);
  q.size_correlation = size_correlation(s, set);
  measure_walls(s, box, set, q);
  return q;
}

std::vector<AskedGot> report(const Quality& q, const Config& c, const RadiusLaw& law, double factor, double neighbours,
                             const Container& box, std::size_t particles) {
  const auto asked_particles = c.particles ? std::optional<double>(double(*c.particles)) : std::nullopt;
  std::vector<AskedGot> lines = {
      {"particles", "1", asked_particles, double(particles)},
      {"porosity", "1", c.porosity, q.porosity},
      {"radius_mean", "m", law.mean, q.radius_mean},
      {"radius_standard_deviation", "m", law.standard_deviation, q.radius_deviation},
      {"radius_min", "m", law.min, q.radius_min},
      {"radius_max", "m", law.max, q.radius_max},
      {"radius_factor", "1", 1.0, factor},
      {"neighbours_per_particle", "1", neighbours, q.neighbours},
      {"neighbour_tolerance", "1", std::nullopt, q.tolerance},
      {"mean_overlap", "1", std::nullopt, q.mean_overlap},
      {"max_overlap", "1", std::nullopt, q.max_overlap},
      {"mean_gap", "1", std::nullopt, q.mean_gap},
      {"max_gap", "1", std::nullopt, q.max_gap},
      {"rms_gap_or_overlap", "1", std::nullopt, q.misfit},
      {"neighbour_size_correlation", "1", c.neighbour_size_correlation, q.size_correlation},
      {"fabric_xx", "1", std::nullopt, q.fabric.x()},
      {"fabric_yy", "1", std::nullopt, q.fabric.y()},
      {"fabric_zz", "1", std::nullopt, q.fabric.z()},
      {"particles_at_walls", "1", std::nullopt, double(q.at_wall)},
      {"tangent_share_at_walls", "1", 1.0, q.tangent},
  };
  if (const auto lower = box.lower_end()) {
    lines.push_back({"particles_on_lower_end", "1", std::nullopt, double(q.touching[*lower])});
    lines.push_back({"particles_on_upper_end", "1", std::nullopt, double(q.touching[*lower + 1])});
  }
  return lines;
}

}  // namespace breccia::labra_onate
