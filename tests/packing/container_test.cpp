// SPDX-License-Identifier: BSD-3-Clause
#include "breccia/packing_tools/container.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace breccia::labra_onate {
namespace {

const Container all[] = {Container::cylinder(2, 3), Container::box(2, 3, 4), Container::sphere(3),
                         Container::rectangle(2, 3), Container::disc(3)};

TEST(Container, Measures) {
  EXPECT_NEAR(Container::cylinder(2, 3).measure(), 3 * std::numbers::pi, 1e-12);
  EXPECT_DOUBLE_EQ(Container::box(2, 3, 4).measure(), 24);
  EXPECT_DOUBLE_EQ(Container::rectangle(2, 3).measure(), 6);
  EXPECT_NEAR(Container::sphere(3).measure(), 4.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(Container::disc(3).measure(), 2.25 * std::numbers::pi, 1e-12);
  EXPECT_DOUBLE_EQ(Container::cylinder(2, 3).largest_radius(), 1);
  EXPECT_DOUBLE_EQ(Container::rectangle(2, 3).largest_radius(), 1);
  EXPECT_DOUBLE_EQ(Container::sphere(3).largest_radius(), 1.5);
  EXPECT_DOUBLE_EQ(Container::disc(3).largest_radius(), 1.5);
}

TEST(Container, SphereAndDiscStandOnTheOrigin) {
  Container::Walls walls;
  ASSERT_EQ(Container::sphere(3).walls(Vec3(0, 0.6, 1.5), walls), 1u);
  EXPECT_NEAR(walls[0].distance, 0.9, 1e-15);
  EXPECT_LT((walls[0].inward - Vec3(0, -1, 0)).norm(), 1e-15);
  ASSERT_EQ(Container::disc(3).walls(Vec3(0.5, 1.5, 0), walls), 1u);
  EXPECT_NEAR(walls[0].distance, 1.0, 1e-15);
  EXPECT_LT((walls[0].inward - Vec3(-1, 0, 0)).norm(), 1e-15);
  EXPECT_FALSE(Container::sphere(3).lower_end().has_value());
  EXPECT_EQ(Container::sphere(3).axis(), Vec3(Vec3::UnitZ()));
  EXPECT_EQ(Container::disc(3).axis(), Vec3(Vec3::UnitY()));
  EXPECT_EQ(Container::sphere(3).outline(), SpecimenShape::Outline::ellipsoid);
}

TEST(Container, PlacesInSphereAndDiscAreUniform) {
  // A third of the numbers a gives the inner part of a third of the measure, whatever the direction.
  for (const double b : {0.1, 0.7})
    for (const double c : {0.2, 0.9}) {
      EXPECT_NEAR((Container::sphere(3).place(0.5, 1.0 / 3, b, c) - Vec3(0, 0, 1.5)).norm(), std::cbrt(1.0 / 3), 1e-14);
      EXPECT_NEAR((Container::disc(3).place(0.5, 1.0 / 3, b, c) - Vec3(0, 1.5, 0)).norm(), std::sqrt(1.0 / 3), 1e-14);
    }
}

TEST(Container, WallDistancesAgreeWithTheirNormals) {
  const double h = 1e-6;
  for (const Container& box : all) {
    const Vec3 x(0.3, 0.4, box.dimension() == 2 ? 0.0 : 0.7);
    std::array<WallDistance, Container::max_walls> here, there;
    const std::size_t count = box.walls(x, here);
    for (std::size_t w = 0; w < count; ++w) {
      EXPECT_GT(here[w].distance, 0);
      EXPECT_NEAR(here[w].inward.norm(), 1, 1e-12);
      for (int k = 0; k < box.dimension(); ++k) {
        ASSERT_EQ(box.walls(x + h * Vec3::Unit(k), there), count);
        EXPECT_NEAR((there[w].distance - here[w].distance) / h, here[w].inward[k], 1e-5);
      }
    }
  }
}

TEST(Container, ProjectionBringsInsideAndLeavesTheInsideAlone) {
  const double r = 0.2;
  for (const Container& box : all) {
    const Vec3 p = box.project(Vec3(5, -7, 9), r, 0);
    std::array<WallDistance, Container::max_walls> walls;
    const std::size_t count = box.walls(p, walls);
    for (std::size_t w = 0; w < count; ++w) EXPECT_GE(walls[w].distance, r - 1e-14);
    const Vec3 inside(0.1, 0.5, box.dimension() == 2 ? 0.0 : 1.0);
    EXPECT_EQ(box.project(inside, r, 0), inside);
  }
}

TEST(Container, ProjectionMakesTangentToEachWallAskedFor) {
  const double r = 0.2;
  for (const Container& box : all) {
    std::array<WallDistance, Container::max_walls> walls;
    const Vec3 x(0.1, 0.5, box.dimension() == 2 ? 0.0 : 1.0);
    const std::size_t count = box.walls(x, walls);
    for (std::size_t w = 0; w < count; ++w) {
      box.walls(box.project(x, r, 1u << w), walls);
      EXPECT_NEAR(walls[w].distance, r, 1e-14) << "wall " << w;
    }
  }
}

TEST(Container, ASphereOnTheAxisCanBePutOnTheCurvedWall) {
  const Vec3 p = Container::cylinder(2, 3).project(Vec3(0, 0, 1), 0.2, 1);
  EXPECT_NEAR(std::hypot(p.x(), p.y()), 0.8, 1e-15);
}

TEST(Container, PlacesKeepTheSphereInside) {
  for (const Container& box : all)
    for (const double u : {0.0, 0.3, 0.999})
      for (const double v : {0.0, 0.6, 0.999}) {
        std::array<WallDistance, Container::max_walls> walls;
        const std::size_t count = box.walls(box.place(0.2, u, v, u), walls);
        for (std::size_t w = 0; w < count; ++w) EXPECT_GE(walls[w].distance, 0.2 - 1e-12);
      }
}

}  // namespace
}  // namespace breccia::labra_onate
