// SPDX-License-Identifier: BSD-3-Clause
/// Tests under a fluid's pressure: confined from all sides, then loaded along the axis while the lateral pressure is
/// held. Source: Oñate et al. (2015), section 10.1.1 (procedure, forces on the surface particles); servo and stages are
/// ours.
#pragma once

#include "breccia/protocol_tools/axial_test.hpp"

namespace breccia {

struct ConfinedConfig : AxialConfig {
  std::optional<double> confining_pressure;
  PressureArea pressure_area;
};

/// `where`: on what the pressure acts, for the documentation.
template <class Config>
void describe_confined(Schema<Config>& s, const char* where) {
  s.param("confining_pressure", &Config::confining_pressure).unit("Pa").at_least(0).example("20 MPa").doc(where);
  describe_axial(s, 0.0);
  describe_pressure_area(s, &Config::pressure_area);
  s.exactly_one_of({"confining_pressure", "stages"});
}

class ConfinedTest : public AxialTest {
 public:
  explicit ConfinedTest(const ConfinedConfig& c)
      : AxialTest(c, {confinement(c)}, std::make_unique<PressureConfinement>(c.pressure_area), std::nullopt) {}

 private:
  static Stage confinement(const ConfinedConfig& c) {
    Stage first;
    first.confining_pressure = c.confining_pressure;
    return first;
  }
};

}  // namespace breccia
