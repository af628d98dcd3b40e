// SPDX-License-Identifier: BSD-3-Clause
#include "check/law_check.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstring>

#include "check/example.hpp"
#include "check/law_ways.hpp"

namespace breccia {
namespace {

class LawCheck {
 public:
  LawCheck(const Registry& registry, const PluginChoice& choice, const Host& user)
      : registry_(registry), choice_(choice), user_(user) {
    try {
      law_ = make(choice.config);
    } catch (const UserError& of_spheres) {
      dimension_ = 2;
      try {
        law_ = make(choice.config);
      } catch (const UserError&) { throw of_spheres; }
    }
    const ContactStiffness k = LawRig(*law_, {}, 1e-9).stiffness();
    const double mass = 1e-5,
                 stiffest = std::max({k.normal, k.shear, (k.bending + k.torsion) / (checked_radius * checked_radius)});
    scale_ = std::max(law_->makes_bonds() ? 0.0 : LawRig::spring_before, std::isfinite(stiffest) ? stiffest : 0.0);
    dt_ = stiffest > 0 && std::isfinite(stiffest) ? 0.05 * std::sqrt(mass / stiffest) : 1e-8;
  }

  CheckFindings operator()() {
    if (dimension_ == 2)
      add("dimensions", true, "with these parameters for discs only: all that follows is in their plane", "");
    for (const bool bonded : {true, false}) {
      if (bonded && !law_->makes_bonds()) continue;
      at_rest(bonded);
      stiffnesses(bonded);
      for (const Way& way : ways(bonded, dimension_)) energy(way);
      frames(bonded);
    }
    vectors();
    box();
    speed();
    return std::move(found_);
  }

 private:
  std::unique_ptr<GuardedLaw> make(const Json& config) const {
    auto law = std::make_unique<GuardedLaw>(registry_.create<ContactLaw>({choice_.type, config}), choice_.type);
    const std::vector<double> r = {checked_radius, 0.8 * checked_radius}, m = {1.1e-5, 5.7e-6};
    const std::vector<Index> i = {0}, j = {1};
    Assembly a;
    a.dimension = dimension_;
    a.radius = r;
    a.mass = m;
    a.bond_i = i;
    a.bond_j = j;
    a.porosity = 0.35;
    a.coordination_number = 8;
    law->prepare(a);
    return law;
  }
  LawRig rig(const Way& way, double dt) { return rig(*law_, way, dt); }
  static LawRig rig(ContactLaw& law, const Way& way, double dt) {
    LawRig::Start start;
    start.bonded = way.bonded;
    return {law, start, dt};
  }
  void checked() {
    law_->check();  // what the law threw
  }
  void add(std::string check, bool holds, std::string measured, std::string mend) {
    if (user_.cancelled()) throw Cancelled();
    checked();
    using Outcome = CheckFinding::Outcome;
    found_.push_back(
        {std::move(check), holds ? Outcome::holds : Outcome::fails, std::move(measured), holds ? "" : std::move(mend)});
  }

  void at_rest(bool bonded) {
    Way way;
    way.bonded = bonded;
    LawRig pair = rig(way, dt_);
    const double scale = scale_ * checked_radius;
    const double force = pair.last().force.norm();
    add("no force where nothing was moved, " + bonded_text(bonded),
        force <= 1e-9 * scale && pair.energy() <= 1e-12 * scale * checked_radius,
        fmt::format("{:.3g} N, {:.3g} J", force, pair.energy()),
        "at `rest_length` a new pair must be free of force and energy: look at `initial` and where displacements "
        "start");
  }

  /// The stated stiffness sets the time step: too small, and the motion runs away.
  void stiffnesses(bool bonded) {
    const double slow = 1e12 * dt_, tiny = 1e-7;  // nothing that depends on rates is left
    struct Direction {
      const char* name;
      double ContactStiffness::*stated;
      Vec3 shift, turn;
    };
    const double a = checked_radius, b = 0.8 * checked_radius;
    for (const Direction& d : {Direction{"normal", &ContactStiffness::normal, Vec3(-1, 0, 0), Vec3::Zero()},
                               {"shear", &ContactStiffness::shear, Vec3(0, 0.6, 0.8), Vec3::Zero()},
                               {"bending", &ContactStiffness::bending, Vec3::Zero(), Vec3(0, 0.6, 0.8)},
                               {"torsion", &ContactStiffness::torsion, Vec3::Zero(), Vec3(1, 0, 0)}}) {
      const auto unit = [](const Vec3& v) { return v.isZero(0) ? v : Vec3(v.normalized()); };
      const Vec3 turn = unit(about_plane(d.turn, dimension_));
      Way way{d.name, unit(in_plane(d.shift, dimension_)), -0.5 * turn, 0.5 * turn, bonded};
      // Bending without shear: the contact point of both stays.
      const Vec3 n(1, 0, 0);
      way.shift += (a * way.turn_i + b * way.turn_j).cross(n) / checked_radius;
      LawRig pair = rig(way, slow);
      Way press;
      press.shift = Vec3(-1, 0, 0);
      if (!bonded)
        for (int k = 0; k < 50; ++k) pair.step(motion(press, 2e-3, 0.02, slow));
      pair.step({});
      const double stated = pair.stiffness().*d.stated;
      const PairResponse before = pair.last();
      const PairResponse after = pair.step(motion(way, tiny, 1, slow));
      const bool turns = !turn.isZero(0);
      const double slope =
          turns ? 0.5 * ((after.torque_i - before.torque_i) - (after.torque_j - before.torque_j)).norm() / tiny
                : (after.force - before.force).norm() / (tiny * checked_radius);
      if (turns && !law_->has_moments()) continue;  // without moments only what is there already turns with the pair
      if (slope <= 1e-6 * scale_ * (turns ? checked_radius * checked_radius : 1) && stated == 0) continue;
      add(fmt::format("stiffness, {}, {}", d.name, bonded_text(bonded)), stated >= 0.95 * slope,
          fmt::format("stated {:.4g}, the force's slope {:.4g} {}", stated, slope, turns ? "N m/rad" : "N/m"),
          fmt::format("`stiffness` states too little in `{}`: the time step will be too long", d.name));
    }
  }

  struct Balance {
    double error = 0, scale = 0, least_dissipated = 0;
    bool finite = true, broke = false;
    double share = 1;  ///< of the way where the bond broke
  };
  Balance follow(const Way& way, double amplitude, int steps) {
    LawRig pair = rig(way, dt_);
    Balance b;
    double dissipated = 0, stored_most = 0;
    const double before = pair.energy();
    // There, half the way back, and on: springs are loaded, unloaded and loaded again.
    const double turning = 0.5, back = 0.2;
    const auto led = [&](double from, double to) {
      const int n = std::max(1, int(std::lround(steps * std::abs(to - from))));
      for (int k = 0; k < n && b.finite; ++k) {
        const PairResponse r = pair.step(motion(way, amplitude, (to - from) / n, dt_));
        b.finite = b.finite && r.finite();
        dissipated += r.friction + r.contact + r.fracture;
        b.least_dissipated = std::min({b.least_dissipated, r.friction, r.contact, r.fracture});
        if (way.bonded && !b.broke && !pair.intact()) {
          b.broke = true;
          b.share = from + (to - from) * (k + 1) / n;
        }
        stored_most = std::max(stored_most, std::abs(pair.energy()));
      }
    };
    led(0, turning);
    led(turning, back);
    led(back, 1);
    b.scale = std::max(pair.way(), stored_most);
    b.error = std::abs(pair.work() - (pair.energy() - before) - dissipated);
    return b;
  }

  void energy(const Way& way) {
    double amplitude = 0.02;
    constexpr int steps = 2000;
    Balance b = follow(way, amplitude, steps);
    // A bond that breaks at once is led there in steps that are small to that.
    for (int k = 0; k < 12 && b.broke && b.share < 0.4 && b.finite; ++k) {
      amplitude *= std::max(1.5 * b.share, 0.01);
      b = follow(way, amplitude, steps);
    }
    const Balance fine = follow(way, amplitude, 8 * steps);
    const double error = fine.scale > 0 ? fine.error / fine.scale : 0;
    const std::string name = way.name + ", " + bonded_text(way.bonded);
    if (!b.finite || !fine.finite) {
      add("energy against work, " + name, false, "a force or energy that is not a number",
          "look for divisions by zero and roots of negative numbers along this way");
      return;
    }
    add("energy against work, " + name, error <= 0.01 || (fine.error < 1e-15 && b.error < 1e-15),
        fmt::format("{:.2g} % of {:.3g} J unaccounted for{}", 100 * error, fine.scale,
                    fine.broke ? ", through its failure" : ""),
        "the force does not do the work that `energy` and the reported dissipation account for: look at their signs "
        "and "
        "components in this direction");
    if (fine.least_dissipated < -1e-9 * fine.scale)
      add("dissipation, " + name, false, fmt::format("{:.3g} J in one step", fine.least_dissipated),
          "friction_work, contact_work and fracture_energy cannot be negative");
  }

  /// The configuration as it is for a pair that is turned: with what is a direction in space turned, too.
  Json turned_config(const Mat3& turn) const {
    Json config = choice_.config;
    for (const ParamSpec& p : registry_.documentation(ContactLaw::kind, choice_.type).root.members) {
      const bool direction = p.name.ends_with("normal") || p.name.ends_with("direction");
      if (!direction || !config.contains(p.name) || !config[p.name].is_array() || config[p.name].size() != 3) continue;
      const auto along = config[p.name].get<std::array<double, 3>>();
      const Vec3 there = turn * Vec3(along[0], along[1], along[2]);
      config[p.name] = {there.x(), there.y(), there.z()};
    }
    return config;
  }

  /// Where the pair lies in space, and which end is the first, is nobody's business.
  void frames(bool bonded) {
    double turned = 0, swapped = 0;
    const Vec3 axis = about_plane(Vec3(0.3, -0.5, 0.8), dimension_).normalized();
    const Mat3 turn = Eigen::AngleAxisd(1.1, axis).toRotationMatrix();
    const auto there = make(turned_config(turn));
    for (const Way& way : ways(bonded, dimension_)) {
      LawRig::Start start;
      start.bonded = bonded;
      LawRig::Start rotated = start, exchanged = start;
      rotated.turned = turn;
      exchanged.swapped = true;
      LawRig a(*law_, start, dt_), r(*there, rotated, dt_), s(*law_, exchanged, dt_);
      constexpr double amplitude = 0.002;
      double most = 1e-6 * scale_ * amplitude * checked_radius, off_turned = 0, off_swapped = 0;
      constexpr int steps = 400;
      for (int k = 0; k < steps; ++k) {
        const PairMotion m = motion(way, amplitude, 1.0 / steps, dt_);
        const PairResponse x = a.step(m), y = r.step(m), z = s.step(m);
        if (r.intact() != a.intact() || s.intact() != a.intact()) break;  // rounding may part them by a step
        most = std::max({most, x.force.norm(), (x.torque_i.norm() + x.torque_j.norm()) / checked_radius});
        off_turned = std::max({off_turned, (y.force - turn * x.force).norm(),
                               (y.torque_i - turn * x.torque_i).norm() / checked_radius,
                               (y.torque_j - turn * x.torque_j).norm() / checked_radius});
        off_swapped =
            std::max({off_swapped, (z.force + x.force).norm(), (z.torque_i - x.torque_j).norm() / checked_radius,
                      (z.torque_j - x.torque_i).norm() / checked_radius});
      }
      if (most > 0) turned = std::max(turned, off_turned / most), swapped = std::max(swapped, off_swapped / most);
    }
    constexpr double rounding = 1e-6;
    add("turned in space, " + bonded_text(bonded), turned <= rounding, fmt::format("forces differ by {:.2g}", turned),
        "the answer depends on the directions of the axes: components are mixed up, or vectors of the history are not "
        "turned with the pair (`follow_plane`)");
    add("ends exchanged, " + bonded_text(bonded), swapped <= rounding, fmt::format("forces differ by {:.2g}", swapped),
        "the answer depends on which particle is i: radii, lever arms or signs are not symmetric");
  }

  /// The vector loop gives the bits of the law by itself, and the same ones a second time.
  void vectors() {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    LawRig pair(*law_, {}, dt_, PairChunk::capacity);
    PairChunk& g = pair.chunk();
    for (std::size_t k = 0; k < g.size; ++k) {
      const Vec3 d = in_plane(random_direction(random), dimension_).normalized() * g.rest[k] * (1 + 2e-3 * u(random));
      g.dx[k] = d.x(), g.dy[k] = d.y(), g.dz[k] = d.z();
      for (double* v : {g.vx, g.vy, g.vz}) v[k] = 0.1 * u(random);
      for (double* w : {g.wix, g.wiy, g.wiz, g.wjx, g.wjy, g.wjz}) w[k] = 50 * u(random);
      if (dimension_ == 2) g.vz[k] = g.wix[k] = g.wiy[k] = g.wjx[k] = g.wjy[k] = 0;
      g.intact[k] = g.may_break[k] = k % 3 != 0 && law_->makes_bonds() ? 1 : 0;
    }
    const std::size_t columns = law_->columns().size();
    std::vector<std::vector<double>> first(columns, std::vector<double>(PairChunk::capacity));
    const auto pointers = [](std::vector<std::vector<double>>& h) {
      std::vector<double*> p;
      for (auto& c : h) p.push_back(c.data());
      return p;
    };
    law_->initialise(g, pointers(first).data());
    bool same = true, again = true, moments = false;
    auto once = std::make_unique<PairAnswer>(), twice = std::make_unique<PairAnswer>();
    for (int round = 0; round < 3; ++round) {  // the history of the first is what the next begins with
      std::vector<std::vector<double>> a = first, b = first, c = first;
      *once = *twice = {};
      law_->evaluate(g, pointers(a).data(), *once, false);
      law_->evaluate(g, pointers(b).data(), *twice, false);
      again = again && a == b && std::memcmp(once.get(), twice.get(), sizeof(PairAnswer)) == 0;
      for (std::size_t k = 0; k < g.size; ++k) {
        const ContactForce f = law_->answer(g, k, pointers(c).data());
        same = same && f.normal == once->normal[k] && f.friction_work == once->friction[k] &&
               f.contact_work == once->contact[k] && f.fracture_energy == once->fracture[k];
        moments = moments || f.moment_x != 0 || f.moment_y != 0 || f.moment_z != 0;
      }
      same = same && a == c;
      first = a;
    }
    add("the same twice", again, again ? "equal bits" : "other bits the second time",
        "the answer depends on something besides the contact and its State: a static or uninitialised variable?");
    add("vector loop and single pairs", same, same ? "equal bits" : "other bits",
        "the compiler may reorder sums: build with the flags of Breccia::sdk only, without -ffast-math");
    add("moments are declared", law_->has_moments() || !moments, moments ? "has moments" : "no moments",
        "say `static constexpr bool has_moments = true;`: the moments that it fills are lost");
  }

  /// Whatever the ranges of the parameters allow must give numbers.
  void box() {
    std::mt19937_64 random(13);
    int tried = 0;
    std::string bad;
    const ParamSpec& root = registry_.documentation(ContactLaw::kind, choice_.type).root;
    for (int draw = 0; draw < 60 && bad.empty(); ++draw) {
      const Json config = drawn_config(root, choice_.config, random, 2, true);
      if (!registry_.check(ContactLaw::kind, choice_.type, config).empty()) continue;
      std::unique_ptr<GuardedLaw> law;
      try {
        law = make(config);
      } catch (const UserError&) { continue; }  // it says itself what does not go together
      ++tried;
      for (const bool bonded : {true, false})
        for (const Way& way : ways(bonded, dimension_)) {
          LawRig pair = rig(*law, way, dt_);
          bool finite = std::isfinite(pair.stiffness().normal + pair.stiffness().shear);
          for (int k = 0; k < 60 && finite; ++k)
            finite =
                pair.step(motion(way, k < 30 ? 1e-3 : 0.3, 1.0 / 60, dt_)).finite() && std::isfinite(pair.energy());
          law->check();
          if (!finite && bad.empty()) bad = way.name + ", " + bonded_text(bonded) + ", with " + config.dump();
        }
    }
    add("numbers for all that the ranges allow", bad.empty(),
        bad.empty() ? fmt::format("{} draws of the parameters", tried) : bad,
        "narrow the range, say in `check` what does not go together, or mind the division by zero");
  }

  /// Of a pair [ns], by the vector loop and by the law alone: the least of several, since other work can only add.
  struct Speed {
    double loop = 1e300, alone = 1e300;
  };
  static Speed speed_of(ContactLaw& law) {
    LawRig pair(law, {}, 1e-9, PairChunk::capacity);
    PairChunk& g = pair.chunk();
    std::vector<std::vector<double>> history(law.columns().size(), std::vector<double>(PairChunk::capacity));
    std::vector<double*> h;
    for (auto& c : history) h.push_back(c.data());
    law.initialise(g, h.data());
    auto answer = std::make_unique<PairAnswer>();
    *answer = {};
    const auto take = [](double& least, auto&& work) {
      constexpr int rounds = 400;
      const auto start = std::chrono::steady_clock::now();
      for (int r = 0; r < rounds; ++r) work();
      const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
      least = std::min(least, took.count() / (rounds * double(PairChunk::capacity)));
    };
    Speed least;
    for (int k = 0; k < 30; ++k) {
      take(least.loop, [&] { law.evaluate(g, h.data(), *answer, false); });
      take(least.alone, [&] {
        for (std::size_t p = 0; p < g.size; ++p) law.answer(g, p, h.data());
      });
    }
    return least;
  }
  void speed() {
    // Two doubles at a time is the least that vector registers hold; what stands around the law alone takes its share.
    Speed own = speed_of(*law_);
    const auto vectorised = [&] { return own.alone >= 2 * own.loop; };
    for (int again = 0; again < 2 && !vectorised(); ++again) own = speed_of(*law_);  // other work may have come between
    add("the loop is vectorised", vectorised(),
        fmt::format("{:.2g} ns a pair in the loop, {:.2g} one at a time", own.loop, own.alone),
        "the compiler left the law's loop as it was: `condition ? a : b` with both sides cheap, `&` and `|` in place "
        "of "
        "`&&` and `||`, no static variables, nothing called that is not BRECCIA_KERNEL");
    std::string text = fmt::format("{:.2g} ns a pair and step", own.loop);
    const auto names = registry_.names(ContactLaw::kind);
    if (const std::string other = "elastic_brittle"; std::find(names.begin(), names.end(), other) != names.end()) {
      LawCheck reference(registry_, example_plugin(registry_, ContactLaw::kind, other), user_);
      text += fmt::format("; `{}` {:.2g}", other, speed_of(*reference.law_).loop);
    }
    add("speed", true, text, "");
  }

  const Registry& registry_;
  PluginChoice choice_;
  const Host& user_;
  std::unique_ptr<GuardedLaw> law_;
  int dimension_ = 3;          ///< 2: of a law that spheres cannot have
  double dt_ = 0, scale_ = 0;  ///< [s]; a stiffness that counts [N/m]
  CheckFindings found_;
};

}  // namespace

CheckFindings check_law(const Registry& registry, const PluginChoice& law, const Host& user) {
  return LawCheck(registry, law, user)();
}

}  // namespace breccia
