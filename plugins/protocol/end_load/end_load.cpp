// SPDX-License-Identifier: BSD-3-Clause
/// Dead loads on parts of a specimen that is held at others, static or dynamic.
#include <map>

#include "group.hpp"
#include "running.hpp"

namespace breccia::end_load {

class EndLoad final : public Protocol {
 public:
  using Config = end_load::Config;
  static void describe(Schema<Config>& s) { end_load::describe(s); }
  explicit EndLoad(const Config& config) : c_(config) {}

  void setup(const SimulationView& view, LoadControl& control, Recorder& recorder, Host& host) override {
    host_ = &host;
    shape_ = specimen_along(c_.axis, view, control);
    space_ = view;
    const double speed = control.bond_stiffness().wave_speed, travel = speed > 0 ? shape_.height / speed : 0;
    if (!(travel > 0) && (!c_.ramp_time || !(c_.duration || c_.max_time)))
      throw UserError(
          "protocol end_load: without bonds there is no wave by which times could be chosen: give `ramp_time`, and "
          "`duration` or `max_time`");
    // What bends swings more slowly than waves travel, in proportion to how slender it is.
    const double area = shape_.cross_section_area,
                 breadth = space_.dimension == 2 ? area / view.thickness : std::sqrt(area),
                 slow = travel * std::max(1.0, shape_.height / breadth);
    ramp_time_ = c_.ramp_time.value_or(20 * slow);
    max_time_ = c_.max_time.value_or(1000 * slow);
    max_displacement_ = c_.max_displacement.value_or(0.1 * shape_.height);
    take_supports(view, control);
    take_loads(view);
    factor_ = recorder.add({"load_factor", "1", "share of the loads that is applied"});
    for (const Loaded& l : loads_) force_ += l.force.norm();
    if (force_ > 0) {
      load_ = recorder.add({"load", "N", "magnitudes of the applied forces, added up", role::load});
      load_displacement_ =
          recorder.add({"load_displacement", "m", "of the points of the forces along them, weighted by the forces",
                        role::displacement});
    }
    for (const Supported& s : supports_) add_columns(recorder, s.group, true);
    for (const Loaded& l : loads_) add_columns(recorder, l.group, false);
    unbalanced_ = recorder.add({"unbalanced_load_share", "1",
                                "sum of the resultants on free particles over the sum of the loads on particles"});
    s_.rotation.assign(supports_.size() + loads_.size(), Vec3::Zero());
  }

  void step(LoadControl& control) override {
    const double time = control.time();
    if (!s_.begun) {
      s_.begun = true;
      s_.last_time = time;
      s_.full_at = time + ramp_time_;
      s_.ramp.lead_to(1, time, ramp_time_);
    }
    const bool released = c_.release_after && time >= s_.full_at + *c_.release_after;
    const double factor = released ? 0.0 : s_.ramp.at(time);
    if (factor == s_.factor) return;
    s_.factor = factor;
    for (const OnParticle& on : on_particles_)
      control.set_applied_force(on.particle, factor * on.force, factor * on.torque, Mat3::Zero());
  }

  Progress decide(LoadControl& control) override {
    if (!s_.marked) control.mark_start_of_loading();
    const SimulationView now = control.particles_here();
    const double time = control.time(), passed = time - s_.last_time;
    s_.last_time = time;
    if (!s_.marked) s_.broken_before = control.broken_bonds();
    s_.marked = true;
    // The velocities are those of the step that led here.
    const std::vector<Motion> of = motions(now);
    for (std::size_t k = 0; k < of.size(); ++k) s_.rotation[k] += passed * of[k].spin;
    s_.displacement = 0;
    for (std::size_t k = supports_.size(); k < of.size(); ++k)
      s_.displacement = std::max(s_.displacement, of[k].displacement.norm());
    const bool broke = control.broken_bonds() > s_.broken_before;
    if (broke && s_.factor_at_break < 0) s_.factor_at_break = s_.factor;
    if (s_.ended == Ending::none) s_.ended = end(now, of, time, broke);
    return s_.ended == Ending::none ? Progress::running : Progress::finished;
  }

  /// A load that is watched for a time may come as fast as it likes: none of it is held to be quasi-static.
  double load() const override { return c_.duration ? 0 : s_.factor; }
  double load_scale() const override { return c_.duration ? 0 : 1; }

  bool sees_parts() const override { return true; }
  void sample(const SimulationView& view, Recorder& recorder) const override {
    const std::vector<Motion> of = motions(view);
    recorder.set(factor_, s_.factor);
    if (force_ > 0) {
      double work = 0;
      for (std::size_t k = 0; k < loads_.size(); ++k)
        work += loads_[k].force.dot(of[supports_.size() + k].displacement);
      recorder.set(load_, s_.factor * force_);
      recorder.set(load_displacement_, work / force_);
    }
    recorder.set(unbalanced_, unbalanced(view));
    std::size_t column = 0;
    for (const double value : values(view, of)) recorder.set(columns_[column++], value);
  }

  double share_done() const override {
    const double ramped = ramp_time_ > 0 ? std::clamp(1 - (s_.full_at - s_.last_time) / ramp_time_, 0.0, 1.0) : 1.0;
    if (s_.ended != Ending::none) return 1;
    if (!s_.begun || s_.last_time < s_.full_at) return 0.3 * ramped;
    const double after = s_.last_time - s_.full_at;
    const double rest = c_.duration ? after / (c_.release_after.value_or(0) + *c_.duration)
                                    : std::log(std::max(s_.unrest, c_.rest)) / std::log(c_.rest);
    return 0.3 + 0.7 * std::clamp(rest, 0.0, 1.0);
  }
  std::string status() const override {
    char text[96];
    std::snprintf(text, sizeof text, "load %.0f %%, displacement %.4g mm", 100 * s_.factor, 1e3 * s_.displacement);
    return text;
  }

  void finish(const SimulationView& view, const Curves&, Summary& summary) override {
    Json counts = Json::object();
    for (std::size_t k = 0; k < s_.rotation.size(); ++k) counts[group(k).name()] = group(k).rows().size();
    summary.own("particles", counts);
    const std::vector<double> last = values(view, motions(view));
    for (std::size_t k = 0; k < last.size(); ++k) summary.own({names_[k].name, names_[k].unit}, last[k]);
    summary.own("load_factor_at_end", s_.factor);
    summary.own("load_factor_at_first_break", s_.factor_at_break < 0 ? Json() : Json(s_.factor_at_break));
    summary.own("unbalanced_load_share_at_end", unbalanced(view));
    summary.own({"ramp_time", "s"}, ramp_time_);
    const char* const by[] = {"request", "rest", "duration", "max_displacement", "max_time", "first break"};
    summary.own("stopped_by", by[std::size_t(s_.ended)]);
  }
  bool archive(Archive& archive) override {
    archive("running", s_);
    return true;
  }

 private:
  struct Supported {
    Group group;
    std::uint8_t mask;
  };
  struct Loaded {
    Group group;
    Vec3 force, moment;  ///< all of it [N], [N m]
  };
  struct OnParticle {
    Index particle;      ///< row in the whole
    double radius;       // [m]
    Vec3 force, torque;  // [N], [N m]
  };
  void take_supports(const SimulationView& view, LoadControl& control) {
    for (std::size_t k = 0; k < c_.supports.size(); ++k) {
      const Support& s = c_.supports[k];
      const std::string path = "supports[" + std::to_string(k) + "]";
      std::uint8_t mask = 0;
      for (const std::string& word : s.holds) mask |= held_by(word);
      supports_.push_back({Group(s, group_name(s, k, "support"), path, shape_, view), mask});
      for (const Index at : supports_.back().group.rows()) {
        if (held_[at] & mask)
          throw UserError("protocol end_load: " + path +
                          " holds what another support holds already: make `depth` smaller, or the ranges narrower");
        held_[at] |= mask;
        control.hold(at, mask, Vec3::Zero(), Vec3::Zero());
      }
    }
  }

  void take_loads(const SimulationView& view) {
    std::map<Index, std::size_t> place;  // of a particle in `on_particles_`
    for (std::size_t k = 0; k < c_.loads.size(); ++k) {
      const Load& l = c_.loads[k];
      const std::string path = "loads[" + std::to_string(k) + "]";
      const Vec3 force = l.force.value_or(Vec3::Zero()), moment = l.moment.value_or(Vec3::Zero());
      if (space_.dimension == 2 && (force.z() != 0 || moment.x() != 0 || moment.y() != 0))
        throw UserError("protocol end_load: " + path +
                        ": in two dimensions a force has no z, and a moment nothing but z");
      loads_.push_back({Group(l, group_name(l, k, "load"), path, shape_, view, l.share), force, moment});
      const Group& group = loads_.back().group;
      for (std::size_t n = 0; n < group.rows().size(); ++n) {
        const Index at = group.rows()[n];
        const auto held = held_.find(at);
        refuse_into_support(path, force, moment, held == held_.end() ? std::uint8_t(0) : held->second);
        const auto [to, is_new] = place.try_emplace(at, on_particles_.size());
        if (is_new) on_particles_.push_back({at, group.radius(n), Vec3::Zero(), Vec3::Zero()});
        on_particles_[to->second].force += group.weight(n) * force;
        on_particles_[to->second].torque += group.weight(n) * moment;
      }
    }
    for (const OnParticle& on : on_particles_) size_ += on.force.norm() + on.torque.norm() / on.radius;
  }
  static void refuse_into_support(const std::string& path, const Vec3& force, const Vec3& moment, std::uint8_t held) {
    for (int c = 0; c < 6; ++c)
      if ((held >> c & 1) && (c < 3 ? force[c] : moment[c - 3]) != 0)
        throw UserError("protocol end_load: " + path + (c < 3 ? ": its force along " : ": its moment about ") +
                        "xyz"[c % 3] + " goes into a support that holds the same particles in that way");
  }

  void add_columns(Recorder& recorder, const Group& group, bool supported) {
    const auto add = [&](const char* what, const char* unit, const char* doc, bool turns) {
      for (int c = 0; c < 3; ++c) {
        if (space_.dimension == 2 && (turns ? c < 2 : c == 2)) continue;
        names_.push_back({group.name() + "_" + what + "_" + "xyz"[c], unit, doc});
        columns_.push_back(recorder.add(names_.back()));
      }
    };
    add("displacement", "m", "mean of the group's particles, as the load is shared", false);
    add("rotation", "rad", "mean of what the group's particles turned by", true);
    if (!supported) return;
    add("reaction_force", "N", "of the support on the specimen", false);
    add("reaction_moment", "N m", "of the support on the specimen, about the middle of the group", true);
  }
  /// In the order of the columns.
  std::vector<double> values(const SimulationView& view, const std::vector<Motion>& of) const {
    const std::vector<Reaction> by_hands = reactions(view, of);
    std::vector<double> all;
    const auto add = [&](const Vec3& v, bool turns) {
      for (int c = 0; c < 3; ++c)
        if (space_.dimension == 3 || (turns ? c == 2 : c < 2)) all.push_back(v[c]);
    };
    for (std::size_t k = 0; k < s_.rotation.size(); ++k) {
      add(of[k].displacement, false);
      add(s_.rotation[k], true);
      if (k >= supports_.size()) continue;
      add(by_hands[k].force, false);
      add(by_hands[k].moment, true);
    }
    return all;
  }
  /// Of all groups, supports first; one message.
  std::vector<Motion> motions(const SimulationView& view) const {
    std::vector<ExactSum> sums(9 * (supports_.size() + loads_.size()));
    for (std::size_t k = 0; 9 * k < sums.size(); ++k) group(k).add_motion(view, std::span(sums).subspan(9 * k, 9));
    const std::vector<double> all = view.sums(sums);
    std::vector<Motion> of;
    for (std::size_t k = 0; k < all.size(); k += 9)
      of.push_back({Vec3::Map(&all[k]), Vec3::Map(&all[k + 3]), Vec3::Map(&all[k + 6])});
    return of;
  }
  std::vector<Reaction> reactions(const SimulationView& view, const std::vector<Motion>& of) const {
    std::vector<ExactSum> sums(6 * supports_.size());
    for (std::size_t k = 0; k < supports_.size(); ++k)
      group(k).add_reaction(view, supports_[k].mask, of[k].middle, std::span(sums).subspan(6 * k, 6));
    const std::vector<double> all = view.sums(sums);
    std::vector<Reaction> found;
    for (std::size_t k = 0; k < all.size(); k += 6) found.push_back({Vec3::Map(&all[k]), Vec3::Map(&all[k + 3])});
    return found;
  }
  const Group& group(std::size_t k) const {
    return k < supports_.size() ? supports_[k].group : loads_[k - supports_.size()].group;
  }

  Ending end(const SimulationView& now, const std::vector<Motion>& of, double time, bool broke) {
    if (s_.displacement >= max_displacement_) return Ending::max_displacement;
    if (broke && c_.stop_at_first_break) return Ending::first_break;
    const double after = time - s_.full_at;
    if (after < 0) return Ending::none;
    if (c_.duration) return after >= c_.release_after.value_or(0) + *c_.duration ? Ending::duration : Ending::none;
    constexpr std::uint32_t steps_between = 20;  // a look goes over all particles
    if (s_.since_look++ % steps_between == 0) {
      s_.unrest = std::max(unbalanced(now), std::sqrt(kinetic_share(now, of)));
      if (s_.unrest <= c_.rest) return Ending::rest;
    }
    if (after < max_time_) return Ending::none;
    char text[200];
    std::snprintf(text, sizeof text,
                  "protocol end_load: the specimen has not come to rest in `max_time`: a share of %.2g of the load is "
                  "still unbalanced, or moves; give it damping, more time, or a larger `rest`",
                  s_.unrest);
    host_->warn(text);
    return Ending::max_time;
  }

  double unbalanced(const SimulationView& view) const { return free_resultants(view) / size_; }
  /// Over the work that the loads, as they are at the end, would have done at once.
  double kinetic_share(const SimulationView& now, const std::vector<Motion>& of) const {
    double work = 0;
    for (std::size_t k = 0; k < loads_.size(); ++k)
      work += loads_[k].force.dot(of[supports_.size() + k].displacement) +
              loads_[k].moment.dot(s_.rotation[supports_.size() + k]);
    const double kinetic = kinetic_energy(now);
    return work > 0 ? kinetic / work : kinetic > 0 ? 1.0 : 0.0;
  }

  Config c_;
  Host* host_ = nullptr;
  SpecimenShape shape_;
  Space space_;
  double ramp_time_ = 0, max_time_ = 0, max_displacement_ = 0;  // [s], [s], [m]
  double size_ = 0;                                             ///< of all loads, particle by particle [N]
  double force_ = 0;                                            ///< magnitudes of the forces, added up [N]
  std::vector<Supported> supports_;
  std::vector<Loaded> loads_;
  std::vector<OnParticle> on_particles_;
  std::map<Index, std::uint8_t> held_;  ///< by the supports, of rows in the whole
  std::vector<Column> names_;
  std::vector<std::size_t> columns_;  ///< of `names_`
  std::size_t factor_ = 0, unbalanced_ = 0, load_ = 0, load_displacement_ = 0;
  Running s_;
};

}  // namespace breccia::end_load

BRECCIA_PLUGIN(breccia::end_load::EndLoad, "protocol", "end_load")
