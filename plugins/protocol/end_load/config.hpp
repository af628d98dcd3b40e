// SPDX-License-Identifier: BSD-3-Clause
/// What a workflow says of supports and loads.
#pragma once

#include <cctype>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "breccia/protocol_tools/axial_config.hpp"

namespace breccia::end_load {

enum class At { lower, middle, upper };
enum class Share { equal, mass };

/// Which particles: all that is given must hold of their centres.
struct Place {
  std::optional<At> at;
  std::optional<double> height, depth;
  std::optional<std::vector<double>> x, y, z;
  std::optional<std::string> name;
};

template <class Group>
void describe_place(Schema<Group>& s) {
  s.param("at", &Group::at)
      .choice("lower", At::lower, "the lower end face of the specimen along the axis")
      .choice("middle", At::middle, "half-way between the ends")
      .choice("upper", At::upper, "the upper end face")
      .doc("where the particles lie");
  s.param("height", &Group::height)
      .unit("m")
      .example("40 mm")
      .doc("the same, as a height above the lower end face along the axis");
  s.param("depth", &Group::depth)
      .unit("m")
      .above(0)
      .example("1 mm")
      .doc(
          "how far below an end face centres may lie; in the middle, or at a height, how thick the layer is about it; "
          "if "
          "absent the largest radius, or the largest diameter");
  for (const auto& [name, range] : {std::pair<const char*, std::optional<std::vector<double>> Group::*>("x", &Group::x),
                                    {"y", &Group::y},
                                    {"z", &Group::z}})
    s.param(name, range)
        .unit("m")
        .items(2, 2)
        .example("[-1 mm, 1 mm]")
        .doc("only centres between these two, as a coordinate of the packing");
  s.param("name", &Group::name)
      .example("\"tip\"")
      .doc("of the group in curves and results; if absent `lower_support`, `upper_load`, `load_2` and the like");
  s.at_most_one_of({"at", "height"});
}

struct Support : Place {
  std::vector<std::string> holds;
  static void describe(Schema<Support>& s) {
    describe_place(s);
    s.param("holds", &Support::holds)
        .items(1, 6)
        .example("[all]")
        .doc(
            "what the particles may not do, each by itself: `x`, `y`, `z`, `rotation_x`, `rotation_y`, `rotation_z`, "
            "or "
            "`translation`, `rotation`, `all`");
  }
};

struct Load : Place {
  std::optional<Vec3> force, moment;
  Share share;
  static void describe(Schema<Load>& s) {
    describe_place(s);
    s.param("force", &Load::force)
        .unit("N")
        .example("[10 N, 0 N, 0 N]")
        .doc("on the group as a whole, in two dimensions on the whole thickness");
    s.param("moment", &Load::moment)
        .unit("N m")
        .example("[0 N m, 0 N m, 1 N m]")
        .doc("on the group as a whole, as torques on its particles; about the axis it is a twist");
    s.param("share", &Load::share)
        .choice("equal", Share::equal, "each particle the same")
        .choice("mass", Share::mass, "each in proportion to its mass")
        .fallback("equal")
        .doc("how force and moment are shared over the particles");
  }
};

struct Config {
  LoadingAxis axis;
  std::vector<Support> supports;
  std::vector<Load> loads;
  std::optional<double> ramp_time, duration, release_after, max_time, max_displacement;
  double rest;
  bool stop_at_first_break;
};

/// Bits of `dof` that a word means; 0: none.
inline std::uint8_t held_by(const std::string& word) {
  const std::pair<const char*, std::uint8_t> words[] = {{"x", dof::x},
                                                        {"y", dof::y},
                                                        {"z", dof::z},
                                                        {"rotation_x", dof::rx},
                                                        {"rotation_y", dof::ry},
                                                        {"rotation_z", dof::rz},
                                                        {"translation", dof::translation},
                                                        {"rotation", dof::rotation},
                                                        {"all", dof::all}};
  for (const auto& [name, bits] : words)
    if (word == name) return bits;
  return 0;
}

inline std::string group_name(const Place& p, std::size_t k, const char* what) {
  if (p.name) return *p.name;
  if (!p.at) return std::string(what) + "_" + std::to_string(k + 1);
  return std::string(*p.at == At::lower ? "lower_" : *p.at == At::upper ? "upper_" : "middle_") + what;
}

/// Rules of what supports and loads have in common.
class PlaceRules {
 public:
  explicit PlaceRules(Issues& issues) : issues_(issues) {}
  void operator()(const Place& p, const std::string& path, const std::string& name) {
    if (!p.at && !p.height && !p.x && !p.y && !p.z)
      issues_.push_back(
          {path, "says of no particles where they are: give `at`, `height`, or a range of `x`, `y`, `z`"});
    if (p.depth && !p.at && !p.height)
      issues_.push_back({path + ".depth", "belongs to `at` or `height`, and neither is given"});
    for (const auto& [key, range] : {std::pair("x", &p.x), {"y", &p.y}, {"z", &p.z}})
      if (*range && (**range)[0] > (**range)[1])
        issues_.push_back({path + "." + key, "the first of the two must be the smaller one"});
    for (const char c : name)
      if (!(std::islower(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)) || c == '_')) {
        issues_.push_back({path + ".name", "`" + name + "`: write small letters, digits and underscores"});
        return;
      }
    if (name.empty() || !names_.insert(name).second)
      issues_.push_back({path + (p.name ? ".name" : ""), name.empty() ? "is empty"
                                                                      : "`" + name +
                                                                            "` is the name of another group: give it a "
                                                                            "`name` of its own"});
  }

 private:
  Issues& issues_;
  std::set<std::string> names_;
};

inline void check_groups(const Config& c, Issues& issues) {
  PlaceRules place(issues);
  for (std::size_t k = 0; k < c.supports.size(); ++k) {
    const std::string path = "supports[" + std::to_string(k) + "]";
    place(c.supports[k], path, group_name(c.supports[k], k, "support"));
    for (const std::string& word : c.supports[k].holds)
      if (!held_by(word))
        issues.push_back(
            {path + ".holds", "`" + word +
                                  "` is nothing that can be held: write some of `x`, `y`, `z`, `rotation_x`, "
                                  "`rotation_y`, `rotation_z`, or `translation`, `rotation`, `all`"});
  }
  for (std::size_t k = 0; k < c.loads.size(); ++k) {
    const std::string path = "loads[" + std::to_string(k) + "]";
    place(c.loads[k], path, group_name(c.loads[k], k, "load"));
    const bool none =
        (!c.loads[k].force || c.loads[k].force->isZero(0)) && (!c.loads[k].moment || c.loads[k].moment->isZero(0));
    if (none) issues.push_back({path, "loads nothing: give a `force` or a `moment` that is not zero"});
  }
}

inline void check_end(const Config& c, Issues& issues) {
  if (c.release_after && !c.duration)
    issues.push_back({"release_after", "needs `duration`: how long what was let go is watched"});
  if (c.max_time && c.duration) issues.push_back({"max_time", "is for a test until rest; `duration` ends this one"});
}

inline void describe(Schema<Config>& s) {
  s.summary("Forces, moments and twists on parts of a specimen that is supported at others: beams, chains, fibres")
      .source("no published test: what beam theory and its checks need")
      .details(
          "Supports hold velocity components of particles, loads are dead loads: they keep their direction. All grow "
          "together, smoothly, in `ramp_time`. Then the test goes on until the specimen is at rest, or for `duration`; "
          "`release_after` takes the load away at once, so that it swings freely. Once bonds break a dead load goes on "
          "pushing: the test ends at `max_displacement`.\n\n"
          "Curves: `load_factor`; of forces `load` (their magnitudes, added up) and `load_displacement` (of the points "
          "where they act, along them, weighted by them: load times displacement is work); of each group "
          "`<name>_displacement_x`, ... (mean of its particles, as shared), "
          "`<name>_rotation_x`, ... (of the particles, from their spins); of supports `<name>_reaction_force_x`, ... "
          "and "
          "`<name>_reaction_moment_x`, ... (on the specimen, about the middle of the group); `unbalanced_load_share`.");
  describe_loading_axis(s);
  s.param("supports", &Config::supports)
      .items(0, 64)
      .example("[{at: lower, holds: [all]}]")
      .doc("what is held; [] for a specimen that nothing holds");
  s.param("loads", &Config::loads).items(1, 64).example("[{at: upper, force: [10 N, 0 N, 0 N]}]").doc("what pushes");
  s.param("ramp_time", &Config::ramp_time)
      .unit("s")
      .at_least(0)
      .example("1 ms")
      .doc(
          "in which the loads grow, along half a cosine; 0: at once; if absent the time of 20 waves from end to end, "
          "times length over breadth of the specimen");
  s.param("rest", &Config::rest)
      .above(0)
      .below(1)
      .fallback(1e-4)
      .doc(
          "the specimen is at rest when the resultants on its free particles add up to no more than this share of the "
          "load, and the kinetic energy to no more than its square of the load's work; needs damping");
  s.param("duration", &Config::duration)
      .unit("s")
      .above(0)
      .example("10 ms")
      .doc("instead of rest: for how long the test goes on once the load is all there, or was taken away");
  s.param("release_after", &Config::release_after)
      .unit("s")
      .at_least(0)
      .example("0 s")
      .doc("takes the load away, at once, so long after it was all there");
  s.param("max_time", &Config::max_time)
      .unit("s")
      .above(0)
      .example("1 s")
      .doc(
          "a specimen that has not come to rest so long after the ramp ends the test; if absent the time of 20 000 "
          "waves "
          "from end to end, times length over breadth");
  s.param("max_displacement", &Config::max_displacement)
      .unit("m")
      .above(0)
      .example("5 mm")
      .doc(
          "of a loaded group, at which the test ends in any case; if absent a tenth of the specimen's length along the "
          "axis");
  s.param("stop_at_first_break", &Config::stop_at_first_break)
      .fallback(false)
      .doc("whether the test ends with the first bond that breaks");
  s.check(check_groups).check(check_end);
}

}  // namespace breccia::end_load
