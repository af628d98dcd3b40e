// SPDX-License-Identifier: BSD-3-Clause
// Pairs of several kinds and bonds with values of their own, in the vector loop, get the bits that each gets alone from
// a law made for it. Factors are powers of two: they change no constant's digits, whichever way it is derived.
#include <gtest/gtest.h>

#include <cstring>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3;
constexpr std::size_t kinds = 3, rows = sizeof(PairAnswer) / sizeof(double) / PairChunk::capacity;

struct Chunk {
  PairChunk pairs;
  std::vector<std::array<double, PairChunk::capacity>> history;
  std::vector<double*> columns;
  PairAnswer answer{};

  explicit Chunk(std::size_t columns_) : history(columns_) {
    for (auto& column : history) columns.push_back(column.data());
  }
  double* row(std::size_t k) { return reinterpret_cast<double*>(&answer) + k * PairChunk::capacity; }
};

/// Stretched and pressed, sheared and turned, bonded and not, near where bonds break; `nearer` by this share.
void fill(Chunk& c, std::size_t size, unsigned seed, double nearer) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double from, double to) { return from + (to - from) * double(random() >> 11) * 0x1p-53; };
  PairChunk& p = c.pairs;
  p.size = size;
  p.time_step = 1e-7;
  for (std::size_t k = 0; k < size; ++k) {
    Vec3 n(uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1));
    n *= 2 * r * (uniform(0.99, 1.01) - nearer) / n.norm();
    p.dx[k] = n.x(), p.dy[k] = n.y(), p.dz[k] = n.z();
    for (double* v : {p.vx, p.vy, p.vz}) v[k] = uniform(-40, 40);
    for (double* w : {p.wix, p.wiy, p.wiz, p.wjx, p.wjy, p.wjz}) w[k] = uniform(-2e4, 2e4);
    p.ri[k] = r * uniform(0.9, 1), p.rj[k] = r * uniform(0.9, 1);
    p.rest[k] = 2 * r;
    p.mi[k] = 1e-5 * uniform(0.9, 1), p.mj[k] = 1e-5 * uniform(0.9, 1);
    p.intact[k] = uniform(0, 1) < 0.7;
    p.kind[k] = std::uint32_t(random() % kinds);
    c.answer.normal[k] = uniform(-100, 50);  // of laws before
  }
}

/// Pair `from` of one chunk as the only one of another.
void copy_pair(const Chunk& a, std::size_t from, Chunk& to) {
  constexpr std::size_t arrays = offsetof(PairChunk, kind) / sizeof(double) / PairChunk::capacity;
  for (std::size_t k = 0; k < arrays; ++k) {
    const std::size_t row = k * PairChunk::capacity;
    reinterpret_cast<double*>(&to.pairs)[row] = reinterpret_cast<const double*>(&a.pairs)[row + from];
  }
  to.pairs.size = 1;
  to.pairs.time_step = a.pairs.time_step;
  to.answer.normal[0] = a.answer.normal[from];
}

struct LawCase {
  std::string name;
  std::array<Json, kinds> of_kind;
  std::vector<std::string> scattering;
  double nearer = 0;  ///< of laws that know grains only which touch
};

Json changed(Json config, const Json& changes) {
  for (const auto& [key, value] : changes.items()) config[key] = value;
  return config;
}

std::vector<LawCase> cases() {
  const Json
      brittle = elastic_brittle(),
      exponential = nonlinear_tension(),
      damage = {{"youngs_modulus", 20e9},
                {"poisson_ratio", 0.25},
                {"area_factor", 1.0},
                {"contact_damping", 0.5},
                {"tensile_strength", 50e6},
                {"shear_strength", 60e6},
                {"internal_friction", 0.5},
                {"friction", 0.3},
                {"softening_tension", 0.5},
                {"softening_shear", 0.5},
                {"failure", "uncoupled"},
                {"compressive_limits", {20e6, 40e6, 60e6}},
                {"compressive_slope_ratios", {2, 4, 5}}},
      dashpot = {{"normal_ratio", 0.1}, {"shear_ratio", 0.2}, {"stiffness_modulus", 10e9}, {"stiffness_ratio", 1.0}},
      bars = {{"normal_ratio", 0.1}, {"contact_modulus", 10e9}, {"shear_damping", 3.0}, {"stiffness_ratio", 2.5}},
      rolling = {{"rolling_friction", 0.2},
                 {"twisting_friction", 0.1},
                 {"rolling_modulus", 10e9},
                 {"rolling_damping", 0.2}},
      grains = {{"contact_modulus", 10e9}, {"stiffness_ratio", 2.5}, {"friction", 0.5}},
      hertz = {{"youngs_modulus", 70e9},
               {"poisson_ratio", 0.2},
               {"friction", 0.5},
               {"restitution", 0.8},
               {"design_overlap", 0.01}},
      cement = {{"bond_modulus", 20e9},      {"stiffness_ratio", 2.5},         {"tensile_strength", 40e6},
                {"cohesion", 60e6},          {"internal_friction_angle", 0.5}, {"radius_multiplier", 1.0},
                {"moment_contribution", 1.0}},
      beam = {{"bond_modulus", 20e9},     {"poisson_ratio", 0.2},          {"radius_multiplier", 1.0},
              {"tensile_strength", 40e6}, {"compressive_strength", 300e6}, {"shear_strength", 80e6}},
      joint = {{"elements", "disc_1x3"},   {"bond_modulus", 20e9}, {"stiffness_ratio", 2.5},
               {"tensile_strength", 40e6}, {"cohesion", 60e6},     {"internal_friction_angle", 0.5},
               {"radius_multiplier", 1.0}, {"friction", 0.4},      {"bonded_share", 1.0},
               {"gapped_share", 0.0},      {"gap", 0.0},           {"lot", 0.5}},
      soft = {{"bond_modulus", 20e9},     {"stiffness_ratio", 2.5},   {"tensile_strength", 40e6},
              {"fracture_energy", 500.0}, {"cohesion", 60e6},         {"internal_friction_angle", 0.5},
              {"friction", 0.3},          {"radius_multiplier", 1.0}, {"moment_contribution", 1.0}},
      jointed = {{"bond_modulus", 20e9},  {"stiffness_ratio", 2.5},         {"tensile_strength", 40e6},
                 {"cohesion", 60e6},      {"internal_friction_angle", 0.5}, {"friction", 0.3},
                 {"smooth_joint", false}, {"dilation_angle", 0.0}};
  return {
      {"elastic_brittle",
       {brittle, changed(brittle, {{"tensile_strength", 90e6}}),
        changed(brittle, {{"bond_modulus", 23e9}, {"model", "model_2"}, {"friction", 0.1}})},
       {"shear_strength", "bond_modulus"}},
      {"elasto_damage_plastic",
       {damage, changed(damage, {{"tensile_strength", 90e6}}),
        changed(damage, {{"youngs_modulus", 33e9}, {"failure", "coupled"}, {"friction", 0.1}})},
       {"tensile_strength", "shear_strength"}},
      {"nonlinear_tension",
       {exponential, changed(exponential, {{"tensile_strain_limit", 7e-3}}),
        changed(exponential, {{"bond_modulus", 23e9}, {"tension_shape", 0.4}})},
       {"tensile_strain_limit"}},
      {"viscous", {dashpot, changed(dashpot, {{"normal_ratio", 0.3}}), bars}, {}},
      {"linear",
       {grains,
        changed(grains, {{"friction", 0.2}}),
        {{"normal_stiffness", 1e7}, {"shear_stiffness", 7e6}, {"friction", 0.1}}},
       {},
       0.1},
      {"hertz_mindlin",
       {hertz, changed(hertz, {{"restitution", 0.3}}), changed(hertz, {{"youngs_modulus", 20e9}, {"friction", 0.1}})},
       {},
       0.1},
      {"rolling_resistance",
       {rolling, changed(rolling, {{"rolling_friction", 0.3}}), changed(rolling, {{"rolling_modulus", 23e9}})},
       {}},
      {"linear_parallel_bond",
       {cement, changed(cement, {{"tensile_strength", 90e6}}),
        changed(cement, {{"bond_modulus", 33e9}, {"radius_multiplier", 0.7}, {"moment_contribution", 0.2}})},
       {"tensile_strength", "cohesion"}},
      {"beam_bond",
       {beam, changed(beam, {{"tensile_strength", 90e6}}),
        changed(beam, {{"bond_modulus", 33e9}, {"radius_multiplier", 0.7}, {"poisson_ratio", 0.3}})},
       {"tensile_strength", "compressive_strength", "shear_strength"}},
      {"flat_joint",
       {joint, changed(joint, {{"tensile_strength", 400e6}, {"stiffness_ratio", 4.0}}),
        changed(joint, {{"bond_modulus", 33e9}, {"radius_multiplier", 0.7}, {"friction", 0.1}})},
       {"tensile_strength", "bond_modulus"}},
      {"soft_bond",
       {soft, changed(soft, {{"tensile_strength", 90e6}}),
        changed(soft, {{"bond_modulus", 33e9}, {"radius_multiplier", 0.7}, {"friction", 0.1}})},
       {"tensile_strength", "fracture_energy", "cohesion"}},
      {"jcfpm",
       {jointed, changed(jointed, {{"tensile_strength", 90e6}}),
        changed(jointed, {{"smooth_joint", true}, {"joint_normal", {1, 2, 3}}, {"dilation_angle", 0.1}})},
       {"bond_modulus", "tensile_strength", "cohesion"}}};
}

std::unique_ptr<ContactLaw> prepared(const std::string& name, const Json& config,
                                     const std::vector<std::string>& scattering = {}) {
  static const std::vector<double> radius{r, 0.9 * r}, mass{1e-5, 1e-5};
  Assembly assembly;
  assembly.radius = radius;
  assembly.mass = mass;
  auto law = make_law(config, name);
  law->scatter(scattering);
  law->prepare(assembly);
  return law;
}

/// Three steps of a chunk, against its pairs one by one.
void compare(const LawCase& of, bool mixed, bool scatters, bool adds, std::size_t size) {
  SCOPED_TRACE(of.name + (mixed ? " mixed" : "") + (scatters ? " scatters" : "") + (adds ? " adds" : ""));
  const std::vector<std::string> scattering = scatters ? of.scattering : std::vector<std::string>();
  std::vector<std::unique_ptr<ContactLaw>> laws;
  std::vector<ContactLaw*> of_kind;
  for (const Json& config : of.of_kind) {
    laws.push_back(prepared(of.name, config, scattering));
    of_kind.push_back(laws.back().get());
  }
  if (!adds && !laws[0]->makes_bonds()) return;  // stands behind another
  laws[0]->take_kinds(of_kind);
  const std::size_t columns = laws[0]->columns().size();
  Chunk all(columns + scattering.size());
  fill(all, size, 7, of.nearer);
  all.pairs.mixed = mixed;
  if (!mixed) std::fill_n(all.pairs.kind, size, 2u);
  for (std::size_t s = 0; s < scattering.size(); ++s)
    for (std::size_t k = 0; k < size; ++k) all.history[columns + s][k] = std::ldexp(1.0, int((k + s) % 3) - 1);
  Chunk before(columns);  // what the pairs were at the start
  fill(before, size, 7, of.nearer);
  laws[0]->initialise(all.pairs, all.columns.data());
  std::vector<bool> broke(size);
  for (int step = 0; step < 3; ++step) {
    laws[0]->evaluate(all.pairs, all.columns.data(), all.answer, adds);
    for (std::size_t k = 0; k < size; ++k) broke[k] = broke[k] || all.answer.breaks[k] > 0;
  }

  std::size_t of_its_own = 0;
  const auto broken = std::size_t(std::count(broke.begin(), broke.end(), true));
  for (std::size_t k = 0; k < size; ++k) {
    Json config = of.of_kind[all.pairs.kind[k]];
    for (std::size_t s = 0; s < scattering.size(); ++s)
      config[scattering[s]] = config[scattering[s]].get<double>() * all.history[columns + s][k];
    const auto run = [&](const Json& with, Chunk& one) {
      copy_pair(before, k, one);
      const auto law = prepared(of.name, with);
      law->initialise(one.pairs, one.columns.data());
      for (int step = 0; step < 3; ++step) law->evaluate(one.pairs, one.columns.data(), one.answer, adds);
    };
    const auto same = [&](Chunk& one) {
      bool equal = true;
      for (std::size_t c = 0; c < columns; ++c) equal &= !std::memcmp(&all.history[c][k], &one.history[c][0], 8);
      for (std::size_t a = 0; a < rows; ++a) equal &= !std::memcmp(&all.row(a)[k], &one.row(a)[0], 8);
      return equal;
    };
    Chunk own(columns), first(columns);
    run(config, own);
    EXPECT_TRUE(same(own)) << "pair " << k << " of kind " << all.pairs.kind[k];
    run(of.of_kind[0], first);
    of_its_own += !same(first);
  }
  EXPECT_GT(of_its_own, size / 4) << "that it is not the first kind's law shows";
  if (laws[0]->makes_bonds()) {
    EXPECT_GT(broken, 0u);
    EXPECT_LT(broken, size);
  }
}

TEST(VariedLaws, GiveEachPairTheBitsOfItsOwnLaw) {
  for (const LawCase& of : cases())
    for (const bool adds : {false, true})
      for (const std::size_t size : {PairChunk::capacity, std::size_t(37)}) {
        compare(of, true, false, adds, size);
        if (of.scattering.empty()) continue;
        compare(of, false, true, adds, size);
        compare(of, true, true, adds, size);
      }
}

/// Constants need not be doubles, nor fill words.
struct OddLaw {
  struct Config {
    float push;
    int power;
    bool flips;
  };
  struct State {
    double steps;
  };
  static constexpr std::array columns{StateColumn<State>{&State::steps, "steps", "1"}};
  OddLaw(const Config& c, const Assembly&) : push(c.push), power(c.power), flips(c.flips) {}
  BRECCIA_KERNEL State initial(const Contact&) const { return {0}; }
  BRECCIA_KERNEL ContactForce operator()(const Contact& c, State& s) const {
    ContactForce f;
    f.normal = (flips ? -1.0 : 1.0) * double(push) * (c.distance + power);
    s.steps += 1;
    return f;
  }
  BRECCIA_KERNEL double energy(const Contact&, const State&) const { return 0; }
  BRECCIA_KERNEL ContactStiffness stiffness(const Contact&) const { return {}; }
  float push;
  int power;
  bool flips;
};
static_assert(sizeof(OddLaw) % sizeof(double) != 0);

TEST(VariedLaws, MayHaveConstantsOfAnyType) {
  const std::array<OddLaw::Config, kinds> configs{{{0.1f, 1, false}, {0.3f, -70000, false}, {0.1f, 1, true}}};
  std::vector<std::unique_ptr<ContactLawOf<OddLaw>>> laws;
  std::vector<ContactLaw*> of_kind;
  for (const auto& c : configs) {
    laws.push_back(std::make_unique<ContactLawOf<OddLaw>>(c));
    laws.back()->prepare({});
    of_kind.push_back(laws.back().get());
  }
  laws[0]->take_kinds(of_kind);
  Chunk all(1);
  fill(all, PairChunk::capacity, 7, 0);
  all.pairs.mixed = true;
  laws[0]->evaluate(all.pairs, all.columns.data(), all.answer, false);
  for (std::size_t k = 0; k < all.pairs.size; ++k) {
    const OddLaw::Config& c = configs[all.pairs.kind[k]];
    const double distance = std::sqrt(all.pairs.dx[k] * all.pairs.dx[k] + all.pairs.dy[k] * all.pairs.dy[k] +
                                      all.pairs.dz[k] * all.pairs.dz[k]);
    EXPECT_EQ(all.answer.normal[k], (c.flips ? -1.0 : 1.0) * double(c.push) * (distance + c.power)) << k;
    EXPECT_EQ(all.history[0][k], 1) << k;
  }
}

}  // namespace
}  // namespace breccia::testing
