// SPDX-License-Identifier: BSD-3-Clause
#include "advancing_front.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace breccia::tangent_discs {

namespace {
constexpr double rounding = 1e-13;       // over the radius: an overlap that is none
constexpr double unpolished = 1e-9;      // of the closed form
constexpr double likely_solid = 0.86;    // for the progress shown only
constexpr std::size_t tell_every = 500;  // discs
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
}  // namespace

AdvancingFront::AdvancingFront(const Container& container, double min, double max, std::uint64_t seed, Host& host)
    : container_(container), min_(min), max_(max), random_(seed), host_(host) {
  const double w = container.size().x(), h = container.size().y();
  if (container.shape() == Container::Shape::sphere) {
    curves_.push_back({Vec2(0, 0.5 * h), -0.5 * w, false});
  } else {  // counterclockwise, so that neighbours have the inside to their left
    curves_ = {
        {Vec2(0, 1), 0, true}, {Vec2(-1, 0), -0.5 * w, true}, {Vec2(0, -1), -h, true}, {Vec2(1, 0), -0.5 * w, true}};
  }
  walls_ = curves_.size();
  low_ = Vec2(-0.5 * w, 0);
  cell_ = 2 * max;
  columns_ = std::size_t(w / cell_) + 1;
  rows_ = std::size_t(h / cell_) + 1;
  head_.assign(columns_ * rows_, none);
}

void AdvancingFront::run() {
  begin();
  do empty_queues();
  while (search_gaps());
  host_.progress("packing", 1);
}

/// A rectangle is begun in its corners, a disc with one disc anywhere at its wall.
void AdvancingFront::begin() {
  if (walls_ > 1) {
    for (Id k = 0; k < walls_; ++k) along_walls_.push({k, Id((k + 1) % walls_), 1});
    return;
  }
  const double r = random_radius(), angle = 2 * std::numbers::pi * (double(random_() >> 11) * 0x1p-53);
  const Curve& wall = curves_[0];
  const Id touched[] = {0};
  add({wall.at + (-wall.r - r) * Vec2(std::cos(angle), std::sin(angle)), r}, touched);
}

/// The walls are lined first; from there the front moves inward, the oldest pocket always next.
void AdvancingFront::empty_queues() {
  while (!along_walls_.empty() || !inside_.empty()) {
    auto& queue = along_walls_.empty() ? inside_ : along_walls_;
    const Pocket pocket = queue.front();
    queue.pop();
    fill(pocket);
  }
}

bool AdvancingFront::fill(const Pocket& pocket) {
  find_near(pocket);
  if (!fill_with_three(pocket) && !fill_with_two(pocket)) return false;
  // With radii of a large ratio there may be room for another one behind the disc.
  (std::min(pocket.a, pocket.b) < walls_ ? along_walls_ : inside_).push(pocket);
  return true;
}

/// A disc that grows in the pocket, touching both its curves, until it meets a third one: the smallest of those that
/// touch three curves and are free.
bool AdvancingFront::fill_with_three(const Pocket& pocket) {
  const Curve a = curves_[pocket.a], b = curves_[pocket.b];
  candidates_.clear();
  for (const Id c : near_) {
    Disc found[2];
    const int n = touching(a, b, curves_[c], found);
    for (int k = 0; k < n; ++k)
      if (found[k].r >= min_ && found[k].r <= max_ && side_of(a, b, found[k].x) == pocket.side)
        candidates_.push_back({found[k], c});
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& p, const Candidate& q) {
    return p.disc.r != q.disc.r ? p.disc.r < q.disc.r : p.third < q.third;
  });
  for (const Candidate& candidate : candidates_) {
    const Id touched[] = {pocket.a, pocket.b, candidate.third};
    Disc disc = candidate.disc;
    if (!is_free(disc, touched, unpolished)) continue;
    const Curve three[] = {a, b, curves_[candidate.third]};
    polish(three, disc);
    if (!(disc.r >= min_ && disc.r <= max_) || !is_free(disc, touched, rounding)) continue;
    add(disc, touched);
    return true;
  }
  return false;
}

/// No disc of the radii allowed meets a third curve: any of them fits, or none.
bool AdvancingFront::fill_with_two(const Pocket& pocket) {
  const Curve two[] = {curves_[pocket.a], curves_[pocket.b]};
  Disc disc;
  if (!touching(two[0], two[1], pocket.side, random_radius(), disc)) return false;
  const Id touched[] = {pocket.a, pocket.b};
  if (!is_free(disc, touched, unpolished)) return false;
  polish(two, disc);
  if (!is_free(disc, touched, rounding)) return false;
  add(disc, touched);
  return true;
}

/// A disc in the pocket is no farther from a curve than its diameter, so neither is what it could overlap.
void AdvancingFront::find_near(const Pocket& pocket) {
  const Curve a = curves_[pocket.a], b = curves_[pocket.b];
  near_.clear();
  for (Id k = 0; k < walls_; ++k)
    if (k != pocket.a && k != pocket.b) near_.push_back(k);
  Disc corner;
  Vec2 middle = pocket.a < walls_ ? b.at : a.at;
  double reach = (pocket.a < walls_ ? b.r : a.r) + 3 * max_;
  if (std::max(pocket.a, pocket.b) < walls_) {
    if (!touching(a, b, 1, max_, corner)) return;
    middle = corner.x;  // centres of all discs in the corner are within 2 max of it
    reach = 4 * max_;
  }
  for_each_near(middle, reach, [&](Id c) {
    if (c == pocket.a || c == pocket.b) return;
    const Curve& o = curves_[c];
    const double limit = o.r + 2 * max_;
    if (a.distance(o.at) <= limit && b.distance(o.at) <= limit) near_.push_back(c);
  });
}

/// What was in the way moves to the front of the list: it is likely to be in the way again.
bool AdvancingFront::is_free(const Disc& disc, std::span<const Id> touched, double slack) {
  for (Id& other : near_) {
    if (curves_[other].distance(disc.x) >= disc.r * (1 - slack)) continue;
    if (std::find(touched.begin(), touched.end(), other) != touched.end()) continue;
    std::swap(other, near_.front());
    return false;
  }
  return true;
}

void AdvancingFront::add(const Disc& disc, std::span<const Id> touched) {
  const Id me = Id(curves_.size());
  for (const Id other : touched) {
    auto& queue = other < walls_ ? along_walls_ : inside_;
    queue.push({other, me, 1});
    queue.push({other, me, -1});
    if (other < walls_) ++at_walls_;
    else touches_.push_back({Index(other - walls_), Index(discs_.size())});
  }
  curves_.push_back({disc.x, disc.r, false});
  discs_.push_back(disc);
  const std::size_t cell = cell_of(disc.x);
  next_.push_back(head_[cell]);
  head_[cell] = me;
  solid_ += disc.r * disc.r;
  if (discs_.size() % tell_every == 0) tell();
}

/// Pockets beside curves that do not touch are found last. A free place for the smallest disc can be moved until the
/// disc touches two curves, and those are then less than its diameter apart: when none of these is free, there is none.
bool AdvancingFront::search_gaps() {
  const std::size_t before = discs_.size();
  std::vector<Id> partners;
  for (Id i = Id(walls_); i < walls_ + before; ++i) {
    if (i % 1024 == 0 && host_.cancelled()) throw Cancelled();
    const Curve me = curves_[i];
    partners.clear();
    const auto near = [&](Id j) { return curves_[j].distance(me.at) - me.r < 2 * min_; };
    for (Id k = 0; k < walls_; ++k)
      if (near(k)) partners.push_back(k);
    for_each_near(me.at, me.r + max_ + 2 * min_, [&](Id j) {
      if (j < i && near(j)) partners.push_back(j);
    });
    for (const Id j : partners)
      for (const int side : {1, -1})
        if (fill({j, i, side})) empty_queues();
  }
  return discs_.size() > before;
}

/// Uniform between the limits, the same on every platform, unlike std::uniform_real_distribution.
double AdvancingFront::random_radius() { return min_ + (max_ - min_) * (double(random_() >> 11) * 0x1p-53); }

std::size_t AdvancingFront::cell_of(const Vec2& x) const {
  const Vec2 at = (x - low_) / cell_;
  return std::min(std::size_t(at.y()), rows_ - 1) * columns_ + std::min(std::size_t(at.x()), columns_ - 1);
}

/// Calls f for all discs with their centres within reach of x, and for some beyond.
template <class F>
void AdvancingFront::for_each_near(const Vec2& x, double reach, F&& f) const {
  const auto cell = [&](double at, std::size_t count) {
    return std::size_t(std::clamp(std::floor(at / cell_), 0.0, double(count - 1)));
  };
  const Vec2 at = x - low_;
  const std::size_t first = cell(at.x() - reach, columns_), last = cell(at.x() + reach, columns_);
  const std::size_t top = cell(at.y() + reach, rows_);
  for (std::size_t row = cell(at.y() - reach, rows_); row <= top; ++row)
    for (std::size_t column = first; column <= last; ++column)
      for (Id m = head_[row * columns_ + column]; m != none; m = next_[m - walls_]) f(m);
}

void AdvancingFront::tell() {
  if (host_.cancelled()) throw Cancelled();
  host_.progress("packing", std::min(1.0, solid_ * std::numbers::pi / (likely_solid * container_.measure())));
}

}  // namespace breccia::tangent_discs
