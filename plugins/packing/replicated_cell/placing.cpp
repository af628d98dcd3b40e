// SPDX-License-Identifier: BSD-3-Clause
#include "placing.hpp"

#include <cmath>

namespace breccia::replicated_cell {
namespace {

[[noreturn]] void no_period(const std::string& file, int k, const char* why) {
  throw UserError(file + " does not say after which length it repeats itself along " + "xyz"[k] + ", and " + why +
                  ": give `period`");
}

double size_along(int k, long count, const Vec3& period, const Extent& cell) {
  return period[k] > 0 ? double(count) * period[k] : cell.high[k] - cell.low[k] + 2 * cell.radius;
}

}  // namespace

void Counts::describe(Schema<Counts>& s) {
  // More than that is never meant, and their product is still a number.
  constexpr long most = 1000000;
  s.param("x", &Counts::x).at_least(1).at_most(most).fallback(1).doc("along x");
  s.param("y", &Counts::y).at_least(1).at_most(most).fallback(1).doc("along y");
  s.param("z", &Counts::z).at_least(1).at_most(most).fallback(1).doc("along z, in three dimensions");
}

double Placing::copies_in_all() const {
  return double(copies.count[0]) * double(copies.count[1]) * double(copies.count[2]);
}

Placing place_block(const Counts& counts, const Vec3& period, const Extent& cell, const PackingRequest& request,
                    const std::string& file) {
  Placing p;
  p.copies.count = {counts.x, counts.y, counts.z};
  double measure = 1;
  for (int k = 0; k < request.dimension; ++k) {
    const long count = p.copies.count[std::size_t(k)];
    if (!(period[k] > 0)) {
      if (request.periodic[std::size_t(k)]) no_period(file, k, "the specimen is to repeat itself there (`periodic`)");
      if (count > 1) no_period(file, k, "there are to be several copies");
    }
    p.size[k] = size_along(k, count, period, cell);
    measure *= double(count) * period[k];
  }
  if (measure > 0) p.measure = measure;
  return p;
}

Placing place_cut(const ContainerConfig& cut, const Vec3& period, const Extent& cell, const PackingRequest& request,
                  const std::string& file) {
  Placing p;
  const Container whole = cut.make(request.dimension);
  p.cut = request.repeats() ? whole.opened(request.periodic) : whole;
  double measure = whole.measure();
  for (int k = 0; k < request.dimension; ++k) {
    const double low = whole.low()[k] - cell.low[k], size = whole.size()[k], length = period[k];
    long &first = p.copies.first[std::size_t(k)], &count = p.copies.count[std::size_t(k)];
    if (request.periodic[std::size_t(k)]) {
      if (!(length > 0)) no_period(file, k, "the specimen is to repeat itself there (`periodic`)");
      first = std::lround(low / length);
      count = std::max(1L, std::lround(size / length));
      measure *= double(count) * length / size;
    } else if (length > 0) {
      const double most = 1e9;  // beyond that it is refused anyway
      if (!(std::abs(low) / length < most) || !(size / length < most))
        throw UserError("more copies of " + file + " are asked for than can be counted: look at the units of `cut`");
      first = long(std::floor(low / length));
      count = long(std::floor((low + size) / length)) - first + 1;
    } else if (const double reach = 2 * cell.radius; low < -reach || low + size > cell.high[k] - cell.low[k] + reach) {
      no_period(file, k, "is shorter there than what is to be cut out");
    }
    p.size[k] = size_along(k, count, period, cell);
  }
  p.measure = measure;
  return p;
}

}  // namespace breccia::replicated_cell
