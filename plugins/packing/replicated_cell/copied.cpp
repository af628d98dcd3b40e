// SPDX-License-Identifier: BSD-3-Clause
#include "copied.hpp"

#include <cmath>

#include "breccia/packing_tools/fit.hpp"
#include "contacts.hpp"

namespace breccia::replicated_cell {
namespace {

/// Of radii and contacts, added in whatever order.
class Gathering {
 public:
  explicit Gathering(int dimension) : dimension_(dimension) {}
  void add(double radius) {
    count_.add(1);
    sum_.add(radius);
    solid_.add(dimension_ == 2 ? radius * radius : radius * radius * radius);
    most_[0] = std::max(most_[0], -radius);
    most_[1] = std::max(most_[1], radius);
  }
  void contact(double overlap) {
    contacts_.add(1);
    most_[2] = std::max(most_[2], overlap);
  }
  CellMeasures of(const SeenInPart& share) {
    CellMeasures m;
    double contacts = 0, sum = 0, solid = 0;
    std::tie(m.particles, contacts, sum, solid) = share.sum(count_, contacts_, sum_, solid_);
    share.max(most_);
    m.solid = solid * (dimension_ == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3);
    if (m.particles == 0) return m;
    m.contacts = contacts / m.particles;
    m.max_overlap = most_[2];
    m.radius_mean = sum / m.particles;
    m.radius_min = -most_[0];
    m.radius_max = most_[1];
    return m;
  }

 private:
  int dimension_;
  ExactSumOf<double> count_, contacts_, sum_, solid_;
  std::array<double, 3> most_{-1e300, -1e300, 0};
};

}  // namespace

Copied::Copied(const PackedParticles& cell, const Space& of_cell, const Placing& place, const PackingRequest& request)
    : cell_(cell),
      of_cell_(of_cell),
      place_(place),
      request_(request),
      period_(of_cell.cell.vectors().diagonal()),
      contacts_(cell.radius.size()) {
  const auto& x = cell.position;
  const auto& r = cell.radius;
  for_each_contact(of_cell, x, r, [&](Index i, Index j, const Vec3& branch) {
    Contact c{j, {}, 1 - branch.norm() / (r[i] + r[j])};
    const Vec3 farther = x[i] + branch - x[j];
    for (int k = 0; k < 3; ++k)
      if (of_cell.cell.repeats(k)) c.cells[std::size_t(k)] = std::lround(farther[k] / period_[k]);
    contacts_[i].push_back(c);
  });
}

template <class F>
void Copied::for_each(const Host& host, F&& f) const {
  const std::size_t n = cell_.radius.size();
  std::array<long, 3> copy{};
  std::size_t of = std::size_t(-1);
  for (const std::size_t number : request_.share_of(place_.copies.all() * n)) {
    if (of != number / n) {
      if (host.cancelled()) throw Cancelled();
      copy = place_.copies.of(of = number / n);
    }
    if (holds(number % n, copy)) f(number % n, copy);
  }
}

bool Copied::holds(std::size_t k, const std::array<long, 3>& copy) const {
  if (!place_.cut) return true;
  Container::Walls walls;
  const std::size_t n = place_.cut->walls(cell_.position[k] + shift_of(copy, period_), walls);
  return std::all_of(walls.begin(), walls.begin() + n, [](const WallDistance& w) { return w.distance >= 0; });
}

bool Copied::is_there(const Contact& contact, std::array<long, 3> copy) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const long first = place_.copies.first[k], count = place_.copies.count[k];
    long number = copy[k] - first + contact.cells[k];
    if (request_.periodic[k]) number = (number % count + count) % count;
    if (number < 0 || number >= count) return false;
    copy[k] = first + number;
  }
  return holds(contact.with, copy);
}

PackedParticles Copied::particles(const Host& host) const {
  PackedParticles all;
  for (const auto& column : cell_.columns) all.columns.push_back({column.first, {}});
  if (!place_.cut) {
    const std::size_t size = request_.share_of(place_.copies.all() * cell_.radius.size()).size();
    all.position.reserve(size);
    all.radius.reserve(size);
  }
  for_each(host, [&](std::size_t k, const std::array<long, 3>& copy) {
    append_moved(cell_, k, shift_of(copy, period_), all);
  });
  return all;
}

CellMeasures Copied::measure(const Host& host) const {
  Gathering all(request_.dimension);
  for_each(host, [&](std::size_t k, const std::array<long, 3>& copy) {
    all.add(cell_.radius[k]);
    for (const Contact& c : contacts_[k])
      if (is_there(c, copy)) all.contact(c.overlap);
  });
  CellMeasures m = all.of(request_.share);
  ExactSumOf<double> squares;
  for_each(host, [&](std::size_t k, const std::array<long, 3>&) {
    const double off = cell_.radius[k] - m.radius_mean;
    squares.add(off * off);
  });
  m.radius_deviation = std::sqrt(request_.share.sum(squares) / m.particles);
  return m;
}

CellMeasures Copied::cell_alone() const {
  Gathering all(request_.dimension);
  for (std::size_t k = 0; k < cell_.radius.size(); ++k) {
    all.add(cell_.radius[k]);
    for (const Contact& c : contacts_[k]) all.contact(c.overlap);
  }
  CellMeasures m = all.of({});
  m.radius_deviation = detail::deviation_of(cell_.radius);
  return m;
}

}  // namespace breccia::replicated_cell
