// SPDX-License-Identifier: BSD-3-Clause
#include "run/frames.hpp"

#include <cmath>

#include "breccia/atomic_file.hpp"
#include "run/frame_fields.hpp"

namespace breccia {

double next_due(double now, double interval) {
  double count = std::floor(now / interval) + 1;
  if (count * interval <= now) ++count;  // rounding
  const double next = count * interval;
  // Shorter than what moves the time at all: a frame whenever it is asked.
  return std::isfinite(count) && next > now ? next : now;
}

Frames::Frames(std::vector<Listed<Output>> outputs, std::vector<Listed<Postprocessor>>& postprocessors)
    : postprocessors_(postprocessors) {
  for (auto& o : outputs) outputs_.push_back({std::move(o)});
}

void Frames::begin(const std::filesystem::path& folder, Host& host) {
  for (Scheduled& s : outputs_) {
    if (!s.output.works()) continue;
    std::filesystem::path own = folder;
    if (s.output.is_named()) {
      own /= s.output.label();
      std::error_code error;
      std::filesystem::create_directory(own, error);
      if (error) throw CannotWrite(own, error.value());
    }
    s.output.call("beginning its files", [&](Output& o) { o.begin(own, host); });
  }
}

void Frames::at(StepViews& views, bool forced) {
  const double now = views.part().time;
  std::vector<double> due;
  for (const Scheduled& s : outputs_)
    due.push_back(s.output.has_failed() || s.last == now || (!forced && now < s.next) ? 0 : 1);
  // Who writes on this rank knows its time; the others learn it from the first.
  if (RankLink* const link = views.others().link(); link && !due.empty()) {
    if (!link->first()) due.assign(due.size(), 0);
    link->largest(due);
  }
  FrameFields fields(views, postprocessors_);
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    if (due[k] == 0) continue;
    Scheduled& s = outputs_[k];
    const std::vector<Field>& given = s.output.sees_parts() ? fields.of_part() : fields.of_whole();
    s.output.show(views, "writing a frame", [&](Output& o, const SimulationView& view) {
      o.frame(view, given);
      s.interval = o.interval();
    });
    s.last = now;
    s.next = next_due(now, s.interval);
  }
}

void Frames::archive(Archive& archive, std::vector<std::string>& unknown) {
  const Archive::Group outputs(archive, "outputs");
  for (Scheduled& s : outputs_) {
    if (!s.output.works()) continue;
    const Archive::Group group(archive, s.output.label());
    archive("interval", s.interval);
    archive("next", s.next);
    archive("last", s.last);
    s.output.archive(archive, unknown);
  }
}

void Frames::finish(MeetingParts& others) {
  for (Scheduled& s : outputs_)
    others.together([&] {
      if (s.output.works() && !s.output.has_failed()) s.output.call("ending its files", [](Output& o) { o.finish(); });
    });
}

}  // namespace breccia
