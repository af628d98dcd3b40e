// SPDX-License-Identifier: BSD-3-Clause
/// exp(-z) - 1 without branches, calls or tables: it vectorises, and gives the same bits in any lane and vector width.
/// The library's vector exponential needs -ffast-math and differs from its scalar one, which does the remainder loop.
#pragma once

#include <bit>
#include <cstdint>

#include "breccia/contact_law.hpp"

namespace breccia::nonlinear_tension {

/// exp(-z) - 1 for z >= 0, within 3e-16 of itself. From z = 700 on it is -1, which it is to the last bit.
BRECCIA_KERNEL double decay(double z) {
  const double x = z < 700 ? -z : -700.0;
  // x = k log 2 + r. Adding 1.5 2^52 rounds to an integer and leaves it in the low bits.
  constexpr double shift = 0x1.8p52, log2_e = 0x1.71547652b82fep0;
  constexpr double log_2_high = 0x1.62e42feep-1, log_2_low = 0x1.a39ef35793c76p-33;  // k times the first is exact
  const double shifted = x * log2_e + shift, k = shifted - shift;
  const double r = (x - k * log_2_high) - k * log_2_low;
  const double power = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);  // 2^k
  // Taylor's series of exp(r) - 1, |r| <= log(2)/2: what is left out is below 1e-17 of the sum. In pairs (Estrin),
  // since one long chain of dependent terms would keep the processor waiting.
  const double r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const double low = (0.5 + r * (1.0 / 6)) + r2 * (1.0 / 24 + r * (1.0 / 120));
  const double middle = (1.0 / 720 + r * (1.0 / 5040)) + r2 * (1.0 / 40320 + r * (1.0 / 362880));
  const double high = (1.0 / 3628800 + r * (1.0 / 39916800)) + r2 * (1.0 / 479001600 + r * (1.0 / 6227020800));
  const double sum = (low + r4 * middle) + r8 * high;
  return power * (r + r2 * sum) + (power - 1);
}

}  // namespace breccia::nonlinear_tension
