// SPDX-License-Identifier: BSD-3-Clause
// Gauges in strain fields that are known.
#include <gtest/gtest.h>

#include <random>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

/// Spheres (discs) strewn over a box of 40 by 60 (by 50) mm, its axis along `axis`.
FakeSimulation strewn(int dimension, int axis) {
  FakeSimulation s;
  s.dimension = dimension;
  std::mt19937_64 random(7);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
  const Vec3 size(0.04, 0.06, dimension == 2 ? 0.0 : 0.05);
  for (int k = 0; k < 3000; ++k) s.add_particle(Vec3(uniform(), uniform(), uniform()).cwiseProduct(size), 0.0005);
  s.specimen.outline = SpecimenShape::Outline::box;
  s.specimen.axis = Vec3::Unit(axis);
  s.specimen.extent = size;
  s.specimen.height = size[axis];
  s.specimen.base = 0.5 * size - 0.5 * size[axis] * s.specimen.axis;
  return s;
}
void deform(FakeSimulation& s, const Mat3& gradient, const Vec3& shift) {
  for (std::size_t k = 0; k < s.position.size(); ++k)
    s.position[k] = s.reference[k] + gradient * s.reference[k] + shift;
}

TEST(Gauges, ExactInAFieldWithoutShear) {
  for (const int dimension : {2, 3})
    for (int axis = 0; axis < dimension; ++axis) {
      FakeSimulation s = strewn(dimension, axis);
      LoadedPostprocessor gauges("gauges");
      gauges.begin(s.view());
      gauges->start_of_loading(s.view());
      const Vec3 strain(1e-3, -2e-3, dimension == 2 ? 0.0 : 4e-3);
      deform(s, strain.asDiagonal(), Vec3(1, 2, 0));
      gauges.sample(s.view());
      const double lateral = (strain.sum() - strain[axis]) / (dimension - 1);
      EXPECT_NEAR(gauges.curves.last("gauge_lateral_strain"), lateral, 1e-12) << dimension << axis;
      EXPECT_NEAR(gauges.curves.last("gauge_axial_strain"), -strain[axis], 1e-12) << dimension << axis;
    }
}

TEST(Gauges, TheSidesAreTheNearestFourToTheirMiddles) {
  FakeSimulation s = strewn(2, 1);
  // Four just inside each side at mid-height; nothing else moves.
  std::vector<Index> right;
  for (int k = 0; k < 4; ++k) {
    right.push_back(s.add_particle(Vec3(0.04, 0.03 + 1e-7 * k, 0), 0.0005));
    s.add_particle(Vec3(0, 0.03 + 1e-7 * k, 0), 0.0005);
  }
  LoadedPostprocessor gauges("gauges");
  gauges.begin(s.view());
  for (const Index k : right) s.position[k].x() += 4e-5;
  gauges.sample(s.view());
  EXPECT_NEAR(gauges.curves.last("gauge_lateral_strain"), 1e-3, 1e-12);
  EXPECT_EQ(gauges.curves.last("gauge_axial_strain"), 0);
  // Fewer than asked for on each side: the mean of what is there changes.
  s.position = s.reference;
  LoadedPostprocessor eight("gauges", {{"particles", 8}});
  eight.begin(s.view());
  for (const Index k : right) s.position[k].x() += 4e-5;
  eight.sample(s.view());
  EXPECT_GT(eight.curves.last("gauge_lateral_strain"), 0.49e-3);
  EXPECT_LT(eight.curves.last("gauge_lateral_strain"), 0.6e-3);
}

TEST(Gauges, CountsFromTheStartOfLoading) {
  FakeSimulation s = strewn(3, 2);
  LoadedPostprocessor gauges("gauges");
  gauges.begin(s.view());
  deform(s, Vec3(0.01, 0.01, -0.02).asDiagonal(), Vec3::Zero());
  s.reference = s.position;
  gauges->start_of_loading(s.view());
  gauges.sample(s.view());
  EXPECT_EQ(gauges.curves.last("gauge_lateral_strain"), 0);
  EXPECT_EQ(gauges.curves.last("gauge_axial_strain"), 0);
}

TEST(Gauges, SaysWhenThereIsTooLittleToMeasure) {
  FakeSimulation s;
  s.add_particle(Vec3(0, 0, 0), 0.5);
  s.specimen.extent = Vec3::Ones();
  s.specimen.height = 1;
  LoadedPostprocessor gauges("gauges");
  EXPECT_THROW(gauges.begin(s.view()), UserError);
}

}  // namespace
}  // namespace breccia::test
