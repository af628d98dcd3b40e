// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a law's answers is laid at the law's door, with the pair and the step.
#include <gtest/gtest.h>

#include <limits>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A linear law that answers wrongly as it is told.
class Wrong final : public ContactLaw {
 public:
  double stated = 1e7;                                            ///< stiffness [N/m]; the true one is 1e7
  double stored = 1;                                              ///< factor on the energy
  double bad_force_at = std::numeric_limits<double>::infinity();  ///< stretch from which on the force is no number [m]
  std::vector<ColumnDoc> columns() const override { return {}; }
  bool has_moments() const override { return false; }
  void prepare(const Assembly&) override {}
  void initialise(const PairChunk&, double* const*) override {}
  void evaluate(const PairChunk& c, double* const*, PairAnswer& out, bool) override {
    out = {};
    for (std::size_t k = 0; k < c.size; ++k) {
      const Vec3 branch(c.dx[k], c.dy[k], c.dz[k]);
      const double stretch = branch.norm() - c.rest[k];
      const Vec3 f = (stretch > bad_force_at ? nan : 1e7 * stretch) * branch.normalized();
      out.fx[k] = f.x();
      out.fy[k] = f.y();
      out.fz[k] = f.z();
    }
  }
  ContactForce answer(const PairChunk&, std::size_t, double* const*) override { return {}; }
  void stiffness(const PairChunk& c, double* const*, ContactStiffness* out) override {
    for (std::size_t k = 0; k < c.size; ++k) out[k] = {stated, 0, 0, 0};
  }
  void energy(const PairChunk& c, double* const*, double* out) override {
    for (std::size_t k = 0; k < c.size; ++k) {
      const double stretch = Vec3(c.dx[k], c.dy[k], c.dz[k]).norm() - c.rest[k];
      out[k] = stored * 0.5e7 * stretch * stretch;
    }
  }
};

std::unique_ptr<Simulation> chain(ContactLaw& law) {
  EngineSettings settings;
  auto s = std::make_unique<Simulation>(assemble(simple_cubic(4, 1, 1, 1e-3), {2650}, 3, 1.0),
                                        Interactions(law, "wrong"), settings);
  s->bond({GapMeasure::relative, 1e-9, std::nullopt});
  return s;
}

template <class F>
std::string error_of(F&& f) {
  try {
    f();
  } catch (const UserError& e) { return e.what(); }
  return "no error";
}

TEST(LawBlame, AStiffnessThatIsZeroTooSmallOrNoNumber) {
  for (const double stated : {0.0, 1e-3, 4e6, -1e7}) {
    Wrong law;
    law.stated = stated;
    const std::string error = error_of([&] { chain(law)->prepare(); });
    EXPECT_NE(error.find("contact law `wrong`: particles 0 and 1, step 0: it states a normal stiffness of"),
              std::string::npos)
        << error;
  }
  for (const double stated : {nan, std::numeric_limits<double>::infinity()}) {
    Wrong law;
    law.stated = stated;
    const std::string error = error_of([&] { chain(law)->prepare(); });
    EXPECT_NE(error.find("contact law `wrong`: particles 0 and 1, step 0: its stiffness is not a finite number"),
              std::string::npos)
        << error;
  }
  Wrong right;
  EXPECT_EQ(error_of([&] { chain(right)->prepare(); }), "no error");
}

TEST(LawBlame, AForceThatIsNoNumberNamesThePairAndTheStep) {
  Wrong law;
  law.bad_force_at = 5e-7;
  auto s = chain(law);
  s->prepare();
  for (Index k = 0; k < 4; ++k)
    if (s->state().particles.id[k] == 3) s->hold(k, dof::all, Vec3(1, 0, 0), Vec3::Zero());
  const std::string error = error_of([&] {
    for (int k = 0; k < 10000; ++k) {
      s->forces(false);
      s->advance();
    }
  });
  EXPECT_EQ(error.rfind("contact law `wrong`: particles 2 and 3, step ", 0), 0u) << error;
  EXPECT_NE(error.find("its force is not a finite number"), std::string::npos) << error;
  EXPECT_NE(error.find("step " + std::to_string(s->state().step) + ":"), std::string::npos) << error;
}

TEST(LawBlame, AVelocityThatIsNoNumberIsNotTheLawsFault) {
  Wrong law;
  auto s = chain(law);
  s->prepare();
  s->forces();
  s->hold(1, dof::x, Vec3(nan, 0, 0), Vec3::Zero());
  EXPECT_NE(error_of([&] { s->advance(); }).find("the motion ran away"), std::string::npos);
}

TEST(LawBlame, AnEnergyThatIsNoNumber) {
  Wrong law;
  auto s = chain(law);
  s->prepare();
  s->forces();
  law.stored = nan;
  const std::string error = error_of([&] { s->view(); });
  EXPECT_EQ(error.rfind("contact law `wrong`: particles 0 and 1, step 0: its stored energy is not a finite number", 0),
            0u)
      << error;
}

TEST(LawBlame, ModuliDensityAndRadiiThatOverflow) {
  const auto prepare = [](double modulus, double density, double radius) {
    auto law = make_law(elastic_brittle({{"bond_modulus", modulus}}));
    EngineSettings settings;
    Simulation s(assemble(simple_cubic(3, 1, 1, radius), {density}, 3, 1.0), Interactions(*law, "elastic_brittle"),
                 settings);
    s.bond({GapMeasure::relative, 1e-9, std::nullopt});
    s.prepare();
  };
  EXPECT_NE(error_of([&] { prepare(1e308, 2650, 1e3); }).find("its stiffness is not a finite number"),
            std::string::npos);
  EXPECT_NE(error_of([&] { prepare(1e10, 1e-300, 1e-3); }).find("has a mass of"), std::string::npos);
  EXPECT_NE(error_of([&] { prepare(1e10, 2650, 1e-100); }).find("has a mass of"), std::string::npos);
  EXPECT_NE(error_of([&] { prepare(1e307, 2650, 1e-3); }).find("check moduli, density and radii"), std::string::npos);
  EXPECT_EQ(error_of([&] { prepare(1e10, 2650, 1e-3); }), "no error");
}

}  // namespace
}  // namespace breccia::testing
