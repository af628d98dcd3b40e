// SPDX-License-Identifier: BSD-3-Clause
#include "workflow/materials.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "config/places.hpp"
#include "engine/counter_random.hpp"

namespace breccia {
namespace {

std::uint8_t number_of(const std::string& name, const std::vector<Material>& materials) {
  const auto at = std::find_if(materials.begin(), materials.end(), [&](const Material& m) { return m.name == name; });
  BRECCIA_ASSERT(at != materials.end());  // the workflow was checked
  return std::uint8_t(at - materials.begin());
}

/// Gives parts of the given volumes to the materials in random order, to each with a chance that goes by what it still
/// lacks of its share: the shares come out to within about one part.
std::vector<std::uint8_t> by_shares(const ByName<double>& shares, const std::vector<Material>& materials,
                                    const std::vector<double>& volume, std::uint64_t seed, const char* use) {
  const double total = std::accumulate(volume.begin(), volume.end(), 0.0);
  std::vector<Index> order(volume.size());
  std::iota(order.begin(), order.end(), Index(0));
  const std::uint64_t stream = stream_of(use);
  std::vector<double> key(volume.size());
  for (Index k = 0; k < key.size(); ++k) key[k] = uniform(seed, stream, k, 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key[a] < key[b]; });
  std::vector<std::uint8_t> of(volume.size());
  std::vector<double> due(shares.size());
  for (std::size_t m = 0; m < due.size(); ++m) due[m] = shares[m].second * total;
  for (const Index k : order) {
    double left = 0;
    for (const double d : due) left += std::max(d, 0.0);
    double at = uniform(seed, stream, k, 1) * left;
    std::size_t chosen = std::size_t(std::max_element(due.begin(), due.end()) - due.begin());
    for (std::size_t m = 0; m < due.size(); ++m) {
      if (due[m] <= 0) continue;
      if (at < due[m]) {
        chosen = m;
        break;
      }
      at -= due[m];
    }
    of[k] = number_of(shares[chosen].first, materials);
    due[chosen] -= volume[k];
  }
  return of;
}

/// The nearest of random points, in a grid with about one point a cell.
std::vector<Index> voronoi_cells(const PackedParticles& p, const Space& space, double size, std::uint64_t seed,
                                 std::size_t& cells) {
  Vec3 low = p.position.front(), high = low;
  for (const Vec3& x : p.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  for (int c = 0; c < 3; ++c) {
    if (space.cell.repeats(c)) {  // no surface
      high[c] = low[c] + space.cell.vectors()(c, c);
      continue;
    }
    low[c] -= 0.5 * size;  // cells at the surface are as large as those within
    high[c] += 0.5 * size;
  }
  const bool flat = space.dimension == 2;
  const Vec3 extent = high - low;
  const double cell_volume = flat ? std::numbers::pi / 4 * size * size : std::numbers::pi / 6 * size * size * size;
  const double volume = extent.x() * extent.y() * (flat ? 1.0 : extent.z());
  constexpr double most = 100;  // grains a particle: each particle is its own grain long before
  if (volume / cell_volume > most * double(p.position.size()))
    throw AtPath(
        "material_of.grains.size",
        "material_of.grains.size: the grains would be far smaller than the particles: is its unit right? Particle by "
        "particle: `shares`");
  const Index points = Index(std::max(1.0, std::round(volume / cell_volume)));
  const std::uint64_t stream = stream_of("grain centres");
  std::vector<Vec3> centre(points);
  for (Index k = 0; k < points; ++k)
    for (std::uint32_t c = 0; c < 3; ++c)
      centre[k][c] = flat && c == 2 ? 0.0 : low[c] + extent[c] * uniform(seed, stream, k, c);
  const double width = std::pow(volume / points, flat ? 0.5 : 1.0 / 3);
  std::array<long, 3> count{};
  for (int c = 0; c < 3; ++c) count[c] = flat && c == 2 ? 1 : std::max(1L, long(extent[c] / width));
  const auto cell_of = [&](const Vec3& x) {
    std::array<long, 3> at{};
    for (int c = 0; c < 3; ++c)
      if (count[c] > 1) at[c] = std::clamp(long((x[c] - low[c]) / extent[c] * double(count[c])), 0L, count[c] - 1);
    return at;
  };
  // The cells of the grid a ring away: past a face of a space that repeats itself come those at the other.
  const auto first = [&](int c, long at) { return space.cell.repeats(c) ? at : std::max(0L, at); };
  const auto last = [&](int c, long at) { return space.cell.repeats(c) ? at : std::min(count[c] - 1, at); };
  const auto folded = [&](int c, long at) { return (at % count[c] + count[c]) % count[c]; };
  std::vector<std::vector<Index>> in(std::size_t(count[0] * count[1] * count[2]));
  const auto row = [&](long x, long y, long z) { return std::size_t((z * count[1] + y) * count[0] + x); };
  for (Index k = 0; k < points; ++k) {
    const auto at = cell_of(centre[k]);
    in[row(at[0], at[1], at[2])].push_back(k);
  }
  double narrowest = extent.maxCoeff();
  for (int c = 0; c < (flat ? 2 : 3); ++c) narrowest = std::min(narrowest, extent[c] / double(count[c]));
  std::vector<Index> nearest(p.position.size());
  for (std::size_t k = 0; k < nearest.size(); ++k) {
    const auto at = cell_of(p.position[k]);
    double least = std::numeric_limits<double>::infinity();
    const long widest = std::max({count[0], count[1], count[2]});
    for (long ring = 0; ring <= widest; ++ring) {
      // What lies beyond this ring is at least so far away.
      if (ring > 0 && std::sqrt(least) <= double(ring - 1) * narrowest) break;
      for (long z = first(2, at[2] - ring); z <= last(2, at[2] + ring); ++z)
        for (long y = first(1, at[1] - ring); y <= last(1, at[1] + ring); ++y)
          for (long x = first(0, at[0] - ring); x <= last(0, at[0] + ring); ++x) {
            if (std::max({std::abs(x - at[0]), std::abs(y - at[1]), std::abs(z - at[2])}) != ring) continue;
            for (const Index g : in[row(folded(0, x), folded(1, y), folded(2, z))])
              if (const double d = space.branch(p.position[k], centre[g]).squaredNorm(); d < least) {
                least = d;
                nearest[k] = g;
              }
          }
    }
  }
  cells = points;
  return nearest;
}

std::vector<std::uint8_t> by_grains(const GrainsConfig& way, const std::vector<Material>& materials,
                                    const PackedParticles& p, const Space& space, std::uint64_t seed) {
  std::size_t cells = 0;
  const std::vector<Index> cell = voronoi_cells(p, space, way.size, seed, cells);
  // Only the grains that have particles are given out, by the volume of these.
  std::vector<double> volume(cells, 0.0);
  for (std::size_t k = 0; k < cell.size(); ++k) volume[cell[k]] += space.solid_volume(p.radius[k]);
  const std::vector<std::uint8_t> of_cell = by_shares(way.shares, materials, volume, seed, "grains");
  std::vector<std::uint8_t> of(cell.size());
  for (std::size_t k = 0; k < of.size(); ++k) of[k] = of_cell[cell[k]];
  return of;
}

/// A region with the surface that its file holds.
class Region {
 public:
  Region(const RegionConfig& config, const Space& space, std::size_t number) : config_(config) {
    if (!config.mesh) return;
    const auto fail = [&](const char* key, const std::string& text) {
      throw AtPath("material_of.regions[" + std::to_string(number) + "].mesh" + key, text);
    };
    if (space.dimension == 2) fail("", "a mesh is a region of three dimensions: use a box or a sphere");
    if (!has_ending(config.mesh->file, ".stl"))
      fail(".file", "the mesh of a region is read from an .stl file, not from " + config.mesh->file.string());
    try {
      surface_ = std::make_shared<const ClosedSurface>(
          closed_surface(read_stl(config.mesh->file, config.mesh->length_unit), config.mesh->file));
    } catch (const UserError& e) { fail(".file", e.what()); }
  }
  bool holds(const Vec3& x) const {
    if (!surface_) return config_.holds(x);
    if ((x.array() < surface_->low().array()).any() || (x.array() > surface_->high().array()).any()) return false;
    Vec3 inward;
    return surface_->depth(x, inward) >= 0;
  }

 private:
  const RegionConfig& config_;
  std::shared_ptr<const ClosedSurface> surface_;
};

std::vector<std::uint8_t> by_column(const ColumnConfig& way, const std::vector<Material>& materials,
                                    const PackedParticles& p) {
  const auto column =
      std::find_if(p.columns.begin(), p.columns.end(), [&](const auto& c) { return c.first == way.name; });
  if (column == p.columns.end()) {
    std::string known;
    for (const auto& c : p.columns) known += (known.empty() ? "`" : ", `") + c.first + "`";
    throw AtPath("material_of.column.name",
                 "material_of.column.name: the packing has no column `" + way.name + "`; " +
                     (known.empty() ? "it has none but positions and radii" : "it has " + known));
  }
  std::vector<std::uint8_t> of;
  for (std::size_t k = 0; k < column->second.size(); ++k) {
    const double value = column->second[k];
    const auto at =
        std::find_if(way.values.begin(), way.values.end(), [&](const auto& v) { return v.second == value; });
    if (at == way.values.end()) {
      char text[32];
      std::snprintf(text, sizeof text, "%.10g", value);
      throw AtPath("material_of.column.values", "material_of.column.values: none is " + std::string(text) +
                                                    ", which column `" + way.name + "` has for particle " +
                                                    std::to_string(k));
    }
    of.push_back(number_of(at->first, materials));
  }
  return of;
}

}  // namespace

std::vector<std::uint8_t> assign_materials(const MaterialOfConfig& way, const std::vector<Material>& materials,
                                           const PackedParticles& p, const Space& space, std::uint64_t seed) {
  if (p.position.empty()) return {};  // said by who makes particles of it
  if (way.column) return by_column(*way.column, materials, p);
  if (way.grains) return by_grains(*way.grains, materials, p, space, seed);
  if (way.shares) {
    std::vector<double> volume;
    for (const double r : p.radius) volume.push_back(space.solid_volume(r));
    return by_shares(*way.shares, materials, volume, seed, "materials");
  }
  std::vector<Region> regions;
  if (way.regions)
    for (std::size_t r = 0; r < way.regions->size(); ++r) regions.emplace_back((*way.regions)[r], space, r);
  std::vector<std::uint8_t> of(p.position.size());
  for (std::size_t k = 0; k < of.size(); ++k) {
    const std::string* name = nullptr;
    if (way.sizes) {
      for (const SizeClassConfig& c : *way.sizes)
        if (!name && (!c.up_to || p.radius[k] <= *c.up_to)) name = &c.material;
    } else if (way.regions) {
      name = &*way.elsewhere;
      for (std::size_t r = way.regions->size(); r-- > 0;)
        if (regions[r].holds(p.position[k])) name = &(*way.regions)[r].material;
    } else {
      const LayersConfig& layers = *way.layers;
      const double period = std::accumulate(layers.thicknesses.begin(), layers.thicknesses.end(), 0.0);
      double at = (p.position[k] - layers.origin).dot(layers.normal());
      at -= period * std::floor(at / period);
      std::size_t layer = 0;
      while (layer + 1 < layers.thicknesses.size() && at >= layers.thicknesses[layer])
        at -= layers.thicknesses[layer++];
      name = &layers.materials[layer];
    }
    of[k] = number_of(*name, materials);
  }
  return of;
}

}  // namespace breccia
