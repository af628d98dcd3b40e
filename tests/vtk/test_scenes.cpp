// SPDX-License-Identifier: BSD-3-Clause
// From where pictures are seen, what of a specimen they show, and in which colours.
#include "scenes.hpp"

namespace breccia::test {
namespace {

TEST_F(Scenes, ADiscBetweenPlatensIsSeenAlongItsAxis) {
  MadeScene scene(Outline::cylinder, {20e-3, 20e-3, 10e-3});
  scene.add_corners(4e-3);
  scene.add_wall("bottom", {0, -10e-3, 5e-3}, Vec3::UnitY());
  scene.add_wall("top", {0, 10e-3, 5e-3}, -Vec3::UnitY());
  scene.write(from_.path());
  EXPECT_TRUE(has(usual(), "displacement_across.png"));
  const Image face = drawn({{"show", "cracks"}});
  EXPECT_NEAR(Wall(face).filled, 0.7854, 0.02) << "a circle";
  EXPECT_GT(platens(face), 5 * platens(drawn({{"show", "cracks"}, {"platens", false}}))) << "but for the writing";
  // Between the same platens a cylinder that stands is seen obliquely, as ever.
  Folder standing;
  MadeScene upright(Outline::cylinder, {20e-3, 20e-3, 10e-3});
  upright.add_corners(4e-3);
  upright.add_wall("bottom", Vec3::Zero(), Vec3::UnitZ());
  upright.add_wall("top", {0, 0, 10e-3}, -Vec3::UnitZ());
  upright.write(standing.path());
  EXPECT_FALSE(has(names(render(standing.path(), to_.path(), {{"size", 200}}, host_)), "displacement_across.png"));
}

TEST_F(Scenes, OutlinesAreTrueFromEverySide) {
  const auto share = [&](Outline outline, const char* view) {
    Folder from;
    MadeScene scene(outline, {20e-3, 20e-3, 30e-3});
    scene.add_corners(4e-3);
    scene.write(from.path());
    render(from.path(), to_.path(), {{"size", 400}, {"pictures", {{{"show", "cracks"}, {"camera", {{"view", view}}}}}}},
           host_);
    return Wall(read(to_.path() / "cracks.png"));
  };
  for (const auto& [outline, front, top] :
       {std::tuple(Outline::cylinder, 1.0, 0.7854), std::tuple(Outline::box, 1.0, 1.0),
        std::tuple(Outline::ellipsoid, 0.7854, 0.7854)}) {
    const Wall from_front = share(outline, "front"), from_top = share(outline, "top");
    EXPECT_NEAR(from_front.filled, front, 0.03) << int(outline);
    EXPECT_NEAR(from_top.filled, top, 0.03) << int(outline);
    EXPECT_NEAR(double(from_front.high) / from_front.wide, 1.5, 0.03) << int(outline);
    EXPECT_NEAR(double(from_top.high) / from_top.wide, 1, 0.03) << int(outline);
  }
  // Of an irregular one the shadow of its grains: from the front eight at the corners are four discs apart, so that the
  // rows and columns which have some are a square of two by two.
  const Wall shadow = share(Outline::irregular, "front");
  EXPECT_NEAR(double(shadow.high) / shadow.wide, 1, 0.03);
  EXPECT_NEAR(shadow.filled, 0.7854, 0.03);
  EXPECT_TRUE(host_.warnings.empty());
}

TEST_F(Scenes, WhatFlewOffSetsNeitherRangeNorFrame) {
  Folder plain;
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(3e-3);
  for (std::size_t p = 0; p < scene.size(); ++p) scene.displacement[p] = Vec3(1e-4 * double(p), 0, 0);
  scene.write(plain.path());
  for (int k = 0; k < 3; ++k) {
    scene.add({5.0 * (k + 1), 1, 1}, 3e-3);
    scene.displacement.back() = Vec3(4, 1, 1);
  }
  scene.write(from_.path());
  const Image with = drawn({{"show", "displacement"}});
  render(plain.path(), to_.path(), {{"size", 400}, {"pictures", {{{"show", "displacement"}}}}}, host_);
  EXPECT_EQ(with.pixel, read(to_.path() / "displacement.png").pixel);
}

/// Reds at the upper end, blues at the lower one: only where there are values of both signs.
TEST_F(Scenes, RangesAreSymmetricWhereTheFieldHasASign) {
  const auto look = [&](double lowest) {
    MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
    scene.add_corners(4e-3);
    for (std::size_t p = 0; p < scene.size(); ++p) scene.displacement[p].z() = p % 2 ? 3e-4 : lowest;
    scene.write(from_.path());
    const Image image = drawn({{"show", "specimen"}, {"field", "displacement_z"}});
    const auto count = [&](auto&& is) {
      return double(std::count_if(image.pixel.begin(), image.pixel.end(), is)) / double(image.pixel.size());
    };
    return std::pair(count([](auto& p) { return p[0] > p[1] + 60 && p[0] > p[2] + 60; }),
                     count([](auto& p) { return p[2] > p[0] + 25 && p[1] > p[0] + 10; }));
  };
  const auto [red, blue] = look(-1e-4);
  EXPECT_GT(red, 0.1);
  EXPECT_GT(blue, 0.1);
  EXPECT_LT(look(-1e-6).first, 0.02) << "noise about zero";
  EXPECT_LT(look(1e-4).first, 0.02) << "one sign";
}

/// A plane at the distance d cuts a circle of the area pi (R² - d²) out of a sphere.
TEST_F(Scenes, SectionsAreTheCirclesOfGeometry) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add({0, 0, 10e-3}, 5e-3);
  scene.write(from_.path());
  const auto area = [&](double offset) {
    return drawn({{"show", "specimen"}, {"field", "radius"}, {"slice", {{"normal", {0, 0, 1}}, {"offset", offset}}}})
        .share_of(68, 1, 84);
  };
  const double none = area(6e-3), middle = area(0) - none;
  EXPECT_GT(middle, 0.05);
  EXPECT_NEAR((area(3e-3) - none) / middle, 1 - 0.36, 0.01);
  EXPECT_NEAR((area(-4e-3) - none) / middle, 1 - 0.64, 0.01);
}

TEST_F(Scenes, AClipTakesAwayTheSideOfItsNormal) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add({-5e-3, 0, 10e-3}, 3e-3);
  scene.add({5e-3, 0, 10e-3}, 4e-3);
  scene.write(from_.path());
  const auto area = [&](const Json& normal) {
    Json picture = {{"show", "cracks"}, {"opacity", 1}, {"camera", {{"view", "front"}}}};
    if (!normal.is_null()) picture["clip"] = {{"normal", normal}};
    const Image image = drawn(picture);
    return double(
        std::count_if(image.pixel.begin(), image.pixel.end(), [](auto& p) { return p[0] != p[2] && p[0] < 240; }));
  };
  const double both = area(nullptr), small = area({1, 0, 0}), large = area({-1, 0, 0});
  EXPECT_GT(small, 0.2 * both);
  EXPECT_NEAR(large / small, 16.0 / 9, 0.15);
  EXPECT_NEAR((large + small) / both, 1, 0.05);
}

TEST_F(Scenes, ABeamLiesAndItsLoadPointsDown) {
  MadeScene scene(Outline::box, {2e-3, 2e-3, 42e-3});
  for (int k = 0; k < 21; ++k) scene.add({0, 0, 1e-3 + 2e-3 * k}, 1e-3);
  scene.held.assign(21, 0);
  scene.held.front() = scene.held.back() = dof::translation;
  scene.applied.assign(21, Vec3::Zero());
  scene.applied[10] = Vec3(3, 0, 0);
  scene.displacement[10] = Vec3(1e-4, 0, 0);
  scene.write(from_.path());
  EXPECT_EQ(usual(), (Names{"specimen.png", "displacement_across.png"}));
  const Image beam = drawn({{"show", "displacement_across"}});
  EXPECT_GT(beam.width, beam.height);
  EXPECT_GT(beam.share_of(70, 70, 74), 0.003) << "what is held";
  // Above the beam, and left of the legend, the arrow is all that there is: over the middle.
  const Image plain = drawn({{"show", "displacement_across"}, {"axes", false}, {"time", false}});
  double ink = 0, x = 0;
  for (int k = 0; k < plain.width * plain.height; ++k) {
    const int column = k % plain.width, up = k / plain.width;  // rows from below
    if (column > 0.85 * plain.width || up < 0.65 * plain.height || plain.pixel[std::size_t(k)][0] > 100) continue;
    ++ink;
    x += column;
  }
  ASSERT_GT(ink, 20);
  const double margin_left = 12, margin_right = 80;  // 3 and 20 hundredths of the size
  EXPECT_NEAR(x / ink, 0.5 * (margin_left + plain.width - margin_right), 2);
}

/// It bends by more than its depth, and lies as before when its load is taken away.
TEST_F(Scenes, ABeamStaysInThePictureWhileItBendsAndAfterItsRelease) {
  MadeScene scene(Outline::box, {2e-3, 2e-3, 42e-3});
  for (int k = 0; k < 21; ++k) scene.add({0, 0, 1e-3 + 2e-3 * k}, 1e-3);
  scene.held.assign(21, 0);
  scene.held.front() = scene.held.back() = dof::translation;
  auto output = make<Output>(BRECCIA_VTK_PLUGIN, {});
  output->begin(from_.path(), host_);
  scene.applied.assign(21, Vec3::Zero());
  scene.applied[10] = Vec3(3, 0, 0);
  scene.displacement[10] = Vec3(3e-3, 0, 0);
  scene.position[10].x() = 3e-3;
  scene.write_frame(*output);
  scene.applied.assign(21, Vec3::Zero());
  scene.write_frame(*output);
  output->finish();
  const Json displacement = {{"show", "displacement"}, {"time", false}};
  Json before = displacement;
  before["frame"] = 0;
  const Image loaded = drawn(before), released = drawn(displacement);
  // The end of the colours is where the middle is, apart from the bar at the right.
  const auto middle = [](const Image& image) {
    double yellow = 0;
    for (std::size_t k = 0; k < image.pixel.size(); ++k) {
      const auto& p = image.pixel[k];
      yellow += double(k % std::size_t(image.width)) < 0.8 * image.width && p[0] > 150 && p[2] < 80;
    }
    return yellow;
  };
  EXPECT_GT(middle(loaded), 20);
  EXPECT_GT(middle(released), 20);
  EXPECT_GT(released.width, released.height) << "lying";
  EXPECT_GT(released.share_of(70, 70, 74), 0.003) << "what is held";
}

TEST_F(Scenes, HeldEndsThatMoveApartHavePlatesAndAreSeenFromTheFront) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 40e-3});
  scene.add_corners(4e-3);
  scene.held.assign(scene.size(), dof::all);
  for (std::size_t p = 0; p < scene.size(); ++p) scene.displacement[p].z() = scene.position[p].z() > 20e-3 ? 1e-4 : 0;
  scene.write(from_.path());
  EXPECT_TRUE(has(usual(), "displacement_across.png"));
  const Image image = drawn({{"show", "cracks"}});
  EXPECT_GT(platens(image), 0.01);
  EXPECT_NEAR(Wall(image).filled, 1, 0.02) << "a rectangle";
}

TEST(SceneKeys, ThoseThatDoNotGoTogetherAreRefused) {
  const auto issue = [](const Json& picture) {
    const Issues all = issues_of(BRECCIA_PICTURES_PLUGIN, {{"pictures", {picture}}});
    return all.size() == 1 ? all[0].path + ": " + all[0].text : std::to_string(all.size()) + " issues";
  };
  EXPECT_EQ(
      issue({{"show", "load_curve"}, {"opacity", 0.5}}),
      "pictures[0].opacity: this goes with pictures of particles and cracks, not with `load_curve`: leave it out, or "
      "choose another `show`");
  for (const Json& wrong :
       {Json{{"show", "specimen"}, {"since", 1e-3}}, Json{{"show", "cracks"}, {"field", "mass"}},
        Json{{"show", "histogram"}}, Json{{"show", "specimen"}, {"movie", "mp4"}, {"frame", 1}},
        Json{{"show", "specimen"}, {"frames_per_second", 5}},
        Json{{"show", "specimen"}, {"slice", {{"normal", {0, 0, 0}}, {"offset", 0}}}},
        Json{{"show", "specimen"}, {"camera", {{"direction", {1, 0, 0}}, {"up", {-2, 0, 0}}, {"zoom", 1}}}}})
    EXPECT_EQ(issue(wrong).rfind("pictures[0]", 0), 0u) << wrong << issue(wrong);
  EXPECT_EQ(issue({{"show", "specimen"}, {"opacity", 0.5}, {"since", 1e-3}}), "0 issues");
}

}  // namespace
}  // namespace breccia::test
