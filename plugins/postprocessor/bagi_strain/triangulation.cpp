// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "breccia/error.hpp"
#include "qhull_hull.hpp"

namespace breccia {
namespace {

/// Below this share of its longest edge cubed (squared), a simplex counts as flat: far above rounding, far below any
/// simplex that matters to a volume average.
constexpr double flat_share = 1e-9;

Vec3 in_plane_normal(const Vec3& edge) { return {edge.y(), -edge.x(), 0}; }

double longest_edge(const Triangulation& t, const std::array<Index, 4>& s, Strided<const Vec3> centre) {
  double longest = 0;
  for (int a = 0; a < t.corners(); ++a)
    for (int b = a + 1; b < t.corners(); ++b) longest = std::max(longest, (centre[s[a]] - centre[s[b]]).norm());
  return longest;
}

void require_volume(int dimension, Strided<const Vec3> centre) {
  const std::string what = dimension == 3 ? "tetrahedra" : "triangles";
  if (centre.size() < std::size_t(dimension) + 1)
    throw UserError("bagi_strain: the packing has " + std::to_string(centre.size()) +
                    " particles; strain is averaged "
                    "over " +
                    what + " of their centres, which takes at least " + std::to_string(dimension + 1));
  Vec3 mean = Vec3::Zero();
  for (const Vec3& x : centre) mean += x;
  mean /= double(centre.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& x : centre) spread += (x - mean) * (x - mean).transpose();
  const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvalues();
  // In two dimensions the first moment is out of the plane and always zero.
  if (std::sqrt(std::max(0.0, moments[3 - dimension])) <= 1e-8 * std::sqrt(moments[2]))
    throw UserError(std::string("bagi_strain: all particle centres of the packing lie in one ") +
                    (dimension == 3 ? "plane" : "line") + ", so that no " + what +
                    " can be made of them; use a packing that is more than one particle thick");
}

/// Between -1 and 1, a function of k alone.
double tie_breaker(std::size_t k) {
  std::uint64_t z = (k + 1) * 0x9e3779b97f4a7c15ull;  // splitmix64
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return 2 * double((z ^ (z >> 31)) >> 11) / double(1ull << 53) - 1;
}

/// Centred and scaled to one, so that Qhull's tolerances and the lifting do not lose digits. The cells of a lattice can
/// be cut in many ways; a change of the squared radii by 1e-5 of their mean, far above rounding, settles all of them
/// alike, so that neighbours meet face to face.
std::vector<double> lift(int dimension, Strided<const Vec3> centre, Strided<const double> radius) {
  Vec3 low = centre[0], high = centre[0];
  for (const Vec3& x : centre) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Vec3 middle = 0.5 * (low + high);
  const double scale = 2 / (high - low).maxCoeff();
  double mean_r2 = 0;
  for (const double r : radius) mean_r2 += r * r * scale * scale / double(radius.size());
  std::vector<double> lifted;
  lifted.reserve(centre.size() * std::size_t(dimension + 1));
  for (std::size_t p = 0; p < centre.size(); ++p) {
    const double r = radius[p] * scale;
    double height = -r * r;
    for (int k = 0; k < dimension; ++k) {
      const double x = (centre[p][k] - middle[k]) * scale;
      lifted.push_back(x);
      height += x * x;
    }
    lifted.push_back(height + 1e-5 * mean_r2 * tie_breaker(p));
  }
  return lifted;
}

/// A face of one simplex. The corners are sorted, so that they are equal for the two simplices that share it.
struct Face {
  std::array<Index, 3> corner;  ///< in two dimensions the first is a filler
  std::size_t simplex;
};

std::vector<Face> faces_of(const Triangulation& t) {
  std::vector<Face> faces;
  faces.reserve(t.simplices.size() * std::size_t(t.corners()));
  for (std::size_t s = 0; s < t.simplices.size(); ++s)
    for (int opposite = 0; opposite < t.corners(); ++opposite) {
      Face f{{0, 0, 0}, s};
      for (int a = 0, n = 0; a < t.corners(); ++a)
        if (a != opposite) f.corner[n++] = t.simplices[s][a];
      if (f.corner[0] > f.corner[1]) std::swap(f.corner[0], f.corner[1]);
      if (f.corner[1] > f.corner[2]) std::swap(f.corner[1], f.corner[2]);
      if (f.corner[0] > f.corner[1]) std::swap(f.corner[0], f.corner[1]);
      faces.push_back(f);
    }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.corner != b.corner ? a.corner < b.corner : a.simplex < b.simplex;
  });
  return faces;
}

}  // namespace

double simplex_volume(const Triangulation& t, std::size_t simplex, Strided<const Vec3> centre) {
  const auto& s = t.simplices[simplex];
  const Vec3 ab = centre[s[1]] - centre[s[0]], ac = centre[s[2]] - centre[s[0]];
  if (t.dimension == 2) return 0.5 * (ab.x() * ac.y() - ab.y() * ac.x());
  return ab.dot(ac.cross(centre[s[3]] - centre[s[0]])) / 6;
}

std::array<Vec3, 4> shape_gradients(const Triangulation& t, std::size_t simplex, Strided<const Vec3> centre) {
  const auto& s = t.simplices[simplex];
  const Vec3 ab = centre[s[1]] - centre[s[0]], ac = centre[s[2]] - centre[s[0]];
  std::array<Vec3, 4> g;
  if (t.dimension == 2) {
    g[1] = 0.5 * in_plane_normal(ac);
    g[2] = -0.5 * in_plane_normal(ab);
    g[3].setZero();
  } else {
    const Vec3 ad = centre[s[3]] - centre[s[0]];
    g[1] = ac.cross(ad) / 6;
    g[2] = ad.cross(ab) / 6;
    g[3] = ab.cross(ac) / 6;
  }
  g[0] = -(g[1] + g[2] + g[3]);
  return g;
}

Triangulation triangulate(int dimension, Strided<const Vec3> centre, Strided<const double> radius) {
  require_volume(dimension, centre);
  Triangulation t;
  t.dimension = dimension;
  const std::vector<Index> corners = lower_hull(dimension + 1, lift(dimension, centre, radius));
  const std::size_t n = std::size_t(t.corners());
  for (std::size_t k = 0; k < corners.size(); k += n) {
    std::array<Index, 4> s{};
    std::copy_n(corners.begin() + long(k), n, s.begin());
    t.simplices.push_back(s);
    double volume = simplex_volume(t, t.simplices.size() - 1, centre);
    if (volume < 0) std::swap(t.simplices.back()[0], t.simplices.back()[1]);
    if (std::abs(volume) > flat_share * std::pow(longest_edge(t, s, centre), dimension)) continue;
    t.simplices.pop_back();
    ++t.flat;
  }
  return t;
}

std::size_t peel_hull(Triangulation& t, Strided<const Vec3> centre, Strided<const double> radius, double limit) {
  const std::size_t count = t.simplices.size();
  const auto spans_gap = [&](const std::array<Index, 4>& s) {
    for (int a = 0; a < t.corners(); ++a)
      for (int b = a + 1; b < t.corners(); ++b)
        if ((centre[s[a]] - centre[s[b]]).norm() - radius[s[a]] - radius[s[b]] > limit) return true;
    return false;
  };
  std::vector<char> wide(count);
  for (std::size_t s = 0; s < count; ++s) wide[s] = spans_gap(t.simplices[s]);

  constexpr std::size_t none = std::size_t(-1);
  std::vector<std::array<std::size_t, 4>> neighbour(count, {none, none, none, none});
  std::vector<char> outside(count, 0);
  std::vector<int> used(count, 0);
  const std::vector<Face> faces = faces_of(t);
  for (std::size_t f = 0; f < faces.size();) {
    const std::size_t s = faces[f].simplex;
    if (f + 1 < faces.size() && faces[f].corner == faces[f + 1].corner) {
      const std::size_t other = faces[f + 1].simplex;
      neighbour[s][used[s]++] = other;
      neighbour[other][used[other]++] = s;
      f += 2;
    } else {
      outside[s] = 1;
      ++f;
    }
  }

  std::vector<std::size_t> front;
  std::vector<char> peeled(count, 0);
  const auto visit = [&](std::size_t s) {
    if (wide[s] && !peeled[s]) {
      peeled[s] = 1;
      front.push_back(s);
    }
  };
  for (std::size_t s = 0; s < count; ++s)
    if (outside[s]) visit(s);
  while (!front.empty()) {
    const std::size_t s = front.back();
    front.pop_back();
    for (int k = 0; k < used[s]; ++k) visit(neighbour[s][k]);
  }
  std::size_t kept = 0;
  for (std::size_t s = 0; s < count; ++s)
    if (!peeled[s]) t.simplices[kept++] = t.simplices[s];
  t.simplices.resize(kept);
  return count - kept;
}

}  // namespace breccia
