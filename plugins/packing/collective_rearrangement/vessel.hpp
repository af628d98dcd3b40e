// SPDX-License-Identifier: BSD-3-Clause
/// A vessel that is packed instead of the container, which is then cut out of its middle: the material of Potyondy &
/// Cundall (2004), whose round specimens are as wide as the box they come from.
#pragma once

#include "breccia/packing_tools/container.hpp"

namespace breccia::collective_rearrangement {

inline Container vessel_box(const std::vector<double>& size, int dimension) {
  ContainerConfig c;
  c.shape = Container::Shape::box;
  c.size = size;
  return c.make(dimension);
}

/// Where in the vessel, in its coordinates, the origin of the container comes to lie: middle on middle.
inline Vec3 place_in(const Container& vessel, const Container& container) {
  return (vessel.low() + 0.5 * vessel.size()) - (container.low() + 0.5 * container.size());
}

/// Why this container cannot be cut out of a vessel of this size; empty when it can.
inline std::string why_not_out_of(const std::vector<double>& size, const Container& container) {
  constexpr double slack = 1 + 1e-9;  // sizes in other units are not equal to the last bit
  const int dimension = container.dimension();
  if (int(size.size()) < dimension) return "in three dimensions `vessel` needs three entries: [x, y, z]";
  for (int k = 0; k < dimension; ++k)
    if (container.size()[k] > slack * size[std::size_t(k)])
      return std::string("`vessel` is narrower along ") + "xyz"[k] +
             " than the container, which is to be cut out of it: make it as wide at the least";
  return {};
}

}  // namespace breccia::collective_rearrangement
