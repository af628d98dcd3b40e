// SPDX-License-Identifier: BSD-3-Clause
/// Brazilian test: a disc is split by compression along its diameter.
/// Source: ISRM (1978), Int. J. Rock Mech. Min. Sci. 15, 99-103; Oñate et al. (2015), section 10.1.3.
#include <algorithm>
#include <numbers>

#include "breccia/protocol_tools/axial_config.hpp"
#include "breccia/protocol_tools/equilibrium.hpp"

namespace breccia {

class Brazilian final : public Protocol {
 public:
  enum class Axis { automatic, x, y, z };
  struct Config : PlatenConfig {
    Axis axis;
    double max_displacement, stop_load_ratio, seating_load_share;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Splitting of a disc between two flat platens: indirect tensile strength")
        .source("ISRM (1978), Int. J. Rock Mech. Min. Sci. 15, 99-103; Oñate et al. (2015), section 10.1.3")
        .details(
            "The specimen is a cylinder that lies on its mantle, or in two dimensions a disc. Two rigid planes start "
            "at the ends of a diameter "
            "and close. With the mean load P of the two, the diameter D and the length t as measured from the "
            "particles, the tensile stress in "
            "the middle is 2 P/(pi D t).\n\n"
            "Curves: `tensile_stress`, `load`, `platen_displacement` (by which the platens have come closer), "
            "`diametral_strain` (that over D), "
            "`platen_imbalance`, `unbalanced_force_ratio`, `platen_particles` (that carry the load). The displacement "
            "of the particles across the load is the "
            "component of `displacement` "
            "in the particle files.");
    describe_platens(s);
    s.param("axis", &Config::axis)
        .choice("automatic", Axis::automatic, "y; in a cylinder along y, z")
        .choice("x", Axis::x, "")
        .choice("y", Axis::y, "")
        .choice("z", Axis::z, "")
        .fallback("automatic")
        .doc("direction of the load, across the axis of the cylinder");
    s.param("max_displacement", &Config::max_displacement)
        .above(0)
        .below(1)
        .fallback(0.03)
        .doc("the test ends when the platens have closed by this share of the diameter");
    s.param("stop_load_ratio", &Config::stop_load_ratio)
        .at_least(0)
        .below(1)
        .fallback(0.5)
        .doc(
            "the test ends once the load has fallen to this share of its peak and stayed there for a tenth of a wave's "
            "travel across the disc; 0: never for this reason");
    s.param("seating_load", &Config::seating_load_share)
        .at_least(0)
        .below(0.1)
        .fallback(1e-5)
        .doc(
            "rows of curves.csv begin when both platens carry a stress over the section D t of this share of the "
            "bonds' modulus");
  }

  explicit Brazilian(const Config& config) : c_(config) {}

  void setup(const SimulationView& view, LoadControl& control, Recorder& recorder, Host& host) override {
    host_ = &host;
    const SpecimenShape& shape = view.specimen;
    const bool flat = view.dimension == 2;
    if (shape.outline != (flat ? SpecimenShape::Outline::ellipsoid : SpecimenShape::Outline::cylinder))
      throw UserError(flat ? "protocol brazilian: the specimen must be a disc: give the packing a container of "
                             "`shape: sphere`, or with from_file `outline: disc`"
                           : "protocol brazilian: the specimen must be a cylinder: give the packing a container of "
                             "`shape: cylinder`, or with from_file `outline: cylinder`");
    int along = c_.axis == Axis::automatic ? 1 : int(c_.axis) - 1;
    if (c_.axis == Axis::automatic && !flat && std::abs(shape.axis.y()) > 0.5) along = 2;
    load_ = Vec3::Unit(along);
    if (flat ? along == 2 : std::abs(load_.dot(shape.axis)) > 1e-6)
      throw UserError("protocol brazilian: the load acts across the axis of the disc: choose another `axis`");
    // The outermost surfaces along the load.
    double low = 1e300, high = -1e300;
    for (std::size_t k = 0; k < view.particles.size(); ++k) {
      const double at = view.particles.position[k].dot(load_), r = view.particles.radius[k];
      low = std::min(low, at - r);
      high = std::max(high, at + r);
    }
    low = -view.max(-low);
    high = view.max(high);
    diameter_ = high - low;
    thickness_ = flat ? view.thickness : shape.height;
    const Vec3 middle = shape.base + (flat ? 0.0 : 0.5 * shape.height) * shape.axis,
               off = middle - middle.dot(load_) * load_;
    platens_.setup(control, c_, off + low * load_, off + high * load_);
    const BondStiffness stiffness = control.bond_stiffness();
    modulus_ = stiffness.modulus;
    travel_ = stiffness.wave_speed > 0 ? diameter_ / stiffness.wave_speed : 0;
    stress_ = recorder.add(
        {"tensile_stress", "Pa", "2 P/(pi D t) with the mean load P of the platens", role::splitting_stress});
    column_[0] = recorder.add({"load", "N", "mean of the platens' normal forces", role::load});
    column_[1] = recorder.add(
        {"platen_displacement", "m", "by which the platens have come closer since seating", role::displacement});
    column_[2] = recorder.add({"diametral_strain", "1", "the same over the diameter", role::diametral_strain});
    column_[3] = recorder.add({"platen_imbalance", "1", "difference of the platens' forces over their mean"});
    column_[4] = recorder.add({"unbalanced_force_ratio", "1", "mean resultant on a particle over mean contact force"});
    column_[5] = recorder.add({carriers, "1", "particles that carry the load at a platen: the fewer of the two"});
  }

  void step(LoadControl& control) override {
    platens_.lead_to(c_.platen_velocity, control.time());
    platens_.move(control);
  }

  Progress decide(LoadControl& control) override {
    const double below = platens_.force_below(control), above = platens_.force_above(control),
                 load = 0.5 * (below + above);
    if (!s_.seated) {
      if (!s_.looking) {
        const double least = std::min(below, above);
        if (least > 0 && least >= c_.seating_load_share * modulus_ * diameter_ * thickness_) {
          s_.looking = true;  // loading begins in the next step, which is looked at
          return Progress::look;
        }
        if (platens_.approach(control) < c_.max_displacement * diameter_) return Progress::running;
        throw UserError(
            "protocol brazilian: the platens have closed by max_displacement without both carrying seating_load");
      }
      s_.seated = true;
      control.mark_start_of_loading();
    }
    s_.load = load;
    s_.imbalance = load > 0 ? (above - below) / load : 0.0;
    s_.displacement = platens_.approach(control);
    s_.stress = 2 * load / (std::numbers::pi * diameter_ * thickness_);
    if (s_.stress > s_.peak) {
      s_.peak = s_.stress;
      s_.displacement_at_peak = s_.displacement;
    }
    s_.broken = control.broken_bonds() > 0;
    const bool low = c_.stop_load_ratio > 0 && s_.broken && s_.stress < c_.stop_load_ratio * s_.peak;
    s_.split = s_.drop.lasts(low, control.time(), 0.1 * travel_);
    return s_.split || s_.displacement >= c_.max_displacement * diameter_ ? Progress::finished : Progress::running;
  }

  double load() const override { return s_.stress; }
  double load_scale() const override { return strain_of_touch * modulus_; }

  bool sees_parts() const override { return true; }
  void sample(const SimulationView& view, Recorder& recorder) const override {
    std::size_t fewest = view.walls.front().contacts;
    for (const WallView& platen : view.walls) fewest = std::min(fewest, platen.contacts);
    const double values[6] = {
        s_.load,       s_.displacement, s_.displacement / diameter_, s_.imbalance, unbalanced_force_ratio(view),
        double(fewest)};
    recorder.set(stress_, s_.stress);
    for (std::size_t k = 0; k < 6; ++k) recorder.set(column_[k], values[k]);
  }

  double share_done() const override {
    return s_.split ? 1.0 : std::min(1.0, s_.displacement / (c_.max_displacement * diameter_));
  }
  std::string status() const override {
    char text[64];
    std::snprintf(text, sizeof text, s_.seated ? "tensile stress %.2f MPa" : "seating", s_.stress * 1e-6);
    return text;
  }
  void finish(const SimulationView&, const Curves& curves, Summary& summary) override {
    // A disc that turned or slid between the platens lost load as well, unbroken.
    const bool failed = s_.split || (s_.broken && s_.stress < 0.95 * s_.peak);
    summary.headline({"brazilian_tensile_strength", "Pa"}, failed ? Json(s_.peak) : Json());
    summary.own({"peak_tensile_stress", "Pa"}, s_.peak);
    summary.own({"displacement_at_peak", "m"}, s_.displacement_at_peak);
    say_who_carries(failed, curves, summary);
    summary.own({"diameter", "m"}, diameter_);
    summary.own({"thickness", "m"}, thickness_);
    summary.own({"platen_stiffness", "N/m"}, platens_.stiffness());
    summary.own("stopped_by", s_.split                                             ? "load drop"
                              : s_.displacement >= c_.max_displacement * diameter_ ? "max_displacement"
                                                                                   : "request");
  }
  bool archive(Archive& archive) override {
    archive("running", s_);
    archive("platens", platens_);
    return true;
  }

 private:
  /// One particle under a platen is driven into the disc like a wedge, and what is measured is the strength of that
  /// place.
  void say_who_carries(bool failed, const Curves& curves, Summary& summary) const {
    const std::span<const double> stress = curves.column("tensile_stress"), count = curves.column(carriers);
    if (stress.empty()) return;
    const auto peak = std::size_t(std::max_element(stress.begin(), stress.end()) - stress.begin());
    summary.own({"platen_particles_at_peak", "1"}, count[peak]);
    if (count[peak] >= fewest_carriers || !failed) return;
    host_->warn("protocol brazilian: at the peak the load of a platen lay on " +
                std::string(count[peak] < 1.5 ? "a single particle" : "two particles") +
                ", which split the disc like a wedge long before its middle would fail: the strength is too low. Let "
                "more particles carry it: a specimen cut out of a `vessel` as wide as itself (packing "
                "collective_rearrangement), smaller particles, or a lower platen_stiffness");
  }

  static constexpr const char* carriers = "platen_particles";
  static constexpr double fewest_carriers = 3;
  struct Running {
    double stress = 0, peak = 0, displacement = 0, displacement_at_peak = 0, load = 0, imbalance = 0;
    StressDrop drop;
    bool looking = false, seated = false, split = false, broken = false;
  };
  Config c_;
  Vec3 load_ = Vec3::UnitY();
  double diameter_ = 0, thickness_ = 0, modulus_ = 0, travel_ = 0;  // [m], [m], [Pa], of a wave across [s]
  Platens platens_;
  std::size_t stress_ = 0, column_[6] = {};
  Host* host_ = nullptr;
  Running s_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Brazilian, "protocol", "brazilian")
