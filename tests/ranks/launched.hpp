// SPDX-License-Identifier: BSD-3-Clause
/// Runs on several ranks, as a launcher starts them.
#pragma once

#include <regex>

#include "cli/every_plugin.hpp"

namespace breccia::testing {

/// As the launcher starts it beside other work, and as root in a container.
inline std::string on(int ranks) {
  return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n " + std::to_string(ranks);
}

/// The same workflows on specimens that make several blocks of particles, with a row now and then: the first rank sees
/// the whole only there.
inline std::string larger(std::string text) {
  const std::pair<const char*, const char*> sizes[] = {
      {"size: \\[12 mm, 18 mm\\]", "size: [32 mm, 44 mm]"},
      {"diameter: 14 mm", "diameter: 40 mm"},
      {"size: \\[10 mm, 10 mm, 12 mm\\]", "size: [18 mm, 18 mm, 20 mm]"},
      {"every_steps: 40,", "every_steps: 60,"},
      {"every_steps: 7\\}", "every_steps: 20}"},
      {"renderers: [^\n]*\n", ""}};
  for (const auto& [from, to] : sizes) text = std::regex_replace(text, std::regex(from), to);
  return text;
}

/// 8 x 8 x 14 tangent spheres in sheared layers.
inline std::string many_spheres() {
  std::ostringstream csv;
  csv << "x,y,z,radius\n";
  for (int k = 0; k < 14; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i)
        csv << 2 * i + 1 + 0.2 * ((i * 7 + j * 3 + k) % 5) << ',' << 2 * j + 1 << ',' << 2 * k + 1 << ",1\n";
  return csv.str();
}

class Ranks : public SmallSpecimen {
 protected:
  void write_many_spheres() const { write("small.csv", many_spheres()); }
};

inline const std::string column =
    std::string(spheres) + brittle +
    "protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, platen_stiffness: 15 MN/m, "
    "max_strain: 0.6 %}\n";

/// Plugins of either kind: those that see parts are asked on all ranks, those that do not on the first.
inline const std::string kept =
    column +
    "postprocessors: [{type: stress}, {type: damage}, {type: energy}, {type: statistics}]\n"
    "sampling: {every_steps: 20}\ncheckpoints: {every_steps: 60, keep: 100, at_end: true}\n";

}  // namespace breccia::testing
