// SPDX-License-Identifier: BSD-3-Clause
// Flat joints against statics of rigid faces on elements: eccentric pressure, bending that breaks element by element,
// strengths, friction, twist.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact_laws/held_pair.hpp"

namespace breccia::testing {
namespace {

constexpr double pi = std::numbers::pi, radius = 0.8e-3, thickness = 2e-3;                   // [m]
constexpr double kn = 5e12, ratio = 2.5, ks = kn / ratio, strength = 20e6, cohesion = 30e6;  // [Pa/m], [Pa]

std::unique_ptr<ContactLaw> joint(const std::string& elements, Json changes = Json::object()) {
  Json config = {{"elements", elements},
                 {"normal_stiffness", kn},
                 {"stiffness_ratio", ratio},
                 {"radius_multiplier", 0.8},
                 {"friction", 0.4},
                 {"tensile_strength", strength},
                 {"cohesion", cohesion},
                 {"bonded_share", 1.0},
                 {"gapped_share", 0.0},
                 {"internal_friction_angle", 0.5},
                 {"gap", 0.0},
                 {"lot", 0.5}};
  for (const auto& [key, value] : changes.items()) config[key] = value;
  return make_law(config, "flat_joint");
}
const Json strong = {{"tensile_strength", 1e12}, {"cohesion", 1e12}}, slit = {{"bonded_share", 0.0}};

PairSetup setup(int dimension) {
  PairSetup s;
  s.dimension = dimension;
  s.thickness = thickness;
  return s;
}
std::string lines(int n) { return "line_" + std::to_string(n); }
double area(int dimension) { return dimension == 2 ? 2 * radius * thickness : pi * radius * radius; }
double centroid(int n, int k) { return radius * (-1 + (2 * k + 1.0) / n); }

TEST(FlatJoint, UnbondedAndPressedOffItsMiddleItOpensAsStaticsSays) {
  // Faces that are turned by b and closed over the length a from one end carry N = kn b a^2 t/2 at e = R - a/3 from the
  // middle: a = 3 (R - e), and the stress at the end is 2 N/(a t). With n elements the closed piece that holds the end
  // of contact errs, and each its own moment: both with 1/n^2.
  const double b = 2e-4;
  double worst[3] = {};
  const int counts[] = {2, 4, 8};
  for (int which = 0; which < 3; ++which) {
    const int n = counts[which];
    for (double a = 0.8 * radius; a < 1.9 * radius; a += 0.05 * radius) {
      HeldPair pair(joint(lines(n), slit), setup(2));
      pair.lead({b * (radius - a), 0, 0, 0, 0, b}, 20);
      double force = 0, moment = 0;
      for (int k = 0; k < n; ++k) {
        const double stress = kn * std::min(0.0, b * (radius - a - centroid(n, k)));
        force += stress * area(2) / n;
        moment -= stress * area(2) / n * centroid(n, k);
      }
      EXPECT_NEAR(pair.normal_force(), force, 1e-6 * -force) << n << " " << a;
      EXPECT_NEAR(pair.moment().z(), moment, 1e-6 * std::abs(moment)) << n << " " << a;
      const double e = std::abs(pair.moment().z() / pair.normal_force()), length = 3 * (radius - e);
      const double end_stress = -2 * pair.normal_force() / (length * thickness);
      worst[which] = std::max({worst[which], std::abs(length / a - 1), std::abs(end_stress / (kn * b * a) - 1)});
    }
  }
  EXPECT_LT(worst[1], worst[0] / 3);
  EXPECT_LT(worst[2], worst[1] / 3);
  EXPECT_LT(worst[2], 0.05);
  // In full contact, up to e = R/3 (1 - 1/n^2) over 1 - 1/n, the moment is k_n A R^2/3 (1 - 1/n^2) b.
  HeldPair pair(joint("line_8", slit), setup(2));
  const double pressed = b * radius;
  pair.lead({-pressed, 0, 0, 0, 0, b}, 20);
  EXPECT_NEAR(pair.normal_force(), -kn * area(2) * pressed, 1e-6 * kn * area(2) * pressed);
  const double known = kn * area(2) * radius * radius / 3 * (1 - 1.0 / 64) * b;
  EXPECT_NEAR(pair.moment().z(), known, 1e-6 * known);
  EXPECT_NEAR(-pair.moment().z() / pair.normal_force(), radius / 3, 0.02 * radius);
}

TEST(FlatJoint, BentItBreaksElementByElement) {
  constexpr int n = 8;
  HeldPair pair(joint(lines(n), {{"cohesion", 1e12}}), setup(2));
  const auto breaks_at = [&](int k) { return strength / (kn * -centroid(n, k)); };  // y < 0 opens
  for (int broken = 0; broken <= n / 2; ++broken) {
    const double from = broken ? breaks_at(broken - 1) : 0, to = broken < n / 2 ? breaks_at(broken) : 1.1 * from;
    for (const double share : {0.02, 0.98}) {
      const double b = from + share * (to - from);
      pair.lead({0, 0, 0, 0, 0, b}, 200);
      double force = 0, moment = 0;
      for (int k = broken; k < n; ++k) {
        const double stress = -kn * b * centroid(n, k);
        force += stress * area(2) / n;
        moment -= stress * area(2) / n * centroid(n, k);
      }
      EXPECT_NEAR(pair.moment().z(), moment, 1e-5 * moment) << broken;
      EXPECT_NEAR(pair.normal_force(), force, 1e-5 * kn * b * radius * area(2)) << broken;
      EXPECT_EQ(pair.history("bonded_share"), double(n - broken) / n);
      EXPECT_EQ(pair.bond(), BondState::intact) << "what is pressed holds";
    }
  }
  // Each of them took what it had stored.
  EXPECT_NEAR(pair.energy().fracture, n / 2 * area(2) / n * 0.5 * strength * strength / kn,
              0.02 * pair.energy().fracture);
  PairMotion apart = pair.now();
  apart.normal += 3 * strength / kn + apart.bend_z * radius;
  pair.lead(apart, 500);
  EXPECT_EQ(pair.bond(), BondState::broken_tension);
  EXPECT_EQ(pair.normal_force(), 0);
  EXPECT_LT(std::abs(pair.unaccounted()), 1e-3 * pair.work());
}

TEST(FlatJoint, ItsStrengthIsThatOfItsArea) {
  for (const auto& layout : {std::pair(2, "line_4"), {3, "disc_1x4"}, {3, "disc_2x4"}}) {
    const int dimension = layout.first;
    const char* const elements = layout.second;
    const double a = area(dimension), phi = std::tan(0.5);
    const auto peak = [&](double normal, bool shears, BondState mode) {
      HeldPair pair(joint(elements), setup(dimension));
      pair.lead(normal, 0);
      double most = 0;
      for (int k = 1; k <= 1000 && pair.bond() == BondState::intact; ++k) {
        const double way = k * 1e-3 * (shears ? 2 * cohesion / ks : 2 * strength / kn);
        shears ? pair.lead(normal, way, 1) : pair.lead(way, 0, 1);
        if (pair.bond() == BondState::intact) most = shears ? pair.shear_force() : pair.normal_force();
      }
      EXPECT_EQ(pair.bond(), mode) << elements;
      EXPECT_EQ(pair.history("bonded_elements"), 0);
      if (shears) {
        EXPECT_NEAR(pair.shear_force(), 0.4 * -pair.normal_force(), 1e-6 * a * cohesion) << "friction is left";
      }
      return most;
    };
    const double step = 3e-3;  // of the peak
    EXPECT_NEAR(peak(0, false, BondState::broken_tension), strength * a, step * strength * a);
    EXPECT_NEAR(peak(0, true, BondState::broken_shear), cohesion * a, step * cohesion * a);
    const double pressure = 10e6, held = cohesion + pressure * phi;
    EXPECT_NEAR(peak(-pressure / kn, true, BondState::broken_shear), held * a, step * held * a);
  }
}

TEST(FlatJoint, BendingAndTwistAreThoseOfItsElements) {
  // Mean squares of the centroids' distances from an axis over R^2; of a whole disc 1/4.
  const double sector3 = 2.0 / 3 * std::sin(pi / 3) / (pi / 3), sector4 = 2.0 / 3 * std::sin(pi / 4) / (pi / 4);
  const double inner = std::sqrt(0.5), ring = 2.0 / 3 * std::sin(pi / 4) / (pi / 4) / 0.5;  // times r2^3 - r1^3
  const double near = ring * inner * inner * inner, far = ring * (1 - inner * inner * inner);
  for (const auto& [elements, square] : {std::pair("disc_1x3", sector3 * sector3 / 2),
                                         {"disc_1x4", sector4 * sector4 / 2},
                                         {"disc_2x4", (near * near + far * far) / 4}}) {
    HeldPair pair(joint(elements, strong), setup(3));
    pair.lead({0, 0, 0, 3e-4, 2e-4, -1e-4});
    const double bending = kn * area(3) * radius * radius * square, torsion = 2 * bending / ratio;
    EXPECT_NEAR(pair.moment().x(), torsion * 3e-4, 1e-6 * torsion * 3e-4) << elements;
    EXPECT_NEAR(pair.moment().y(), bending * 2e-4, 1e-6 * bending * 2e-4) << elements;
    EXPECT_NEAR(pair.moment().z(), -bending * 1e-4, 1e-6 * bending * 2e-4) << elements;
  }
  // Unbonded and pressed, all four elements slide round at the same distance.
  HeldPair pair(joint("disc_1x4", slit), setup(3));
  pair.lead(-1e-6, 0);
  PairMotion turned = pair.now();
  turned.twist = 0.05;
  pair.lead(turned, 400);
  const double slides = 0.4 * kn * 1e-6 * area(3) * sector4 * radius;
  EXPECT_NEAR(pair.moment().x(), slides, 1e-6 * slides);
  EXPECT_LT(std::abs(pair.unaccounted()), 1e-6 * pair.work());
}

TEST(FlatJoint, EnergyClosesToSecondOrderThroughPartialFailure) {
  for (const auto& [dimension, elements] :
       {std::pair(2, "line_2"), {2, "line_8"}, {3, "disc_1x3"}, {3, "disc_1x4"}, {3, "disc_2x4"}}) {
    const auto error = [&, d = dimension, e = elements](int steps) {
      HeldPair pair(joint(e), setup(d));
      PairMotion to{-2e-6, 8e-6, 0, 0, 0, 0.02};
      if (d == 3) to.shear_z = -5e-6, to.twist = 0.013, to.bend_y = 0.011;
      pair.lead(to, steps);
      const double share = pair.history("bonded_share");
      EXPECT_LT(share, 1) << e;
      pair.lead({1e-6, -3e-6, 0, 0, 0, 0.01}, steps);
      pair.lead({-9e-6, 25e-6, 0, 0, 0, -0.01}, steps);
      EXPECT_GT(pair.energy().fracture, 0) << e;
      EXPECT_GT(pair.energy().friction, 0) << e;
      return std::abs(pair.unaccounted()) / pair.work();
    };
    const double coarse = error(500), fine = error(2000);
    EXPECT_LT(coarse, 5e-3) << elements;
    EXPECT_LT(fine, std::max(coarse / 3, 1e-5)) << elements;
  }
}

TEST(FlatJoint, FacesGoOnWithoutBondsUntilTheyHavePartedByTheirDiameter) {
  const double b = 0.02;
  const auto pressed_and_bent = [&](double parted) {
    HeldPair pair(joint("disc_1x4"), setup(3));
    pair.lead(2 * strength / kn, 0);
    EXPECT_EQ(pair.bond(), BondState::broken_tension);
    pair.lead(parted, 0);
    pair.lead(-2e-6, 0);
    pair.lead({-2e-6, 0, 0, 0, b, 0});
    const double known = -kn * area(3) * 2e-6;
    if (parted > 2 * radius) {
      EXPECT_NEAR(pair.normal_force(), known, 1e-6 * -known);
    } else {
      EXPECT_LT(pair.normal_force(), known) << "the edges that press carry more";
    }
    EXPECT_EQ(pair.history("faces"), parted > 2 * radius ? 0 : 1);
    return pair.moment().y();
  };
  EXPECT_GT(pressed_and_bent(1e-4), 1e-3);
  EXPECT_EQ(pressed_and_bent(2.1 * radius), 0);
  HeldPair never(joint("disc_1x4"), [] {
    PairSetup s = setup(3);
    s.bonded = false;
    return s;
  }());
  never.lead(-2e-6, 1e-6);
  never.lead({-2e-6, 1e-6, 0, 0, b, 0});
  EXPECT_EQ(never.moment(), Vec3::Zero().eval());
  EXPECT_NEAR(never.shear_force(), std::min(ks * 1e-6, 0.4 * kn * 2e-6) * area(3), 1e-6 * ks * area(3) * 1e-6);
}

TEST(FlatJoint, AGapMustCloseFirst) {
  HeldPair pair(joint("line_4", {{"bonded_share", 0.0}, {"gapped_share", 1.0}, {"gap", 3e-6}}), setup(2));
  pair.lead(-2.9e-6, 0);
  EXPECT_EQ(pair.normal_force(), 0);
  pair.lead(-4e-6, 0);
  EXPECT_NEAR(pair.normal_force(), -kn * area(2) * 1e-6, 1e-6 * kn * area(2) * 1e-6);
  EXPECT_EQ(pair.bond(), BondState::intact) << "nothing broke that was not bonded";
}

TEST(FlatJoint, ContactsAreBondedGappedAndSlitByTheirShares) {
  auto law = joint("disc_1x4", {{"bonded_share", 0.5}, {"gapped_share", 0.25}, {"gap", 2e-6}});
  law->scatter({"lot"});
  auto chunk = std::make_unique<PairChunk>();
  const std::size_t columns = law->columns().size();
  std::vector<std::vector<double>> history(columns + 1, std::vector<double>(PairChunk::capacity, 7.0));
  std::vector<double*> h;
  for (auto& c : history) h.push_back(c.data());
  chunk->size = 64;
  chunk->time_step = 1e-7;
  for (std::size_t k = 0; k < 64; ++k) {
    for (double* of : {chunk->dy, chunk->dz, chunk->vx, chunk->vy, chunk->vz, chunk->wix, chunk->wiy, chunk->wiz,
                       chunk->wjx, chunk->wjy, chunk->wjz})
      of[k] = 0;
    chunk->dx[k] = chunk->rest[k] = 2e-3;
    chunk->ri[k] = chunk->rj[k] = chunk->mi[k] = chunk->mj[k] = 1e-3;
    chunk->intact[k] = chunk->may_break[k] = k < 60;
    history[columns][k] = 2 * (double(k) + 0.5) / 60;  // over the mean of 0.5; of the four without a bond no matter
  }
  const std::vector<double> radii{1e-3, 1e-3}, masses{1e-5, 1e-5};
  Assembly assembly;
  assembly.radius = radii;
  assembly.mass = masses;
  law->prepare(assembly);
  law->initialise(*chunk, h.data());
  int bonded = 0, gapped = 0, slits = 0;
  for (std::size_t k = 0; k < 64; ++k) {
    const bool faces = history[3][k] > 0;
    EXPECT_EQ(faces, k < 60);
    bonded += history[1][k] == 1;
    gapped += history[2][k] == 2e-6;
    slits += faces && history[1][k] == 0 && history[2][k] == 0;
  }
  EXPECT_EQ(bonded, 30);
  EXPECT_EQ(gapped, 15);
  EXPECT_EQ(slits, 15);
}

TEST(FlatJoint, FacesOfDiscsAreNotThoseOfSpheres) {
  Assembly plane;
  plane.dimension = 2;
  for (const auto& [elements, assembly] : {std::pair("disc_1x4", plane), {"line_4", Assembly()}}) {
    try {
      joint(elements)->prepare(assembly);
      ADD_FAILURE() << elements;
    } catch (const UserError& e) {
      EXPECT_NE(std::string(e.what()).find(elements[0] == 'd' ? "`line_4`" : "`disc_1x4`"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace breccia::testing
