// SPDX-License-Identifier: BSD-3-Clause
/// When the outputs write their frames.
#pragma once

#include <memory>
#include <vector>

#include "breccia/output.hpp"
#include "run/listed.hpp"

namespace breccia {

/// The first whole multiple of `interval` after `now` [s]; an interval that is too short to move the time: `now`, so
/// that every later sample has a frame.
double next_due(double now, double interval);

class Frames {
 public:
  Frames(std::vector<Listed<Output>> outputs, std::vector<Listed<Postprocessor>>& postprocessors);
  /// Each writes into the folder, a named one into a folder of its own within.
  void begin(const std::filesystem::path& folder, Host& host);
  /// Writes the outputs whose time has come; all of them when `forced` (first and last state). All ranks call it
  /// together; the clock is the first one's.
  void at(StepViews& views, bool forced);
  void finish(MeetingParts& others);  ///< of all but those that have failed
  /// After `begin`. Adds to `unknown` who does not say what changes in it while it runs.
  void archive(Archive& archive, std::vector<std::string>& unknown);

 private:
  struct Scheduled {
    Listed<Output> output;
    double interval = 0;  ///< [s]
    double next = 0;      ///< [s]
    double last = -1;     ///< time of the last frame [s]
  };
  std::vector<Scheduled> outputs_;
  std::vector<Listed<Postprocessor>>& postprocessors_;
};

}  // namespace breccia
