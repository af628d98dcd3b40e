// SPDX-License-Identifier: BSD-3-Clause
/// A piece of a space that repeats itself, strained as a whole: no platens, no surface.
/// Source: Thornton (2000), Geotechnique 50, 43-53; Cundall (1988), Micromechanics of Granular Materials, 113-123.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "breccia/protocol.hpp"
#include "breccia/protocol_tools/axial_config.hpp"
#include "breccia/protocol_tools/equilibrium.hpp"
#include "breccia/protocol_tools/smooth_ramp.hpp"

namespace breccia {
namespace {

enum class Sense { compression, tension };
enum class Lateral { pressure, fixed };

}  // namespace

class PeriodicCell final : public Protocol {
 public:
  struct Config {
    LoadingAxis axis;
    Sense sense;
    Lateral lateral;
    double strain_rate, max_strain, stop_stress_ratio, lateral_pressure;
    std::optional<double> failure_stress;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Loading along one axis of a space that repeats itself, strained as a whole")
        .source(
            "Thornton (2000), Geotechnique 50, 43-53; Cundall (1988), Micromechanics of Granular Materials, 113-123")
        .details(
            "Needs `periodic: [x, y, z]` (in two dimensions `[x, y]`) and has neither platens nor sides: what is "
            "measured is a point in the middle of a large body. The edge of the cell along the axis changes at a "
            "steady "
            "rate. Across the axis it is led so that the stress there is `lateral_pressure` (0 gives uniaxial stress, "
            "more "
            "a triaxial test), or it keeps its size (uniaxial strain). A pressure above 0 is first led to its value "
            "all "
            "round. Stresses are (1/V) times the sum over pairs of branch vector (x) force, V the present volume of "
            "the "
            "cell; strains are changes of its edges over their lengths at the start of loading.");
    describe_loading_axis(s);
    s.param("sense", &Config::sense)
        .choice("compression", Sense::compression, "the cell grows shorter")
        .choice("tension", Sense::tension, "the cell grows longer")
        .fallback("compression")
        .doc("which way it is loaded along the axis");
    s.param("strain_rate", &Config::strain_rate)
        .unit("1/s")
        .above(0)
        .example("1 1/s")
        .doc("of the axial strain; slow against the time that a wave takes through the cell");
    s.param("max_strain", &Config::max_strain)
        .above(0)
        .below(1)
        .fallback(0.02)
        .doc("axial strain at which the test ends at the latest");
    s.param("lateral", &Config::lateral)
        .choice("pressure", Lateral::pressure, "lateral_pressure is kept, and the cell grows as it must")
        .choice("fixed", Lateral::fixed, "no lateral strain is let through")
        .fallback("pressure")
        .doc("what happens across the axis while the cell is loaded");
    s.param("lateral_pressure", &Config::lateral_pressure)
        .unit("Pa")
        .at_least(0)
        .fallback(0.0)
        .example("20 MPa")
        .doc("compression positive: led to this value all round before the cell is loaded");
    s.param("stop_stress_ratio", &Config::stop_stress_ratio)
        .at_least(0)
        .below(1)
        .fallback(0.5)
        .doc(
            "the test ends once the deviatoric stress has fallen to this share of its peak and stayed there while a "
            "wave travels through the cell; 0: never for this reason");
    describe_failure_stress(s);
  }

  explicit PeriodicCell(const Config& config) : c_(config) {}

  void setup(const SimulationView& view, LoadControl& control, Recorder& recorder, Host&) override {
    if (!view.repeats_all_round())
      throw UserError(std::string("protocol periodic_cell: write `periodic: ") +
                      (view.dimension == 2 ? "[x, y]" : "[x, y, z]") +
                      "` into the workflow: the space must repeat "
                      "itself in all directions");
    const SpecimenShape shape = specimen_along(c_.axis, view, control);
    shape.axis.cwiseAbs().maxCoeff(&axis_);
    dimension_ = view.dimension;
    stiffness_ = control.bond_stiffness();
    if (!(stiffness_.modulus > 0))
      throw UserError(
          "protocol periodic_cell: there are no bonds, nor contacts where the law makes none, and their stiffness is "
          "what the cell is led by: widen `bonding`");
    refuse_pressure_out_of_reach(c_.lateral_pressure, stiffness_);
    double widest = 0;
    for (int k = 0; k < dimension_; ++k) widest = std::max(widest, view.cell.width(k));
    travel_ = widest / stiffness_.wave_speed;
    failure_stress_ = c_.failure_stress.value_or(load_scale());
    s_.start = edges(view.cell);
    axial_strain_ =
        recorder.add({"axial_strain", "1", "of the cell along the axis, compression positive", role::strain});
    lateral_strain_ =
        recorder.add({"lateral_strain", "1", "of the cell across the axis, extension positive", role::lateral_strain});
    volumetric_strain_ = recorder.add({"volumetric_strain", "1", "of the cell, compression positive"});
    axial_stress_ = recorder.add(
        {"cell_axial_stress", "Pa", "of the pairs, along the axis, compression positive", role::machine_stress});
    lateral_stress_ =
        recorder.add({"cell_lateral_stress", "Pa", "of the pairs, across the axis, compression positive"});
    deviator_ = recorder.add({"cell_deviatoric_stress", "Pa", "axial minus lateral stress"});
    unbalanced_ = recorder.add({"unbalanced_force_ratio", "1", "mean resultant on a particle over mean contact force"});
  }

  void step(LoadControl& control) override {
    const double t = control.time();
    if (!s_.begun) begin(control);
    const double pressure = s_.pressure.at(t);
    Vec3 rate = Vec3::Zero();  // of strain, extension positive [1/s]
    for (int k = 0; k < dimension_; ++k) {
      const bool led = k == axis_ && s_.loading;
      if (led) rate[k] = s_.rate.at(t) * s_.start[k] / edges(control.cell())[k];  // a steady change of length
      else if (c_.lateral == Lateral::pressure || !s_.loading)
        rate[k] = follow(-s_.stress[k] - pressure, s_.steady_rate[k], control.time_step());
    }
    control.set_cell_velocity(control.cell().vectors() * rate.asDiagonal());
  }

  Progress decide(LoadControl& control) override {
    const double t = control.time();
    const Mat3 stress = control.cell_stress();
    s_.stress = stress.diagonal();
    if (!s_.loading) {
      if (!s_.looking) {  // loading begins in a step whose forces are wanted in full
        s_.looking = confined(t);
        if (!s_.looking || t > 0) return s_.looking ? Progress::look : Progress::running;
      }
      s_.loading = true;
      s_.start = edges(control.cell());
      s_.rate.lead_to((c_.sense == Sense::tension ? 1 : -1) * c_.strain_rate, t, 5 * travel_);
      control.mark_start_of_loading();
    }
    s_.edges = edges(control.cell());
    const double load = this->load(), strain = std::abs(s_.edges[axis_] / s_.start[axis_] - 1);
    s_.strain = strain;
    s_.peak = std::max(s_.peak, load);
    const bool low = c_.stop_stress_ratio > 0 && s_.peak > failure_stress_ && load < c_.stop_stress_ratio * s_.peak;
    s_.failed = s_.drop.lasts(low, t, travel_);
    return s_.failed || strain >= c_.max_strain ? Progress::finished : Progress::running;
  }

  double load() const override {
    return (c_.sense == Sense::tension ? 1 : -1) * (s_.stress[axis_] - lateral(s_.stress));
  }
  double load_scale() const override { return strain_of_touch * stiffness_.modulus; }

  bool sees_parts() const override { return true; }
  void sample(const SimulationView& view, Recorder& recorder) const override {
    const Vec3 strain = s_.edges.cwiseQuotient(s_.start) - Vec3::Ones();
    double volume = 1;
    for (int k = 0; k < dimension_; ++k) volume *= 1 + strain[k];
    recorder.set(axial_strain_, -strain[axis_]);
    recorder.set(lateral_strain_, lateral(strain));
    recorder.set(volumetric_strain_, 1 - volume);
    recorder.set(axial_stress_, -s_.stress[axis_]);
    recorder.set(lateral_stress_, -lateral(s_.stress));
    recorder.set(deviator_, lateral(s_.stress) - s_.stress[axis_]);
    recorder.set(unbalanced_, unbalanced_force_ratio(view));
  }

  double share_done() const override { return s_.failed ? 1 : std::clamp(s_.strain / c_.max_strain, 0.0, 1.0); }
  std::string status() const override {
    if (!s_.loading) return "confining";
    char text[64];
    std::snprintf(text, sizeof text, "deviatoric stress %.1f MPa", load() * 1e-6);
    return text;
  }

  void finish(const SimulationView&, const Curves&, Summary& summary) override {
    for (int k = 0; k < dimension_; ++k) summary.own({std::string("edge_at_start_") + "xyz"[k], "m"}, s_.start[k]);
    summary.own({"lateral_pressure_asked", "Pa"}, c_.lateral_pressure);
    summary.own({"lateral_pressure_at_end", "Pa"}, -lateral(s_.stress));
    summary.own({"peak_deviatoric_stress", "Pa"}, s_.peak);
    summary.own("final_axial_strain", s_.strain);
    summary.own("stopped_by", s_.failed ? "stress drop" : s_.strain >= c_.max_strain ? "max_strain" : "request");
  }
  bool archive(Archive& archive) override {
    archive("running", s_);
    return true;
  }

 private:
  struct Running {
    Vec3 start = Vec3::Ones(), edges = Vec3::Ones(), stress = Vec3::Zero(), steady_rate = Vec3::Zero();
    double strain = 0, peak = 0, confining_time = 0;
    SmoothRamp pressure, rate;
    StressDrop drop;
    bool begun = false, looking = false, loading = false, failed = false;

    void archive(Archive& archive) {
      for (auto& [name, value] : {std::pair<const char*, Vec3*>("start", &start),
                                  {"edges", &edges},
                                  {"stress", &stress},
                                  {"steady_rate", &steady_rate}})
        archive(name, *value);
      for (auto& [name, value] :
           {std::pair<const char*, double*>("strain", &strain), {"peak", &peak}, {"confining_time", &confining_time}})
        archive(name, *value);
      for (auto& [name, value] : {std::pair<const char*, bool*>("begun", &begun),
                                  {"looking", &looking},
                                  {"loading", &loading},
                                  {"failed", &failed}})
        archive(name, *value);
      archive("pressure", pressure);
      archive("rate", rate);
      archive("drop", drop);
    }
  };

  static Vec3 edges(const Cell& cell) { return cell.vectors().colwise().norm().transpose(); }

  double lateral(const Vec3& of) const {
    double sum = 0;
    for (int k = 0; k < dimension_; ++k) sum += k == axis_ ? 0 : of[k];
    return sum / (dimension_ - 1);
  }

  void begin(const LoadControl& control) {
    s_.begun = true;
    const double pressure = c_.lateral_pressure;
    if (pressure == 0) return;
    // At about the rate of the test, and slowly against the waves that it sends.
    s_.confining_time = std::max(pressure / stiffness_.modulus / c_.strain_rate, 5 * travel_);
    s_.pressure.lead_to(pressure, control.time(), s_.confining_time);
  }

  /// Rate of strain that makes up for too large a pressure in about the time of a wave through the cell; `steady`
  /// learns the rate at which the cell must grow for the pressure to stay as it is.
  double follow(double excess, double& steady, double time_step) const {
    const double most = 10 * c_.strain_rate, now = excess / (stiffness_.modulus * travel_);
    steady = std::clamp(steady + now * time_step / (8 * travel_), -most, most);
    return std::clamp(now + steady, -most, most);
  }

  /// Whether all directions carry the pressure.
  bool confined(double time) {
    const double pressure = c_.lateral_pressure;
    if (pressure == 0) return true;
    if (!s_.pressure.done(time)) return false;
    double off = 0;
    for (int k = 0; k < dimension_; ++k) off = std::max(off, std::abs(s_.stress[k] + pressure));
    if (off < 0.005 * pressure) return true;
    if (time > 20 * s_.confining_time)
      throw UserError(
          "protocol periodic_cell: the specimen does not carry the lateral pressure: it is still away from it after "
          "twenty times the time in which it was led there");
    return false;
  }

  Config c_;
  Running s_;
  BondStiffness stiffness_;
  double travel_ = 0, failure_stress_ = 0;
  int axis_ = 2, dimension_ = 3;
  std::size_t axial_strain_ = 0, lateral_strain_ = 0, volumetric_strain_ = 0, axial_stress_ = 0, lateral_stress_ = 0,
              deviator_ = 0, unbalanced_ = 0;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::PeriodicCell, "protocol", "periodic_cell")
