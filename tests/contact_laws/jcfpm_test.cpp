// SPDX-License-Identifier: BSD-3-Clause
// Stiffness and strength of the law's bonds; its smooth joints: forces, a plane of weakness, rows that slide.
#include <numbers>

#include "contact_laws/held_pair.hpp"

namespace breccia::testing {
namespace {

constexpr double pi = std::numbers::pi, modulus = 40e9, ratio = 4, strength = 8e6, cohesion = 20e6, angle = 0.5,
                 friction = 0.4, r1 = 1e-3, r2 = 1.5e-3;

Json jcfpm(Json changes = Json::object()) {
  Json config = {{"bond_modulus", modulus},
                 {"stiffness_ratio", ratio},
                 {"tensile_strength", strength},
                 {"cohesion", cohesion},
                 {"internal_friction_angle", angle},
                 {"friction", friction},
                 {"smooth_joint", false},
                 {"dilation_angle", 0.0}};
  for (const auto& [key, value] : changes.items()) config[key] = value;
  return config;
}
Json joint(const Vec3& n, Json changes = Json::object()) {
  changes["smooth_joint"] = true;
  changes["joint_normal"] = {n.x(), n.y(), n.z()};
  return jcfpm(std::move(changes));
}

struct Cement {
  explicit Cement(int dimension_) : dimension(dimension_), thickness(dimension == 2 ? 3e-3 : 1.0) {
    area = dimension == 2 ? 2 * r1 * thickness : pi * r1 * r1;
    kn = dimension == 2 ? modulus * thickness : 2 * modulus * r1 * r2 / (r1 + r2);
    ks = kn / ratio;
  }
  HeldPair pair(const Json& config, bool bonded = true) const {
    return HeldPair(make_law(config, "jcfpm"), {bonded, 1e9, dimension, thickness, r1, r2, 0});
  }
  int dimension;
  double thickness, area, kn, ks;  // [m], [m2], [N/m]
};

TEST(Jcfpm, StiffnessAndStrengthFollowFromTheRadii) {
  for (const int dimension : {2, 3}) {
    const Cement c(dimension);
    const double pull = strength * c.area / c.kn, press = 0.5 * cohesion * c.area / c.kn;
    const struct {
      const char* what;
      double normal, shear;
      BondState as;
    } ways[] = {
        {"tension", pull, 0, BondState::broken_tension},
        {"shear", 0, cohesion * c.area / c.ks, BondState::broken_shear},
        {"shear under pressure", -press, (1 + 0.5 * std::tan(angle)) * cohesion * c.area / c.ks,
         BondState::broken_shear},
        {"shear in tension", 0.5 * pull, (cohesion - 0.5 * strength * std::tan(angle)) * c.area / c.ks,
         BondState::broken_shear},
    };
    for (const auto& way : ways)
      for (const double share : {0.999, 1.001}) {
        SCOPED_TRACE(way.what + std::string(share < 1 ? " below" : " above"));
        HeldPair p = c.pair(jcfpm());
        const bool by_shear = way.shear > 0;
        p.lead(by_shear ? way.normal : share * way.normal, 0);
        p.lead(by_shear ? way.normal : share * way.normal, share * way.shear, 1000);
        EXPECT_EQ(p.bond(), share < 1 ? BondState::intact : way.as);
        EXPECT_NEAR(p.unaccounted(), 0, 1e-4 * p.work());
        const double pressed = std::max(0.0, -way.normal) * c.kn;
        if (share < 1) {
          EXPECT_NEAR(p.normal_force(), c.kn * p.now().normal, 2e-4 * std::abs(c.kn * p.now().normal));
          EXPECT_NEAR(p.shear_force(), c.ks * p.now().shear_y, 2e-4 * c.ks * way.shear);
        } else {
          EXPECT_NEAR(p.normal_force(), -pressed, 1e-3 * pressed) << "the contact keeps its pressure";
          EXPECT_NEAR(p.shear_force(), friction * pressed, 1e-3 * pressed) << "and the residual friction";
        }
      }
    HeldPair given = c.pair(jcfpm({{"bond_modulus", nullptr}, {"normal_stiffness", c.kn / c.area}}));
    given.lead(0.5 * pull, 0);
    EXPECT_NEAR(given.normal_force(), 0.5 * strength * c.area, 1e-9 * strength * c.area) << "stiffness per area";
  }
}

/// Across a joint the motion of the contact is taken apart by the joint's normal, wherever the centres are.
TEST(SmoothJoint, ForcesActAlongItsNormalAndInItsPlane) {
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(1, 2, -3), Vec3(-0.2, 1, 0.1)})
    for (const double sign : {1.0, -1.0}) {
      const Cement c(3);
      HeldPair p = c.pair(joint(sign * direction));
      const PairMotion m{2e-7, 1e-7, -3e-7};
      p.lead(m);
      const Vec3 n = direction.normalized(), moved(m.normal, m.shear_y, m.shear_z);
      const Vec3 force = c.kn * moved.dot(n) * n + c.ks * (moved - moved.dot(n) * n);
      ASSERT_EQ(p.bond(), BondState::intact);
      EXPECT_LT((p.force() - force).norm(), 1e-3 * force.norm()) << "joint normal " << n.transpose();
      EXPECT_NEAR(p.unaccounted(), 0, 1e-6 * p.work());
    }
}

/// A plane of weakness (Jaeger): the pair's traction is that of sigma_1 and sigma_3 on the joint, and sigma_1 grows.
TEST(SmoothJoint, FailsAsAPlaneOfWeakness) {
  const double phi = std::tan(angle);
  for (const double beta : {0.8, 1.0, 1.2, 1.4})     // between the joint's normal and sigma_1 [rad]
    for (const double least : {0.0, 10e6})           // sigma_3 [Pa]
      for (const double tilted : {0.0, 0.4, 1.1}) {  // of the line of centres to sigma_1 [rad]
        const Cement c(3);
        const Vec3 major(std::cos(tilted), std::sin(tilted), 0), n(std::cos(tilted + beta), std::sin(tilted + beta), 0);
        const double difference = 2 * (cohesion + least * phi) / ((1 - phi / std::tan(beta)) * std::sin(2 * beta));
        for (const double share : {0.995, 1.005}) {
          HeldPair p = c.pair(joint(n));
          const auto load = [&](double deviator, int steps) {
            // What presses the first grain and the second together is a motion of the second against the normal from
            // the first to it.
            const double side = n.x() < 0 ? -1 : 1;
            const Vec3 force = -side * c.area * (least * n + deviator * major.dot(n) * major);
            const double along = force.dot(n);
            const Vec3 moved = along / c.kn * n + (force - along * n) / c.ks;
            p.lead({moved.x(), moved.y(), moved.z()}, steps);
          };
          load(0, 100);
          load(share * difference, 1000);
          EXPECT_EQ(p.bond(), share < 1 ? BondState::intact : BondState::broken_shear)
              << "beta " << beta << ", sigma_3 " << least << ", " << share;
          EXPECT_NEAR(p.unaccounted(), 0, 2e-3 * p.work());
        }
      }
}

/// A slide on a joint that dilates wedges it open: at a constant height the pressure grows by k_n tan(psi) of it.
TEST(SmoothJoint, DilatesAsItSlides) {
  const double psi = 0.2, slide = 2e-5, press = 2e-6;
  for (const int dimension : {2, 3}) {
    const Cement c(dimension);
    HeldPair p = c.pair(joint(
        Vec3(1, 0, 0),
        {{"dilation_angle", psi}, {"tensile_strength", 0.0}, {"cohesion", 0.0}, {"internal_friction_angle", 0.0}}));
    p.lead(-press, 0);
    p.lead(-press, slide, 4000);
    ASSERT_EQ(p.bond(), BondState::broken_shear);
    // Of the motion across, what the springs do not hold has slid.
    const double pushed = -p.normal_force(), slid = slide - friction * pushed / c.ks;
    EXPECT_NEAR(p.shear_force(), friction * pushed, 1e-3 * friction * pushed);
    EXPECT_NEAR(pushed, c.kn * (press + std::tan(psi) * slid), 2e-3 * pushed) << dimension;
    EXPECT_GT(pushed, 2 * c.kn * press) << "it shows";
    EXPECT_NEAR(p.unaccounted(), 0, 1e-3 * p.work());
    EXPECT_GT(p.energy().friction, 0);
  }
}

/// Upper row over lower row, in the valleys between its grains, each grain pressed down by a constant force.
struct Rows {
  static constexpr double r = 1e-3, spacing = 2.1 * r, force = 2000;
  static constexpr int below = 9, above = 3;

  explicit Rows(const Json& law) {
    PackedParticles p;
    const double height = std::sqrt(4 * r * r - 0.25 * spacing * spacing);
    for (int k = 0; k < below; ++k) p.position.emplace_back(k * spacing, 0, 0);
    for (int k = 0; k < above; ++k) p.position.emplace_back((k + 0.5) * spacing, height, 0);
    p.radius.assign(p.position.size(), r);
    p.outline = SpecimenShape::Outline::box;
    EngineSettings settings;
    settings.damping = {0.7, 0.7};
    bench = make_bench(p, law, 1e-6, settings, 2, "jcfpm");
    bench->prepare();
    for (Index k = 0; k < below + above; ++k) {
      if (bench->state().particles.id[k] >= below) {
        upper.push_back(k);
        bench->set_applied_force(k, Vec3(0, -force, 0), Vec3::Zero(), Mat3::Zero());
      } else {
        bench->hold(k, dof::all, Vec3::Zero(), Vec3::Zero());
      }
    }
    bench->forces();
    bench->mark_start_of_loading();
    steps(3000, 0);
  }
  void steps(int n, double velocity) {
    for (const Index k : upper) bench->hold(k, std::uint8_t(dof::all & ~dof::y), Vec3(velocity, 0, 0), Vec3::Zero());
    for (int k = 0; k < n; ++k) {
      bench->advance();
      bench->forces();
    }
  }
  /// Slides on by this way, in so many parts; the drag over the push after each of them.
  std::vector<double> slide(double way, int parts) {
    const double velocity = 0.2;
    std::vector<double> all;
    for (int k = 0; k < parts; ++k) {
      steps(int(way / parts / (velocity * bench->time_step())), velocity);
      Vec3 sum = Vec3::Zero();
      for (const PairForce& f : bench->state().pairs.force) sum += Vec3(f.fx, f.fy, f.fz);
      all.push_back(std::abs(sum.x() / (above * force)));
    }
    return all;
  }
  double height() const {
    double sum = 0;
    for (const Index k : upper) sum += bench.simulation->state().particles.position()[k].y() / above;
    return sum;
  }
  Bench bench;
  std::vector<Index> upper;
};

const Json weak = {{"tensile_strength", 0.0}, {"cohesion", 0.0}, {"internal_friction_angle", 0.0}};

TEST(SmoothJoint, RowsSlideUnderAConstantForceWithoutRidingUp) {
  Rows rows(joint(Vec3(0, 1, 0), weak));
  const double start = rows.height();
  // Until the first partners part, when they are 2 r apart along the joint.
  for (const double drag : rows.slide(0.9 * Rows::r, 30)) EXPECT_NEAR(drag, friction, 1e-3 * friction);
  EXPECT_NEAR(rows.height(), start, 1e-6 * Rows::r);
  // Partners change: each hand-over lets the row down by no more than the grains are pressed in.
  const std::vector<double> on = rows.slide(6 * Rows::r, 60);
  double mean = 0;
  for (const double drag : on) mean += drag / double(on.size());
  EXPECT_NEAR(mean, friction, 0.02 * friction);
  EXPECT_LE(rows.height(), start);
  const double pressed = Rows::force / modulus;  // k_n = E t, t = 1 m
  EXPECT_GT(rows.height(), start - 10 * pressed);
  const EnergyLedger e = rows.bench->view().energy;
  EXPECT_NEAR(e.error(), 0, 0.01 * e.boundary_work);
}

TEST(SmoothJoint, WithoutItTheRowsRideUp) {
  Rows rows(jcfpm(weak));
  const double start = rows.height();
  const std::vector<double> drag = rows.slide(0.9 * Rows::r, 30);
  EXPECT_GT(*std::max_element(drag.begin(), drag.end()), 1.5 * friction);
  EXPECT_GT(rows.height(), start + 0.1 * Rows::r);
}

TEST(SmoothJoint, RefusesWhatMakesNoSense) {
  const auto issues = [](const Json& config) {
    Registry registry;
    std::string all;
    for (const Issue& issue : registry.check("contact_law", "jcfpm", config)) all += issue.path + " ";
    return all;
  };
  EXPECT_EQ(issues(jcfpm()), "");
  EXPECT_EQ(issues(joint(Vec3(1, 1, 0))), "");
  EXPECT_EQ(issues(jcfpm({{"smooth_joint", true}})), "joint_normal ");
  EXPECT_EQ(issues(jcfpm({{"joint_normal", {1, 0, 0}}})), "joint_normal ");
  EXPECT_EQ(issues(joint(Vec3(0, 0, 0))), "joint_normal ");
  EXPECT_EQ(issues(jcfpm({{"dilation_angle", 0.1}})), "dilation_angle ");
  EXPECT_EQ(issues(joint(Vec3(1, 0, 0), {{"dilation_angle", 0.5}})), "dilation_angle ");
  const Cement plane(2);
  EXPECT_THROW(plane.pair(joint(Vec3(1, 0, 1))), UserError);
}

}  // namespace
}  // namespace breccia::testing
