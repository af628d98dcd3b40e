// SPDX-License-Identifier: BSD-3-Clause
// The inside of a closed surface of triangles as the region of a material.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "workflow/materials.hpp"

namespace breccia::testing {
namespace {

/// A wedge with a notch: no convex hull, no box. Extruded along y from 0 to 1 mm.
std::vector<std::array<Vec3, 3>> notched_block() {
  const Vec3 outline[] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 3}, {0.5, 0, 1.5}, {0, 0, 3}};  // a V cut from the top
  std::vector<std::array<Vec3, 3>> t;
  const Vec3 back(0, 1, 0);
  const auto face = [&](int a, int b, int c) {
    t.push_back({outline[a], outline[b], outline[c]});
    t.push_back({outline[a] + back, outline[c] + back, outline[b] + back});
  };
  face(0, 1, 3);
  face(1, 2, 3);
  face(0, 3, 4);
  for (int k = 0; k < 5; ++k) {
    const Vec3 &a = outline[k], &b = outline[(k + 1) % 5];
    t.push_back({a, a + back, b});
    t.push_back({b, a + back, b + back});
  }
  return t;
}

TEST(Assignment, InsideAClosedMesh) {
  const auto triangles = notched_block();
  const auto folder = std::filesystem::temp_directory_path() / ("breccia_mesh_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto text = [&](std::size_t first, bool turned) {
    std::ostringstream out;
    out << "solid wedge\n";
    for (std::size_t k = first; k < triangles.size(); ++k) {
      out << "facet normal 0 0 0\nouter loop\n";
      for (int v = 0; v < 3; ++v) {
        const Vec3& x = triangles[k][std::size_t(turned && k % 2 ? 2 - v : v)];
        out << "vertex " << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
      }
      out << "endloop\nendfacet\n";
    }
    out << "endsolid wedge\n";
    return out.str();
  };
  std::string binary(80, 's');
  const auto count = std::uint32_t(triangles.size());
  binary.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& t : triangles) {
    float numbers[12] = {};
    for (std::size_t v = 0; v < 3; ++v)
      for (int c = 0; c < 3; ++c) numbers[3 + 3 * v + std::size_t(c)] = float(t[v][c]);
    binary.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, '\0');
  }
  const auto write = [&](const char* name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  };
  write("text.stl", text(0, false));
  write("turned.STL", text(0, true));
  write("binary.stl", binary);
  write("open.stl", text(1, false));
  write("short.stl", binary.substr(0, binary.size() - 20));

  PackedParticles p;
  const Space space;
  std::vector<std::uint8_t> inside;
  for (double x = 0.05; x < 1.3; x += 0.1)
    for (double z = -0.25; z < 3.3; z += 0.1)
      for (const double y : {-0.2, 0.4, 1.2}) {
        p.position.push_back(1e-3 * Vec3(x, y, z));
        p.radius.push_back(1e-4);
        const double top = 1.5 + 3 * std::abs(x - 0.5);
        inside.push_back(x < 1 && y > 0 && y < 1 && z > 0 && z < top);
      }
  const std::vector<Material> list = {{2650, "a"}, {2560, "b"}};
  MaterialOfConfig way;
  way.elsewhere = "a";
  RegionConfig wedge;
  wedge.material = "b";
  for (const char* name : {"text.stl", "turned.STL", "binary.stl"}) {
    wedge.mesh = MeshConfig{folder / name, 1e-3};
    way.regions = {wedge};
    EXPECT_EQ(assign_materials(way, list, p, space, 1), inside) << name;
  }
  ASSERT_GT(std::count(inside.begin(), inside.end(), 1), 100);
  for (const auto& [name, why] :
       {std::pair{"open.stl", "3 of its edges do not join exactly two"}, std::pair{"short.stl", "cut short"},
        std::pair{"none.stl", "none.stl"}, std::pair{"wedge.vtp", "from an .stl file"}}) {
    wedge.mesh = MeshConfig{folder / name, 1e-3};
    way.regions = {wedge};
    try {
      assign_materials(way, list, p, space, 1);
      ADD_FAILURE() << name << " was not refused";
    } catch (const UserError& e) { EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what(); }
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace breccia::testing
