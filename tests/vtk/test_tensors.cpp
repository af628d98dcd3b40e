// SPDX-License-Identifier: BSD-3-Clause
// Which number of a vector or tensor a picture shows: each compared with a field that is this number.
#include "made_scene.hpp"
#include "png_image.hpp"

namespace breccia::test {
namespace {

/// What is known of a tensor: in the plane it has no z.
struct Known {
  Mat3 tensor;
  double mean, von_mises, magnitude;
};
Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }
/// Of the pair of components a, b.
Mat3 shear(int a, int b, double t) {
  Mat3 m = Mat3::Zero();
  m(a, b) = m(b, a) = t;
  return m;
}

class Tensors : public ::testing::Test {
 protected:
  /// Whether a histogram of `field` (and `component`) has the bars and axes of the values in `expected`.
  void expect_shown(const std::vector<Mat3>& tensors, const std::vector<double>& expected, const std::string& component,
                    const std::string& name, int dimension = 3, int components = 6) {
    MadeScene scene(SpecimenShape::Outline::box, {20e-3, 20e-3, 20e-3});
    scene.dimension = dimension;
    Field tensor{Field::On::particles, "stress", "Pa", components, {}}, scalar{Field::On::particles, "x", "Pa", 1, {}};
    for (std::size_t k = 0; k < tensors.size(); ++k) {
      scene.add({2e-3 * double(k), 0, 10e-3}, 1e-3);
      const Mat3& t = tensors[k];
      if (components == 6) {
        for (const double c : {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2)}) tensor.values.push_back(c);
      } else {
        for (int c = 0; c < 9; ++c) tensor.values.push_back(t(c / 3, c % 3));
      }
      scalar.values.push_back(expected[k]);
    }
    scene.fields = {tensor, scalar};
    Folder from, to;
    scene.write(from.path());
    QuietHost host;
    const auto histogram = [](const std::string& file, const Json& more) {
      Json picture = {{"show", "histogram"}, {"name", file}};
      picture.update(more);
      return picture;
    };
    render(from.path(), to.path(),
           {{"size", 300},
            {"pictures",
             {histogram("scalar", {{"field", "x"}}), histogram("named", {{"field", "stress_" + component}}),
              histogram("chosen", {{"field", "stress"}, {"component", component}})}}},
           host);
    ASSERT_TRUE(host.warnings.empty()) << host.warnings[0];
    const auto drawn = [&](const char* file, const std::string& title) {
      std::string svg = bytes(to.path() / file);
      for (std::size_t at = svg.find(title), count = 0; count < 2; at = svg.find(title, at), ++count) {
        EXPECT_NE(at, svg.npos) << title;
        if (at == svg.npos) break;
        svg.erase(at, title.size());
      }
      return svg;
    };
    const std::string scalars = drawn("scalar.svg", "x (Pa)");
    EXPECT_TRUE(drawn("named.svg", name + " (Pa)") == scalars) << component;
    EXPECT_TRUE(drawn("chosen.svg", name + " (Pa)") == scalars) << component;
  }
  template <class Get>
  static std::vector<double> each(const std::vector<Mat3>& tensors, Get&& get) {
    std::vector<double> all;
    for (const Mat3& t : tensors) all.push_back(get(t));
    return all;
  }
};

TEST_F(Tensors, ComponentsAreThoseOfTheirNames) {
  std::vector<Mat3> tensors;
  for (int k = 0; k < 5; ++k) {
    Mat3 t = Mat3::Zero();
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b) t(a, b) = t(b, a) = 1.0 * (k * k * (a + 1) - 3 * b * k + a);
    tensors.push_back(t);
  }
  for (const auto& [name, a, b] :
       {std::tuple("xx", 0, 0), std::tuple("yy", 1, 1), std::tuple("zz", 2, 2), std::tuple("xy", 0, 1),
        std::tuple("yz", 1, 2), std::tuple("xz", 0, 2), std::tuple("zx", 2, 0)})
    expect_shown(tensors, each(tensors, [&](const Mat3& t) { return t(a, b); }), name, std::string("stress ") + name);
}

TEST_F(Tensors, OfNineComponentsEachHasItsPlace) {
  Mat3 t;
  t << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  const std::vector<Mat3> tensors = {t, -2 * t, 3 * t};
  expect_shown(tensors, {7, -14, 21}, "zx", "stress zx", 3, 9);
  expect_shown(tensors, {3, -6, 9}, "xz", "stress xz", 3, 9);
  expect_shown(tensors, {5, -10, 15}, "mean", "mean stress", 3, 9);
  // The symmetric part of shear that goes one way is half of it.
  Mat3 one_way = Mat3::Zero();
  one_way(0, 2) = 2;
  expect_shown({one_way, Mat3(5 * one_way)}, {std::sqrt(3.0), 5 * std::sqrt(3.0)}, "von_mises", "von Mises stress", 3,
               9);
}

TEST_F(Tensors, InvariantsAreThoseOfTextbooks) {
  const double s3 = std::sqrt(3.0), s2 = std::sqrt(2.0);
  const Known known[] = {{diagonal(-7, -7, -7), -7, 0, 7 * s3},
                         {diagonal(0, 0, -6), -2, 6, 6},
                         {diagonal(3, 0, 0), 1, 3, 3},
                         {shear(0, 2, -4), 0, 4 * s3, 4 * s2},
                         {shear(1, 2, 5), 0, 5 * s3, 5 * s2}};
  std::vector<Mat3> tensors;
  std::vector<double> mean, von_mises, magnitude;
  for (const Known& k : known) {
    tensors.push_back(k.tensor);
    mean.push_back(k.mean);
    von_mises.push_back(k.von_mises);
    magnitude.push_back(k.magnitude);
  }
  expect_shown(tensors, mean, "mean", "mean stress");
  expect_shown(tensors, von_mises, "von_mises", "von Mises stress");
  expect_shown(tensors, magnitude, "magnitude", "stress magnitude");
}

TEST_F(Tensors, InThePlaneTheyAreThoseOfThePlane) {
  const std::vector<Mat3> tensors = {diagonal(-6, -6, 0), diagonal(0, -4, 0), shear(0, 1, 3)};
  expect_shown(tensors, {-6, -2, 0}, "mean", "mean stress", 2);
  expect_shown(tensors, {0, 4, 6}, "von_mises", "von Mises stress", 2);
}

TEST(Components, ThatThereAreNotAreRefusedWithThoseThatThereAre) {
  MadeScene scene(SpecimenShape::Outline::box, {20e-3, 20e-3, 20e-3});
  scene.add_corners(3e-3);
  scene.fields = {{Field::On::particles, "stress", "Pa", 6, std::vector<double>(48, 1.0)}};
  Folder from, to;
  scene.write(from.path());
  QuietHost host;
  const auto picture = [](const char* name, const Json& more) {
    Json p = {{"show", "specimen"}, {"name", name}};
    p.update(more);
    return p;
  };
  render(from.path(), to.path(),
         {{"size", 300},
          {"pictures",
           {picture("fine", {{"field", "stress"}}), picture("a", {{"field", "stress"}, {"component", "x"}}),
            picture("b", {{"field", "velocity_mean"}}), picture("c", {{"field", "mass"}, {"component", "zz"}}),
            picture("d", {{"field", "strss"}, {"component", "zz"}}), picture("e", {{"field", "strss"}})}}},
         host);
  ASSERT_EQ(host.warnings.size(), 5u);
  const char* expected[] = {
      "the field `stress` has no component `x`; it has: xx, yy, zz, xy, yz, xz, magnitude, mean, "
      "von_mises",
      "the field `velocity` has no component `mean`; it has: x, y, z, magnitude",
      "the field `mass` has no component `zz`; each value is one number",
      "there is no field `strss_zz`; did you mean `stress`?", "there is no field `strss`; did you mean `stress`?"};
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NE(host.warnings[k].find(expected[k]), std::string::npos) << host.warnings[k];
}

TEST(Components, GoWithAFieldOfParticles) {
  const auto issue = [](const Json& picture) {
    const Issues all = issues_of(BRECCIA_PICTURES_PLUGIN, {{"pictures", {picture}}});
    return all.size() == 1 ? all[0].path + ": " + all[0].text : std::to_string(all.size()) + " issues";
  };
  EXPECT_EQ(
      issue({{"show", "specimen"}, {"component", "zz"}}),
      "pictures[0].component: a component of what? Add a `field`, for example `field: stress`, or leave this out");
  EXPECT_EQ(issue({{"show", "cracks"}, {"component", "zz"}}),
            "pictures[0].component: this goes with pictures of particles and histograms, not with `cracks`: leave it "
            "out, or choose another `show`");
  EXPECT_EQ(issue({{"show", "displacement"}, {"component", "z"}}), "0 issues");
}

}  // namespace
}  // namespace breccia::test
