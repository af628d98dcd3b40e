// SPDX-License-Identifier: BSD-3-Clause
/// The materials of a workflow, and which particle is made of which.
#pragma once

#include <filesystem>
#include <optional>

#include "breccia/packing.hpp"
#include "breccia/packing_tools/triangle_mesh.hpp"
#include "breccia/schema.hpp"
#include "engine/assembly.hpp"

namespace breccia {

struct MaterialConfig {
  double density;
  static void describe(Schema<MaterialConfig>& s);
};

/// Particles up to a radius.
struct SizeClassConfig {
  std::string material;
  std::optional<double> up_to;
  static void describe(Schema<SizeClassConfig>& s);
};

struct BoxConfig {
  Vec3 from, to;
  static void describe(Schema<BoxConfig>& s);
};
struct SphereConfig {
  Vec3 centre;
  double radius;
  static void describe(Schema<SphereConfig>& s);
};
struct CylinderConfig {
  Vec3 from, to;
  double radius;
  static void describe(Schema<CylinderConfig>& s);
};
struct HalfSpaceConfig {
  Vec3 point, normal;
  static void describe(Schema<HalfSpaceConfig>& s);
};

struct RegionConfig {
  std::string material;
  std::optional<BoxConfig> box;
  std::optional<SphereConfig> sphere;
  std::optional<CylinderConfig> cylinder;
  std::optional<HalfSpaceConfig> half_space;
  std::optional<MeshConfig> mesh;
  bool holds(const Vec3& point) const;  ///< of one that is no mesh
  static void describe(Schema<RegionConfig>& s);
};

struct LayersConfig {
  std::vector<std::string> materials;
  std::vector<double> thicknesses;
  double dip, dip_direction;
  Vec3 origin;
  Vec3 normal() const;
  static void describe(Schema<LayersConfig>& s);
};

struct GrainsConfig {
  double size;
  ByName<double> shares;
  static void describe(Schema<GrainsConfig>& s);
};

struct ColumnConfig {
  std::string name;
  ByName<double> values;
  static void describe(Schema<ColumnConfig>& s);
};

/// The section `material_of:`; one of its ways is given.
struct MaterialOfConfig {
  std::optional<ByName<double>> shares;
  std::optional<std::vector<SizeClassConfig>> sizes;
  std::optional<std::vector<RegionConfig>> regions;
  std::optional<LayersConfig> layers;
  std::optional<GrainsConfig> grains;
  std::optional<ColumnConfig> column;
  std::optional<std::string> elsewhere;
  static void describe(Schema<MaterialOfConfig>& s);

  /// Names of materials that it speaks of, with the paths where it does.
  std::vector<std::pair<std::string, std::string>> names() const;
};

/// Gives each particle of the packing its material, by its number in the packing: the same whatever the order or the
/// threads. `materials` by name. UserError when a column lacks or has other values.
std::vector<std::uint8_t> assign_materials(const MaterialOfConfig& way, const std::vector<Material>& materials,
                                           const PackedParticles& packing, const Space& space, std::uint64_t seed);

}  // namespace breccia
