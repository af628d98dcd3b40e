// SPDX-License-Identifier: BSD-3-Clause
// What a study varied and kept, in the words of a methods section.
#include <algorithm>
#include <cmath>

#include "report/methods.hpp"
#include "report/quantity.hpp"
#include "report/study_files.hpp"

namespace breccia::report {
namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " and " : ", ") + words[k];
  return text;
}

/// "10, 20 and 30 GPa", "25 values from 1 to 4 GPa".
std::string values_text(const StudyColumn& column, const std::vector<Json>& values) {
  constexpr std::size_t most_listed = 8;
  const bool numbers = std::all_of(values.begin(), values.end(), [](const Json& v) { return v.is_number(); });
  std::vector<std::string> words;
  if (!numbers) {
    for (const Json& v : values) {  // of a file's path its name: where it lay is nobody's business
      const std::string word = v.is_string() ? v.get<std::string>() : v.dump();
      words.push_back(v.is_string() ? "“" + word.substr(word.rfind('/') + 1) + "”" : word);
    }
    return words.size() > most_listed ? std::to_string(words.size()) + " values" : listed(words);
  }
  std::vector<double> sorted;
  for (const Json& v : values) sorted.push_back(v.get<double>());
  std::sort(sorted.begin(), sorted.end());
  const double like = std::max(std::abs(sorted.front()), std::abs(sorted.back()));
  const std::string unit = shown_quantity(like, column.unit).unit, behind = unit.empty() ? "" : "\u00A0" + unit;
  for (const double v : sorted) words.push_back(shown_quantity(v, column.unit, like).number);
  if (words.size() > most_listed)
    return std::to_string(words.size()) + " values from " + words.front() + " to " + words.back() + behind;
  return listed(words) + behind;
}

std::vector<Json> different(const StudyFiles& study, std::size_t input) {
  std::vector<Json> values;
  for (const StudyCase& c : study.cases)
    if (std::find(values.begin(), values.end(), c.inputs[input]) == values.end()) values.push_back(c.inputs[input]);
  return values;
}

/// Of the finished cases: the same in all, or from the least to the largest.
std::string achieved_text(const StudyFiles& study, const char* key, const char* what) {
  for (std::size_t k = 0; k < study.values.size(); ++k) {
    if (study.values[k].key != key) continue;
    const std::vector<double> numbers = study.numbers(k);
    if (numbers.empty()) return {};
    const double least = *std::min_element(numbers.begin(), numbers.end()),
                 most = *std::max_element(numbers.begin(), numbers.end());
    const auto shown = [&](double v) { return shown_quantity(v, study.values[k].unit, most).text(); };
    if (shown(least) == shown(most)) return what + std::string(" of ") + shown(least);
    return what + std::string(" from ") + shown(least) + " to " + shown(most);
  }
  return {};
}

}  // namespace

std::vector<std::string> methods_text(const StudyFiles& study) {
  std::string text = "The study had " + std::to_string(study.cases.size()) + " cases";
  const std::size_t open = study.cases.size() - study.finished();
  text += open == 0 ? "." : ", of which " + std::to_string(study.finished()) + " have results.";
  std::vector<std::string> varied;
  std::size_t packings = 0;
  for (std::size_t k = 0; k < study.inputs.size(); ++k) {
    const std::vector<Json> values = different(study, k);
    if (study.inputs[k].is_seed()) packings = values.size();
    else varied.push_back(study.inputs[k].title + " (" + values_text(study.inputs[k], values) + ")");
  }
  if (!varied.empty()) text += " They differed in " + listed(varied) + ".";
  if (packings > 1) text += " There were " + std::to_string(packings) + " packings, by as many seeds, of each kind.";
  std::vector<std::string> achieved;
  for (const auto& [key, what] : {std::pair("particles", "numbers of particles"), std::pair("porosity", "porosities"),
                                  std::pair("coordination_number", "coordination numbers")})
    if (std::string said = achieved_text(study, key, what); !said.empty()) achieved.push_back(std::move(said));
  if (!achieved.empty()) text += " Their specimens had " + listed(achieved) + ".";
  std::vector<std::string> all{text};
  for (const RunFiles& run : study.examples) {
    all.push_back("For what the cases have in common" +
                  std::string(study.examples.size() > 1 ? " by the workflow “" + run.name() + "”" : "") +
                  ", the case “" + run.folder.filename().string() + "” stands here.");
    for (std::string& said : methods_text(run)) all.push_back(std::move(said));
  }
  return all;
}

}  // namespace breccia::report
