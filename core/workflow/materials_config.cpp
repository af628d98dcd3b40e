// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include "workflow/materials.hpp"

namespace breccia {

void MaterialConfig::describe(Schema<MaterialConfig>& s) {
  s.param("density", &MaterialConfig::density).unit("kg/m3").above(0).example("2650 kg/m3").doc("of the particles");
}

void SizeClassConfig::describe(Schema<SizeClassConfig>& s) {
  s.param("material", &SizeClassConfig::material).example("quartz").doc("of the particles of this class");
  s.param("up_to", &SizeClassConfig::up_to)
      .unit("m")
      .above(0)
      .example("1 mm")
      .doc("radius up to which particles belong to it that belong to no class before; the last has none");
}

void BoxConfig::describe(Schema<BoxConfig>& s) {
  s.param("from", &BoxConfig::from).unit("m").example("[0 mm, 0 mm, 0 mm]").doc("its lowest corner");
  s.param("to", &BoxConfig::to).unit("m").example("[10 mm, 10 mm, 20 mm]").doc("its highest corner");
}

void SphereConfig::describe(Schema<SphereConfig>& s) {
  s.param("centre", &SphereConfig::centre).unit("m").example("[0 mm, 0 mm, 10 mm]").doc("in the packing's coordinates");
  s.param("radius", &SphereConfig::radius).unit("m").above(0).example("5 mm").doc("of the sphere, in the plane a disc");
}

void CylinderConfig::describe(Schema<CylinderConfig>& s) {
  s.param("from", &CylinderConfig::from).unit("m").example("[0 mm, 0 mm, 0 mm]").doc("where its axis begins");
  s.param("to", &CylinderConfig::to).unit("m").example("[0 mm, 0 mm, 20 mm]").doc("where it ends");
  s.param("radius", &CylinderConfig::radius).unit("m").above(0).example("5 mm").doc("about the axis");
}

void HalfSpaceConfig::describe(Schema<HalfSpaceConfig>& s) {
  s.param("point", &HalfSpaceConfig::point).unit("m").example("[0 mm, 0 mm, 10 mm]").doc("of its bounding plane");
  s.param("normal", &HalfSpaceConfig::normal)
      .example("[0, 0, 1]")
      .doc("of that plane, into the half-space; of any length");
}

void RegionConfig::describe(Schema<RegionConfig>& s) {
  s.param("material", &RegionConfig::material).example("quartz").doc("of the particles whose centres are in it");
  s.param("box", &RegionConfig::box).doc("along the coordinate axes");
  s.param("sphere", &RegionConfig::sphere).doc("a sphere");
  s.param("cylinder", &RegionConfig::cylinder).doc("a cylinder with flat ends");
  s.param("half_space", &RegionConfig::half_space).doc("all on one side of a plane");
  s.param("mesh", &RegionConfig::mesh).doc("the inside of a closed surface, in three dimensions");
  s.exactly_one_of({"box", "sphere", "cylinder", "half_space", "mesh"});
}

bool RegionConfig::holds(const Vec3& p) const {
  if (box) return (p.array() >= box->from.array()).all() && (p.array() <= box->to.array()).all();
  if (sphere) return (p - sphere->centre).norm() <= sphere->radius;
  if (half_space) return (p - half_space->point).dot(half_space->normal) >= 0;
  const Vec3 axis = cylinder->to - cylinder->from;
  const double along = (p - cylinder->from).dot(axis) / axis.squaredNorm();
  return along >= 0 && along <= 1 && (p - cylinder->from - along * axis).norm() <= cylinder->radius;
}

void LayersConfig::describe(Schema<LayersConfig>& s) {
  s.param("materials", &LayersConfig::materials)
      .items(2, SIZE_MAX)
      .example("[sandstone, shale]")
      .doc("from the origin along the normal, again and again in this order");
  s.param("thicknesses", &LayersConfig::thicknesses)
      .unit("m")
      .above(0)
      .items(2, SIZE_MAX)
      .example("[5 mm, 2 mm]")
      .doc("of the layers, as many as there are materials");
  s.param("dip", &LayersConfig::dip)
      .unit("rad")
      .at_least(0)
      .at_most(3.15)
      .fallback(0.0)
      .doc("angle of the layers to the plane z = const");
  s.param("dip_direction", &LayersConfig::dip_direction)
      .unit("rad")
      .fallback(0.0)
      .doc("azimuth of the steepest way down, from y (north) toward x (east)");
  s.param("origin", &LayersConfig::origin)
      .unit("m")
      .fallback({0.0, 0.0, 0.0})
      .doc("where the first layer begins, in the packing's coordinates");
}

Vec3 LayersConfig::normal() const {
  return {std::sin(dip) * std::sin(dip_direction), std::sin(dip) * std::cos(dip_direction), std::cos(dip)};
}

namespace {

void check_shares(const ByName<double>& shares, const std::string& where, Issues& issues) {
  const double sum =
      std::accumulate(shares.begin(), shares.end(), 0.0, [](double s, const auto& one) { return s + one.second; });
  if (std::abs(sum - 1) > 1e-6) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", 100 * sum);
    issues.push_back({where, std::string("the shares add up to ") + text + " %, not to 100 %"});
  }
}

}  // namespace

void GrainsConfig::describe(Schema<GrainsConfig>& s) {
  s.param("size", &GrainsConfig::size)
      .unit("m")
      .above(0)
      .example("4 mm")
      .doc("mean diameter of the grains: of the sphere (in the plane the disc) as large as the mean cell");
  s.param("shares", &GrainsConfig::shares)
      .at_least(0)
      .at_most(1)
      .items(1, SIZE_MAX)
      .example("{quartz: 35 %, feldspar: 65 %}")
      .doc("of the solid volume, given out grain by grain");
}

void ColumnConfig::describe(Schema<ColumnConfig>& s) {
  s.param("name", &ColumnConfig::name).example("mineral").doc("of the column in the packing's file");
  s.param("values", &ColumnConfig::values)
      .items(1, SIZE_MAX)
      .example("{quartz: 1, feldspar: 2}")
      .doc("what stands in it for each material");
}

void MaterialOfConfig::describe(Schema<MaterialOfConfig>& s) {
  s.param("shares", &MaterialOfConfig::shares)
      .at_least(0)
      .at_most(1)
      .items(1, SIZE_MAX)
      .example("{quartz: 35 %, feldspar: 65 %}")
      .doc("of the solid volume, particle by particle at random");
  s.param("sizes", &MaterialOfConfig::sizes).items(2, SIZE_MAX).doc("by the particles' radii, from small to large");
  s.param("regions", &MaterialOfConfig::regions)
      .items(1, SIZE_MAX)
      .doc("by where a particle's centre is: in the first region that holds it, else `elsewhere`");
  s.param("layers", &MaterialOfConfig::layers).doc("parallel layers");
  s.param("grains", &MaterialOfConfig::grains)
      .doc("cells of a Voronoi diagram of random points, each of one material with all its particles");
  s.param("column", &MaterialOfConfig::column).doc("as a column of the packing's file says");
  s.param("elsewhere", &MaterialOfConfig::elsewhere).example("quartz").doc("outside of all regions");
  s.exactly_one_of({"shares", "sizes", "regions", "layers", "grains", "column"});
  s.check([](const MaterialOfConfig& c, Issues& issues) {
    if (c.shares) check_shares(*c.shares, "shares", issues);
    if (c.regions && !c.elsewhere)
      issues.push_back({"elsewhere", "is missing: which material is outside of all regions"});
    if (!c.regions && c.elsewhere) issues.push_back({"elsewhere", "goes with `regions`"});
    if (c.sizes)
      for (std::size_t k = 0; k < c.sizes->size(); ++k) {
        const std::string where = "sizes[" + std::to_string(k) + "].up_to";
        const bool last = k + 1 == c.sizes->size();
        const auto& one = (*c.sizes)[k].up_to;
        const double before = k ? (*c.sizes)[k - 1].up_to.value_or(0) : 0;
        if (!last && !one) issues.push_back({where, "is missing: only the last class is without"});
        if (last && one) issues.push_back({where, "must not stand with the last class: it takes all that are larger"});
        if (one && *one <= before) issues.push_back({where, "must be above that of the class before"});
      }
    if (c.regions)
      for (std::size_t k = 0; k < c.regions->size(); ++k) {
        const RegionConfig& r = (*c.regions)[k];
        const std::string where = "regions[" + std::to_string(k) + "]";
        if (r.box && !(r.box->from.array() < r.box->to.array()).all())
          issues.push_back({where + ".box.to", "must be above `from` in all directions"});
        if (r.half_space && !(r.half_space->normal.norm() > 0))
          issues.push_back({where + ".half_space.normal", "must not be zero"});
        if (r.cylinder && r.cylinder->from == r.cylinder->to)
          issues.push_back({where + ".cylinder.to", "must be another point than `from`"});
      }
    if (c.layers && c.layers->materials.size() != c.layers->thicknesses.size())
      issues.push_back({"layers.thicknesses",
                        "must be as many as there are materials, " + std::to_string(c.layers->materials.size())});
    if (c.grains) check_shares(c.grains->shares, "grains.shares", issues);
  });
}

std::vector<std::pair<std::string, std::string>> MaterialOfConfig::names() const {
  std::vector<std::pair<std::string, std::string>> all;
  const auto by_name = [&](const ByName<double>& of, const std::string& where) {
    for (const auto& [name, value] : of) all.emplace_back(name, where + "." + name);
  };
  if (shares) by_name(*shares, "shares");
  if (grains) by_name(grains->shares, "grains.shares");
  if (column) by_name(column->values, "column.values");
  if (elsewhere) all.emplace_back(*elsewhere, "elsewhere");
  const auto each = [&](const auto& list, const std::string& where) {
    for (std::size_t k = 0; k < list.size(); ++k)
      all.emplace_back(list[k].material, where + "[" + std::to_string(k) + "].material");
  };
  if (sizes) each(*sizes, "sizes");
  if (regions) each(*regions, "regions");
  if (layers)
    for (std::size_t k = 0; k < layers->materials.size(); ++k)
      all.emplace_back(layers->materials[k], "layers.materials[" + std::to_string(k) + "]");
  return all;
}

}  // namespace breccia
