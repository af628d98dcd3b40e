// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "archive/memory_archive.hpp"
#include "breccia/contact_law.hpp"
#include "check/attempt.hpp"
#include "check/check.hpp"
#include "check/example.hpp"
#include "check/findings.hpp"
#include "check/made_specimen.hpp"
#include "check/names.hpp"
#include "check/protocol_rig.hpp"

namespace breccia {
namespace {

constexpr const char* law_of_trials = "elastic_brittle";

/// So fast, and to so small a strain, that a test on a few hundred particles takes some hundred steps.
std::optional<std::string> quick(const ParamSpec& p) {
  if (p.type != ParamType::quantity) return {};
  if (p.fallback.is_null() && p.required && p.unit == "m/s") return "1 m/s";
  if (p.fallback.is_null() && p.required && p.unit == "1/s") return "100 1/s";
  if ((p.name == "max_strain" || p.name == "max_displacement") && p.unit == "1") return "0.8 %";
  if (p.name == "rest" && p.unit == "1") return "1 %";
  return {};
}

/// Empty when two tests were the same to the last bit. `rows` behind as many of the first are compared.
std::string difference(ProtocolRig& a, ProtocolRig& b, bool with_rows) {
  if (a.steps() != b.steps()) return fmt::format("it ends after {} and {} steps", a.steps(), b.steps());
  const auto x = a.simulation().particles().position, y = b.simulation().particles().position;
  for (std::size_t k = 0; k < x.size(); ++k)
    for (int c = 0; c < 3; ++c)
      if (!same_value(x[k][c], y[k][c])) return "the particles end elsewhere";
  if (!with_rows) return {};
  for (std::size_t c = 0; c < a.rows.columns().size(); ++c) {
    const auto &u = a.rows.values(c), &v = b.rows.values(c);
    const std::string& name = a.rows.columns()[c].name;
    if (u.size() != v.size()) return fmt::format("curve `{}` has {} and {} rows", name, u.size(), v.size());
    for (std::size_t row = 0; row < u.size(); ++row)
      if (!same_value(u[row], v[row]))
        return fmt::format("curve `{}`, row {}, is {:.9g} and {:.9g}", name, row + 1, u[row], v[row]);
  }
  for (const auto& [key, value] : a.summary.all)
    if (const auto other = b.summary.all.find(key);
        other == b.summary.all.end() || other->second.dump() != value.dump())
      return "result `" + key + "` differs";
  return {};
}

std::string fault_of_rows(const KeptCurves& rows) {
  for (std::size_t c = 0; c < rows.columns().size(); ++c) {
    const Column& column = rows.columns()[c];
    if (const std::string fault = fault_of_name(column.name, column.unit); !fault.empty())
      return "curve `" + column.name + "`: " + fault;
    for (std::size_t row = 0; row < rows.rows(); ++row)
      if (!std::isfinite(rows.values(c)[row]))
        return fmt::format("curve `{}` has no number in row {}", column.name, row + 1);
  }
  return {};
}

class ProtocolCheck {
 public:
  ProtocolCheck(const Registry& registry, PluginChoice choice, const Host& user)
      : registry_(registry),
        choice_(std::move(choice)),
        laws_{{example_plugin(registry, ContactLaw::kind, law_of_trials,
                              {"tensile_strength=15 MPa", "shear_strength=15 MPa"})}},
        trials_(user) {}

  CheckFindings operator()() {
    for (const MadeForm& form : made_forms()) {
      form_ = form;
      packing_ = made_packing(form, true);
      const Attempt set_up = attempt([&] { make(1); });
      if (set_up.end == Attempt::End::refused) {
        trials_.skip("sets up", form.name, set_up.text);
        continue;
      }
      trials_.see("sets up", form.name, bool(set_up), set_up.text,
                  "`setup` should refuse a specimen by a UserError that says what is wanted");
      if (set_up) guarded([&] { one_form(); });
    }
    if (!trials_.any())
      trials_.see("sets up", "every specimen", false, "it refuses each one",
                  "loosen what `setup` refuses, or give parameters for a small specimen by `--set`");
    return trials_.findings();
  }

 private:
  template <class F>
  void guarded(F&& f) {
    const Attempt end = attempt(f);
    trials_.see("runs to its end", form_.name, bool(end), end ? fmt::format("after {} steps", steps_) : end.text,
                "a test that cannot go on ends by `Progress::finished`; give parameters for a specimen of some 20 mm "
                "by `--set`");
  }

  std::unique_ptr<ProtocolRig> make(int threads, std::uint64_t every = 20) const {
    RigSettings s;
    s.dimension = form_.dimension;
    s.thickness = form_.dimension == 2 ? made_thickness : 1;
    s.bonding_gap = made_bonding_gap;
    s.threads = threads;
    s.sampling = {every, 0.02};
    return std::make_unique<ProtocolRig>(registry_, packing_, laws_, registry_.create<Protocol>(choice_), s);
  }

  std::unique_ptr<ProtocolRig> whole(int threads, std::uint64_t every = 20) const {
    auto rig = make(threads, every);
    if (!rig->go(most_steps))
      throw UserError(fmt::format("it has not ended after {} steps ({})", most_steps, rig->protocol().status()));
    return rig;
  }

  void see(const char* check, const std::string& fault, const std::string& fine, const char* mend) {
    trials_.see(check, form_.name, fault.empty(), fault.empty() ? fine : fault, mend);
  }

  void one_form() {
    const auto test = make(1);
    double least = 1, most = 0;
    bool finite = true;
    const bool ended = test->go(most_steps, [&](Simulation&) {
      const double share = test->protocol().share_done();
      finite = finite && std::isfinite(share) && std::isfinite(test->protocol().load());
      least = std::min(least, share);
      most = std::max(most, share);
    });
    steps_ = test->steps();
    if (!ended)
      throw UserError(fmt::format("it has not ended after {} steps ({})", most_steps, test->protocol().status()));
    see("rows of curves", test->rows.rows() < 3 ? fmt::format("only {}", test->rows.rows()) : "",
        fmt::format("{}", test->rows.rows()),
        "call `mark_start_of_loading` when the specimen is loaded, and end some time after: curves begin there");
    see("names, units and numbers of the curves", fault_of_rows(test->rows), "in order",
        "`sample` sets every column in every row; look for divisions by what is zero at the start");
    see("results", fault_of_results(test->summary), "in order", "give null for what was not reached, and SI units");
    see("share done", finite && least >= 0 && most <= 1 + 1e-9 ? "" : fmt::format("from {:.3g} to {:.3g}", least, most),
        fmt::format("to {:.2g}", most), "`share_done` is between 0 and 1, `load` a number");
    trials_.see(
        "energy closes", form_.name, test->energy_error() <= 0.02,
        fmt::format("{:.2g} % of the work is unaccounted for", 100 * test->energy_error()),
        "work goes through `set_wall_velocity`, `hold`, `set_applied_force` and `set_cell_velocity` alone, and each is "
        "set anew in `step` when it changes: look for jumps of velocities",
        test->energy_error());
    for (const int threads : {2, 3})
      see("threads", difference(*test, *whole(threads), true), "the same bits for 1, 2 and 3",
          "what is decided must not depend on the order of sums: look for static variables and own threads");
    see("rows more rarely", difference(*test, *whole(1, 97), false), "the same test",
        "`sample` must not change what `step` and `decide` go by");
    resumed(*test);
    stopped(test->steps() / 2);
  }

  /// From places all along the test: a member may matter for a while only.
  void resumed(ProtocolRig& test) {
    constexpr std::uint64_t places = 10;
    const auto before = make(1);
    for (std::uint64_t k = 0; k < places; ++k) {
      while (before->steps() < (2 * k + 1) * test.steps() / (2 * places)) before->step();
      MemoryArchive archive;
      if (!before->archive(archive))
        return trials_.skip("archive and resume", "",
                            "`archive` returns false: runs with this protocol have no checkpoints");
      archive.read_back();
      const auto after = make(2);
      after->archive(archive);
      after->rows = before->rows;
      const bool ended = after->go(most_steps);
      see("archive and resume", ended ? difference(test, *after, true) : "a test that goes on does not end",
          "the same bits from ten places on", "`archive` misses a member that changes after `setup`");
    }
  }

  void stopped(std::uint64_t at) {
    auto rig = make(1);
    while (rig->steps() < at) rig->step();
    const Attempt end = attempt([&] { rig->step(true); });
    const std::string fault = end ? fault_of_results(rig->summary) : end.text;
    see("stopped on request", fault, "it sums up what there is",
        "`finish` must do with a test that was stopped anywhere: no peak, few rows");
  }

  static constexpr std::uint64_t most_steps = 50000;
  const Registry& registry_;
  PluginChoice choice_;
  PluginStack laws_;
  MadeForm form_;
  PackedParticles packing_;
  Trials trials_;
  std::uint64_t steps_ = 0;
};

}  // namespace

CheckFindings check_protocol(const Registry& registry, const std::string& name,
                             const std::vector<std::string>& parameters, const Host& user) {
  const std::vector<std::string> laws = registry.names(ContactLaw::kind);
  if (std::find(laws.begin(), laws.end(), law_of_trials) == laws.end())
    throw UserError(std::string("a protocol is tried with the contact law `") + law_of_trials +
                    "`, which is not installed");
  return ProtocolCheck(registry, example_plugin(registry, Protocol::kind, name, parameters, quick), user)();
}

}  // namespace breccia
