// SPDX-License-Identifier: BSD-3-Clause
/// The compressive stress-strain line: three bends, elastic unloading.
#pragma once

#include "breccia/contact_law.hpp"

namespace breccia::elasto_damage_plastic {

/// Strains are positive in compression. Without limits the line is straight.
class Hardening {
 public:
  Hardening() = default;
  Hardening(double modulus, const std::vector<double>& limits, const std::vector<double>& slope_ratios) {
    double strain = limits[0] / modulus;
    for (std::size_t k = 0; k < 3; ++k) {
      const double ratio = slope_ratios[k];
      stress_[k] = limits[k];
      strain_[k] = strain;
      plastic_share_[k] = 1 - 1 / ratio;
      // A branch that does not bend has no plastic strain, so its modulus is never used.
      plastic_modulus_[k] = ratio > 1 ? modulus / (ratio - 1) : 0.0;
      if (k == 2) break;
      width_[k] = (limits[k + 1] - limits[k]) * ratio / modulus;
      plastic_width_[k] = plastic_share_[k] * width_[k];
      strain += width_[k];
    }
  }

  /// Plastic part of a strain reached on the line.
  BRECCIA_KERNEL double plastic_strain(double strain) const {
    return plastic_share_[0] * within(strain - strain_[0], width_[0]) +
           plastic_share_[1] * within(strain - strain_[1], width_[1]) +
           plastic_share_[2] * positive(strain - strain_[2]);
  }

  /// Plastic work up to a plastic strain, the integral of the yield stress [J/m3].
  BRECCIA_KERNEL double plastic_work(double plastic) const {
    const double first = within(plastic, plastic_width_[0]),
                 second = within(plastic - plastic_width_[0], plastic_width_[1]),
                 third = positive(plastic - plastic_width_[0] - plastic_width_[1]);
    return first * (stress_[0] + 0.5 * plastic_modulus_[0] * first) +
           second * (stress_[1] + 0.5 * plastic_modulus_[1] * second) +
           third * (stress_[2] + 0.5 * plastic_modulus_[2] * third);
  }

 private:
  BRECCIA_KERNEL static double positive(double x) { return x > 0 ? x : 0.0; }
  BRECCIA_KERNEL static double within(double x, double width) {
    const double above = positive(x);
    return above < width ? above : width;
  }

  double strain_[3] = {1e300, 1e300, 1e300}, stress_[3] = {}, width_[2] = {};  ///< where the line bends, and between
  double plastic_share_[3] = {}, plastic_width_[2] = {}, plastic_modulus_[3] = {};
};

}  // namespace breccia::elasto_damage_plastic
