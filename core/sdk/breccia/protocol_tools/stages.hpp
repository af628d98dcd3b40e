// SPDX-License-Identifier: BSD-3-Clause
/// A test as a list of stages, each with one target.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "breccia/schema.hpp"

namespace breccia {

struct Stage {
  std::optional<double> confining_pressure, axial_strain, axial_stress, deviatoric_stress, hold_time, velocity;

  static void describe(Schema<Stage>& s) {
    s.param("confining_pressure", &Stage::confining_pressure)
        .unit("Pa")
        .at_least(0)
        .doc("leads lateral pressure and platen stress to this value, and waits until both are held");
    s.param("axial_strain", &Stage::axial_strain)
        .above(-1)
        .below(1)
        .doc("moves the platens to this platen strain, either way");
    s.param("axial_stress", &Stage::axial_stress)
        .unit("Pa")
        .doc("moves the platens until the platen stress is this, either way");
    s.param("deviatoric_stress", &Stage::deviatoric_stress)
        .unit("Pa")
        .doc("moves the platens until platen stress minus confining pressure is this, either way");
    s.param("hold_time", &Stage::hold_time)
        .unit("s")
        .above(0)
        .doc("lets the platens stand for this time, all else held");
    s.param("velocity", &Stage::velocity)
        .unit("m/s")
        .above(0)
        .doc("of a moving platen in this stage, instead of platen_velocity");
    s.exactly_one_of({"confining_pressure", "axial_strain", "axial_stress", "deviatoric_stress", "hold_time"});
  }

  /// "axial_strain 0.01": for logs and the summary.
  std::string text() const {
    const auto say = [](const char* what, double value) {
      char line[64];
      std::snprintf(line, sizeof line, "%s %.6g", what, value);
      return std::string(line);
    };
    if (confining_pressure) return say("confining_pressure", *confining_pressure);
    if (axial_strain) return say("axial_strain", *axial_strain);
    if (axial_stress) return say("axial_stress", *axial_stress);
    if (deviatoric_stress) return say("deviatoric_stress", *deviatoric_stress);
    return say("hold_time", hold_time.value_or(0));
  }
};

}  // namespace breccia
