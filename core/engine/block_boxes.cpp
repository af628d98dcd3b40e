// SPDX-License-Identifier: BSD-3-Clause
// Which own particles other parts may meet: boxes around blocks of particles say it without a look at every pair.
#include <algorithm>

#include "engine/chunks.hpp"
#include "engine/parts.hpp"

namespace breccia {
namespace {

constexpr double hair = 1 + 1e-9;  // rounding loses none

BlockBox empty_box() { return {Vec3::Constant(1e300), Vec3::Constant(-1e300), 0}; }

void add(BlockBox& to, const BlockBox& b) {
  to.low = to.low.cwiseMin(b.low);
  to.high = to.high.cwiseMax(b.high);
  to.radius = std::max(to.radius, b.radius);
}

bool overlap(const BlockBox& a, const BlockBox& b, double reach) {
  return ((a.low - b.high).array() <= reach).all() && ((b.low - a.high).array() <= reach).all();
}

double distance(const Vec3& x, const BlockBox& box) {
  return (box.low - x).cwiseMax(x - box.high).cwiseMax(Vec3::Zero()).norm();
}

/// The ways by which images of `b` may come near `a`; `everywhere` when they are so wide that any may.
std::vector<Vec3> shifts(const Cell& cell, const BlockBox& a, const BlockBox& b, double reach, bool& everywhere) {
  std::vector<Vec3> all;
  const Mat3 size = cell.inverse().cwiseAbs();
  const Vec3 extent = size * (0.5 * (a.high - a.low) + 0.5 * (b.high - b.low) + Vec3::Constant(reach));
  const Vec3 nearest = cell.cells(0.5 * (b.low + b.high) - 0.5 * (a.low + a.high));
  everywhere = (extent.array() > 0.99).any();
  int most[3];
  for (int k = 0; k < 3; ++k) most[k] = cell.repeats(k) ? 1 : 0;
  for (int x = -most[0]; x <= most[0]; ++x)
    for (int y = -most[1]; y <= most[1]; ++y)
      for (int z = -most[2]; z <= most[2]; ++z) all.push_back(-cell.vectors() * (nearest + Vec3(x, y, z)));
  return all;
}

}  // namespace

std::vector<BlockBox> boxes_of_blocks(const Particles& p) {
  std::vector<BlockBox> boxes;
  for (std::size_t first = p.first_own(); first < p.end_own(); first += particle_block) {
    BlockBox& box = boxes.emplace_back(empty_box());
    for (std::size_t a = first; a < std::min(p.end_own(), first + particle_block); ++a)
      add(box, {p.position()[a], p.position()[a], p.radius()[a]});
  }
  return boxes;
}

void mark_near(const State& s, std::span<const BlockBox> own, std::span<const BlockBox> others, double skin,
               std::vector<std::uint8_t>& near) {
  constexpr std::size_t some = 32;  // blocks that are looked at together first
  const Particles& p = s.particles;
  const bool repeats = s.cell.repeats();
  std::vector<BlockBox> groups;
  for (std::size_t b = 0; b < own.size(); ++b) {
    if (b % some == 0) groups.push_back(empty_box());
    add(groups.back(), own[b]);
  }
  BlockBox whole = empty_box();
  for (const BlockBox& b : own) add(whole, b);
  for (const BlockBox& other : others) {
    if (!repeats && !overlap(whole, other, hair * (whole.radius + other.radius + skin))) continue;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      bool everywhere = false;
      const auto ways = [&](const BlockBox& box) {
        const double reach = hair * (box.radius + other.radius + skin);
        if (!repeats) return std::vector<Vec3>{Vec3::Zero()};
        return shifts(s.cell, box, other, reach, everywhere);
      };
      const auto moved = [&](const Vec3& way) { return BlockBox{other.low + way, other.high + way, other.radius}; };
      const auto met = [&](const BlockBox& box, const Vec3& way) {
        return overlap(box, moved(way), hair * (box.radius + other.radius + skin));
      };
      const auto all = ways(groups[g]);
      if (!everywhere && std::none_of(all.begin(), all.end(), [&](const Vec3& w) { return met(groups[g], w); }))
        continue;
      for (std::size_t b = g * some; b < std::min(own.size(), (g + 1) * some); ++b) {
        const std::size_t first = b * particle_block, end = std::min(near.size(), first + particle_block);
        const auto these = ways(own[b]);
        if (everywhere) std::fill(near.begin() + std::ptrdiff_t(first), near.begin() + std::ptrdiff_t(end), 1);
        else
          for (const Vec3& way : these) {
            if (!met(own[b], way)) continue;
            for (std::size_t k = first; k < end; ++k) {
              const std::size_t a = p.first_own() + k;
              near[k] |= distance(p.position()[a], moved(way)) <= hair * (p.radius()[a] + other.radius + skin);
            }
          }
      }
    }
  }
}

}  // namespace breccia
