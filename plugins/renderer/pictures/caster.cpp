// SPDX-License-Identifier: BSD-3-Clause
#include "caster.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "breccia/cell_grid.hpp"
#include "breccia/error.hpp"

namespace breccia::pictures {
namespace {

constexpr int fine = rays_per_side;
constexpr int band_rows = 16;  // of pixels: what is drawn at a time stays in the cache
constexpr float far_away = -std::numeric_limits<float>::infinity();
// Light from the upper left with a fill from the right, seen by the reader: shapes are seen, colours stay readable.
const Eigen::Vector3f key = Eigen::Vector3f(-0.7f, 0.9f, 1.2f).normalized(),
                      fill = Eigen::Vector3f(0.9f, 0.1f, 0.8f).normalized();
constexpr float key_strength = 0.8f, fill_strength = 0.35f;
constexpr float sphere_ambient = 0.28f, sphere_diffuse = 0.78f, patch_ambient = 0.55f, patch_diffuse = 0.5f;
constexpr float deepest_shadow = 0.85f;  // even a hidden corner keeps some of its colour

/// All lengths in rays: `fine` to a pixel, upwards from the lower edge.
struct Ball {
  float x, y, z, radius;
};
struct Flat {
  float x, y, z;                 // centre
  float ux, uy, vx, vy, az, bz;  // u = ux dx + uy dy, v = vx dx + vy dy, depth = z + u az + v bz
  float low_x, high_x, low_y, high_y;
  float shade;  // 1: its own colour
  bool round, behind;
};

float diffuse(const Eigen::Vector3f& normal) {
  return key_strength * std::max(0.0f, normal.dot(key)) + fill_strength * std::max(0.0f, normal.dot(fill));
}

class Caster {
 public:
  Caster(const Scene& scene, const Projection& projection, Image& image, const Vec3& background)
      : scene_(scene), image_(image) {
    for (int c = 0; c < 3; ++c) background_[c] = float(255 * background[c]);
    bands_.resize(std::size_t((image.height + band_rows - 1) / band_rows));
    for (const Sphere& s : scene.spheres) {
      const Vec3 at = fine * projection.seen(s.centre);
      balls_.push_back(
          {float(at.x()), float(at.y()), float(at.z()), float(fine * projection.pixels_per_metre * s.radius)});
      file(balls_.size() - 1, at.y() - balls_.back().radius, at.y() + balls_.back().radius);
    }
    for (const Patch& p : scene.patches) {
      flats_.push_back(flat_of(p, projection));
      file(balls_.size() + flats_.size() - 1, flats_.back().low_y, flats_.back().high_y);
    }
    if (scene.occlusion) find_neighbours();
  }

  void run(int threads) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      std::vector<float> depth;
      std::vector<std::int32_t> hit;
      for (std::size_t b; (b = next++) < bands_.size();) draw_band(b, depth, hit);
    };
    std::vector<std::thread> others;
    for (int t = 1; t < std::min(threads, int(bands_.size())); ++t) others.emplace_back(work);
    work();
    for (std::thread& t : others) t.join();
  }

 private:
  /// Bands count from the lower edge.
  void file(std::size_t index, double low, double high) {
    const double band = double(fine) * band_rows, last = double(bands_.size()) - 1;
    if (!(high >= 0) || !(low <= (last + 1) * band)) return;
    const auto from = std::size_t(std::clamp(std::floor(low / band), 0.0, last));
    const auto to = std::size_t(std::clamp(std::floor(high / band), 0.0, last));
    for (std::size_t b = from; b <= to; ++b) bands_[b].push_back(std::int32_t(index));
  }

  static Flat flat_of(const Patch& p, const Projection& projection) {
    const double scale = fine * projection.pixels_per_metre;
    const auto turned = [&](const Vec3& x) {
      return Vec3(scale * projection.right.dot(x), scale * projection.up.dot(x), scale * projection.toward.dot(x));
    };
    const Vec3 at = fine * projection.seen(p.centre), a = turned(p.a), b = turned(p.b);
    const double area = a.x() * b.y() - a.y() * b.x();
    Flat f{};
    f.x = float(at.x());
    f.y = float(at.y());
    f.z = float(at.z());
    f.round = p.round;
    f.behind = p.behind;
    f.shade = 1;
    f.low_y = 1;  // seen from its edge it has no area: nothing of it is drawn
    f.high_y = -1;
    if (!(std::abs(area) > 1e-9 * a.norm() * b.norm())) return f;
    f.ux = float(b.y() / area);
    f.uy = float(-b.x() / area);
    f.vx = float(-a.y() / area);
    f.vy = float(a.x() / area);
    f.az = float(a.z());
    f.bz = float(b.z());
    const Vec3 reach = p.round ? Vec3((a.cwiseAbs2() + b.cwiseAbs2()).cwiseSqrt()) : Vec3(a.cwiseAbs() + b.cwiseAbs());
    f.low_x = float(at.x() - reach.x());
    f.high_x = float(at.x() + reach.x());
    f.low_y = float(at.y() - reach.y());
    f.high_y = float(at.y() + reach.y());
    if (p.lit) {
      Vec3 normal = a.cross(b).normalized();
      if (normal.z() < 0) normal = -normal;  // both sides are lit
      f.shade = patch_ambient + patch_diffuse * diffuse(normal.cast<float>());
    }
    return f;
  }

  /// Spheres that can keep light from each other: not much farther apart than a mean radius.
  void find_neighbours() {
    const std::size_t n = balls_.size();
    if (n == 0) return;
    std::vector<Vec3> centre;
    double mean = 0, most = 0;
    for (const Ball& b : balls_) {
      centre.emplace_back(b.x, b.y, b.z);
      mean += b.radius / double(n);
      most = std::max(most, double(b.radius));
    }
    if (!(mean > 0)) return;
    const double gap = 1.5 * mean;
    std::vector<std::pair<Index, Index>> pairs;
    // A few giants among many grains must not make everyone a neighbour of all.
    CellGrid(centre, std::min(2 * most, 6 * mean) + gap).for_each_pair([&](Index i, Index j) {
      if ((centre[i] - centre[j]).norm() < balls_[i].radius + balls_[j].radius + gap) pairs.emplace_back(i, j);
    });
    first_.assign(n + 1, 0);
    for (const auto& [i, j] : pairs) ++first_[i + 1], ++first_[j + 1];
    for (std::size_t k = 0; k < n; ++k) first_[k + 1] += first_[k];
    neighbour_.resize(first_[n]);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const auto& [i, j] : pairs) {
      neighbour_[next[i]++] = balls_[j];
      neighbour_[next[j]++] = balls_[i];
    }
  }

  void draw_band(std::size_t band, std::vector<float>& depth, std::vector<std::int32_t>& hit) const {
    const int first_row = int(band) * band_rows, rows = std::min(band_rows, image_.height - first_row);
    const int across = image_.width * fine, down = rows * fine, low = first_row * fine;
    depth.assign(std::size_t(across) * std::size_t(down), far_away);
    hit.assign(depth.size(), -1);
    for (const std::int32_t index : bands_[band]) {
      const bool is_ball = std::size_t(index) < balls_.size();
      const Flat* flat = is_ball ? nullptr : &flats_[std::size_t(index) - balls_.size()];
      const Ball* ball = is_ball ? &balls_[std::size_t(index)] : nullptr;
      const float low_y = is_ball ? ball->y - ball->radius : flat->low_y,
                  high_y = is_ball ? ball->y + ball->radius : flat->high_y;
      // Ray k passes through k + 1/2.
      const int from = int(std::clamp(std::ceil(low_y - 0.5f), float(low), float(low + down))),
                to = int(std::clamp(std::floor(high_y - 0.5f), float(low - 1), float(low + down - 1)));
      for (int y = from; y <= to; ++y) {
        const std::size_t row = std::size_t(y - low) * std::size_t(across);
        if (is_ball) ball_row(*ball, float(y) + 0.5f, index, across, &depth[row], &hit[row]);
        else flat_row(*flat, float(y) + 0.5f, index, across, &depth[row], &hit[row]);
      }
    }
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < image_.width; ++x) shade(x, y, low, hit, first_row);
  }

  static void ball_row(const Ball& b, float y, std::int32_t index, int across, float* depth, std::int32_t* hit) {
    const float dy = y - b.y, square = b.radius * b.radius - dy * dy;
    if (!(square >= 0)) return;
    const float half = std::sqrt(square);
    const int from = int(std::clamp(std::ceil(b.x - half - 0.5f), 0.0f, float(across))),
              to = int(std::clamp(std::floor(b.x + half - 0.5f), -1.0f, float(across - 1)));
    for (int x = from; x <= to; ++x) {
      const float dx = float(x) + 0.5f - b.x, z = b.z + std::sqrt(std::max(square - dx * dx, 0.0f));
      const bool nearer = z > depth[x];
      depth[x] = nearer ? z : depth[x];
      hit[x] = nearer ? index : hit[x];
    }
  }

  static void flat_row(const Flat& f, float y, std::int32_t index, int across, float* depth, std::int32_t* hit) {
    const int from = int(std::clamp(std::ceil(f.low_x - 0.5f), 0.0f, float(across))),
              to = int(std::clamp(std::floor(f.high_x - 0.5f), -1.0f, float(across - 1)));
    const float dy = y - f.y;
    for (int x = from; x <= to; ++x) {
      const float dx = float(x) + 0.5f - f.x, u = f.ux * dx + f.uy * dy, v = f.vx * dx + f.vy * dy;
      const bool inside = f.round ? u * u + v * v <= 1 : std::abs(u) <= 1 && std::abs(v) <= 1;
      const float z = f.behind ? std::numeric_limits<float>::lowest() : f.z + u * f.az + v * f.bz;
      const bool nearer = inside && z > depth[x];
      depth[x] = nearer ? z : depth[x];
      hit[x] = nearer ? index : hit[x];
    }
  }

  /// The mean over a pixel's rays. What several of them hit is lit once, at the middle of where they hit it.
  void shade(int x, int y, int low, const std::vector<std::int32_t>& hit, int first_row) const {
    constexpr int rays = fine * fine;
    const std::size_t across = std::size_t(image_.width) * fine;
    std::int32_t seen[rays];
    float sum_x[rays], sum_y[rays];
    int count[rays], kinds = 0;
    for (int j = 0; j < fine; ++j)
      for (int i = 0; i < fine; ++i) {
        const std::int32_t index = hit[std::size_t(y * fine + j) * across + std::size_t(x * fine + i)];
        int k = 0;
        while (k < kinds && seen[k] != index) ++k;
        if (k == kinds) {
          seen[k] = index;
          sum_x[k] = sum_y[k] = 0;
          count[k] = 0;
          ++kinds;
        }
        sum_x[k] += float(x * fine + i) + 0.5f;
        sum_y[k] += float(low + y * fine + j) + 0.5f;
        ++count[k];
      }
    float total[3] = {0, 0, 0};
    for (int k = 0; k < kinds; ++k) {
      const float n = float(count[k]);
      if (seen[k] < 0) {
        for (int c = 0; c < 3; ++c) total[c] += n * background_[c];
        continue;
      }
      const bool is_ball = std::size_t(seen[k]) < balls_.size();
      const std::size_t flat = std::size_t(seen[k]) - balls_.size();
      const Rgb& colour = is_ball ? scene_.spheres[std::size_t(seen[k])].colour : scene_.patches[flat].colour;
      const float light = is_ball ? light_on(std::size_t(seen[k]), sum_x[k] / n, sum_y[k] / n) : flats_[flat].shade;
      for (int c = 0; c < 3; ++c) total[c] += n * std::min(255.0f, light * float(colour[std::size_t(c)]));
    }
    const std::size_t row = std::size_t(image_.height - 1 - first_row - y);
    unsigned char* to = &image_.rgb[3 * (row * std::size_t(image_.width) + std::size_t(x))];
    for (int c = 0; c < 3; ++c) to[c] = static_cast<unsigned char>(total[c] / rays + 0.5f);
  }

  float light_on(std::size_t index, float x, float y) const {
    const Ball& b = balls_[index];
    const float dx = (x - b.x) / b.radius, dy = (y - b.y) / b.radius;
    const Eigen::Vector3f normal(dx, dy, std::sqrt(std::max(1 - dx * dx - dy * dy, 0.0f)));
    const float light = sphere_ambient + sphere_diffuse * diffuse(normal);
    if (neighbour_.empty()) return light;
    const Eigen::Vector3f at = Eigen::Vector3f(b.x, b.y, b.z) + b.radius * normal;
    float open = 1;
    for (std::size_t k = first_[index]; k < first_[index + 1]; ++k) {
      const Ball& other = neighbour_[k];
      const Eigen::Vector3f way = Eigen::Vector3f(other.x, other.y, other.z) - at;
      const float over = way.dot(normal);
      if (over <= -other.radius) continue;
      const float distance = way.norm();
      open *= 1 - shadow_of_sphere(std::max(1.0f, distance / other.radius), over / std::max(distance, 1e-6f));
    }
    return light * (1 - deepest_shadow * (1 - open));
  }

  const Scene& scene_;
  Image& image_;
  float background_[3];
  std::vector<Ball> balls_;
  std::vector<Flat> flats_;
  std::vector<std::vector<std::int32_t>> bands_;  // what each may show, in order: spheres, then patches
  std::vector<std::size_t> first_;                // of each sphere's neighbours
  std::vector<Ball> neighbour_;
};

}  // namespace

Image cast(const Scene& scene, const Projection& projection, int width, int height, const Vec3& background,
           int threads) {
  BRECCIA_ASSERT(width > 0 && height > 0 && projection.pixels_per_metre > 0);
  Image image{width, height, std::vector<unsigned char>(3 * std::size_t(width) * std::size_t(height))};
  Caster(scene, projection, image, background).run(threads);
  if (scene.opacity >= 1 || scene.spheres.empty()) return image;
  // The foremost spheres as one pane of glass: what is behind them all shows the same, however many lie in the way.
  Scene behind;
  behind.patches = scene.patches;
  const Image through = cast(behind, projection, width, height, background, threads);
  for (std::size_t k = 0; k < image.rgb.size(); ++k)
    image.rgb[k] =
        static_cast<unsigned char>(scene.opacity * image.rgb[k] + (1 - scene.opacity) * through.rgb[k] + 0.5);
  return image;
}

}  // namespace breccia::pictures
