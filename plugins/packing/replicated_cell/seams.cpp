// SPDX-License-Identifier: BSD-3-Clause
#include "seams.hpp"

#include <cmath>
#include <cstdio>

#include "contacts.hpp"

namespace breccia::replicated_cell {
namespace {

/// Across one direction.
struct Plane {
  double cut = 0;                               ///< contacts that a plane cuts on average, twice
  double weight = 0, overlap = 0, squares = 0;  ///< of those within the cell
  double contacts = 0, its_overlap = 0;         ///< of those across the boundary

  std::string fault(char direction, std::size_t particles) const {
    char text[400] = "";
    // Seen by chance no more often than once in 50 000 packings.
    constexpr double enough = 20, least_share = 0.25;
    if (0.5 * cut >= enough && contacts < least_share * cut) {
      std::snprintf(
          text, sizeof text,
          "it does not repeat itself along %c: its boundary there cuts %.0f contacts, a plane elsewhere %.0f. "
          "Was it packed between walls, or is the period too long?",
          direction, 0.5 * contacts, 0.5 * cut);
      return text;
    }
    if (contacts == 0 || (weight == 0 && particles == 1)) return text;  // it has nothing within to compare with
    const double mean = weight > 0 ? overlap / weight : 0, got = its_overlap / contacts;
    const double deviation = weight > 0 ? std::sqrt(std::max(0.0, squares / weight - mean * mean)) : 0;
    constexpr double errors = 5, slack = 1e-3;
    if (got > mean + errors * deviation / std::sqrt(0.5 * contacts) + slack)
      std::snprintf(text, sizeof text,
                    "it does not repeat itself along %c: contacts across its boundary there overlap by %.3g %% of the "
                    "sum of the radii on average, those within by %.3g %%. Is the period too short?",
                    direction, 100 * got, 100 * mean);
    return text;
  }
};

}  // namespace

std::string fault_at_seams(const PackedParticles& cell, const Space& space, const std::array<bool, 3>& used) {
  Plane planes[3];
  const auto& x = cell.position;
  for_each_contact(space, x, cell.radius, [&](Index i, Index j, const Vec3& branch) {
    const Vec3 cells = space.cell.cells(x[i] + branch - x[j]);
    const double overlap = 1 - branch.norm() / (cell.radius[i] + cell.radius[j]);
    for (int k = 0; k < 3; ++k) {
      if (!used[std::size_t(k)]) continue;
      Plane& p = planes[k];
      const double weight = std::abs(branch[k]) / space.cell.width(k);
      p.cut += weight;
      if (cells[k] != 0) {
        p.contacts += 1;
        p.its_overlap += overlap;
      } else {
        p.weight += weight;
        p.overlap += weight * overlap;
        p.squares += weight * overlap * overlap;
      }
    }
  });
  for (int k = 0; k < 3; ++k)
    if (used[std::size_t(k)])
      if (const std::string fault = planes[k].fault("xyz"[k], x.size()); !fault.empty()) return fault;
  return {};
}

}  // namespace breccia::replicated_cell
