// SPDX-License-Identifier: BSD-3-Clause
#include "engine/law_probe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "breccia/error.hpp"

namespace breccia {
namespace {

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", v);
  return text;
}

/// `names` in backquotes.
std::string about(const State& s, std::size_t pair, const std::string& names) {
  return "contact law " + names + ": " + pair_name(s, pair) + ", step " + std::to_string(s.step) + ": ";
}

double distance(const State& s, std::size_t pair) {
  return s.branch(s.particles.position()[s.pairs.i[pair]], s.particles.position()[s.pairs.j[pair]]).norm();
}

double touching(const State& s, std::size_t pair) {
  return s.particles.radius()[s.pairs.i[pair]] + s.particles.radius()[s.pairs.j[pair]];
}

bool all_finite(const ContactStiffness& c) {
  return std::isfinite(c.normal) && std::isfinite(c.shear) && std::isfinite(c.bending) && std::isfinite(c.torsion) &&
         std::isfinite(c.damping) && std::isfinite(c.shear_damping);
}

/// Copies of all that one pair has, for the law to work on.
struct OnePair {
  OnePair(const State& s, std::size_t k, double stretch, std::size_t laws)
      : rest(s.pairs.rest_length[k]), state(s.pairs.state[k]), column(s.pairs.columns.size()), dissipated(laws) {
    const Index ends[] = {s.pairs.i[k], s.pairs.j[k]};
    for (int e = 0; e < 2; ++e) {
      motion[e] = s.particles.motion[ends[e]];
      motion[e].velocity = motion[e].angular_velocity = Vec3::Zero();
      id[e] = s.particles.id[ends[e]];
      if (!s.particles.material.empty()) material[e] = s.particles.material[ends[e]];
    }
    const Vec3 branch = s.branch(motion[0].position, motion[1].position);
    normal = branch.normalized();
    motion[1].position = motion[0].position + branch + stretch * normal;
    for (std::size_t c = 0; c < column.size(); ++c) column[c] = s.pairs.columns[c][k];
    for (double& c : column) columns.push_back(&c);
    batch.end = 1;
    batch.i = &i;
    batch.j = &j;
    batch.rest_length = &rest;
    batch.state = &state;
    batch.columns = columns.data();
    batch.motion = motion;
    batch.id = id;
    if (!s.particles.material.empty()) batch.material = material;
    batch.materials = s.materials.size();
    batch.force = &force;
    batch.moment = &moment;
    batch.dissipated = dissipated.data();
    batch.chunk_broke = &broke;
    batch.time_step = s.time_step;
  }
  OnePair(const OnePair&) = delete;
  OnePair& operator=(const OnePair&) = delete;

  Index i = 0, j = 1, id[2];
  std::uint8_t material[2] = {0, 0};
  double rest;
  BondState state;
  std::vector<double> column;
  std::vector<double*> columns;
  ParticleMotion motion[2];
  Vec3 normal, moment = Vec3::Zero();
  std::vector<Dissipated> dissipated;
  PairForce force{};
  std::uint8_t broke = 0;
  PairBatch batch;
};

}  // namespace

std::string pair_name(const State& s, std::size_t pair) {
  const auto& id = s.particles.id;
  const Index a = id[s.pairs.i[pair]], b = id[s.pairs.j[pair]];
  return "particles " + std::to_string(std::min(a, b)) + " and " + std::to_string(std::max(a, b));
}

LawAnswer ask_law(State& s, const Interactions& laws, std::size_t k, double stretch) {
  OnePair one(s, k, stretch, laws.size());
  laws.evaluate(one.batch);
  const Vec3 f(one.force.fx, one.force.fy, one.force.fz);
  bool finite = f.allFinite() && one.moment.allFinite();
  for (const double c : one.column) finite &= std::isfinite(c);
  return {f.dot(one.normal), laws.energy(one.batch), finite};
}

ContactStiffness ask_stiffness(State& s, const Interactions& laws, std::size_t k) {
  OnePair one(s, k, 0, laws.size());
  ContactStiffness c;
  laws.stiffness(one.batch, &c);
  return c;
}

namespace {

/// The first of the laws whose force, with those of the laws before it, is no number for this pair.
std::optional<std::string> law_without_force(State& s, const Interactions& laws, std::size_t k, double stretch) {
  std::vector<NamedLaw> first;
  for (const NamedLaw& law : laws.laws()) {
    first.push_back(law);
    if (!ask_law(s, Interactions(first), k, stretch).finite) return "`" + law.name + "`";
  }
  return std::nullopt;
}

}  // namespace

void check_stiffness(State& s, const Interactions& laws) {
  constexpr std::size_t most = 64;
  std::vector<std::size_t> held;
  for (std::size_t k = 0; k < s.pairs.size(); ++k)
    if (s.pairs.state[k] == BondState::intact || distance(s, k) < touching(s, k)) held.push_back(k);
  for (std::size_t n = 0; n < std::min(most, held.size()); ++n) {
    const std::size_t k = held[n * held.size() / std::min(most, held.size())];
    const double small = 1e-6 * touching(s, k), stated = ask_stiffness(s, laws, k).normal;
    double normal[3];
    for (const int way : {-1, 0, 1}) {
      if (const auto law = law_without_force(s, laws, k, way * small))
        throw UserError(about(s, k, *law) + "its force is not a finite number");
      normal[way + 1] = ask_law(s, laws, k, way * small).normal;
    }
    const double shown = std::max(normal[1] - normal[0], normal[2] - normal[1]) / small;
    if (shown > 2 * std::max(stated, 0.0))
      throw UserError(about(s, k, laws.names()) + "it states a normal stiffness of " + number(stated) +
                      " N/m, and its force " + "changes by " + number(shown) +
                      " N per metre: a time step that follows from the first would be too long");
  }
}

std::optional<std::string> blame_force(State& s, const Interactions& laws) {
  for (std::size_t k = 0; k < s.pairs.size(); ++k) {
    const double d = distance(s, k);
    if (!(d > 0) || !(d < 1e3 * touching(s, k))) continue;  // the motion ran away before
    if (const auto law = law_without_force(s, laws, k, 0))
      return about(s, k, *law) + "its force is not a finite number";
  }
  return std::nullopt;
}

std::optional<std::string> blame_energy(State& s, const Interactions& laws) {
  for (std::size_t k = 0; k < s.pairs.size(); ++k) {
    OnePair one(s, k, 0, laws.size());
    for (std::size_t l = 0; l < laws.size(); ++l)
      if (const double e = laws.energy(one.batch, l); !std::isfinite(e))
        return about(s, k, "`" + laws.laws()[l].name + "`") + "its stored energy is not a finite number (" + number(e) +
               " J)";
  }
  return std::nullopt;
}

std::optional<std::string> blame_stiffness(State& s, const Interactions& laws) {
  for (std::size_t k = 0; k < s.pairs.size(); ++k)
    for (const NamedLaw& law : laws.laws())
      if (const ContactStiffness c = ask_stiffness(s, Interactions(*law.law, law.name), k);
          distance(s, k) > 0 && !all_finite(c))
        return about(s, k, "`" + law.name + "`") + "its stiffness is not a finite number (normal " + number(c.normal) +
               ", shear " + number(c.shear) + " N/m): check moduli and radii";
  return std::nullopt;
}

}  // namespace breccia
