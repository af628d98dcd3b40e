// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "breccia/shown_unit.hpp"
#include "breccia/utf8.hpp"
#include "compare/compare.hpp"
#include "results/summary_keys.hpp"

namespace breccia {
namespace {

/// Adds the new ones of `more`, each behind its section or else its predecessor: what belongs together stays together.
void merge(std::vector<std::string>& keys, const std::vector<std::string>& more) {
  std::size_t at = 0;
  for (const std::string& key : more) {
    const auto it = std::find(keys.begin(), keys.end(), key);
    const std::string section = key.substr(0, key.find('.') + 1);  // empty at the top level
    if (it == keys.end() && !section.empty() && !(at > 0 && keys[at - 1].starts_with(section)))
      for (std::size_t k = 0; k < keys.size(); ++k)
        if (keys[k].starts_with(section)) at = k + 1;
    if (it != keys.end()) at = std::size_t(it - keys.begin()) + 1;
    else keys.insert(keys.begin() + std::ptrdiff_t(at++), key);
  }
}

std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "\\|" : c == '\n' || c == '\r' ? " " : std::string(1, c);
  return out;
}

/// The value of a key, or null.
Json value_of(const Json& object, const std::string& key) {
  const auto it = object.find(key);
  return it == object.end() ? Json() : *it;
}

Json reference_of(const ComparedRun& run, const std::string& key) {
  const Json reference = value_of(run.summary, "reference");
  return reference.is_object() ? value_of(reference, key) : Json();
}

bool has_references(const ComparedRun& run) {
  const Json reference = value_of(run.summary, "reference");
  return reference.is_object() &&
         std::any_of(reference.begin(), reference.end(), [](const Json& v) { return v.is_number(); });
}

/// One row of the table: the quantity, with the prefix that suits the largest of its values.
class Row {
 public:
  Row(const std::string& key, const std::vector<ComparedRun>& runs) : key_(key) {
    for (const ComparedRun& run : runs) {
      const TitleAndUnit said = title_of(key, run.summary);
      if (name_.empty() || !said.unit.empty()) {
        name_ = said.title;
        unit_ = said.unit;
      }
    }
    double largest = 0;
    for (const ComparedRun& run : runs)
      for (const Json& v : {value_of(run.summary, key_), reference_of(run, key_)})
        if (v.is_number()) largest = std::max(largest, std::abs(v.get<double>()));
    const ShownUnit shown = shown_unit(unit_, largest);
    unit_ = shown.unit;
    factor_ = shown.factor;
  }

  std::string title() const { return unit_.empty() ? name_ : name_ + " (" + unit_ + ")"; }

  std::string shown(const Json& v) const {
    if (v.is_boolean()) return v.get<bool>() ? "yes" : "no";
    if (v.is_number_integer()) return v.dump();
    if (v.is_number()) return fmt::format("{:.5g}", v.get<double>() * factor_);
    return v.is_string() ? markdown_cell(v.get<std::string>()) : "";
  }

  /// "299.91 (+5.5 %)", or only the reference where the run has no value.
  std::string compared(const ComparedRun& run) const {
    const Json reference = reference_of(run, key_), value = value_of(run.summary, key_);
    if (!reference.is_number()) return "";
    const double r = reference.get<double>();
    if (!value.is_number() || r == 0) return shown(reference);
    return fmt::format("{} ({:+.1f} %)", shown(reference), 100 * (value.get<double>() / r - 1) + 0.0);
  }

 private:
  std::string key_, name_, unit_;
  double factor_ = 1;
};

std::vector<std::string> quantities(const std::vector<ComparedRun>& runs) {
  std::vector<std::string> keys;
  for (const ComparedRun& run : runs) {
    std::vector<std::string> own;
    for (const auto& [key, value] : run.summary.items())
      if (!value.is_structured() && !is_bookkeeping(key)) own.push_back(key);
    merge(keys, own);
  }
  return keys;
}

}  // namespace

std::string comparison_csv(const std::vector<ComparedRun>& runs) {
  std::vector<std::vector<std::pair<std::string, Json>>> rows;
  std::vector<std::string> keys;
  for (const ComparedRun& run : runs) {
    rows.push_back(numbers_below(run.summary));
    std::vector<std::string> own;
    for (const auto& [key, value] : rows.back()) own.push_back(key);
    merge(keys, own);
  }
  std::string text = "label";
  for (const std::string& key : keys) text.append(",").append(csv_cell(key));
  for (std::size_t k = 0; k < runs.size(); ++k) {
    text.append("\n").append(csv_cell(runs[k].label));
    for (const std::string& key : keys) {
      const auto it = std::find_if(rows[k].begin(), rows[k].end(), [&](const auto& cell) { return cell.first == key; });
      text.append(",").append(it == rows[k].end() || it->second.is_null() ? "" : json_text(it->second));
    }
  }
  return text + "\n";
}

std::string comparison_markdown(const std::vector<ComparedRun>& runs,
                                const std::vector<std::filesystem::path>& charts) {
  std::string header = "| |", rule = "|---|", rows;
  for (const ComparedRun& run : runs) {
    header.append(" ").append(markdown_cell(run.label)).append(has_references(run) ? " | reference |" : " |");
    rule += has_references(run) ? "---:|---:|" : "---:|";
  }
  for (const std::string& key : quantities(runs)) {
    const Row row(key, runs);
    rows.append("| ").append(markdown_cell(row.title())).append(" |");
    for (const ComparedRun& run : runs) {
      rows.append(" ").append(row.shown(value_of(run.summary, key))).append(" |");
      if (has_references(run)) rows.append(" ").append(row.compared(run)).append(" |");
    }
    rows += "\n";
  }
  std::string text = "# Comparison\n\n" + header + "\n" + rule + "\n" + rows + "\n";
  if (std::any_of(runs.begin(), runs.end(), has_references))
    text += "In brackets: how far the run lies above (+) or below (-) its reference. ";
  text += "All numbers in SI units: `comparison.csv`.\n\n";
  for (const ComparedRun& run : runs) {
    text +=
        "- **" + run.label + "**: `" + run.folder.string() + "`" + (run.interrupted ? ", stopped before its end" : "");
    const Json source = reference_of(run, "source");
    text += (source.is_string() ? "; reference: " + source.get<std::string>() : "") + "\n";
  }
  for (const std::filesystem::path& chart : charts)
    if (chart.extension() == ".png")
      text += "\n![" + chart.stem().string() + "](<" + chart.filename().string() + ">)\n";
  return text;
}

}  // namespace breccia
