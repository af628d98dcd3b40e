// SPDX-License-Identifier: BSD-3-Clause
/// `interval`, as every output of frames has it.
#pragma once

#include "breccia/schema.hpp"

namespace breccia {

template <class Config>
void frame_interval(Schema<Config>& s, double Config::*interval) {
  s.param("interval", interval)
      .unit("s")
      .above(0)
      .fallback(1e-4)
      .example("0.1 ms")
      .doc("time between frames; the first and the last state are always written");
}

}  // namespace breccia
