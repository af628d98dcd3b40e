// SPDX-License-Identifier: BSD-3-Clause
/// The energy balance of the engine as curves, and how well it closes.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "breccia/postprocessor.hpp"

namespace breccia {
namespace {

struct Account {
  const char *name, *doc;
  double (*value)(const EnergyLedger&);
};

constexpr std::array<Account, 8> accounts{{
    {"energy_boundary_work", "work of walls, prescribed motion and applied forces on the particles",
     [](const EnergyLedger& e) { return e.boundary_work; }},
    {"energy_elastic", "stored in pairs and wall contacts", [](const EnergyLedger& e) { return e.elastic; }},
    {"energy_kinetic", "of translation and rotation", [](const EnergyLedger& e) { return e.kinetic; }},
    {"energy_friction", "dissipated by sliding", [](const EnergyLedger& e) { return e.friction; }},
    {"energy_damping", "dissipated by the non-viscous damping", [](const EnergyLedger& e) { return e.damping; }},
    {"energy_contact", "dissipated otherwise in contacts", [](const EnergyLedger& e) { return e.contact; }},
    {"energy_fracture", "released by breaking bonds", [](const EnergyLedger& e) { return e.fracture; }},
    {"energy_error", "initial energy plus boundary work, minus all of the others",
     [](const EnergyLedger& e) { return e.error(); }},
}};

double largest_size(std::span<const double> values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

}  // namespace

class Energy final : public Postprocessor {
 public:
  struct Config {};
  static void describe(Schema<Config>& s) {
    s.summary("Energy balance: where the work of the boundary went, and what is unaccounted for")
        .details(
            "error = initial + boundary work - (elastic + kinetic + friction + damping + contact + fracture), counted "
            "from the start of loading, initial being elastic + kinetic at that moment. The headline `energy_error` is "
            "its size at the end over the largest boundary work of the run.");
  }

  explicit Energy(const Config&) {}
  bool sees_parts() const override { return true; }  // the ledger is that of the whole

  void begin(const SimulationView&, Recorder& recorder, Host&) override {
    for (std::size_t k = 0; k < accounts.size(); ++k)
      column_[k] = recorder.add({accounts[k].name, "J", accounts[k].doc});
  }

  void start_of_loading(const SimulationView&) override { rows_of_loading_ = 0; }

  void sample(const SimulationView& view, Recorder& recorder) override {
    for (std::size_t k = 0; k < accounts.size(); ++k) recorder.set(column_[k], accounts[k].value(view.energy));
    if (rows_of_loading_) ++*rows_of_loading_;
  }

  void finish(const SimulationView& view, const Curves& curves, Summary& summary) override {
    // Rows before the start of loading belong to a ledger that was closed then.
    const std::size_t rows = std::min(rows_of_loading_.value_or(curves.rows()), curves.rows());
    const auto loading = [&](const char* name) { return curves.column(name).last(rows); };
    const double work = std::max(largest_size(loading("energy_boundary_work")), std::abs(view.energy.boundary_work));
    const double worst = std::max(largest_size(loading("energy_error")), std::abs(view.energy.error()));
    const auto relative = [&](double error) { return work > 0 ? Json(std::abs(error) / work) : Json(); };
    summary.headline("energy_error", relative(view.energy.error()));
    for (const Account& a : accounts) summary.own({std::string(a.name).substr(7), "J"}, a.value(view.energy));
    summary.own({"initial", "J"}, view.energy.initial);
    summary.own({"largest_boundary_work", "J"}, work);
    summary.own("largest_relative_error", relative(worst));
  }
  bool archive(Archive& archive) override {
    archive("rows_of_loading", rows_of_loading_);
    return true;
  }

 private:
  std::array<std::size_t, accounts.size()> column_{};
  std::optional<std::size_t> rows_of_loading_;  ///< unset until loading starts
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Energy, "postprocessor", "energy")
