// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>

#include "bench_case.hpp"
#include "plain_kernel.hpp"

namespace breccia::bench {
namespace {

/// No walls and nothing held: particles that swing freely, each with a velocity and a spin of its own at the start.
State swinging(const Specimen& specimen, double speed) {
  State s = specimen.assembled();
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Particles& p = s.particles;
  for (std::size_t a = 0; a < p.size(); ++a)
    for (int c = 0; c < 3; ++c) {
      p.velocity()[a][c] = speed * normal(random);
      p.angular_velocity()[a][c] = speed / p.radius()[a] * normal(random);
    }
  return s;
}

PlainLaw plain_law(const Workflow& w) {
  const auto& laws = w.contact_law.plugins;
  if (laws.size() != 1 || laws[0].type != "elastic_brittle" || w.dimension != 3)
    throw UserError("the plain kernel knows one law: elastic_brittle between spheres");
  const Json& c = laws[0].config;
  if (c.at("model") != "model_1" || c.at("broken_rest_length") != "initial_distance")
    throw UserError(
        "the plain kernel knows elastic_brittle with `model: model_1`, `broken_rest_length: initial_distance`");
  return {c.at("bond_modulus"), c.at("stiffness_ratio"), c.at("tensile_strength"), c.at("shear_strength"),
          c.at("friction")};
}

/// Norm of a difference over that of what differs.
class Difference {
 public:
  explicit Difference(const char* of) : of_(of) {}
  void add(double engine, double plain) {
    difference_ += (engine - plain) * (engine - plain);
    size_ += plain * plain;
  }
  double relative() const { return difference_ > 0 ? std::sqrt(difference_ / size_) : 0; }
  const char* of() const { return of_; }

 private:
  const char* of_;
  double difference_ = 0, size_ = 0;
};

struct Broken {
  std::size_t torn, sheared;
  double friction;  // [J]
};

/// The engine and the plain kernel from the same start.
class Both {
 public:
  Both(const Specimen& specimen, const Workflow& w, double speed)
      : laws_(specimen.registry, w.contact_law, w.material_list()),
        engine_(swinging(specimen, speed), laws_.interactions(), specimen.settings(1)),
        plain_((engine_.bond(w.bonding.rule()), engine_.prepare(), engine_.state()), plain_law(w),
               specimen.settings(1).damping) {}

  void engine_steps(int n) {
    for (int k = 0; k < n; ++k) {
      engine_.forces(false);
      engine_.advance();
    }
  }
  void plain_steps(int n) {
    for (int k = 0; k < n; ++k) plain_.step();
  }
  Broken compare();  ///< after as many steps of each, and one more. UserError: they do not move alike
  void refuse_new_list() const;
  const State& state() const { return engine_.state(); }

 private:
  ContactLaws laws_;
  Simulation engine_;
  PlainKernel plain_;
};

Broken Both::compare() {
  constexpr double tolerance = 1e-9;
  Difference force("resultants"), way("displacements"), velocity("velocities"), spin("spins"), spring("shear springs"),
      friction("friction"), fracture("fracture energy"), damped("damping");
  const State& s = engine_.state();
  const Particles& p = s.particles;
  engine_.forces(true);
  refuse_new_list();
  const EnergyLedger energy = engine_.view().energy;
  damped.add(energy.damping, plain_.damped());
  plain_.step();
  friction.add(energy.friction, plain_.friction());
  fracture.add(energy.fracture, plain_.fracture());
  for (std::size_t a = 0; a < p.size(); ++a)
    for (int c = 0; c < 3; ++c) force.add(p.force()[a][c], plain_.resultants()[3 * a + std::size_t(c)]);
  engine_.advance();
  for (std::size_t a = 0; a < p.size(); ++a) {
    const PlainParticle& q = plain_.particles()[a];
    for (int c = 0; c < 3; ++c) {
      const double start = p.reference_position[a][c];
      way.add(p.position()[a][c] - start, q.x[c] - start);
      velocity.add(p.velocity()[a][c], q.v[c]);
      spin.add(p.angular_velocity()[a][c], q.w[c]);
    }
  }
  std::size_t torn = 0, sheared = 0, other = 0;
  const PlainPairs& pairs = plain_.pairs();
  const std::vector<double>* springs[] = {&pairs.spring_x, &pairs.spring_y, &pairs.spring_z};
  for (std::size_t k = 0; k < s.pairs.size(); ++k) {
    torn += s.pairs.state[k] == BondState::broken_tension;
    sheared += s.pairs.state[k] == BondState::broken_shear;
    other += std::uint8_t(s.pairs.state[k]) != pairs.state[k];
    for (std::size_t c = 0; c < 3; ++c) spring.add(s.pairs.columns[c][k], (*springs[c])[k]);
  }
  double most = 0;
  std::string text;
  for (const Difference& d : {force, way, velocity, spin, spring, friction, fracture, damped}) {
    most = std::max(most, d.relative());
    text += fmt::format("{}{} {:.1e}", text.empty() ? "" : ", ", d.of(), d.relative());
  }
  fmt::print("  {} steps, {} bonds broken by tension, {} by shear; engine and plain kernel differ by: {}\n", s.step,
             torn, sheared, text);
  if (other > 0) throw UserError(fmt::format("{} pairs are in another state in the plain kernel", other));
  if (!(most < tolerance)) throw UserError("the plain kernel does not do the same");
  return {torn, sheared, energy.friction};
}

void Both::refuse_new_list() const {
  if (engine_.rebuilds() != 1) throw UserError("the pair list was made anew: the plain kernel has one only");
}

}  // namespace

double step_over_plain_kernel(const Specimen& specimen) {
  constexpr double rough = 2, gentle = 1e-3;  // rms of velocities at the start [m/s]
  constexpr int steps = 5;
  {
    // So weak that bonds break both ways and slide: every branch of the law. No longer than this, since the damping,
    // which turns with the direction of even the smallest velocity, lets rounding errors grow tenfold in ten steps.
    Workflow weak = specimen.workflow;
    for (const char* strength : {"tensile_strength", "shear_strength"}) {
      Json& value = weak.contact_law.plugins.at(0).config.at(strength);
      value = 0.03 * value.get<double>();
    }
    Both both(specimen, weak, rough);
    both.engine_steps(30);
    both.plain_steps(30);
    const Broken broken = both.compare();
    if (broken.torn == 0 || broken.sheared == 0 || !(broken.friction > 0))
      throw UserError("nothing broke or slid: that proves nothing");
  }
  Both both(specimen, specimen.workflow, gentle);
  both.engine_steps(steps);
  both.plain_steps(steps);
  both.compare();
  // The time of the processor: what else runs on the machine does not count, but for what it does to the caches.
  const int batches = std::clamp(int(12'000'000 / both.state().bonds.size()), 30, 200);
  Batches engine, plain;
  for (int b = 0; b < batches; ++b) {
    engine.times.push_back(processor_seconds([&] { both.engine_steps(steps); }));
    plain.times.push_back(processor_seconds([&] { both.plain_steps(steps); }));
  }
  both.refuse_new_list();
  const State& s = both.state();
  const double each = 1e9 / steps / double(s.bonds.size()), ratio = engine.least() / plain.least();
  fmt::print(
      "{} particles, {} bonds, {} pairs; ns per bond and step, least (median) of {} batches: engine {:.2f} ({:.2f}), "
      "plain kernel {:.2f} ({:.2f}); step over plain kernel {:.3f} (medians {:.3f})\n",
      s.particles.size(), s.bonds.size(), s.pairs.size(), batches, each * engine.least(), each * engine.median(),
      each * plain.least(), each * plain.median(), ratio, engine.median() / plain.median());
  return ratio;
}

}  // namespace breccia::bench
