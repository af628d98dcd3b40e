// SPDX-License-Identifier: BSD-3-Clause
// The lateral surface: Voronoi cells fill it, and only particles that are seen from outside belong to it.
#include <numeric>

#include "breccia/protocol_tools/lateral_surface.hpp"
#include "protocols/protocol_run.hpp"

namespace breccia::testing {
namespace {

std::vector<SurfacePoint> scattered(int n, double width, double height, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
  std::vector<SurfacePoint> points;
  for (int k = 0; k < n; ++k) points.emplace_back(width * uniform(), height * uniform());
  return points;
}

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

TEST(Voronoi, CellsOfASquareLatticeAreEqual) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) points.emplace_back(0.5 + i, 0.5 + j);
  for (const bool wraps : {false, true})
    for (const double a : voronoi_areas(points, 6, 4, wraps)) EXPECT_NEAR(a, 1, 1e-12);
}

TEST(Voronoi, CellsFillTheRectangleFlatAndRolledUp) {
  for (const int n : {1, 2, 3, 7, 50, 1000})
    for (const bool wraps : {false, true}) {
      const auto areas = voronoi_areas(scattered(n, 3, 2, unsigned(n)), 3, 2, wraps);
      EXPECT_NEAR(sum(areas), 6, 1e-10) << n << wraps;
      for (const double a : areas) EXPECT_GE(a, 0);
    }
}

TEST(Voronoi, ACellHoldsWhatIsNearestToItsPoint) {
  for (const double largest : {0.0, 0.3, 1.0}) {
    const auto points = scattered(40, 3, 2, 5);
    std::vector<double> radii;
    for (const SurfacePoint& p : scattered(40, 1, 1, 6)) radii.push_back(largest * p.x());
    const auto areas = voronoi_areas(points, 3, 2, true, radii);
    EXPECT_NEAR(sum(areas), 6, 1e-10);
    std::vector<double> counted(points.size(), 0);
    constexpr int grid = 900;
    for (int i = 0; i < grid; ++i)
      for (int j = 0; j < grid; ++j) {
        const SurfacePoint at(3 * (i + 0.5) / grid, 2 * (j + 0.5) / grid);
        std::size_t nearest = 0;
        double least = 1e300;
        for (std::size_t k = 0; k < points.size(); ++k) {
          SurfacePoint d = points[k] - at;
          d.x() -= 3 * std::round(d.x() / 3);
          const double power = d.squaredNorm() - radii[k] * radii[k];
          if (power < least) {
            least = power;
            nearest = k;
          }
        }
        counted[nearest] += 6.0 / grid / grid;
      }
    for (std::size_t k = 0; k < points.size(); ++k) EXPECT_NEAR(areas[k], counted[k], 2e-3) << k;
  }
}

TEST(Voronoi, TwoPointsInOnePlaceHaveOneCell) {
  const auto areas = voronoi_areas({{1, 1}, {1, 1}, {2, 1}}, 3, 2, false);
  EXPECT_NEAR(areas[0], 3, 1e-12);
  EXPECT_EQ(areas[1], 0);
  EXPECT_NEAR(sum(areas), 6, 1e-12);
}

TEST(Voronoi, OfTwoCirclesInOnePlaceTheLargerHasTheCell) {
  const auto areas = voronoi_areas({{1, 1}, {1, 1}, {2, 1}}, 3, 2, false, {0.1, 0.2, 0.1});
  EXPECT_EQ(areas[0], 0);
  EXPECT_NEAR(areas[1], 2 * (1.5 + 0.5 * (0.04 - 0.01)), 1e-12);
  EXPECT_NEAR(sum(areas), 6, 1e-12);
}

TEST(LateralSurface, LosesWhatSinksBehindOthers) {
  PackedParticles p = simple_cubic(5, 5, 5, 1e-3);
  State s = assemble(p, {2650}, 3, 1);
  const ParticlesView v{s.particles.position(), {}, {}, {}, {}, {}, {}, {}, s.particles.radius(), {}, {}, {}, {}};
  LateralSurface surface(s.specimen, v, 3, 1);
  surface.measure(v, 0, s.specimen.height);
  const auto of = [&](Index k) {
    double area = 0;
    for (const SurfaceCell& c : surface.cells()) area += c.particle == k ? c.area : 0;
    return area;
  };
  Index mid = 0, behind = 0;  // in the middle of the face at high x, and the next one inward
  for (Index k = 0; k < s.particles.size(); ++k) {
    const Vec3 off = s.particles.position()[k] - s.specimen.base - Vec3(0, 0, 5e-3);
    if (off.isApprox(Vec3(4e-3, 0, 0), 1e-9)) mid = k;
    if (off.isApprox(Vec3(2e-3, 0, 0), 1e-9)) behind = k;
  }
  EXPECT_NEAR(of(mid), 4e-6, 1e-15);
  EXPECT_EQ(of(behind), 0);
  std::swap(s.particles.position()[mid].x(), s.particles.position()[behind].x());
  surface.measure(v, 0, s.specimen.height);
  EXPECT_EQ(of(mid), 0);
  EXPECT_NEAR(of(behind), 4e-6, 1e-15);
}

TEST(LateralSurface, OfALatticeIsItsOuterLayer) {
  PackedParticles p = simple_cubic(5, 4, 6, 1e-3);
  const State s = assemble(p, {2650}, 3, 1);
  LateralSurface surface(
      s.specimen, {s.particles.position(), {}, {}, {}, {}, {}, {}, {}, s.particles.radius(), {}, {}, {}, {}}, 3, 1);
  surface.measure({s.particles.position(), {}, {}, {}, {}, {}, {}, {}, s.particles.radius(), {}, {}, {}, {}}, 0,
                  s.specimen.height);
  EXPECT_NEAR(surface.area(), 2 * (10e-3 + 8e-3) * 12e-3, 1e-12);
  EXPECT_EQ(surface.cells().size(), std::size_t(2 * (5 + 4) * 6));
  for (const SurfaceCell& c : surface.cells()) EXPECT_NEAR(c.area, 4e-6, 1e-15);
  EXPECT_NEAR(surface.disc_area() / surface.area(), std::numbers::pi / 4, 1e-12);
}

TEST(LateralSurface, OfACylinderFacesInward) {
  PackedParticles block = random_block(14, 14, 16, 1e-3, 3), p;
  for (std::size_t k = 0; k < block.position.size(); ++k)
    if (std::hypot(block.position[k].x() - 14e-3, block.position[k].y() - 14e-3) + block.radius[k] < 13e-3) {
      p.position.push_back(block.position[k]);
      p.radius.push_back(block.radius[k]);
    }
  p.outline = SpecimenShape::Outline::cylinder;
  const State s = assemble(p, {2650}, 3, 1);
  const ParticlesView v{s.particles.position(), {}, {}, {}, {}, {}, {}, {}, s.particles.radius(), {}, {}, {}, {}};
  LateralSurface surface(s.specimen, v, 3, 1);
  surface.measure(v, 0, s.specimen.height);
  double outer = 0, area = 0;
  Vec3 closed = Vec3::Zero();
  for (const SurfaceCell& c : surface.cells()) {
    const Vec3 off = s.particles.position()[c.particle] - s.specimen.base;
    EXPECT_LT(c.inward.dot(off), 0);
    EXPECT_EQ(c.inward.z(), 0);
    outer = std::max(outer, std::hypot(off.x(), off.y()));
    area += c.area;
    closed += c.area * c.inward;
  }
  EXPECT_NEAR(surface.area(), area, 1e-12 * area);
  EXPECT_LT(area, 2 * std::numbers::pi * 13e-3 * s.specimen.height);
  EXPECT_GT(area, 0.9 * 2 * std::numbers::pi * 13e-3 * s.specimen.height) << "the mean outer radius, not the largest";
  EXPECT_LT(closed.norm(), 0.01 * area) << "a pressure does not push a closed surface";
}

}  // namespace
}  // namespace breccia::testing
