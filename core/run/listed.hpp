// SPDX-License-Identifier: BSD-3-Clause
/// The plugins of a workflow's lists, told apart by the names that the workflow gives them: each goes through the
/// wrappers below, which put the name in front of whatever it leaves among what others leave.
#pragma once

#include "breccia/postprocessor.hpp"
#include "plugin/guarded.hpp"
#include "plugin/registry.hpp"
#include "results/summary_table.hpp"
#include "run/step_views.hpp"
#include "workflow/plugin_label.hpp"

namespace breccia {

/// One plugin of a list. On ranks behind the first stand all of them, too, but only those work that see parts.
template <class P>
class Listed {
 public:
  Listed(const PluginChoice& choice, const Registry& registry, bool first_rank = true)
      : type_(choice.type),
        name_(given_name(choice)),
        label_(result_label(choice)),
        plugin_(registry.create<P>(choice)),
        sees_parts_(says_so(*plugin_)),
        works_(first_rank || sees_parts_) {}

  /// `f` of the plugin; what it throws names the plugin.
  template <class F>
  decltype(auto) call(std::string_view doing, F&& f) {
    try {
      return calling({P::kind, type_, name_}, doing, [&]() -> decltype(auto) { return f(*plugin_); });
    } catch (...) {
      failed_ = true;
      throw;
    }
  }
  /// `f` of the plugin and what it is to see of the step; all ranks call it together.
  template <class F>
  void show(StepViews& views, std::string_view doing, F&& f) {
    try {
      views.show(sees_parts_, [&](const SimulationView& view) { call(doing, [&](P& plugin) { f(plugin, view); }); });
    } catch (...) {
      failed_ = true;
      throw;
    }
  }
  /// What changes in it while it runs; adds it to `unknown` when it does not say.
  void archive(Archive& archive, std::vector<std::string>& unknown) {
    if (failed_ || !works_) return;
    call(archive.reading() ? "reading a checkpoint" : "writing a checkpoint", [&](P& plugin) {
      if (!plugin.archive(archive)) unknown.push_back(std::string(P::kind) + " `" + label_ + "`");
    });
  }
  const std::string& label() const { return label_; }
  std::string prefix() const { return name_.empty() ? "" : name_ + "_"; }
  bool is_named() const { return !name_.empty(); }
  bool has_failed() const { return failed_; }  ///< on any rank
  bool sees_parts() const { return sees_parts_; }
  bool works() const { return works_; }  ///< on this rank

 private:
  static bool says_so(const P& plugin) {
    if constexpr (requires { plugin.sees_parts(); }) return plugin.sees_parts();
    else return false;  // renderers see files
  }

  std::string type_, name_, label_;
  std::unique_ptr<P> plugin_;
  bool sees_parts_, works_, failed_ = false;
};

/// Columns `upper_...` for the plugin named `upper`.
class NamedRecorder final : public Recorder {
 public:
  NamedRecorder(Recorder& to, std::string prefix) : to_(to), prefix_(std::move(prefix)) {}
  std::size_t add(Column column) override {
    column.name = prefix_ + column.name;
    return to_.add(std::move(column));
  }
  void set(std::size_t column, double value) override { to_.set(column, value); }

 private:
  Recorder& to_;
  std::string prefix_;
};

/// The plugin finds its own columns, and those of others of its name, by the names without prefix; then all others.
class NamedCurves final : public Curves {
 public:
  NamedCurves(const Curves& of, std::string prefix) : of_(of), prefix_(std::move(prefix)) {}
  const std::vector<Column>& columns() const override { return of_.columns(); }
  std::span<const double> column(std::string_view name) const override;
  std::size_t rows() const override { return of_.rows(); }

 private:
  const Curves& of_;
  std::string prefix_;
};

/// A section, headlines and tables of its own.
class NamedSummary final : public Summary {
 public:
  template <class P>
  NamedSummary(SummaryTable& table, const Listed<P>& plugin)
      : section_(table, plugin.label()), prefix_(plugin.prefix()) {}
  void headline(const ResultName& name, Json value) override {
    section_.headline({prefix_ + name.name, name.unit}, std::move(value));
  }
  void own(const ResultName& name, Json value) override { section_.own(name, std::move(value)); }
  void table(Table table) override {
    table.name = prefix_ + table.name;
    section_.table(std::move(table));
  }

 private:
  SummaryTable::Section section_;
  std::string prefix_;
};

}  // namespace breccia
