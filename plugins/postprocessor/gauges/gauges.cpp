// SPDX-License-Identifier: BSD-3-Clause
/// Strain gauges as in the laboratory: a few particles on each side, and two sections along the axis.
/// Source: Ouyang, Yang & Chen (2017), Appl. Sci. 7(7), 686, section 2.4 (lateral: four particles nearest each side's
/// mid-point); the axial gauge is ours.
#include <algorithm>

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
  bool sees_parts() const override { return true; }

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
    for (Gauge& g : across_) across += strain(view, g) / double(across_.size());
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
  /// Particles by their numbers in the packing, ascending; and the rows of those that are own ones.
  class Group {
   public:
    Group() = default;
    explicit Group(std::vector<Index> ids) : ids_(std::move(ids)) { std::sort(ids_.begin(), ids_.end()); }
    std::size_t size() const { return ids_.size(); }
    bool empty() const { return ids_.empty(); }
    void add(const SimulationView& view, Strided<const Vec3> x, const Vec3& direction, ExactSumOf<double>& to) {
      find(view);
      for (const Index row : rows_) to.add(x[row].dot(direction));
    }
    void archive(Archive& archive) {
      archive("ids", ids_);
      own_ = {};
      rows_.clear();
    }

   private:
    /// Anew when particles have changed their places.
    void find(const SimulationView& view) {
      const OwnRows own = view.own_particles();
      const auto& id = view.particles.id;
      const Index first = own.size() > 0 ? id[own.first()] : Index(-1);
      bool same = own.first() == own_.first() && own.behind() == own_.behind() && first == first_;
      for (std::size_t k = 0; same && k < rows_.size(); ++k) same = id[rows_[k]] == found_[k];
      if (same) return;
      own_ = own;
      first_ = first;
      rows_.clear();
      found_.clear();
      for (const std::size_t row : own) {
        if (!std::binary_search(ids_.begin(), ids_.end(), id[row])) continue;
        rows_.push_back(Index(row));
        found_.push_back(id[row]);
      }
    }
    std::vector<Index> ids_, rows_, found_;
    OwnRows own_;
    Index first_ = Index(-1);  ///< id of the first own one
  };

  /// Two groups of particles and the direction from one to the other.
  struct Gauge {
    Vec3 direction = Vec3::Zero();
    Group low, high;
    double length = 0;  ///< at the start of loading [m]
    void archive(Archive& archive) {
      archive("direction", direction);
      archive("low", low);
      archive("high", high);
      archive("length", length);
    }
  };

  static double distance(const SimulationView& view, Strided<const Vec3> x, Gauge& g) {
    ExactSumOf<double> low, high;
    g.low.add(view, x, g.direction, low);
    g.high.add(view, x, g.direction, high);
    const auto [of_low, of_high] = view.sum(low, high);
    return of_high / double(g.high.size()) - of_low / double(g.low.size());
  }
  static double strain(const SimulationView& view, Gauge& g) {
    return distance(view, view.particles.position, g) / g.length - 1;
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
      across_.push_back(checked({side, nearest(view, middle - half * side), nearest(view, middle + half * side), 0},
                                view, "lateral"));
    }
    ExactSumOf<double> radii;
    ExactSumOf<std::size_t> count;
    for (const std::size_t k : view.own_particles()) radii.add(view.particles.radius[k]);
    count.add(view.own_particles().size());
    const auto [sum, all] = view.sum(radii, count);
    const double radius = sum / double(all), half = 0.5 * c_.axial_length * s.height;
    const auto layer = [&](double height) {
      std::vector<Index> ids;
      for (const std::size_t k : view.own_particles())
        if (std::abs((x[k] - middle).dot(s.axis) - height) <= 2 * radius) ids.push_back(view.particles.id[k]);
      return Group(view.all(ids));
    };
    along_ = checked({s.axis, layer(-half), layer(half), 0}, view, "axial");
  }

  static Gauge checked(Gauge g, const SimulationView& view, const char* which) {
    if (!g.low.empty() && !g.high.empty()) g.length = distance(view, view.particles.initial_position, g);
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

  Group nearest(const SimulationView& view, const Vec3& point) const {
    struct Near {
      double distance;
      Index id;
    };
    std::vector<Near> all;
    for (const std::size_t k : view.own_particles())
      all.push_back({(view.particles.initial_position[k] - point).squaredNorm(), view.particles.id[k]});
    const auto keep_nearest = [&] {
      const std::size_t n = std::min(all.size(), std::size_t(c_.particles));
      std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(n), all.end(), [](const Near& a, const Near& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
      });
      all.resize(n);
    };
    keep_nearest();
    all = view.all(all);  // of the nearest of each part
    keep_nearest();
    std::vector<Index> ids;
    for (const Near& one : all) ids.push_back(one.id);
    return Group(std::move(ids));
  }

  Config c_;
  std::vector<Gauge> across_;
  Gauge along_;
  std::size_t lateral_ = 0, axial_ = 0;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Gauges, "postprocessor", "gauges")
