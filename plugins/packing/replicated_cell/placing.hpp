// SPDX-License-Identifier: BSD-3-Clause
/// Which copies of a cell a specimen is made of.
#pragma once

#include <optional>

#include "../../shared/copies.hpp"
#include "breccia/packing_tools/container.hpp"

namespace breccia::replicated_cell {

/// So many along each direction.
struct Counts {
  long x = 1, y = 1, z = 1;
  static void describe(Schema<Counts>& s);
};

struct Extent {
  Vec3 low, high;  ///< of the cell's centres [m]
  double radius;   ///< largest [m]
};

struct Placing {
  CopyNumbers copies;
  Vec3 size = Vec3::Zero();       ///< of the block where the cell repeats itself, else as far as its spheres reach [m]
  std::optional<double> measure;  ///< of what is filled [m3], [m2]; unknown where the cell says nothing of its size
  std::optional<Container> cut;   ///< out of the block; open where the specimen repeats itself
  double copies_in_all() const;
};

/// UserError, with `file` in it, for copies along a direction in which the cell does not repeat itself.
Placing place_block(const Counts& counts, const Vec3& period, const Extent& cell, const PackingRequest& request,
                    const std::string& file);
/// As many as it takes to cut this out.
Placing place_cut(const ContainerConfig& cut, const Vec3& period, const Extent& cell, const PackingRequest& request,
                  const std::string& file);

}  // namespace breccia::replicated_cell
