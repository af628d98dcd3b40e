// SPDX-License-Identifier: BSD-3-Clause
// What the rays of a picture hit: areas, order in depth, light, and the same bytes for any number of threads.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "caster.hpp"

namespace breccia::pictures {
namespace {

constexpr Rgb red{255, 0, 0}, green{0, 255, 0}, white{255, 255, 255};
const Vec3 black = Vec3::Zero();

/// The mean of a channel over the picture, 0 to 255, times the number of pixels.
double sum(const Image& image, int channel) {
  double s = 0;
  for (std::size_t k = std::size_t(channel); k < image.rgb.size(); k += 3) s += image.rgb[k];
  return s;
}

Patch flat(const Vec3& centre, const Vec3& a, const Vec3& b, const Rgb& colour, bool round = true) {
  return {centre, a, b, round, false, false, colour};
}

const Projection half_pixels{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), 100, {200, 150}};

TEST(Caster, AreasAreThoseOfGeometry) {
  const double scale = 100 * 100;
  Scene disc;
  disc.patches.push_back(flat({0.1, -0.2, 0}, {1.2, 0, 0}, {0, 0.7, 0.4}, white));  // its depth is not seen
  EXPECT_NEAR(sum(cast(disc, half_pixels, 400, 300, black, 1), 0) / 255, std::numbers::pi * 1.2 * 0.7 * scale, 40);
  Scene square;
  square.patches.push_back(flat({0.1, -0.2, 0}, {0.6, 0.3, 0}, {-0.3, 0.6, 1}, white, false));
  EXPECT_NEAR(sum(cast(square, half_pixels, 400, 300, black, 1), 0) / 255, 4 * (0.36 + 0.09) * scale, 40);
  // A sphere's outline: on a white sheet a black sphere takes away a circle.
  Scene ball;
  ball.spheres.push_back({{0.13, 0.08, 5}, 1.1, {0, 0, 0}});
  const double left = sum(cast(ball, half_pixels, 400, 300, Vec3::Ones(), 1), 1) / 255;
  EXPECT_NEAR(400 * 300 - left, std::numbers::pi * 1.21 * scale, 40);
}

TEST(Caster, TheNearerOneIsSeen) {
  Scene scene;
  scene.spheres.push_back({{0, 0, 0}, 1, red});
  scene.spheres.push_back({{0, 0, 0.5}, 0.6, green});  // reaches 1.1: its cap alone stands out of the other
  const Image image = cast(scene, half_pixels, 400, 300, black, 1);
  const auto at = [&](int x, int y) { return &image.rgb[3 * std::size_t((299 - y) * 400 + x)]; };
  // They meet in the circle where 1 - z² = 0.36 - (z - 0.5)², z = 0.89: its radius is 0.4560.
  const double meet = std::sqrt(1 - 0.89 * 0.89);
  for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
    const auto probe = [&](double r) {
      return at(int(200 + 100 * r * std::cos(angle)), int(150 + 100 * r * std::sin(angle)));
    };
    EXPECT_GT(probe(meet - 0.03)[1], 60);
    EXPECT_EQ(probe(meet - 0.03)[0], 0);
    EXPECT_GT(probe(meet + 0.03)[0], 60);
    EXPECT_EQ(probe(meet + 0.03)[1], 0);
  }
  // A tilted plate through a sphere: half of it is hidden, whichever is named first.
  Scene cut;
  cut.spheres.push_back({{0, 0, 0}, 1, red});
  cut.patches.push_back(flat({0, 0, 0}, {1.4, 0, 1.4}, {0, 1.4, 0}, green, false));
  const Image halves = cast(cut, half_pixels, 400, 300, black, 1);
  EXPECT_EQ(halves.rgb[3 * (150 * 400 + 170) + 1], 0) << "the sphere, left";
  EXPECT_EQ(halves.rgb[3 * (150 * 400 + 230) + 1], 0) << "the plate has not come out of the sphere yet";
  EXPECT_EQ(halves.rgb[3 * (150 * 400 + 285) + 1], 255) << "the plate, right";
}

TEST(Caster, WhatStandsBehindEverythingIsBehind) {
  Scene scene;
  scene.patches.push_back({{0, 0, 9}, {1, 0, 0}, {0, 1, 0}, false, false, true, white});
  scene.patches.push_back(flat({0, 0, -9}, {0.5, 0, 0}, {0, 0.5, 0}, red, false));
  const Image image = cast(scene, half_pixels, 400, 300, black, 1);
  EXPECT_NEAR(sum(image, 0) / 255, 4e4, 1e-9);
  EXPECT_NEAR(sum(image, 1) / 255, 3e4, 1e-9);
}

TEST(Caster, NumbersBeyondThePictureAreLeftOut) {
  Scene scene;
  for (const double far : {-1e9, -3.0, 3.0, 1e9, std::nan("")}) {
    scene.spheres.push_back({{far, 0, 0}, 0.5, white});
    scene.spheres.push_back({{0, far, 0}, 0.5, white});
    scene.patches.push_back(flat({0, far, 0}, {0.5, 0, 0}, {0, 0.5, 0}, white));
  }
  scene.patches.push_back(flat({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, white));  // seen from its edge
  EXPECT_EQ(sum(cast(scene, half_pixels, 400, 300, black, 2), 0), 0);
}

/// Of the light from everywhere that a small area gets, weighted by the cosine; by summation over directions.
double shadow_by_summation(double distance, double cosine) {
  const Vec3 centre(distance * std::sqrt(1 - cosine * cosine), 0, distance * cosine);
  double shadow = 0, all = 0;
  for (int i = 0; i < 400; ++i)
    for (int j = 0; j < 400; ++j) {
      const double z = (i + 0.5) / 400, turn = 2 * std::numbers::pi * (j + 0.5) / 400, r = std::sqrt(1 - z * z);
      const Vec3 d(r * std::cos(turn), r * std::sin(turn), z);
      const double along = d.dot(centre);
      all += z;
      if (along > 0 && centre.squaredNorm() - along * along < 1) shadow += z;
    }
  return shadow / all;
}

TEST(Caster, TheShadowOfASphere) {
  for (const double distance : {1.0001, 1.3, 2.0, 4.0})
    for (const double cosine : {-0.9, -0.4, 0.0, 0.3, 0.8, 1.0})
      EXPECT_NEAR(shadow_of_sphere(float(distance), float(cosine)), shadow_by_summation(distance, cosine), 0.035)
          << distance << " " << cosine;
  EXPECT_NEAR(shadow_of_sphere(2, 0.8f), 0.2, 1e-6) << "above the horizon: cosine/distance²";
}

TEST(Caster, GapsAreDarkerThanFreeSurfaces) {
  Scene alone, pair;
  alone.occlusion = pair.occlusion = true;
  alone.spheres.push_back({{-0.5, 0, 0}, 0.5, white});
  pair.spheres = alone.spheres;
  pair.spheres.push_back({{0.5, 0, 0}, 0.5, white});
  const Image one = cast(alone, half_pixels, 400, 300, black, 1), two = cast(pair, half_pixels, 400, 300, black, 1);
  const auto at = [](const Image& image, int x) { return int(image.rgb[3 * std::size_t(150 * 400 + x)]); };
  EXPECT_LT(at(two, 190), 0.8 * at(one, 190)) << "beside the contact";
  EXPECT_NEAR(at(two, 110), at(one, 110), 2) << "on the far side";
}

TEST(Caster, AnyNumberOfThreadsDrawsTheSame) {
  std::mt19937_64 random(3);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
  Scene scene;
  scene.occlusion = true;
  for (int k = 0; k < 500; ++k) {
    const Vec3 x(3 * uniform() - 1.5, 2 * uniform() - 1, uniform());
    scene.spheres.push_back({x, 0.02 + 0.1 * uniform(), {200, 100, 50}});
    if (k % 5 == 0) scene.patches.push_back(flat(x, {0.1, 0, 0.1}, {0, 0.1, 0}, green));
  }
  const Image one = cast(scene, half_pixels, 403, 307, black, 1);
  for (const int threads : {2, 3, 16}) EXPECT_EQ(cast(scene, half_pixels, 403, 307, black, threads).rgb, one.rgb);
}

}  // namespace
}  // namespace breccia::pictures
