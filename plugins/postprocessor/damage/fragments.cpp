// SPDX-License-Identifier: BSD-3-Clause
#include "fragments.hpp"

#include <algorithm>
#include <unordered_map>

#include "breccia/result_tools/connected.hpp"

namespace breccia {

Fragments find_fragments(const SimulationView& view) {
  const Bodies bodies = find_bodies(view);
  std::vector<Body> all = view.all(bodies.here);
  all.insert(all.end(), bodies.shared.begin(), bodies.shared.end());
  std::sort(all.begin(), all.end(),
            [](const Body& a, const Body& b) { return a.mass != b.mass ? a.mass > b.mass : a.first < b.first; });
  Fragments f;
  f.count = all.size();
  std::unordered_map<Index, Index> rank;
  std::int64_t of_all = 0;
  for (const Body& b : all) {
    rank[b.first] = Index(rank.size());
    f.with_company += b.size > 1;
    of_all += b.mass;
  }
  f.of.reserve(bodies.of.size());
  for (const Index first : bodies.of) f.of.push_back(rank[first]);
  if (of_all > 0) f.largest_mass_share = double(all[0].mass) / double(of_all);
  return f;
}

}  // namespace breccia
