// SPDX-License-Identifier: BSD-3-Clause
/// What laboratory tests along one axis share: two platens, a confinement, stages with a target each, and what is
/// measured.
#pragma once

#include <array>
#include <memory>

#include "breccia/protocol_tools/axial_config.hpp"
#include "breccia/protocol_tools/confinement.hpp"
#include "breccia/protocol_tools/equilibrium.hpp"

namespace breccia {

/// The protocol of such a test. A derived plugin says how the specimen is confined and when loading starts.
class AxialTest : public Protocol {
 public:
  void setup(const SimulationView& view, LoadControl& control, Recorder& recorder, Host& host) override {
    host_ = &host;
    shape_ = specimen_along(c_.axis, view, control);
    stiffness_ = control.bond_stiffness();
    travel_ = stiffness_.wave_speed > 0 ? shape_.height / stiffness_.wave_speed : 0;
    failure_stress_ = c_.failure_stress.value_or(load_scale());
    platens_.setup(control, c_, shape_.base, shape_.base + shape_.height * shape_.axis);
    s_.height = shape_.height;
    for (const Stage& stage : stages_) refuse_pressure_out_of_reach(stage.confining_pressure.value_or(0), stiffness_);
    confinement_->setup(shape_, view, control, platens_.stiffness());
    stress_ = recorder.add({"platen_stress", "Pa",
                            "mean of both platens' normal forces over the cross-section; compression positive",
                            role::machine_stress});
    strain_ = recorder.add(
        {"platen_strain", "1",
         "approach of the platens since seating (or since the end of the first confining stage) over the height then",
         role::machine_strain});
    imbalance_ = recorder.add({"platen_imbalance", "1", "difference of the platens' forces over their mean"});
    unbalanced_ = recorder.add({"unbalanced_force_ratio", "1", "mean resultant on a particle over mean contact force"});
    stage_ = recorder.add({"stage", "1", "number of the stage, from 0"});
    if (confinement_->any()) {
      asked_ =
          recorder.add({"confining_pressure", "Pa", "asked for at this moment (measured, where the wall is rigid)"});
      got_ = recorder.add(
          {"confining_pressure_applied", "Pa", "sum of the normal forces on the lateral surface over its area"});
      deviator_ =
          recorder.add({"deviatoric_platen_stress", "Pa", "platen stress minus the applied confining pressure"});
    }
  }

  void step(LoadControl& control) override {
    const double t = control.time();
    if (!(s_.seated ? strain(control) < 1 : platens_.approach(control) < shape_.height))
      throw UserError(
          "protocol: the platens have passed each other: nothing stopped the test before. Lower platen_velocity, or "
          "set "
          "max_strain");
    if (!s_.begun) {
      s_.begun = true;
      enter_stage(control);
    } else if (s_.seated && s_.stage < stages_.size() && reached(control)) {
      leave_stage(control);
      if (s_.stage < stages_.size()) enter_stage(control);
    }
    if (s_.stage < stages_.size() && stages_[s_.stage].confining_pressure) serve(control);
    platens_.move(control);
    confinement_->apply(control, t, platens_.lower_rise(control) + s_.lower_rise_before,
                        shape_.height - platens_.upper_fall(control) - s_.upper_fall_before);
  }

  Progress decide(LoadControl& control) override {
    if (!s_.seated) return seat(control);
    const double below = platens_.force_below(control), above = platens_.force_above(control),
                 mean = 0.5 * (below + above);
    s_.strain = strain(control);
    s_.stress = mean / shape_.cross_section_area;
    s_.imbalance = mean > 0 ? (above - below) / mean : 0.0;
    s_.lateral = confinement_->achieved(control);
    s_.asked = confinement_->asked(control.time(), s_.lateral);
    const bool staged = s_.stage < stages_.size();
    if (staged && stages_[s_.stage].confining_pressure) return look_for_rest(control);
    const double deviator = s_.stress - s_.lateral;
    if (deviator > s_.peak) {
      s_.peak = deviator;
      s_.stress_at_peak = s_.stress;
    }
    const bool first_time = s_.strain >= s_.farthest;
    s_.farthest = std::max(s_.farthest, s_.strain);
    const bool low = c_.stop_stress_ratio > 0 && first_time && s_.peak > failure_stress_ &&
                     deviator < c_.stop_stress_ratio * s_.peak;
    s_.failed = s_.drop.lasts(low, control.time(), 0.1 * travel_);
    s_.out_of_reach = staged && out_of_reach(mean);
    if (s_.failed && staged && !s_.out_of_reach && in_stress(stages_[s_.stage])) say_missed("the specimen has failed");
    return s_.failed || s_.out_of_reach || !staged ? Progress::finished : Progress::running;
  }

  double load() const override { return s_.stress - s_.lateral; }
  double load_scale() const override { return strain_of_touch * stiffness_.modulus; }

  bool sees_parts() const override { return true; }
  void sample(const SimulationView& view, Recorder& recorder) const override {
    recorder.set(stress_, s_.stress);
    recorder.set(strain_, s_.strain);
    recorder.set(imbalance_, s_.imbalance);
    recorder.set(unbalanced_, unbalanced_force_ratio(view));
    recorder.set(stage_, double(std::min(s_.stage, stages_.size() - 1)));
    if (!confinement_->any()) return;
    recorder.set(asked_, s_.asked);
    recorder.set(got_, s_.lateral);
    recorder.set(deviator_, s_.stress - s_.lateral);
  }

  double share_done() const override {
    if (s_.failed || s_.out_of_reach || s_.stage >= stages_.size()) return 1;
    const Stage& now = stages_[s_.stage];
    const double way = now.axial_strain ? *now.axial_strain - s_.strain_at_entry : 0;
    const double within = way != 0 ? std::clamp((s_.strain - s_.strain_at_entry) / way, 0.0, 1.0) : 0.0;
    return (double(s_.stage) + within) / double(stages_.size());
  }
  std::string status() const override {
    char text[96];
    if (!s_.seated) return "seating";
    if (stages_.size() > 1)
      std::snprintf(text, sizeof text, "stage %zu of %zu, stress %.1f MPa", std::min(s_.stage + 1, stages_.size()),
                    stages_.size(), s_.stress * 1e-6);
    else std::snprintf(text, sizeof text, "stress %.1f MPa", s_.stress * 1e-6);
    return text;
  }

  void finish(const SimulationView& view, const Curves& curves, Summary& summary) override {
    summary.own("seated", s_.seated);
    summary.own({"seating_approach", "m"}, s_.seating_approach);
    summary.own({"height_at_seating", "m"}, s_.height);
    summary.own({"cross_section_area", "m2"}, shape_.cross_section_area);
    summary.own({"platen_stiffness", "N/m"}, platens_.stiffness());
    summary.own({"peak_platen_stress", "Pa"}, s_.stress_at_peak);
    summary.own({"peak_deviatoric_platen_stress", "Pa"}, s_.peak);
    summary.own("final_platen_strain", s_.strain);
    summary.own("stopped_by", s_.failed                   ? "stress drop"
                              : s_.out_of_reach           ? "a stage that was not reached"
                              : s_.stage < stages_.size() ? "request"
                              : c_.stages                 ? "last stage"
                                                          : "max_strain");
    Json stages = Json::array();
    for (std::size_t k = 0; k < std::min(s_.stage, stages_.size()); ++k) {
      const StageEnd& e = s_.ends[k];
      stages.push_back({{"target", stages_[k].text()},
                        {"end_time_s", e.time},
                        {"platen_stress_Pa", e.stress},
                        {"confining_pressure_Pa", e.pressure},
                        {"platen_strain", e.strain}});
    }
    summary.own("stages", stages);
    confinement_->finish(view, summary);
    // Evidence of a quasi-static run: the ratio over the loading branch between 10 % and 90 % of the peak.
    if (curves.rows() == 0) return;
    const auto stress = curves.column(confinement_->any() ? "deviatoric_platen_stress" : "platen_stress"),
               ratio = curves.column("unbalanced_force_ratio");
    double most = 0;
    for (std::size_t k = 0; k < stress.size() && stress[k] < 0.9 * s_.peak; ++k)
      if (stress[k] > 0.1 * s_.peak) most = std::max(most, ratio[k]);
    summary.own("unbalanced_force_ratio_max_before_peak", most);
  }
  bool archive(Archive& archive) override {
    archive("running", s_);
    archive("platens", platens_);
    archive("confinement", *confinement_);
    return true;
  }

 protected:
  /// The `stages` of the configuration, or those of `first` and then one to `max_strain`. Without a `seating_stress`
  /// strain is counted from the first step.
  AxialTest(const AxialConfig& config, std::vector<Stage> first, std::unique_ptr<Confinement> confinement,
            std::optional<double> seating_stress)
      : c_(config),
        stages_(config.stages.value_or(std::move(first))),
        confinement_(std::move(confinement)),
        seating_stress_(seating_stress) {
    if (c_.stages) return;
    Stage last;
    last.axial_strain = strain_limit();
    stages_.push_back(last);
  }

 private:
  struct StageEnd {
    double time, stress, pressure, strain;
  };
  struct Running {
    double height = 0, seating_approach = 0, strain = 0, stress = 0, peak = 0, stress_at_peak = 0, farthest = -1e300;
    double reference_approach = 0, strain_at_entry = 0, entry_time = 0, ramp_time = 0;
    double lower_rise_before = 0, upper_fall_before = 0;  // before the start of loading
    double imbalance = 0, lateral = 0, asked = 0, last_look = -1e300, calm_since = 0;
    double sense = 1;         // +1: the stage closes the platens
    SmoothRamp axial_stress;  // target of the servo
    StressDrop drop;
    bool begun = false, seated = false, failed = false, out_of_reach = false, quiet = false, confined_once = false,
         looking = false;
    std::size_t stage = 0;
    std::array<StageEnd, 64> ends;
  };

  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }

  double strain_limit() const {
    if (c_.max_strain) return *c_.max_strain;
    double farthest = 0;
    if (c_.stages)
      for (const Stage& stage : *c_.stages) farthest = std::max(farthest, stage.axial_strain.value_or(0));
    return farthest + 0.05;
  }

  /// A target in stress beyond what the specimen carries, or below none at all, would never come; says so.
  bool out_of_reach(double mean_force) {
    const Stage& now = stages_[s_.stage];
    const bool closes = s_.sense > 0 && !now.hold_time;
    const bool apart = in_stress(now) && s_.sense < 0 && mean_force <= 0,
               strained = closes && s_.strain > strain_limit();
    if (!apart && !strained) return false;
    say_missed(apart ? "the platens have come off the specimen, which they cannot pull"
                     : "the platen strain has passed " + number(100 * strain_limit()) + " % (max_strain)");
    return true;
  }

  /// For how long a confined specimen must be seen at rest before it is loaded, in times that a wave takes along it. A
  /// body that swings as a whole passes through its rest, and the resultants on its particles are small all the while;
  /// what is loaded then shows a modulus off by a third (`concrete_triaxial_4.5MPa`: 39 GPa, at rest 29).
  static constexpr double travels_at_rest = 10, patience = 60;  ///< the second: after which this is given up

  static bool in_stress(const Stage& stage) { return stage.axial_stress || stage.deviatoric_stress; }

  void say_missed(const std::string& why) {
    host_->warn("protocol: stage " + std::to_string(s_.stage + 1) + " of " + std::to_string(stages_.size()) + " (" +
                stages_[s_.stage].text() + ") was not reached: " + why + "; the test ends here");
  }

  double strain(const LoadControl& control) const {
    return (platens_.approach(control) - s_.reference_approach) / s_.height;
  }
  double stress(const LoadControl& control) const { return platens_.force(control) / shape_.cross_section_area; }
  double deviator(const LoadControl& control) const { return stress(control) - confinement_->target(); }

  /// Loading begins in the step after both platens carry the seating stress: in one that is looked at.
  Progress seat(LoadControl& control) {
    if (seating_stress_ && !s_.looking) {
      const double least = std::min(platens_.force_below(control), platens_.force_above(control));
      if (least > 0 && least >= *seating_stress_ * shape_.cross_section_area) {
        s_.looking = true;
        return Progress::look;
      }
      const double limit = strain_limit();
      if (platens_.approach(control) < limit * s_.height) return Progress::running;
      throw UserError("protocol: the platens have closed by " + number(100 * limit) +
                      " % without both carrying "
                      "seating_stress; lower seating_stress, or look whether the specimen reaches from end to end");
    }
    s_.looking = false;
    s_.seated = true;
    s_.seating_approach = platens_.approach(control);
    if (seating_stress_) s_.height = shape_.height - s_.seating_approach;
    s_.lower_rise_before = platens_.lower_rise(control);
    s_.upper_fall_before = platens_.upper_fall(control);
    control.mark_start_of_loading();
    return decide(control);
  }

  /// A confining stage ends only with the specimen at rest: looked at some times while a wave travels through it.
  Progress look_for_rest(LoadControl& control) {
    if (s_.looking) s_.quiet = control.unbalanced_force_ratio() < 0.02;
    s_.looking = !s_.looking && control.time() - s_.last_look >= 0.05 * travel_;
    if (!s_.looking) return Progress::running;
    s_.last_look = control.time();
    return Progress::look;
  }

  void enter_stage(LoadControl& control) {
    const Stage& now = stages_[s_.stage];
    const double t = control.time(), speed = now.velocity.value_or(c_.platen_velocity);
    s_.entry_time = s_.calm_since = t;
    s_.looking = s_.quiet = false;
    s_.strain_at_entry = strain(control);
    if (now.confining_pressure) {
      const double way = std::max(std::abs(*now.confining_pressure - stress(control)),
                                  std::abs(*now.confining_pressure - confinement_->target()));
      // So that the platens close at about their velocity, and slowly against the waves that it sends.
      s_.ramp_time = std::max(way / stiffness_.modulus * s_.height / (platens_.platens() * speed),
                              5 * s_.height / stiffness_.wave_speed);
      s_.axial_stress.set(stress(control));
      s_.axial_stress.lead_to(*now.confining_pressure, t, s_.ramp_time);
      confinement_->lead_to(*now.confining_pressure, t, s_.ramp_time);
      return;
    }
    confinement_->begin_loading(t, travel_);
    const double from = now.axial_strain ? s_.strain_at_entry : now.axial_stress ? stress(control) : deviator(control);
    const double to = now.axial_strain   ? *now.axial_strain
                      : now.axial_stress ? *now.axial_stress
                                         : now.deviatoric_stress.value_or(0);
    s_.sense = to >= from ? 1 : -1;
    platens_.lead_to(now.hold_time ? 0 : s_.sense * speed, t);
  }

  bool reached(LoadControl& control) {
    const Stage& now = stages_[s_.stage];
    if (now.axial_strain) return s_.sense * (strain(control) - *now.axial_strain) >= 0;
    if (now.axial_stress) return s_.sense * (stress(control) - *now.axial_stress) >= 0;
    if (now.deviatoric_stress) return s_.sense * (deviator(control) - *now.deviatoric_stress) >= 0;
    const double since = control.time() - s_.entry_time;
    if (now.hold_time) return since >= *now.hold_time;
    if (since < s_.ramp_time) return false;
    const double off = std::abs(stress(control) - *now.confining_pressure),
                 scale = std::max(*now.confining_pressure, 1e-3 * stiffness_.modulus * 1e-2);
    const bool calm = off < 0.005 * scale && s_.quiet;
    if (!calm) s_.calm_since = control.time();
    if (calm && control.time() - s_.calm_since >= travels_at_rest * travel_) return true;
    if (calm && since > s_.ramp_time + patience * travel_) {
      host_->warn("protocol: the specimen still swings under the confining pressure " + number(patience) +
                  " times as long after it was applied as a wave takes along the specimen: the axial load begins on a "
                  "specimen that is not at rest, and what is read off its first part depends on when. Raise "
                  "damping.translational, or lower platen_velocity");
      return true;
    }
    if (since > 20 * s_.ramp_time)
      throw UserError(
          "protocol: the specimen does not carry the confining pressure: the platen stress is still away from it after "
          "twenty times the "
          "time in which it was led there");
    return false;
  }

  void leave_stage(LoadControl& control) {
    if (stages_[s_.stage].confining_pressure && !s_.confined_once) {
      s_.confined_once = true;
      s_.height -= platens_.approach(control) - s_.reference_approach;
      s_.reference_approach = platens_.approach(control);
    }
    s_.ends[s_.stage] = {control.time(), stress(control), confinement_->target(), strain(control)};
    host_->info("stage " + std::to_string(s_.stage) + " (" + stages_[s_.stage].text() + ") ended");
    ++s_.stage;
  }

  /// The platens close as fast as would make up what the stress lacks within two travels of a wave along the specimen.
  void serve(LoadControl& control) {
    const double speed = stages_[s_.stage].velocity.value_or(c_.platen_velocity);
    const double lacks = s_.axial_stress.at(control.time()) - stress(control);
    const double closing = lacks / stiffness_.modulus * stiffness_.wave_speed / 2;
    platens_.set(std::clamp(closing / platens_.platens(), -speed, speed));
  }

  AxialConfig c_;
  std::vector<Stage> stages_;
  std::unique_ptr<Confinement> confinement_;
  std::optional<double> seating_stress_;
  Host* host_ = nullptr;
  SpecimenShape shape_;
  BondStiffness stiffness_;
  double travel_ = 0, failure_stress_ = 0;  // of a wave from end to end [s]; [Pa]
  Platens platens_;
  std::size_t stress_ = 0, strain_ = 0, imbalance_ = 0, unbalanced_ = 0, stage_ = 0, asked_ = 0, got_ = 0,
              deviator_ = 0;
  Running s_;
};

}  // namespace breccia
