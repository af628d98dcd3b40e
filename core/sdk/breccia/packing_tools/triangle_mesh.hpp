// SPDX-License-Identifier: BSD-3-Clause
/// Triangles from a file, and what makes a closed surface of them.
#pragma once

#include <bit>
#include <cstring>
#include <sstream>

#include "breccia/packing_tools/closed_surface.hpp"
#include "breccia/schema.hpp"
#include "breccia/text_file.hpp"

namespace breccia {

/// What a workflow says of a file of triangles.
struct MeshConfig {
  std::filesystem::path file;
  double length_unit = 1;  // [m]
  static void describe(Schema<MeshConfig>& s) {
    s.param("file", &MeshConfig::file)
        .example("core.stl")
        .doc("closed surface of triangles: .stl, for a packing also .vtp");
    s.param("length_unit", &MeshConfig::length_unit)
        .unit("m")
        .above(0)
        .example("1 mm")
        .doc("what a 1 in the file stands for: these formats have no units");
  }
};

struct TriangleMesh {
  std::vector<Vec3> points;                      // [m]
  std::vector<ClosedSurface::Triangle> corners;  ///< rows of `points`
};

namespace detail {

/// All that counts in the text are the words `vertex x y z`, three to a triangle.
inline std::vector<Vec3> vertices_of_text(const std::filesystem::path& file) {
  std::vector<Vec3> all;
  std::istringstream words(read_text_file(file));
  for (std::string word; words >> word;) {
    if (word != "vertex") continue;
    std::string x, y, z;
    if (!(words >> x >> y >> z)) break;
    char* end = nullptr;
    const auto number = [&](const std::string& text) {
      const float value = std::strtof(text.c_str(), &end);
      if (*end != 0 || !std::isfinite(value))
        throw UserError("cannot read " + file.string() + ": `" + text + "` is no number");
      return double(value);
    };
    all.emplace_back(number(x), number(y), number(z));
  }
  return all;
}

/// Eighty bytes of anything, the number of triangles, then fifty bytes each: the normal, three corners, two more bytes.
inline std::vector<Vec3> vertices_of_binary(const std::string& bytes, const std::filesystem::path& file) {
  static_assert(std::endian::native == std::endian::little);
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  if (bytes.size() < 84 + 50 * std::size_t(count))
    throw UserError("cannot read " + file.string() + ": it is cut short: " + std::to_string(count) +
                    " triangles are announced");
  std::vector<Vec3> all;
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      float x[3];
      std::memcpy(x, bytes.data() + 84 + 50 * t + 12 * (k + 1), 12);
      all.emplace_back(x[0], x[1], x[2]);
      if (!all.back().allFinite())
        throw UserError("cannot read " + file.string() + ": triangle " + std::to_string(t) + " is not finite");
    }
  return all;
}

}  // namespace detail

/// Of an .stl file, text or binary; `unit`: what a 1 in it stands for [m]. UserError when it holds no triangles.
inline TriangleMesh read_stl(const std::filesystem::path& file, double unit) {
  const std::string bytes = read_bytes(file);
  std::uint32_t count = 0;
  if (bytes.size() >= 84) std::memcpy(&count, bytes.data() + 80, 4);
  // A binary file may begin with the word of a text; its length gives it away.
  const bool binary = bytes.size() >= 84 &&
                      (bytes.size() == 84 + 50 * std::size_t(count) || text_fault(without_mark(bytes)).has_value());
  using namespace std::string_view_literals;
  bool wide = false;  // UTF-16: the text's reader says so
  for (const std::string_view start : {"\xFF\xFE"sv, "\xFE\xFF"sv, "s\0o\0"sv, "\0s\0o"sv})
    wide |= std::string_view(bytes).starts_with(start);
  TriangleMesh mesh;
  mesh.points = binary && !wide ? detail::vertices_of_binary(bytes, file) : detail::vertices_of_text(file);
  for (Vec3& p : mesh.points) p *= unit;
  for (std::size_t k = 0; k + 2 < mesh.points.size(); k += 3) mesh.corners.push_back({k, k + 1, k + 2});
  if (mesh.corners.empty()) throw UserError("cannot read " + file.string() + ": it holds no triangles");
  return mesh;
}

/// The surface of a mesh whose triangles may have corners of their own and turn either way: equal points become one,
/// triangles without area go, neighbours turn the same way, outward. UserError, naming the file, when an edge does not
/// join exactly two triangles.
inline ClosedSurface closed_surface(const TriangleMesh& mesh, const std::filesystem::path& file) {
  std::map<std::array<double, 3>, std::size_t> known;
  std::vector<Vec3> points;
  std::vector<std::size_t> same;
  for (const Vec3& p : mesh.points) {
    const auto [at, is_new] = known.try_emplace({p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}, points.size());
    if (is_new) points.push_back(p);
    same.push_back(at->second);
  }
  std::vector<ClosedSurface::Triangle> triangles;
  for (const auto& c : mesh.corners) {
    const ClosedSurface::Triangle t{same[c[0]], same[c[1]], same[c[2]]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  if (triangles.empty()) throw UserError("cannot read " + file.string() + ": all its triangles are degenerate");
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> edges;
  const auto edge = [](std::size_t a, std::size_t b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) edges[edge(triangles[t][k], triangles[t][(k + 1) % 3])].push_back(t);
  std::size_t open = 0;
  for (const auto& [ends, of] : edges) open += of.size() != 2;
  if (open > 0)
    throw UserError("the surface of " + file.string() + " is not closed: " + std::to_string(open) +
                    " of its edges do not join exactly two triangles");
  // From neighbour to neighbour: of two that turn the same way each runs along their edge the other way.
  const auto runs = [&](std::size_t t, std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (triangles[t][k] == a && triangles[t][(k + 1) % 3] == b) return true;
    return false;
  };
  std::vector<std::uint8_t> seen(triangles.size(), 0);
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (seen[first]) continue;
    std::vector<std::size_t> piece{first};
    seen[first] = 1;
    for (std::size_t next = 0; next < piece.size(); ++next) {
      const ClosedSurface::Triangle t = triangles[piece[next]];
      for (std::size_t k = 0; k < 3; ++k)
        for (const std::size_t other : edges[edge(t[k], t[(k + 1) % 3])]) {
          if (seen[other]) continue;
          seen[other] = 1;
          if (runs(other, t[k], t[(k + 1) % 3])) std::swap(triangles[other][1], triangles[other][2]);
          piece.push_back(other);
        }
    }
    double six = 0;
    for (const std::size_t t : piece) {
      const Vec3 &o = points[triangles[first][0]], &a = points[triangles[t][0]], &b = points[triangles[t][1]],
                 &c = points[triangles[t][2]];
      six += (a - o).dot((b - o).cross(c - o));
    }
    if (six < 0)
      for (const std::size_t t : piece) std::swap(triangles[t][1], triangles[t][2]);
  }
  return {std::move(points), std::move(triangles)};
}

}  // namespace breccia
