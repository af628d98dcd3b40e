// SPDX-License-Identifier: BSD-3-Clause
#include "run/loading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "workflow/workflow.hpp"

namespace breccia {

LoadingStep Loading::step(bool last) {
  const std::uint64_t step = simulation_.state().step;
  LoadingStep now;
  now.ends = end_ || last;
  now.row = row_ || now.ends || step % sampling_.every_steps == 0;
  const bool was_loading = simulation_.loading_started();
  calling(id_, "moving what loads the specimen", [&] { protocol_.step(simulation_); });
  laws_.in_step([&] { simulation_.forces(now.row || look_); });
  Progress progress = Progress::running;
  calling(id_, "deciding how the test goes on", [&] {
    progress = protocol_.decide(simulation_);
    load_ = protocol_.load();
    load_scale_ = protocol_.load_scale();
  });
  now.begins = !was_loading && simulation_.loading_started();
  now.row = now.row || now.begins;
  end_ = progress == Progress::finished;
  look_ = progress == Progress::look;
  peak_ = std::max(peak_, load_);
  if (now.row && simulation_.loading_started()) {
    load_of_row_ = load_;
    peak_of_rows_ = std::max(peak_of_rows_, load_);
    step_of_row_ = step;
  }
  row_ = end_ || load_calls_for_row();
  return now;
}

void Loading::warn_of_missed_peak(Host& host) const {
  constexpr double share = 0.01;
  if (peak_of_rows_ >= (1 - share) * peak_) return;
  host.warn(fmt::format(
      "the curves miss the peak: between their rows the load rose to {:.4g}, in them to {:.4g}. Strength and moduli "
      "read off them depend on sampling.every_steps: make it smaller{}",
      peak_, peak_of_rows_, sampling_.load_change > 0 ? "" : ", or set sampling.load_change"));
}

void Loading::archive(Archive& archive) {
  archive("look", look_);
  archive("row", row_);
  archive("end", end_);
  archive("load", load_);
  archive("load_of_row", load_of_row_);
  archive("peak", peak_);
  archive("peak_of_rows", peak_of_rows_);
  archive("load_scale", load_scale_);
  archive("step_of_row", step_of_row_);
}

/// Large changes since the last row, and a maximum as soon as it is over.
bool Loading::load_calls_for_row() const {
  constexpr std::uint64_t apart = 10;        // steps between two rows at the least
  constexpr double of_a_maximum = 1.0 / 10;  // how much finer it is looked at than the way there
  if (sampling_.load_change <= 0 || !simulation_.loading_started()) return false;
  if (simulation_.state().step - step_of_row_ < apart) return false;
  const double change = sampling_.load_change * std::max(peak_, load_scale_);
  const double fine = of_a_maximum * change;
  return std::abs(load_ - load_of_row_) >= change || (peak_ - peak_of_rows_ >= 2 * fine && load_ <= peak_ - fine);
}

}  // namespace breccia
