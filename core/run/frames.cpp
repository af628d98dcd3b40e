// SPDX-License-Identifier: BSD-3-Clause
#include "run/frames.hpp"

#include <cmath>

namespace breccia {

double next_due(double now, double interval) {
  double count = std::floor(now / interval) + 1;
  if (count * interval <= now) ++count;  // rounding
  const double next = count * interval;
  // Shorter than what moves the time at all: a frame whenever it is asked.
  return std::isfinite(count) && next > now ? next : now;
}

Frames::Frames(std::vector<std::unique_ptr<Output>> outputs,
               const std::vector<std::unique_ptr<Postprocessor>>& postprocessors)
    : postprocessors_(postprocessors) {
  for (auto& o : outputs) outputs_.push_back({std::move(o)});
}

void Frames::begin(const std::filesystem::path& folder, Host& host) {
  for (Scheduled& s : outputs_) s.output->begin(folder, host);
}

void Frames::at(const SimulationView& view, bool forced) {
  std::vector<Field> fields;
  bool have_fields = false;
  for (Scheduled& s : outputs_) {
    if (s.last == view.time || (!forced && view.time < s.next)) continue;
    if (!have_fields) {
      for (const auto& p : postprocessors_) p->fields(view, fields);
      have_fields = true;
    }
    s.output->frame(view, fields);
    s.last = view.time;
    s.next = next_due(view.time, s.output->interval());
  }
}

void Frames::finish() {
  for (Scheduled& s : outputs_) s.output->finish();
}

}  // namespace breccia
