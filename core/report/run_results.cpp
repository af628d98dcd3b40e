// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>

#include "report/html.hpp"
#include "report/quantity.hpp"
#include "report/run_parts.hpp"
#include "results/summary_keys.hpp"

namespace breccia::report {
namespace {

const std::set<std::string>& keys_of_specimen() {
  static const std::set<std::string> all{"particles",      "bonds",      "porosity", "coordination_number",
                                         "bond_tolerance", "bond_gap_m", "seed"};
  return all;
}

/// Has a part of its own.
bool told_elsewhere(const std::string& key) {
  return is_bookkeeping(key) || keys_of_specimen().contains(key) || key == "interrupted" || key == "energy_error";
}

/// A number, or what a reader should know instead of one.
std::string cell(const Json& v, const std::string& unit, double like = 0) {
  if (v.is_boolean()) return v.get<bool>() ? "yes" : "no";
  if (v.is_number()) return shown_quantity(v.get<double>(), unit, like).text();
  if (v.is_null()) return "<span class=\"soft\">not measured</span>";
  return v.is_string() ? escaped(v.get<std::string>()) : "";
}

struct Result {
  std::string key, title, unit;
  Json value, reference;
};

/// The numbers at the top level of the summary, and the reference values beside them.
std::vector<Result> headline_results(const RunFiles& run) {
  std::vector<Result> all;
  const Json reference = run.result("reference");
  for (const auto& [key, value] : run.summary.items()) {
    if (value.is_structured() || value.is_string() || told_elsewhere(key)) continue;
    const auto [title, unit] = title_of(key, run.summary);
    const bool compared = reference.is_object() && reference.contains(key) && reference[key].is_number();
    all.push_back({key, capital(title), unit, value, compared ? reference[key] : Json()});
  }
  std::stable_partition(all.begin(), all.end(), [](const Result& r) { return !is_secondary(r.key); });
  return all;
}

std::string reference_note(const RunFiles& run) {
  const Json reference = run.result("reference");
  if (!reference.is_object()) return {};
  std::string out, unmatched;
  for (const auto& [key, value] : reference.items()) {
    if (value.is_string())
      out +=
          "<p class=\"about\">" +
          escaped((key == "source" ? "Reference values" : capital(readable(key))) + ": " + value.get<std::string>()) +
          "</p>\n";
    else if (value.is_number() && !run.summary.contains(key))
      unmatched += (unmatched.empty() ? "" : ", ") + key + " = " + number_text(value.get<double>());
  }
  if (!unmatched.empty())
    out += "<p class=\"about\">Reference values that this run did not measure: " + escaped(unmatched) + ".</p>\n";
  return out;
}

}  // namespace

bool is_secondary(const std::string& key) {
  return key.starts_with("bonds_broken") || key == "global_damage" || key == "energy_error" ||
         keys_of_specimen().contains(key);
}

std::string tiles(const RunFiles& run) {
  std::string out;
  int count = 0;
  for (const Result& r : headline_results(run)) {
    if (!r.value.is_number() || count == 4) continue;
    const ShownQuantity q = shown_quantity(r.value.get<double>(), r.unit);
    out += "<li><span>" + escaped(r.title) + "</span><b>" + q.number +
           (q.unit.empty() ? "" : " <small>" + q.unit + "</small>") + "</b></li>\n";
    ++count;
  }
  return out.empty() ? "" : "<ul class=\"tiles\">\n" + out + "</ul>\n";
}

std::string results_table(const RunFiles& run) {
  const std::vector<Result> all = headline_results(run);
  const bool compared = std::any_of(all.begin(), all.end(), [](const Result& r) { return r.reference.is_number(); });
  Table table("What was measured");
  table.column("Quantity").column("Measured", Table::Is::number);
  if (compared) table.column("Reference", Table::Is::number).column("Difference", Table::Is::number);
  for (const Result& r : all) {
    std::vector<std::string> row{escaped(r.title), cell(r.value, r.unit)};
    if (compared) {
      row.emplace_back();
      row.emplace_back();
      if (r.reference.is_number()) {
        const double paper = r.reference.get<double>();
        row[2] = cell(r.reference, r.unit, r.value.is_number() ? r.value.get<double>() : 0);
        if (r.value.is_number() && paper != 0) {
          const double share = r.value.get<double>() / paper - 1;
          row[3] = (share > 0 ? "+" : "") + percent_text(share);
        }
      }
    }
    table.row(row);
  }
  std::string out = table.html() + reference_note(run);
  if (run.result("peak_reached") == false)
    out +=
        "<div class=\"note\">" +
        paragraph(
            "The stress had not fallen from its largest value when the run ended: the peak need not be the strength.") +
        "</div>\n";
  return out;
}

std::string specimen_table(const RunFiles& run) {
  Table table("The packing: what was asked for and what was achieved");
  table.column("Quantity").column("Asked", Table::Is::number).column("Achieved", Table::Is::number);
  const Json packing = run.result("packing");
  if (packing.is_object())
    for (const auto& [key, line] : packing.items()) {
      if (!line.is_object() || !line.contains("got")) continue;
      const std::string unit = line.value("unit", "1");
      const double like = line["got"].is_number() ? line["got"].get<double>() : 0;
      table.row({escaped(capital(readable(key))), line.contains("asked") ? cell(line["asked"], unit, like) : "",
                 cell(line["got"], unit)});
    }
  const auto more = [&](const char* key, const char* title, const char* unit, const char* asked) {
    if (!run.summary.contains(key)) return;
    const Json wanted = asked ? run.given(asked) : Json();
    table.row({title, wanted.is_null() ? "" : escaped(value_text(wanted)), cell(run.result(key), unit)});
  };
  more("bonds", "Bonds", "1", nullptr);
  more("coordination_number", "Coordination number (bonds per particle, counted at both)", "1",
       "bonding.coordination_number");
  more("bond_tolerance", "Bonded up to a gap, over the mean radius, of", "1", "bonding.tolerance");
  more("bond_gap_m", "Bonded up to a gap of", "m", "bonding.gap");
  return table.html();
}

std::string damage_part(const RunFiles& run) {
  const Json damage = run.result("damage");
  Table table("Cracks at the end of the test");
  table.column("Quantity").column("Value", Table::Is::number);
  const double made = run.number("damage.bonds_made");
  const auto share = [&](double broken) {
    return made > 0 ? " <span class=\"soft\">(" + percent_text(broken / made) + ")</span>" : "";
  };
  if (!std::isnan(made)) table.row({"Bonds made", cell(made, "1")});
  for (const auto& [path, title] : {std::pair{"damage.bonds_broken", "Bonds broken"},
                                    {"bonds_broken_tension", "in tension"},
                                    {"bonds_broken_shear", "in shear"},
                                    {"damage.bonds_broken_before_loading", "before loading"}})
    if (const double n = run.number(path); !std::isnan(n)) table.row({title, cell(n, "1") + share(n)});
  for (const auto& [path, title] : {std::pair{"damage.fragments", "Fragments of more than one particle"},
                                    {"damage.single_particles", "Single particles broken off"},
                                    {"damage.largest_fragment_share", "Largest fragment, share of the mass"}})
    if (const double n = run.number(path); !std::isnan(n))
      table.row({title, std::string(path).ends_with("share") ? percent_text(n) : cell(n, "1")});
  return table.html();
}

std::string energy_part(const RunFiles& run) {
  static constexpr std::pair<const char*, const char*> terms[] = {
      {"energy.elastic_J", "Stored in bonds, contacts and walls"},
      {"energy.kinetic_J", "Kinetic"},
      {"energy.friction_J", "Dissipated by friction"},
      {"energy.damping_J", "Dissipated by damping"},
      {"energy.contact_J", "Dissipated otherwise in contacts"},
      {"energy.fracture_J", "Released by fracture"}};
  const double work = run.number("energy.boundary_work_J"), initial = run.number("energy.initial_J");
  if (std::isnan(work)) return {};
  const double whole = work + (std::isnan(initial) ? 0 : initial);
  double largest = std::abs(whole);
  for (const auto& [path, title] : terms) largest = std::max(largest, std::abs(run.number(path)));
  Table table("Energy at the end, against the work done at the boundary and what was there at the beginning");
  table.column("Term").column("Energy", Table::Is::number).column("Share", Table::Is::number).column("");
  const auto add = [&](const char* title, double value, bool foot) {
    if (std::isnan(value)) return;
    const double part = whole != 0 ? value / whole : 0;
    const int width = std::clamp(int(std::lround(100 * part)), 0, 100);
    std::vector<std::string> row{
        title, shown_quantity(value, "J", largest).text(), whole != 0 ? percent_text(part) : "",
        foot ? "" : "<span class=\"bar\"><i style=\"width:" + std::to_string(width) + "%\"></i></span>"};
    foot ? table.foot(row) : table.row(row);
  };
  for (const auto& [path, title] : terms) add(title, run.number(path), false);
  add("Work at the boundary", work, true);
  add("Present at the beginning", initial, true);
  add("Unaccounted for at the end", run.number("energy.error_J"), true);
  std::string out = table.html();
  const double worst = run.number("energy.largest_relative_error");
  if (!std::isnan(worst))
    out += "<p>At no sample was more than <strong>" + percent_text(worst) +
           "</strong> of the largest work at the boundary unaccounted for.</p>\n";
  return out;
}

std::string other_numbers(const RunFiles& run) {
  static const std::set<std::string> told{"packing", "energy", "damage", "reference",
                                          "units",   "values", "format", "environment"};
  Table table("Numbers of each plugin");
  table.column("Name in summary.json").column("Value", Table::Is::number);
  for (const auto& [owner, section] : run.summary.items()) {
    if (!section.is_object() || told.contains(owner)) continue;
    for (const auto& [key, value] : numbers_below(section, owner + "."))
      table.row({"<code>" + escaped(key) + "</code>", cell(value, title_of(key, run.summary).unit)});
  }
  return foldable("All other numbers that were measured", table.html());
}

std::string warnings_list(const Json& warnings) {
  std::string out;
  if (warnings.is_array())
    for (const Json& w : warnings)
      if (w.is_string()) out += "<li class=\"note\">" + escaped(w.get<std::string>()) + "</li>\n";
  return out.empty() ? out : "<ul class=\"warnings\">\n" + out + "</ul>\n";
}

std::string warnings_part(const RunFiles& run) {
  const Json warnings = run.result("warnings");
  const std::string list = warnings_list(warnings);
  return list.empty() && warnings.is_array() ? paragraph("The run gave none.") : list;
}

}  // namespace breccia::report
