// SPDX-License-Identifier: BSD-3-Clause
// Cracks in pictures: which are seen, how large, from where.
#include <fstream>

#include "scenes.hpp"

namespace breccia::test {
namespace {

class ScenesOfCracks : public Scenes {
 protected:
  static const Specimen& specimen() {
    static const Specimen one(1200, 3);
    return one;
  }
  void SetUp() override { write_frames(specimen(), from_.path()); }
  double blue(const Json& more) {
    Json picture = {{"show", "cracks"}};
    picture.update(more);
    return drawn(picture).share_of(0, 100, 156);
  }
};

/// Face to face, evenly from front to back: 200 discs of 2 mm would cover the view of 20 by 20 mm six times.
TEST_F(Scenes, OfCracksThatHideEachOtherASlabIsShown) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(2e-3);
  for (int k = 0; k < 200; ++k)
    scene.add_crack({1e-3 * (k * 7 % 17 - 8), 1e-4 * (k - 99.5), 1e-3 * (4 + k * 11 % 13)}, Vec3::UnitY());
  scene.write(from_.path());
  const auto covered = [&](const Json& more) {
    Json picture = {{"show", "cracks"}};
    picture.update(more);
    const Image image = drawn(picture);
    const double blue = image.share_of(0, 108, 168),
                 pale = double(std::count(image.pixel.begin(), image.pixel.end(), wall)) / double(image.pixel.size());
    return blue / (blue + pale);
  };
  EXPECT_GT(covered({{"slice", {{"thickness", 1}}}}), 0.7);
  const double slab = covered(Json::object());
  EXPECT_GT(slab, 0.02);
  EXPECT_LT(slab, 0.35);
  EXPECT_LT(covered({{"since", 2e-3}}), 0.02) << "later than all: the legend's dot remains";
}

/// A disc has an edge: as long as the disc is wide.
TEST_F(Scenes, CracksAreSeenFromTheirEdge) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(4e-3);
  scene.write(from_.path());
  const double legend = drawn({{"show", "cracks"}, {"camera", {{"view", "front"}}}}).share_of(0, 114, 178);
  scene.add_crack({0, 0, 10e-3}, Vec3::UnitZ());
  Folder with;
  scene.write(with.path());
  render(with.path(), to_.path(),
         {{"size", 400}, {"pictures", {{{"show", "cracks"}, {"camera", {{"view", "front"}}}}}}}, host_);
  const Image image = read(to_.path() / "cracks.png");
  // 20 mm are 342 of 400 pixels: a line of 8 mm by some one and a half pixels.
  const double line = (image.share_of(0, 114, 178) - legend) * double(image.pixel.size());
  EXPECT_GT(line, 137);
  EXPECT_LT(line, 137 * 3);
}

TEST_F(Scenes, CracksAreAsLargeAsTheEnergyTheyReleased) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(3e-3);
  scene.add_crack({-5e-3, 0, 10e-3}, Vec3::UnitY(), 1e-6);
  scene.add_crack({5e-3, 0, 10e-3}, Vec3::UnitY(), 4e-6);
  scene.add_crack({0, 0, 16e-3}, Vec3::UnitY(), -9e-6);
  scene.write(from_.path());
  // Blue pixels in the left and right half of the box, and above both.
  const auto areas = [&](const Json& size_by) {
    Json picture = {{"show", "cracks"}, {"camera", {{"view", "front"}}}};
    if (!size_by.is_null()) picture["size_by"] = size_by;
    const Image image = drawn(picture);
    const double box = 342;  // pixels, of 400: from 12 to the right and from 46 upwards
    std::array<double, 3> n{};
    for (std::size_t k = 0; k < image.pixel.size(); ++k) {
      const auto& p = image.pixel[k];
      const double x = (double(k % std::size_t(image.width)) - 12) / box,
                   z = (double(k / std::size_t(image.width)) - 46) / box;
      if (x < 1 && p[2] > p[0] + 60) ++n[z > 0.66 ? 2 : x > 0.5];
    }
    return n;
  };
  const auto usual = areas(nullptr), by_energy = areas("energy");
  EXPECT_EQ(areas("area"), usual);
  EXPECT_NEAR(usual[0] / usual[1], 1, 0.02);
  EXPECT_GT(usual[2], 0.5 * usual[0]);
  EXPECT_NEAR(by_energy[1] / usual[1], 1, 0.02) << "the largest";
  EXPECT_NEAR(by_energy[0] / by_energy[1], 0.25, 0.03);
  EXPECT_EQ(by_energy[2], 0) << "it took energy";
}

TEST_F(Scenes, WithoutReleasedEnergySizesByItAreRefused) {
  MadeScene scene(Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(3e-3);
  scene.add_crack({0, 0, 10e-3}, Vec3::UnitY(), 1e-6);
  scene.write(from_.path());
  const fs::path file = from_.path() / "bonds_000000.vtp";
  std::string text = bytes(file);
  const std::string name = "released_energy";
  ASSERT_NE(text.find(name), text.npos);
  text.replace(text.find(name), name.size(), "something_other");
  std::ofstream(file, std::ios::binary) << text;
  EXPECT_THROW(render(from_.path(), to_.path(),
                      {{"size", 300}, {"pictures", {{{"show", "cracks"}, {"size_by", "energy"}}}}}, host_),
               UserError);
  ASSERT_EQ(host_.warnings.size(), 1u);
  EXPECT_NE(host_.warnings[0].find("`size_by: energy` needs the bond field `released_energy`"), std::string::npos)
      << host_.warnings[0];
}

TEST_F(ScenesOfCracks, AreSizedByAField) {
  // With areas in proportion to the radius, small discs are larger than their particles.
  const Json all = {{"slice", {{"thickness", 1}}}};
  Json sized = all;
  sized["size_by"] = "crack_radius";
  EXPECT_GT(blue(sized), 1.02 * blue(all));
}

TEST_F(ScenesOfCracks, AreSeenThroughTransparentParticles) {
  const Json grey = {{"show", "specimen"}, {"field", "radius"}, {"colour_map", "grey"}};
  Json glass = grey;
  glass["opacity"] = 0.3;
  const auto bluish = [](const Image& image) {
    return double(std::count_if(image.pixel.begin(), image.pixel.end(), [](auto& p) { return p[2] > p[0] + 50; })) /
           double(image.pixel.size());
  };
  EXPECT_LT(bluish(drawn(grey)), 0.001);
  EXPECT_GT(bluish(drawn(glass)), 0.01);
}

TEST_F(ScenesOfCracks, AFieldHasAHistogram) {
  const Json four = {{"size", 300}, {"pictures", {{{"show", "histogram"}, {"field", "force_shear"}, {"bins", 4}}}}};
  EXPECT_EQ(names(render(from_.path(), to_.path(), four, host_)),
            (Names{"histogram_force_shear.png", "histogram_force_shear.svg", "histogram_force_shear.pdf"}));
  const std::string svg = bytes(to_.path() / "histogram_force_shear.svg");
  const std::size_t bonds = specimen().view(0).bonds.size();
  EXPECT_NE(svg.find("force shear (N)"), std::string::npos);
  EXPECT_NE(svg.find("n = " + std::to_string(bonds / 1000) + "\u202f"), std::string::npos);
}

}  // namespace
}  // namespace breccia::test
