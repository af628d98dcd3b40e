// SPDX-License-Identifier: BSD-3-Clause
/// Pieces of the specimen that intact bonds hold together.
#pragma once

#include <vector>

#include "breccia/views.hpp"

namespace breccia {

struct Fragments {
  std::vector<Index> of;          ///< per particle of the view: its fragment, 0 the heaviest
  std::size_t count = 0;          ///< all, single particles included
  std::size_t with_company = 0;   ///< of more than one particle
  double largest_mass_share = 0;  ///< mass of fragment 0 over that of all particles
};

/// Union-find over the intact bonds. Fragments of equal mass are in order of their first particle in the packing. Of a
/// part, whose fragments go on in others, those of the whole specimen; all parts ask together.
Fragments find_fragments(const SimulationView& view);

}  // namespace breccia
