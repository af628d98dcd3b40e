// SPDX-License-Identifier: BSD-3-Clause
#include "run/frames.hpp"

#include <cmath>

#include "breccia/atomic_file.hpp"

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

void Frames::at(const SimulationView& view, bool forced) {
  std::vector<Field> fields;
  bool have_fields = false;
  for (Scheduled& s : outputs_) {
    if (s.output.has_failed() || s.last == view.time || (!forced && view.time < s.next)) continue;
    if (!have_fields) add_fields(view, fields);
    have_fields = true;
    s.output.call("writing a frame", [&](Output& o) {
      o.frame(view, fields);
      s.interval = o.interval();
    });
    s.last = view.time;
    s.next = next_due(view.time, s.interval);
  }
}

void Frames::add_fields(const SimulationView& view, std::vector<Field>& fields) {
  for (auto& p : postprocessors_) {
    if (p.has_failed()) continue;
    const std::size_t first = fields.size();
    p.call("giving fields", [&](Postprocessor& q) { q.fields(view, fields); });
    for (std::size_t k = first; k < fields.size(); ++k) fields[k].name = p.prefix() + fields[k].name;
  }
}

void Frames::archive(Archive& archive, std::vector<std::string>& unknown) {
  const Archive::Group outputs(archive, "outputs");
  for (Scheduled& s : outputs_) {
    const Archive::Group group(archive, s.output.label());
    archive("interval", s.interval);
    archive("next", s.next);
    archive("last", s.last);
    s.output.archive(archive, unknown);
  }
}

void Frames::finish() {
  for (Scheduled& s : outputs_)
    if (!s.output.has_failed()) s.output.call("ending its files", [](Output& o) { o.finish(); });
}

}  // namespace breccia
