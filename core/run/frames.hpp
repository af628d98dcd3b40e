// SPDX-License-Identifier: BSD-3-Clause
/// When the outputs write their frames.
#pragma once

#include <memory>
#include <vector>

#include "breccia/output.hpp"
#include "breccia/postprocessor.hpp"

namespace breccia {

/// The first whole multiple of `interval` after `now` [s]; an interval that is too short to move the time: `now`, so
/// that every later sample has a frame.
double next_due(double now, double interval);

class Frames {
 public:
  Frames(std::vector<std::unique_ptr<Output>> outputs,
         const std::vector<std::unique_ptr<Postprocessor>>& postprocessors);
  void begin(const std::filesystem::path& folder, Host& host);
  /// Writes the outputs whose time has come; all of them when `forced` (first and last state).
  void at(const SimulationView& view, bool forced);
  void finish();

 private:
  struct Scheduled {
    std::unique_ptr<Output> output;
    double next = 0;   ///< [s]
    double last = -1;  ///< time of the last frame [s]
  };
  std::vector<Scheduled> outputs_;
  const std::vector<std::unique_ptr<Postprocessor>>& postprocessors_;
};

}  // namespace breccia
