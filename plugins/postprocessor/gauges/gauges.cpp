// SPDX-License-Identifier: BSD-3-Clause
/// Strain gauges as in the laboratory: a few particles on each side, and two sections along the axis.
/// Source: Ouyang, Yang & Chen (2017), Appl. Sci. 7(7), 686, section 2.4 (lateral: four particles nearest each side's
/// mid-point); the axial gauge is ours.
#include <algorithm>
#include <numeric>

#include "breccia/postprocessor.hpp"

namespace breccia {

class Gauges final : public Postprocessor {
 public:
  struct Config {
    int particles;
    double axial_length;
  };
  static void describe(Schema<Config>& s) {
    s.summary("Lateral strain from the particles nearest the sides' mid-points, axial strain between two sections")
        .source("Ouyang et al. (2017), section 2.4: four particles nearest each side's mid-point")
        .details(
            "`gauge_lateral_strain`: change of the mean distance, across the axis, of two groups of particles on "
            "opposite sides, over "
            "that distance at the start of loading; in three dimensions the mean of two such pairs at right angles. "
            "Positive in "
            "extension. `gauge_axial_strain`: the same along the axis between two sections of the specimen, "
            "`axial_length` of its "
            "height apart about the middle, each a layer as thick as two mean diameters. Positive in compression.");
    s.param("particles", &Config::particles).at_least(1).at_most(1000).fallback(4).doc("in each group on a side");
    s.param("axial_length", &Config::axial_length)
        .above(0)
        .below(1)
        .fallback(0.5)
        .doc("distance of the two sections over the height");
  }

  explicit Gauges(const Config& config) : c_(config) {}

  void begin(const SimulationView& view, Recorder& recorder, Host&) override {
    if (view.cell.repeats())
      throw UserError(
          "gauges: where space repeats itself (`periodic`) a specimen has no outline to measure strain within: use the "
          "strain of the cell, which the protocol periodic_cell writes");
    lateral_ = recorder.add(
        {"gauge_lateral_strain", "1", "between particles nearest the sides' mid-points, positive in extension"});
    axial_ = recorder.add({"gauge_axial_strain", "1", "between two sections along the axis, positive in compression"});
    refer(view);
  }
  void start_of_loading(const SimulationView& view) override { refer(view); }

  void sample(const SimulationView& view, Recorder& recorder) override {
    double across = 0;
    for (const Gauge& g : across_) across += strain(view, g) / double(across_.size());
    recorder.set(lateral_, across);
    recorder.set(axial_, -strain(view, along_));
  }

  void finish(const SimulationView&, const Curves&, Summary& summary) override {
    Json lateral = Json::array();
    for (const Gauge& g : across_) lateral.push_back(g.length);
    summary.own({"lateral_gauge_lengths", "m"}, lateral);
    summary.own({"axial_gauge_length", "m"}, along_.length);
    summary.own("axial_gauge_particles", Json{{"lower", along_.low.size()}, {"upper", along_.high.size()}});
  }
  bool archive(Archive& archive) override {
    archive("across", across_);
    archive("along", along_);
    return true;
  }

 private:
  /// Two groups of particles and the direction from one to the other.
  struct Gauge {
    Vec3 direction = Vec3::Zero();
    std::vector<Index> low, high;
    double length = 0;  ///< at the start of loading [m]
    void archive(Archive& archive) {
      archive("direction", direction);
      archive("low", low);
      archive("high", high);
      archive("length", length);
    }
  };

  static double distance(Strided<const Vec3> x, const Gauge& g) {
    const auto mean = [&](const std::vector<Index>& group) {
      double sum = 0;
      for (const Index k : group) sum += x[k].dot(g.direction);
      return sum / double(group.size());
    };
    return mean(g.high) - mean(g.low);
  }
  static double strain(const SimulationView& view, const Gauge& g) {
    return distance(view.particles.position, g) / g.length - 1;
  }

  /// Groups and lengths as they are where displacements are counted from.
  void refer(const SimulationView& view) {
    const Strided<const Vec3> x = view.particles.initial_position;
    const SpecimenShape& s = view.specimen;
    const Vec3 middle = s.base + 0.5 * s.height * s.axis;
    across_.clear();
    for (const Vec3& side : cross_directions(s.axis, view.dimension)) {
      // The bounding box has its sides along x, y, z; a cylinder is as wide in all directions across its axis.
      const double half = 0.5 * side.cwiseAbs().dot(s.extent);
      across_.push_back(
          checked({side, nearest(x, middle - half * side), nearest(x, middle + half * side), 0}, x, "lateral"));
    }
    const double radius =
        std::accumulate(view.particles.radius.begin(), view.particles.radius.end(), 0.0) / double(x.size());
    const double half = 0.5 * c_.axial_length * s.height;
    const auto layer = [&](double height) {
      std::vector<Index> group;
      for (Index k = 0; k < x.size(); ++k)
        if (std::abs((x[k] - middle).dot(s.axis) - height) <= 2 * radius) group.push_back(k);
      return group;
    };
    along_ = checked({s.axis, layer(-half), layer(half), 0}, x, "axial");
  }

  static Gauge checked(Gauge g, Strided<const Vec3> x, const char* which) {
    if (!g.low.empty() && !g.high.empty()) g.length = distance(x, g);
    if (!(g.length > 0))
      throw UserError(std::string("postprocessor gauges: the specimen has too few particles for the ") + which +
                      " gauge");
    return g;
  }

  /// One direction across the axis in two dimensions, else two, along x, y or z where the axis is.
  static std::vector<Vec3> cross_directions(const Vec3& axis, int dimension) {
    if (dimension == 2) return {Vec3(axis.y(), -axis.x(), 0)};
    Eigen::Index most = 0;
    axis.cwiseAbs().maxCoeff(&most);
    const Vec3 first = axis.cross(Vec3::Unit((most + 2) % 3)).normalized();
    return {first, axis.cross(first)};
  }

  std::vector<Index> nearest(Strided<const Vec3> x, const Vec3& point) const {
    std::vector<Index> all(x.size());
    std::iota(all.begin(), all.end(), Index(0));
    const std::size_t n = std::min(all.size(), std::size_t(c_.particles));
    std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(n), all.end(), [&](Index a, Index b) {
      const double da = (x[a] - point).squaredNorm(), db = (x[b] - point).squaredNorm();
      return da < db || (da == db && a < b);
    });
    all.resize(n);
    return all;
  }

  Config c_;
  std::vector<Gauge> across_;
  Gauge along_;
  std::size_t lateral_ = 0, axial_ = 0;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Gauges, "postprocessor", "gauges")
