// SPDX-License-Identifier: BSD-3-Clause
#include "check/postprocessor_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/findings.hpp"
#include "check/names.hpp"

namespace breccia {
namespace {

class ThreadsHost final : public SilentHost {
 public:
  explicit ThreadsHost(int threads) : threads_(threads) {}
  int threads() const override { return threads_; }

 private:
  int threads_;
};

/// Of each unit the largest number: what is small against it is rounding.
using Scales = std::map<std::string, double>;

std::string differ(const std::string& what, double a, double b, double scale, bool exact) {
  const bool fine = exact ? same_value(a, b) : same_value(a, b) || std::abs(a - b) <= 1e-7 * scale;
  return fine ? "" : fmt::format("{} is {:.9g} and {:.9g}", what, a, b);
}

std::string differ(const std::string& what, const Json& a, const Json& b, double scale, bool exact) {
  if (a.is_number() && b.is_number()) return differ(what, a.get<double>(), b.get<double>(), scale, exact);
  if (a.type() != b.type() || a.size() != b.size()) return fmt::format("{} is {} and {}", what, a.dump(), b.dump());
  if (a.is_structured()) {
    auto other = b.begin();
    for (auto it = a.begin(); it != a.end(); ++it, ++other)
      if (const std::string text = differ(what, *it, *other, scale, exact); !text.empty()) return text;
    return {};
  }
  return a == b ? "" : fmt::format("{} is {} and {}", what, a.dump(), b.dump());
}

double largest(const Json& value) {
  if (value.is_number()) return std::abs(value.get<double>());
  double most = 0;
  if (value.is_structured())
    for (const Json& item : value) most = std::max(most, largest(item));
  return most;
}

}  // namespace

PostprocessorRun::PostprocessorRun(const Registry& registry, const PluginChoice& choice, const MadeSimulation& first,
                                   int threads)
    : plugin_(registry.create<Postprocessor>(choice)) {
  ThreadsHost host(threads);
  plugin_->begin(first.view(), rows, host);
  own_columns = rows.columns().size();
  for (const std::string& name : plugin_->needed_curves()) {
    const auto& there = rows.columns();
    if (std::none_of(there.begin(), there.end(), [&](const Column& c) { return c.name == name; }))
      rows.add({name, "1", "of another plugin"});
  }
}

void PostprocessorRun::sample(const MadeSimulation& state, int times) {
  const SimulationView view = state.view();
  for (int k = 0; k < times; ++k) plugin_->sample(view, rows);
  const double share = 1e4 * state.time;  // what others would have measured grows in proportion
  for (std::size_t c = own_columns; c < rows.columns().size(); ++c)
    rows.set(c, share * (rows.columns()[c].name.find("stress") != std::string::npos ? 1e7 : 1e-3));
  rows.end_row();
  fields.emplace_back();
  plugin_->fields(view, fields.back());
}

void PostprocessorRun::whole(const States& states) {
  start(states.front());
  for (const MadeSimulation& s : states) sample(s);
  finish(states.back());
}

std::string fault_of_names(const PostprocessorRun& run) {
  const auto wrong = [](const std::string& kind, const std::string& name, const std::string& unit) -> std::string {
    const std::string fault = fault_of_name(name, unit);
    return fault.empty() ? "" : kind + " `" + name + "`: " + fault;
  };
  for (std::size_t c = 0; c < run.own_columns; ++c)
    if (const Column& column = run.rows.columns()[c]; !wrong("curve", column.name, column.unit).empty())
      return wrong("curve", column.name, column.unit);
  for (const auto& frame : run.fields)
    for (std::size_t k = 0; k < frame.size(); ++k) {
      const Field& f = frame[k];
      if (const std::string text = wrong("field", f.name, f.unit); !text.empty()) return text;
      for (std::size_t m = 0; m < k; ++m)
        if (frame[m].name == f.name && frame[m].on == f.on) return "two fields are called `" + f.name + "`";
    }
  if (const std::string text = fault_of_units(run.summary); !text.empty()) return text;
  for (const auto& [name, table] : run.summary.tables) {
    if (const std::string text = wrong("table", name, "1"); !text.empty()) return text;
    for (const Column& c : table.columns)
      if (const std::string text = wrong("column", c.name, c.unit); !text.empty())
        return text + ", in table `" + name + "`";
  }
  return {};
}

std::string fault_of_values(const PostprocessorRun& run, const States& states) {
  for (std::size_t c = 0; c < run.own_columns; ++c)
    for (const double v : run.rows.values(c))
      if (!std::isfinite(v)) return "curve `" + run.rows.columns()[c].name + "` has a row without a number";
  for (std::size_t row = 0; row < run.fields.size(); ++row)
    for (const Field& f : run.fields[row]) {
      const std::size_t count = f.on == Field::On::particles ? states[row].radius.size() : states[row].bond_i.size();
      if (f.components < 1 || f.values.size() != count * std::size_t(f.components))
        return fmt::format("field `{}` has {} values, where {} times {} belong", f.name, f.values.size(), count,
                           f.components);
      for (const double v : f.values)
        if (!std::isfinite(v)) return "field `" + f.name + "` holds what is no number";
    }
  if (const std::string text = fault_of_numbers(run.summary); !text.empty()) return text;
  for (const auto& [name, table] : run.summary.tables) {
    if (table.columns.size() != table.values.size())
      return fmt::format("table `{}` has {} columns and values of {}", name, table.columns.size(), table.values.size());
    for (const auto& column : table.values)
      if (column.size() != table.values.front().size()) return "the columns of table `" + name + "` differ in length";
  }
  return {};
}

std::vector<std::vector<Field>> joined_fields(const PostprocessorRun& low, const States& of_low,
                                              const PostprocessorRun& high, const States& of_high) {
  std::vector<std::vector<Field>> all;
  for (std::size_t row = 0; row < low.fields.size(); ++row) {
    all.emplace_back();
    for (std::size_t f = 0; f < low.fields[row].size(); ++f) {
      Field joined = low.fields[row][f];
      joined.values.clear();
      for (const auto& [run, states] : {std::pair{&low, &of_low}, {&high, &of_high}}) {
        if (f >= run->fields[row].size()) continue;  // one that is missing makes it too short
        const Field& part = run->fields[row][f];
        const PartOfSpecimen& own = *(*states)[row].part;
        const OwnRows rows = part.on == Field::On::particles ? own.particles : own.bonds;
        const auto n = std::size_t(std::max(1, part.components));
        if (part.values.size() >= rows.behind() * n)
          joined.values.insert(joined.values.end(), part.values.begin() + std::ptrdiff_t(rows.first() * n),
                               part.values.begin() + std::ptrdiff_t(rows.behind() * n));
      }
      all.back().push_back(std::move(joined));
    }
  }
  return all;
}

std::string difference(const PostprocessorRun& a, const PostprocessorRun& b, const std::vector<Index>* order) {
  const bool exact = !order;
  Scales scales;
  for (std::size_t c = 0; c < a.own_columns; ++c)
    for (const double v : a.rows.values(c)) {
      double& most = scales[a.rows.columns()[c].unit];
      most = std::max(most, std::isfinite(v) ? std::abs(v) : 0);
    }
  for (std::size_t c = 0; c < a.own_columns; ++c) {
    const Column& column = a.rows.columns()[c];
    const auto &x = a.rows.values(c), &y = b.rows.values(c);
    if (x.size() != y.size()) return fmt::format("curve `{}` has {} and {} rows", column.name, x.size(), y.size());
    for (std::size_t row = 0; row < x.size(); ++row)
      if (const std::string text = differ(fmt::format("curve `{}`, row {},", column.name, row + 1), x[row], y[row],
                                          scales[column.unit], exact);
          !text.empty())
        return text;
  }
  const std::size_t frames = std::min(a.fields.size(), b.fields.size());
  for (std::size_t k = 1; k <= frames; ++k) {  // from the last: one that goes on has only some
    const auto &x = a.fields[a.fields.size() - k], &y = b.fields[b.fields.size() - k];
    if (x.size() != y.size()) return fmt::format("there are {} and {} fields", x.size(), y.size());
    for (std::size_t f = 0; f < x.size(); ++f) {
      if (x[f].name != y[f].name || x[f].values.size() != y[f].values.size())
        return "field `" + x[f].name + "` has another form";
      if (order && x[f].on == Field::On::bonds) continue;
      double scale = 0;
      for (const double v : x[f].values) scale = std::max(scale, std::abs(v));
      const auto n = std::size_t(std::max(1, x[f].components));
      for (std::size_t v = 0; v < y[f].values.size(); ++v) {
        const std::size_t of = order ? (*order)[v / n] * n + v % n : v;
        if (const std::string text = differ("field `" + x[f].name + "`", x[f].values[of], y[f].values[v], scale, exact);
            !text.empty())
          return text;
      }
    }
  }
  for (const ResultName& name : a.summary.names)
    scales[name.unit] = std::max(scales[name.unit], largest(a.summary.all.at(name.key())));
  if (a.summary.all.size() != b.summary.all.size()) return "the summaries have different results";
  for (const ResultName& name : a.summary.names) {
    const auto other = b.summary.all.find(name.key());
    if (other == b.summary.all.end()) return "result `" + name.key() + "` is missing";
    if (const std::string text = differ("result `" + name.key() + "`", a.summary.all.at(name.key()), other->second,
                                        scales[name.unit], exact);
        !text.empty())
      return text;
  }
  if (a.summary.tables.size() != b.summary.tables.size()) return "there are other tables";
  for (const auto& [name, table] : a.summary.tables) {
    const auto other = b.summary.tables.find(name);
    if (other == b.summary.tables.end() || other->second.values.size() != table.values.size())
      return "table `" + name + "` differs";
    for (std::size_t c = 0; c < table.values.size(); ++c) {
      const auto &x = table.values[c], &y = other->second.values[c];
      if (x.size() != y.size()) return "table `" + name + "` has another length";
      double scale = 0;
      for (const double v : x) scale = std::max(scale, std::isfinite(v) ? std::abs(v) : 0);
      for (std::size_t row = 0; row < x.size(); ++row)
        if (const std::string text = differ("table `" + name + "`", x[row], y[row], scale, exact); !text.empty())
          return text;
    }
  }
  return {};
}

}  // namespace breccia
