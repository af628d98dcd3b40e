// SPDX-License-Identifier: BSD-3-Clause
/// Packings into closed surfaces that the test writes itself.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "host.hpp"
#include "plugin_under_test.hpp"

namespace breccia {
namespace {

using Triangle = std::array<Vec3, 3>;
constexpr const char* plugin = BRECCIA_REARRANGEMENT_PLUGIN;

std::string stl(const std::vector<Triangle>& triangles) {
  std::ostringstream out;
  out.precision(9);
  out << "solid test\n";
  for (const Triangle& t : triangles) {
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    out << "facet normal " << n.x() << ' ' << n.y() << ' ' << n.z() << "\nouter loop\n";
    for (const Vec3& v : t) out << "vertex " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    out << "endloop\nendfacet\n";
  }
  out << "endsolid test\n";
  return out.str();
}

/// Edge 1, one corner at the origin.
std::vector<Triangle> cube() {
  std::vector<Triangle> t;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = Vec3::Unit((k + 1) % 3), b = Vec3::Unit((k + 2) % 3), up = Vec3::Unit(k), o = Vec3::Zero();
    t.push_back({up, up + a, up + a + b});
    t.push_back({up, up + a + b, up + b});
    t.push_back({o, a + b, a});
    t.push_back({o, b, a + b});
  }
  return t;
}

/// Octahedron of half diagonal 1, each face split in four `times` times and blown up to the unit sphere.
std::vector<Triangle> sphere(int times) {
  std::vector<Triangle> t;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  for (const double a : {1.0, -1.0})
    for (const double b : {1.0, -1.0})
      for (const double c : {1.0, -1.0}) {
        if (a * b * c > 0) t.push_back({a * x, b * y, c * z});
        else t.push_back({a * x, c * z, b * y});
      }
  for (int k = 0; k < times; ++k) {
    std::vector<Triangle> finer;
    for (const auto& [p, q, r] : t) {
      const Vec3 pq = (p + q).normalized(), qr = (q + r).normalized(), rp = (r + p).normalized();
      finer.insert(finer.end(), {{p, pq, rp}, {pq, q, qr}, {rp, qr, r}, {pq, qr, rp}});
    }
    t = finer;
  }
  return t;
}

Json filled(const std::filesystem::path& file, double unit) {
  return {{"mesh", {{"file", file.string()}, {"length_unit", unit}}},
          {"porosity", 0.5},
          {"radius", {{"distribution", "uniform"}, {"min", 0.4e-3}, {"max", 0.8e-3}}}};
}

PackedParticles pack(const Json& config, Host& host) {
  return generate(*test::make<Packing>(plugin, config), {{3, 1}, 1}, host);
}

double solid(const PackedParticles& p) {
  double sum = 0;
  for (const double r : p.radius) sum += 4 * std::numbers::pi / 3 * r * r * r;
  return sum;
}

void expect_no_overlaps(const PackedParticles& p) {
  double largest = 0;
  for (std::size_t i = 0; i < p.radius.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      largest = std::max(largest, 1 - (p.position[i] - p.position[j]).norm() / (p.radius[i] + p.radius[j]));
  EXPECT_LE(largest, 1e-3);
}

TEST(MeshPacking, ACubeIsFilledAndKept) {
  const test::Folder folder;
  TestHost host;
  Json config = filled(folder.file("cube.stl", stl(cube())), 0.008);  // an edge of 8 mm
  const PackedParticles p = pack(config, host);
  EXPECT_NEAR(p.container_volume, 512e-9, 1e-12);
  EXPECT_NEAR(solid(p), 256e-9, 0.51 * solid(p) / double(p.radius.size()));
  for (std::size_t i = 0; i < p.radius.size(); ++i) {
    ASSERT_GE(p.position[i].minCoeff(), p.radius[i] * (1 - 1e-6));
    ASSERT_LE(p.position[i].maxCoeff(), 0.008 - p.radius[i] * (1 - 1e-6));
  }
  expect_no_overlaps(p);
  EXPECT_EQ(p.outline, SpecimenShape::Outline::irregular);
  config["porosity"] = 0.6;
  TestHost two(2);
  EXPECT_TRUE(same_bits(pack(config, host), pack(config, two)));
}

TEST(MeshPacking, ASharpEdgedBodyKeepsThemToo) {
  // Tetrahedron at the corner of the cube, edges along x, y, z: x + y + z <= 1 with angles of 54.7 degrees between
  // faces.
  const Vec3 o = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const test::Folder folder;
  TestHost host;
  const PackedParticles p =
      pack(filled(folder.file("t.stl", stl({{o, y, x}, {o, z, y}, {o, x, z}, {x, y, z}})), 0.015), host);
  EXPECT_NEAR(p.container_volume, std::pow(0.015, 3) / 6, 1e-12);
  for (std::size_t i = 0; i < p.radius.size(); ++i) {
    ASSERT_GE(p.position[i].minCoeff(), p.radius[i] * (1 - 1e-6));
    ASSERT_GE((0.015 - p.position[i].sum()) / std::sqrt(3.0), p.radius[i] * (1 - 1e-6));
  }
  expect_no_overlaps(p);
}

TEST(MeshPacking, ASphereWithAMarginIsCutOutOfALargerOne) {
  const test::Folder folder;
  TestHost host;
  Json config = filled(folder.file("sphere.stl", stl(sphere(3))), 0.005);
  const PackedParticles whole = pack(config, host);
  for (std::size_t i = 0; i < whole.radius.size(); ++i)  // the facets lie inside the sphere
    ASSERT_LE(whole.position[i].norm() + whole.radius[i], 0.005 * (1 + 1e-6));
  config["margin"] = 1e-3;
  const PackedParticles cut = pack(config, host);
  EXPECT_NEAR(double(cut.radius.size()), double(whole.radius.size()), 0.05 * double(whole.radius.size()));
  double farthest = 0;
  for (std::size_t i = 0; i < cut.radius.size(); ++i) {
    ASSERT_LE(cut.position[i].norm(), 0.005 * (1 + 1e-6));
    farthest = std::max(farthest, cut.position[i].norm() + cut.radius[i]);
  }
  EXPECT_GT(farthest, 0.0052);
  EXPECT_NEAR(cut.container_volume, 4 * std::numbers::pi / 3 * 125e-9,
              0.03 * 523.6e-9);  // less what the facets cut off
}

TEST(MeshPacking, MistakesAreNamed) {
  const test::Folder folder;
  TestHost host;
  const auto refusal = [&](const Json& j) { return test::user_error([&] { pack(j, host); }); };
  auto open = cube();
  open.pop_back();
  std::string text = refusal(filled(folder.file("open.stl", stl(open)), 0.008));
  EXPECT_NE(text.find("is not closed: 3 of its edges"), std::string::npos) << text;
  text = refusal(filled(folder.path() / "absent.stl", 0.008));
  EXPECT_NE(text.find("absent.stl: no such file"), std::string::npos) << text;
  text = refusal(filled(folder.file("empty.stl", "solid a\nendsolid a\n"), 0.008));
  EXPECT_NE(text.find("it holds no triangles"), std::string::npos) << text;
  text = refusal(filled(folder.file("cube.obj", "v 0 0 0\n"), 0.008));
  EXPECT_NE(text.find("from .stl or .vtp"), std::string::npos) << text;
  Json j = filled(folder.file("cube.stl", stl(cube())), 0.0015);  // 1.5 mm: the largest, of 0.8 mm, does not fit
  j.erase("porosity");
  j["particles"] = 1;
  j["radius"]["min"] = 0.79e-3;
  EXPECT_NE(refusal(j).find("does not fit"), std::string::npos) << refusal(j);
}

}  // namespace
}  // namespace breccia
