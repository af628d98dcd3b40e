// SPDX-License-Identifier: BSD-3-Clause
/// Uniaxial compression between two rigid platens that move toward each other.
/// Source: Rojek et al. (2012), section 5.2 (platens, stiffness, velocity); seating, ramp and stop are ours.
#include <cstdio>

#include "breccia/protocol.hpp"

namespace breccia {

class UniaxialCompression final : public Protocol {
 public:
  struct Config {
    double platen_velocity, platen_stiffness, platen_friction, stiffness_ratio, ramp_time;
    double seating_stress, max_strain, stop_stress_ratio, failure_stress;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Unconfined compression between two rigid platens, to failure or to a strain")
        .source("Rojek et al. (2012), section 5.2")
        .details(
            "Two rigid planes start at the measured ends of the specimen and move toward each other along its axis, "
            "each at `platen_velocity`, reached over `ramp_time` with a smooth (cosine) rise. Strain is counted, and "
            "rows of curves.csv are written, from the moment both platens carry `seating_stress`.\n\n"
            "Curves: `platen_stress` (mean of the two platens' forces over the measured cross-section), `platen_strain` "
            "(approach of the platens since seating over the height then), `platen_imbalance` (difference of the two "
            "forces over their mean) and `unbalanced_force_ratio` (mean resultant on a particle over mean contact "
            "force): small values say that the run is quasi-static.");
    s.param("platen_velocity", &Config::platen_velocity).unit("m/s").above(0).example("0.2 m/s")
        .doc("of each platen, toward the other").source("Rojek et al. (2012), section 5.2: 0.2 m/s");
    s.param("platen_stiffness", &Config::platen_stiffness).unit("N/m").above(0).example("15 MN/m")
        .doc("penalty stiffness of the contact of a particle with a platen").source("Rojek et al. (2012), section 5.2: 15 MN/m");
    s.param("platen_friction", &Config::platen_friction).at_least(0).fallback(0.0)
        .doc("Coulomb coefficient between particles and platens").source("Rojek et al. (2012), section 5.2: frictionless");
    s.param("platen_stiffness_ratio", &Config::stiffness_ratio).above(0).fallback(1.0)
        .doc("normal over shear stiffness of a platen contact; matters only with friction");
    s.param("ramp_time", &Config::ramp_time).unit("s").at_least(0).fallback(20e-6)
        .doc("time in which the platens reach their velocity");
    s.param("seating_stress", &Config::seating_stress).unit("Pa").at_least(0).fallback(0.5e6)
        .doc("both platens must carry this stress before strain is counted");
    s.param("max_strain", &Config::max_strain).above(0).below(1).fallback(0.05)
        .doc("platen strain at which the test ends at the latest");
    s.param("stop_stress_ratio", &Config::stop_stress_ratio).at_least(0).below(1).fallback(0.3)
        .doc("the test ends once the platen stress has fallen to this share of its peak; 0: never for this reason");
    s.param("failure_stress", &Config::failure_stress).unit("Pa").at_least(0).fallback(5e6)
        .doc("a stress drop counts as failure only if the peak was above this");
    s.check([](const Config& c, Issues& issues) {
      if (c.failure_stress < c.seating_stress) issues.push_back({"failure_stress", "must not be below seating_stress"});
    });
  }

  explicit UniaxialCompression(const Config& config) : c_(config) {}

  void setup(const SimulationView& view, LoadControl& control, Recorder& recorder, Host&) override {
    axis_ = view.specimen.axis;
    area_ = view.specimen.cross_section_area;
    const double shear = c_.platen_friction > 0 ? c_.platen_stiffness / c_.stiffness_ratio : 0;
    lower_ = control.add_wall({"lower_platen", view.specimen.base, axis_, c_.platen_stiffness, shear, c_.platen_friction});
    upper_ = control.add_wall({"upper_platen", view.specimen.base + view.specimen.height * axis_, -axis_, c_.platen_stiffness, shear, c_.platen_friction});
    s_.height = view.specimen.height;
    column_[0] = recorder.add({"platen_stress", "Pa", "mean of both platens' normal forces over the cross-section; compression positive"});
    column_[1] = recorder.add({"platen_strain", "1", "approach of the platens since seating over the height then"});
    column_[2] = recorder.add({"platen_imbalance", "1", "difference of the platens' forces over their mean"});
    column_[3] = recorder.add({"unbalanced_force_ratio", "1", "mean resultant on a particle over mean contact force"});
  }

  void step(LoadControl& control) override {
    if (!s_.started) { s_.start_time = control.time(); s_.started = true; }
    const double t = control.time() - s_.start_time;
    const double share = t < c_.ramp_time ? 0.5 * (1 - std::cos(M_PI * t / c_.ramp_time)) : 1.0;
    control.set_wall_velocity(lower_, share * c_.platen_velocity * axis_);
    control.set_wall_velocity(upper_, -share * c_.platen_velocity * axis_);
  }

  Progress sample(const SimulationView& view, LoadControl& control, Recorder& recorder) override {
    const WallView &low = view.walls[lower_], &up = view.walls[upper_];
    const double on_low = -low.force.dot(axis_), on_up = up.force.dot(axis_), mean = 0.5 * (on_low + on_up);
    if (!s_.seated) {
      const double need = c_.seating_stress * area_;
      if (low.contacts == 0 || up.contacts == 0 || std::min(on_low, on_up) < need) return too_late(low, up);
      s_.seated = true;
      s_.seating_approach = approach(low, up);
      s_.height = (up.point - low.point).dot(axis_);
      control.mark_start_of_loading();
      s_.strain = 0;
    } else {
      s_.strain = approach(low, up) / s_.height;
    }
    s_.stress = mean / area_;
    s_.peak = std::max(s_.peak, s_.stress);
    recorder.set(column_[0], s_.stress);
    recorder.set(column_[1], s_.strain);
    recorder.set(column_[2], mean > 0 ? (on_up - on_low) / mean : 0.0);
    recorder.set(column_[3], unbalanced_force_ratio(view));
    const bool failed = c_.stop_stress_ratio > 0 && s_.peak > c_.failure_stress && s_.stress < c_.stop_stress_ratio * s_.peak;
    s_.failed = failed;
    return failed || s_.strain >= c_.max_strain ? Progress::finished : Progress::running;
  }

  double share_done() const override {
    if (s_.failed) return 1;
    return std::min(1.0, s_.strain / c_.max_strain);
  }
  std::string status() const override {
    char text[64];
    std::snprintf(text, sizeof text, s_.seated ? "stress %.1f MPa" : "seating", s_.stress * 1e-6);
    return text;
  }
  void finish(const SimulationView&, const Curves& curves, Summary& summary) override {
    summary.own("seated", s_.seated);
    summary.own("seating_approach_m", s_.seating_approach);
    summary.own("height_at_seating_m", s_.height);
    summary.own("cross_section_area_m2", area_);
    summary.own("peak_platen_stress_Pa", s_.peak);
    summary.own("final_platen_strain", s_.strain);
    summary.own("stopped_by", s_.failed ? "stress drop" : s_.strain >= c_.max_strain ? "max_strain" : "request");
    // Evidence of a quasi-static run: the ratio over the loading branch between 10 % and 90 % of the peak.
    if (curves.rows() == 0) return;
    const auto stress = curves.column("platen_stress"), ratio = curves.column("unbalanced_force_ratio");
    double most = 0;
    for (std::size_t k = 0; k < stress.size() && stress[k] < 0.9 * s_.peak; ++k)
      if (stress[k] > 0.1 * s_.peak) most = std::max(most, ratio[k]);
    summary.own("unbalanced_force_ratio_max_before_peak", most);
  }
  std::span<std::byte> state() override { return std::as_writable_bytes(std::span(&s_, 1)); }

 private:
  struct Running {
    double start_time = 0, height = 0, seating_approach = 0, strain = 0, stress = 0, peak = 0;
    bool started = false, seated = false, failed = false;
  };

  static double unbalanced_force_ratio(const SimulationView& view) {
    double resultant = 0, contact = 0;
    std::size_t contacts = 0;
    for (const Vec3& f : view.particles.force) resultant += f.norm();
    for (const PairForce& f : view.pairs.force) {
      const double size = std::sqrt(f.fx * f.fx + f.fy * f.fy + f.fz * f.fz);
      contact += size;
      contacts += size > 0;
    }
    return contact > 0 ? resultant / double(view.particles.size()) / (contact / double(contacts)) : 0.0;
  }
  double approach(const WallView& low, const WallView& up) const { return (low.displacement - up.displacement).dot(axis_); }
  /// Platens that have closed by the largest strain without both being loaded will never seat.
  Progress too_late(const WallView& low, const WallView& up) const {
    if (approach(low, up) < c_.max_strain * s_.height) return Progress::running;
    throw UserError("protocol: the platens approached by max_strain without both carrying seating_stress; "
                    "lower seating_stress, or look whether the specimen reaches from end to end");
  }

  Config c_;
  Vec3 axis_ = Vec3::UnitZ();
  double area_ = 0;
  std::size_t lower_ = 0, upper_ = 0, column_[4] = {};
  Running s_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::UniaxialCompression, "protocol", "uniaxial_compression")
