// SPDX-License-Identifier: BSD-3-Clause
/// Where the centroids of an interface's elements stand, in its radii, and the history that goes with them. All
/// elements of an interface have the same area. Each layout is its own image in the second axis: which of the two
/// particles comes first turns the first axis round, and must not matter.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace breccia::flat_joint {

struct Point {
  double x, y;
};

// For constants that the compiler needs; the library's functions are not for that.
constexpr double root(double v) {
  double x = v > 1 ? v : 1;
  for (int k = 0; k < 60; ++k) x = 0.5 * (x + v / x);
  return v > 0 ? x : 0;
}
constexpr double sine(double angle) {
  long double term = angle, sum = angle;
  for (int k = 1; k < 30; ++k) {
    term *= -static_cast<long double>(angle) * angle / ((2 * k) * (2 * k + 1));
    sum += term;
  }
  return double(sum);
}

/// N pieces of a line from -1 to 1.
template <int N>
struct Line {
  static constexpr int dimension = 2, count = N;
  static constexpr Point at(int k) { return {-1 + (2 * k + 1.0) / N, 0}; }
};

/// `rings` of equal area, each of `around` equal sectors.
template <int rings, int around>
struct Disc {
  static constexpr int dimension = 3, count = rings * around;
  static constexpr Point at(int k) {
    const double inner = root(double(k / around) / rings), outer = root(double(k / around + 1) / rings);
    const double half = std::numbers::pi / around;
    const double radius = 2.0 / 3.0 * (outer * outer * outer - inner * inner * inner) /
                          (outer * outer - inner * inner) * sine(half) / half;
    // Mirrored elements get the same digits: a quarter turn of an angle between -pi and pi.
    int turn = 2 * (k % around);
    if (turn > around) turn -= 2 * around;
    const double angle = turn * half;
    return {-radius * sine(angle), radius * sine(0.5 * std::numbers::pi - angle)};
  }
};

/// Mean over the elements of the square of the distance from the first axis (spheres: from any through the centre).
template <class Layout>
constexpr double mean_square() {
  double sum = 0;
  for (int k = 0; k < Layout::count; ++k) {
    const Point p = Layout::at(k);
    sum += Layout::dimension == 2 ? p.x * p.x : 0.5 * (p.x * p.x + p.y * p.y);
  }
  return sum / Layout::count;
}

/// How far each element has slid since it came loose, in the two directions of the plane; one for discs.
template <int dimension, int k>
struct Slid : Slid<dimension, k - 1> {
  double slid_1, slid_2;
};
template <int k>
struct Slid<2, k> : Slid<2, k - 1> {
  double slid_1;
};
template <>
struct Slid<3, -1> {};
template <>
struct Slid<2, -1> {};

/// "slid_07_1"
template <int k, char direction>
struct SlidName {
  static constexpr char text[] = {'s', 'l',       'i', 'd', '_', char('0' + (k + 1) / 10), char('0' + (k + 1) % 10),
                                  '_', direction, 0};
};

}  // namespace breccia::flat_joint
