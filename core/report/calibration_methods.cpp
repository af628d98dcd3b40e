// SPDX-License-Identifier: BSD-3-Clause
// What a calibration sought and found, in the words of a methods section.
#include <cmath>

#include "report/calibration_files.hpp"
#include "report/methods.hpp"
#include "report/quantity.hpp"

namespace breccia::report {
namespace {

/// "modulus (1.96 ± 0.16 GPa), strength (...) and ...".
template <class Text>
std::string listed(const std::vector<CalibratedQuantity>& all, const Text& text) {
  std::string out;
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::string title = all[k].name;
    for (char& ch : title)
      if (ch == '_') ch = ' ';
    out += (k == 0 ? "" : k + 1 == all.size() ? " and " : ", ") + title + " (" + text(all[k]) + ")";
  }
  return out;
}

}  // namespace

std::vector<std::string> methods_text(const CalibrationFiles& c) {
  const std::size_t runs = c.count("runs"), failed = c.count("failed_runs");
  std::string text = "Sought were " +
                     listed(c.parameters, [](const CalibratedQuantity& p) { return p.ends("range", 6); }) +
                     ", such that simulated tests give what the laboratory measured: " +
                     listed(c.targets,
                            [](const CalibratedQuantity& t) {
                              return t.number(t.value("wanted")) + " ± " + t.text(t.value("scatter_of_experiment"), 2);
                            }) +
                     ". " + std::to_string(runs) + " runs were made at " + std::to_string(c.count("points")) +
                     " points, each with packings of its own";
  text += failed == 0 ? "." : ", of which " + std::to_string(failed) + " have no result.";
  if (!c.search().empty())
    text += " The search “" + c.search() + "” proposed the points by what earlier ones had given.";
  std::vector<std::string> all{text};
  const bool has_best = !c.parameters.empty() && std::isfinite(c.parameters[0].value("best"));
  if (has_best) {
    std::string found =
        "Best were " + listed(c.parameters, [](const CalibratedQuantity& p) {
          const std::string best = p.text(p.value("best"));
          return std::isfinite(p.value("interval_90.0")) ? best + "; 90 % interval " + p.ends("interval_90", 3) : best;
        });
    const double packings = c.targets.empty() ? 0 : c.targets[0].value("packings");
    if (packings > 0)
      found += ". There, packings that the search had not seen gave " +
               listed(c.targets, [](const CalibratedQuantity& t) { return t.text(t.value("measured")); });
    all.push_back(found + ".");
  }
  for (const RunFiles& run : c.examples) {
    all.push_back("For what the runs have in common by the workflow “" + run.name() + "”, the run “" +
                  run.folder.filename().string() + "” stands here.");
    for (std::string& said : methods_text(run)) all.push_back(std::move(said));
  }
  return all;
}

}  // namespace breccia::report
