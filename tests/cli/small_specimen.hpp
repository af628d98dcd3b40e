// SPDX-License-Identifier: BSD-3-Clause
/// A specimen that runs in a blink.
#pragma once

#include "program.hpp"

namespace breccia::testing {

class SmallSpecimen : public Program {
 protected:
  /// 4 x 4 x 8 tangent spheres in sheared layers, as `small.csv`.
  void write_spheres() const {
    std::ostringstream csv;
    csv << "x,y,z,radius\n";
    for (int k = 0; k < 8; ++k)
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          csv << 2 * i + 1 + 0.2 * ((i * 7 + j * 3 + k) % 5) << ',' << 2 * j + 1 << ',' << 2 * k + 1 << ",1\n";
    write("small.csv", csv.str());
  }
  /// With the workflow `small.yaml`.
  void write_small() const {
    write_spheres();
    write("small.yaml", small);
  }
  Json summary(const std::string& run) const { return Json::parse(content(folder_ / run / "summary.json")); }

  static constexpr const char* small = R"(packing: {type: from_file, file: small.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
damping: {translational: 0.7, rotational: 0.7}
protocol: {type: uniaxial_compression, platen_velocity: 0.2 m/s, platen_stiffness: 15 MN/m, max_strain: 0.5 %}
sampling: {every_steps: 5}
postprocessors: [{type: stress}, {type: bagi_strain}, {type: elastic_constants}, {type: damage}, {type: bond_statistics}, {type: fabric}, {type: energy}]
)";
};

}  // namespace breccia::testing
