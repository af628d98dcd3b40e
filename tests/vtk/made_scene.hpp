// SPDX-License-Identifier: BSD-3-Clause
/// Specimens of a few spheres whose pictures are known beforehand.
#pragma once

#include "breccia/output.hpp"
#include "plugin_under_test.hpp"
#include "specimen.hpp"

namespace breccia::test {

/// Two frames by the output plugin.
inline void write_frames(const Specimen& specimen, const std::filesystem::path& folder) {
  QuietHost host;
  auto output = make<Output>(BRECCIA_VTK_PLUGIN, {});
  output->begin(folder, host);
  output->frame(specimen.view(0), specimen.fields());
  output->frame(specimen.view(3.2e-3), specimen.fields());
  output->finish();
}

/// Centred about the z axis, from z = 0 upwards.
class MadeScene {
 public:
  MadeScene(SpecimenShape::Outline outline, const Vec3& extent) {
    shape_.outline = outline;
    shape_.height = extent.z();
    shape_.extent = extent;
  }
  void add(const Vec3& at, double r) {
    position.push_back(at);
    displacement.push_back(Vec3::Zero());
    radius_.push_back(r);
  }
  /// Eight that touch the faces of the bounding box.
  void add_corners(double r) {
    const Vec3 half = 0.5 * shape_.extent - Vec3::Constant(r);
    for (int c = 0; c < 8; ++c)
      add({c & 1 ? half.x() : -half.x(), c & 2 ? half.y() : -half.y(),
           0.5 * shape_.height + (c & 4 ? half.z() : -half.z())},
          r);
  }
  void add_wall(const std::string& name, const Vec3& point, const Vec3& normal) {
    walls_.push_back({name, point, normal, Vec3::Zero(), Vec3::Zero(), -1e3 * normal, 1e3, 0, 1});
  }
  /// A bond between the first two spheres that broke in tension, at 1 ms, and released `energy` [J].
  void add_crack(const Vec3& at, const Vec3& normal, double energy = 0) {
    cracks_.push_back({1e-3, at, normal, energy});
  }
  std::size_t size() const { return radius_.size(); }

  /// One frame.
  void write(const std::filesystem::path& folder) const {
    QuietHost host;
    auto output = make<Output>(BRECCIA_VTK_PLUGIN, {});
    output->begin(folder, host);
    write_frame(*output);
    output->finish();
  }
  void write_frame(Output& output) const {
    const std::size_t n = size();
    std::vector<Vec3> initial, none(n, Vec3::Zero());
    std::vector<Index> id;
    for (std::size_t p = 0; p < n; ++p) {
      initial.push_back(position[p] - displacement[p]);
      id.push_back(Index(p));
    }
    SimulationView view;
    view.dimension = dimension;
    view.particles = {position, none, none, initial, none, none, applied, {}, radius_, radius_, held, id, {}};
    const std::vector<Index> first(cracks_.size(), 0), second(cracks_.size(), 1),
        parted(cracks_.size(), BondsView::no_pair);
    std::vector<Index> row;
    for (std::size_t k = 0; k < cracks_.size(); ++k) row.push_back(Index(k));
    const std::vector<double> distance(cracks_.size(), 1e-3);
    const std::vector<BondState> broken(cracks_.size(), BondState::broken_tension);
    view.bonds = {first, second, distance, broken, parted, row, cracks_};
    view.walls = walls_;
    view.specimen = shape_;
    output.frame(view, fields);
  }

  int dimension = 3;
  std::vector<Vec3> position, displacement, applied;
  std::vector<std::uint8_t> held;
  std::vector<Field> fields;

 private:
  SpecimenShape shape_;
  std::vector<double> radius_;
  std::vector<WallView> walls_;
  std::vector<Crack> cracks_;
};

}  // namespace breccia::test
