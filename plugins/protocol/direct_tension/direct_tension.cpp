// SPDX-License-Identifier: BSD-3-Clause
/// Direct tension: the particles near both ends are held by plates that move apart.
/// Source: Ouyang, Yang & Chen (2017), Appl. Sci. 7(7), 686, section 2.4 (held ends, breakable layer); the ramp, the
/// depth of the grips and the stop are ours.
#include "breccia/protocol_tools/axial_config.hpp"
#include "breccia/protocol_tools/equilibrium.hpp"

namespace breccia {

class DirectTension final : public Protocol {
 public:
  struct Config {
    LoadingAxis axis;
    MovingPlatens moving;
    double plate_velocity, ramp_time, breakable_layer, max_strain, stop_stress_ratio;
    std::optional<double> grip, time_after_peak, failure_stress;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Tension along the axis: particles near both ends move with plates, a middle layer may fail")
        .source("Ouyang et al. (2017), section 2.4")
        .details(
            "Particles whose centre lies within `grip` of an end face are held in all their motions and move with a "
            "plate. The load is "
            "what they are pulled with: the sum of their resultants, the mean of both ends. Strain is the plates' "
            "displacement over the "
            "free length, which lies between the mean heights of the held particles that are bonded to free ones. "
            "Bonds between particles that do not both lie in the middle "
            "`breakable_layer` of the height are neither damaged nor broken.\n\n"
            "Curves have the signs and names of a compression test, so both come out negative: `platen_stress` (load "
            "over the measured "
            "cross-section), `platen_strain`, `platen_imbalance` (difference of the ends' loads over their mean), "
            "`unbalanced_force_ratio` (of the particles that are not held). `load` and `platen_displacement` are "
            "positive "
            "in tension.");
    describe_loading_axis(s);
    s.param("plate_velocity", &Config::plate_velocity)
        .unit("m/s")
        .above(0)
        .example("0.1 m/s")
        .doc("of each moving plate, away from the other");
    s.param("moving_plates", &Config::moving)
        .choice("both", MovingPlatens::both, "each at plate_velocity")
        .choice("upper", MovingPlatens::upper, "the lower one stands")
        .fallback("upper")
        .doc("which plates move");
    s.param("ramp_time", &Config::ramp_time)
        .unit("s")
        .at_least(0)
        .fallback(20e-6)
        .doc("time in which the plates reach their velocity");
    s.param("grip", &Config::grip)
        .unit("m")
        .above(0)
        .example("0.9 mm")
        .doc("depth below an end face down to which centres are held; if absent the largest radius");
    s.param("breakable_layer", &Config::breakable_layer)
        .above(0)
        .at_most(1)
        .fallback(0.6)
        .doc("share of the height, about the middle, in which bonds may fail; 1: all may")
        .source("0.6 L");
    s.param("max_strain", &Config::max_strain)
        .above(0)
        .below(1)
        .fallback(0.02)
        .doc("plate strain at which the test ends at the latest");
    s.param("stop_stress_ratio", &Config::stop_stress_ratio)
        .at_least(0)
        .below(1)
        .fallback(0.3)
        .doc(
            "the test ends once the stress has fallen to this share of its peak and stayed there for a tenth of a "
            "wave's travel from end to end; 0: never for this reason");
    s.param("time_after_peak", &Config::time_after_peak)
        .unit("s")
        .above(0)
        .example("40 us")
        .doc("the test goes on at least this long after the peak")
        .source("4000 steps of 10 ns");
    describe_failure_stress(s);
  }

  explicit DirectTension(const Config& config) : c_(config) {}

  void setup(const SimulationView& view, LoadControl& control, Recorder& recorder, Host&) override {
    shape_ = specimen_along(c_.axis, view, control);
    stiffness_ = control.bond_stiffness();
    travel_ = stiffness_.wave_speed > 0 ? shape_.height / stiffness_.wave_speed : 0;
    const ParticlesView& p = view.particles;
    double largest = 0;
    for (const std::size_t k : view.own_particles()) largest = std::max(largest, p.radius[k]);
    grip_ = c_.grip.value_or(view.max(largest));
    if (2 * grip_ >= shape_.height) throw UserError("protocol direct_tension: the grips meet: make `grip` smaller");
    for (const std::size_t k : view.own_particles()) {
      const double at = height_of(p.position[k]);
      // Pulled at the end face, not at its centre.
      if (is_low(at)) lower_.take(view.row_in_whole(k), -at);
      if (is_high(at)) upper_.take(view.row_in_whole(k), shape_.height - at);
    }
    for (Grip* grip : {&lower_, &upper_}) grip->meet(view);
    if (lower_.rows.empty() || upper_.rows.empty())
      throw UserError("protocol direct_tension: no particle lies within `grip` of an end face; make it larger");
    free_length_ = free_length(view);
    protect(view, control);
    const Ends ends(*this, view);
    s_.lower_start = ends.height[0];
    s_.upper_start = ends.height[1];
    stress_ =
        recorder.add({"platen_stress", "Pa", "mean load of both ends over the cross-section; compression positive",
                      role::machine_stress});
    strain_ =
        recorder.add({"platen_strain", "1", "displacement of the plates over the free length; compression positive",
                      role::machine_strain});
    load_ = recorder.add({"load", "N", "what the plates pull with, mean of both ends; tension positive", role::load});
    displacement_ =
        recorder.add({"platen_displacement", "m", "by which the plates have moved apart", role::displacement});
    imbalance_ = recorder.add({"platen_imbalance", "1", "difference of the ends' loads over their mean"});
    unbalanced_ = recorder.add(
        {"unbalanced_force_ratio", "1", "mean resultant on a particle that is not held over mean contact force"});
  }

  void step(LoadControl& control) override {
    if (!s_.begun) {
      s_.begun = true;
      s_.ramp.lead_to(c_.plate_velocity, control.time(), c_.ramp_time);
    }
    const double speed = s_.ramp.at(control.time());
    if (s_.holding && speed == s_.speed) return;
    const Vec3 up = speed * shape_.axis, down = c_.moving == MovingPlatens::both ? Vec3(-up) : Vec3::Zero();
    for (const auto& [grip, velocity] : {std::pair(&upper_, up), {&lower_, down}})
      for (std::size_t k = 0; k < grip->rows.size(); ++k)
        control.hold(grip->rows[k], dof::all, velocity, Vec3::Zero(), grip->arms[k] * shape_.axis);
    s_.speed = speed;
    s_.holding = true;
  }

  Progress decide(LoadControl& control) override {
    if (!s_.marked) control.mark_start_of_loading();
    s_.marked = true;
    const Ends ends(*this, control.particles_here());
    const double below = ends.pull[0], above = -ends.pull[1], mean = 0.5 * (below + above);
    s_.stress = mean / shape_.cross_section_area;
    s_.imbalance = mean > 0 ? (above - below) / mean : 0.0;
    s_.strain = (ends.height[1] - s_.upper_start - ends.height[0] + s_.lower_start) / free_length_;
    const double time = control.time();
    if (s_.stress > s_.peak) {
      s_.peak = s_.stress;
      s_.strain_at_peak = s_.strain;
      s_.time_of_peak = time;
      s_.broken_at_peak = control.broken_bonds();
    }
    const bool low = c_.stop_stress_ratio > 0 && s_.peak > c_.failure_stress.value_or(load_scale()) &&
                     s_.stress < c_.stop_stress_ratio * s_.peak;
    s_.failed = s_.drop.lasts(low, time, 0.1 * travel_) && time - s_.time_of_peak >= c_.time_after_peak.value_or(0);
    return s_.failed || s_.strain >= c_.max_strain ? Progress::finished : Progress::running;
  }

  double load() const override { return s_.stress; }
  /// A tenth of what counts as loaded in compression, as rock and concrete carry a tenth in tension.
  double load_scale() const override { return 0.1 * strain_of_touch * stiffness_.modulus; }

  bool sees_parts() const override { return true; }
  void sample(const SimulationView& view, Recorder& recorder) const override {
    const ParticlesView& p = view.particles;
    std::vector<std::uint8_t> held(p.size());  // by the plates, and by nobody else in all motions
    for (std::size_t k = 0; k < held.size(); ++k) held[k] = p.held[k] == dof::all;
    recorder.set(stress_, -s_.stress);
    recorder.set(strain_, -s_.strain);
    recorder.set(load_, s_.stress * shape_.cross_section_area);
    recorder.set(displacement_, s_.strain * free_length_);
    recorder.set(imbalance_, s_.imbalance);
    recorder.set(unbalanced_, unbalanced_force_ratio(view, held));
  }

  double share_done() const override { return s_.failed ? 1.0 : std::clamp(s_.strain / c_.max_strain, 0.0, 1.0); }
  std::string status() const override {
    char text[64];
    std::snprintf(text, sizeof text, "tension %.2f MPa", s_.stress * 1e-6);
    return text;
  }

  void finish(const SimulationView& view, const Curves& curves, Summary& summary) override {
    summary.own("held_particles", Json{{"lower", lower_.rows.size()}, {"upper", upper_.rows.size()}});
    summary.own({"grip", "m"}, grip_);
    summary.own({"free_length", "m"}, free_length_);
    summary.own("protected_bonds", protected_);
    summary.own({"cross_section_area", "m2"}, shape_.cross_section_area);
    summary.own({"peak_tension", "Pa"}, s_.peak);
    summary.own("strain_at_peak", s_.strain_at_peak);
    summary.own("broken_bonds_at_peak", s_.broken_at_peak);
    summary.own("broken_bonds_at_end", broken(view));
    summary.own({"time_after_peak", "s"}, view.time - s_.time_of_peak);
    summary.own("stopped_by", s_.failed ? "stress drop" : s_.strain >= c_.max_strain ? "max_strain" : "request");
    // Evidence of a quasi-static run: how far the two ends were apart between half the peak and the peak.
    const auto stress = curves.column("platen_stress"), imbalance = curves.column("platen_imbalance");
    double most = 0;
    for (std::size_t k = 0; k < stress.size() && -stress[k] < s_.peak; ++k)
      if (-stress[k] > 0.5 * s_.peak) most = std::max(most, std::abs(imbalance[k]));
    summary.own("platen_imbalance_max_before_peak", most);
  }
  bool archive(Archive& archive) override {
    archive("running", s_);
    return true;
  }

 private:
  struct Running {
    double lower_start = 0, upper_start = 0, speed = 0, strain = 0, stress = 0, peak = 0, strain_at_peak = 0,
           time_of_peak = 0, imbalance = 0;
    StressDrop drop;
    std::size_t broken_at_peak = 0;
    SmoothRamp ramp;  // of the plates' speed
    bool begun = false, holding = false, marked = false, failed = false;
  };

  double height_of(const Vec3& x) const { return (x - shape_.base).dot(shape_.axis); }
  bool is_low(double at) const { return at <= grip_ + 1e-9 * shape_.height; }
  bool is_high(double at) const { return at >= shape_.height - grip_ - 1e-9 * shape_.height; }
  bool is_held(const Vec3& x) const { return is_low(height_of(x)) || is_high(height_of(x)); }

  /// What a plate holds, of the whole specimen: few particles.
  struct Grip {
    std::vector<Index> rows;   ///< in the whole
    std::vector<double> arms;  ///< along the axis, from the centre to the end face [m]
    void take(Index row, double arm) {
      rows.push_back(row);
      arms.push_back(arm);
    }
    void meet(const SimulationView& view) {
      rows = view.all(rows);
      arms = view.all(arms);
    }
  };
  /// Of what the lower and the upper plate hold, now.
  struct Ends {
    Ends(const DirectTension& test, const SimulationView& view) {
      ExactSumOf<Eigen::Vector2d> of[2];
      for (int end = 0; end < 2; ++end)
        view.for_each_own((end == 0 ? test.lower_ : test.upper_).rows, [&](std::size_t, std::size_t k) {
          const ParticlesView& p = view.particles;
          of[end].add({p.force[k].dot(test.shape_.axis), test.height_of(p.position[k])});
        });
      const auto [low, high] = view.sum(of[0], of[1]);
      pull[0] = low[0];
      pull[1] = high[0];
      height[0] = low[1] / double(test.lower_.rows.size());
      height[1] = high[1] / double(test.upper_.rows.size());
    }
    double pull[2];    ///< of the specimen on held particles, along the axis [N]
    double height[2];  ///< mean [m]
  };
  /// Between the mean heights of the held particles that are bonded to free ones.
  double free_length(const SimulationView& view) const {
    const ParticlesView& p = view.particles;
    std::vector<std::uint8_t> counts(p.size(), 0);
    for (std::size_t b = 0; b < view.bonds.size(); ++b)
      for (const auto& [k, other] :
           {std::pair(view.bonds.i[b], view.bonds.j[b]), std::pair(view.bonds.j[b], view.bonds.i[b])})
        if (is_held(p.position[k]) && !is_held(p.position[other])) counts[k] = 1;
    ExactSumOf<Eigen::Vector2d> of[2];  // number, height
    for (const std::size_t k : view.own_particles()) {
      const double at = height_of(p.position[k]);
      if (counts[k]) of[at > 0.5 * shape_.height].add({1, at});
    }
    const auto [low, high] = view.sum(of[0], of[1]);
    if (low[0] == 0 || high[0] == 0)
      throw UserError("protocol direct_tension: no bond joins the particles held at an end to the specimen");
    return high[1] / high[0] - low[1] / low[0];
  }
  void protect(const SimulationView& view, LoadControl& control) {
    if (c_.breakable_layer >= 1) return;
    const double half = 0.5 * c_.breakable_layer * shape_.height;
    const auto inside = [&](Index k) {
      return std::abs(height_of(view.particles.position[k]) - 0.5 * shape_.height) <= half;
    };
    std::vector<Index> bonds;
    ExactSumOf<std::size_t> number;
    for (Index b = 0; b < view.bonds.size(); ++b) {
      if (inside(view.bonds.i[b]) && inside(view.bonds.j[b])) continue;
      bonds.push_back(b);
      if (view.own_bonds().contain(b)) number.add(1);
    }
    control.protect_bonds(bonds);
    protected_ = view.sum(number);
  }
  static std::size_t broken(const SimulationView& view) {
    std::size_t here = 0;
    for (const std::size_t b : view.own_bonds()) here += is_broken(view.bonds.state[b]);
    ExactSumOf<std::size_t> n;
    n.add(here);
    return view.sum(n);
  }

  Config c_;
  SpecimenShape shape_;
  BondStiffness stiffness_;
  double grip_ = 0, free_length_ = 0, travel_ = 0;  // [m], [m], of a wave from end to end [s]
  Grip lower_, upper_;
  std::size_t protected_ = 0;
  std::size_t stress_ = 0, strain_ = 0, load_ = 0, displacement_ = 0, imbalance_ = 0, unbalanced_ = 0;
  Running s_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::DirectTension, "protocol", "direct_tension")
