// SPDX-License-Identifier: BSD-3-Clause
#include "report/methods.hpp"

#include <algorithm>
#include <cmath>

#include "report/html.hpp"
#include "report/quantity.hpp"
#include "report/run_parts.hpp"
#include "results/summary_keys.hpp"

namespace breccia::report {
namespace {

std::string type_of(const Json& section) {
  return section.is_object() && section.contains("type") && section["type"].is_string()
             ? readable(section["type"].get<std::string>())
             : std::string();
}

std::string si(double value, const char* unit) { return shown_quantity(value, unit).text(); }

std::string number(double value) { return number_text(value); }

/// "bond modulus 30 GPa, stiffness ratio 3, ..."; `left_out`: beginnings of keys that are told elsewhere, or decide
/// nothing about the result.
std::string parameter_list(const Json& section, std::initializer_list<std::string_view> left_out = {}) {
  std::string out;
  for (const auto& [key, value] : section.items()) {
    const std::string text = value_text(value);
    const bool is_left_out =
        std::any_of(left_out.begin(), left_out.end(), [&, k = key](std::string_view b) { return k.starts_with(b); });
    if (key == "type" || text.empty() || is_left_out) continue;
    out += (out.empty() ? "" : ", ") + readable(key) +
           (value.is_object() ? " (" + text + ")" : (is_quantity(value) ? " " : ": ") + text);
  }
  return out;
}

/// "a cylinder 10 mm in diameter and 20 mm in height".
std::string container_text(const Json& container) {
  if (!container.is_object()) return {};
  std::string sizes;
  for (const auto& [key, value] : container.items()) {
    const std::string text = value_text(value);
    if (key == "shape" || text.empty()) continue;
    sizes += (sizes.empty() ? "" : ", ") + readable(key) + " " + text;
  }
  const Json shape = container.value("shape", Json());
  return "a " + (shape.is_string() ? readable(shape.get<std::string>()) : std::string("container")) +
         (sizes.empty() ? "" : " (" + sizes + ")");
}

/// The diameter of a cylinder, or the shortest side of a box; NaN when the input names none.
double width_of(const Json& container) {
  double width = number_of(at_path(container, "diameter"));
  if (const Json size = at_path(container, "size"); std::isnan(width) && size.is_array())
    for (const Json& side : size) width = std::fmin(width, number_of(side));
  return width;
}

std::string grains(const RunFiles& run) { return run.given("dimension") == 2 ? "discs" : "spheres"; }

std::string packing_text(const RunFiles& run) {
  const double particles = run.number("particles");
  const std::string method = type_of(run.given("packing")), container = container_text(run.given("packing.container"));
  std::string text = "The specimen consisted of " + number(particles) + " " + grains(run);
  if (!container.empty()) text += " in " + container;
  if (!method.empty()) text += ", packed by the method “" + method + "” (seed " + number(run.number("seed")) + ")";
  text += ".";
  const double mean = run.number("packing.radius_mean.got"), least = run.number("packing.radius_min.got"),
               most = run.number("packing.radius_max.got");
  if (!std::isnan(mean)) {
    text += " Their radii had a mean of " + si(mean, "m");
    if (const double sd = run.number("packing.radius_standard_deviation.got"); !std::isnan(sd))
      text += " and a standard deviation of " + shown_quantity(sd, "m", mean).text();
    if (!std::isnan(least) && !std::isnan(most))
      text +=
          ", from " + si(least, "m") + " to " + si(most, "m") + " (size ratio " + number_text(most / least, 3) + ")";
    text += ".";
    if (const double width = width_of(run.given("packing.container")); width > 0)
      text += " The container's smallest width was " + number_text(width / (2 * mean), 3) + " mean diameters.";
  }
  if (const double got = run.number("porosity"); !std::isnan(got)) {
    text += " The porosity was " + percent_text(got, 4);
    if (const double asked = run.number("packing.porosity.asked"); !std::isnan(asked))
      text += " (" + percent_text(asked, 4) + " asked for)";
    text += ".";
  }
  if (const double z = run.number("coordination_number"); !std::isnan(z))
    text += " " + number(run.number("bonds")) + " bonds were made, a coordination number of " + number(z) + ".";
  return text;
}

std::string law_text(const RunFiles& run) {
  std::string text;
  const std::vector<Json> laws = run.laws();
  for (const Json& law : laws) {
    const std::string values = parameter_list(law);
    text += (text.empty() ? (laws.size() > 1 ? "The forces of these contact laws added up: “"
                                             : "Particles interacted by the contact law “")
                          : "; “") +
            type_of(law) + "”" + (values.empty() ? "" : " with " + values);
  }
  if (!text.empty()) text += ".";
  if (const std::string density = value_text(run.given("material.density")); !density.empty())
    text += " The density of the particles was " + density + ".";
  return text;
}

std::string test_text(const RunFiles& run) {
  const Json protocol = run.given("protocol");
  std::string text;
  if (const std::string type = type_of(protocol); !type.empty()) {
    const std::string values = parameter_list(protocol, {"stop_", "max_", "seating_"});
    text = "The test was “" + type + "”" + (values.empty() ? "" : " with " + values) + ".";
  }
  if (const auto rate = strain_rate(run)) {
    text += " From the beginning of loading to the largest load the " + readable(rate->curve) +
            " grew at a mean rate of " + si(rate->rate, "1/s");
    const double inertial = inertial_number(run, rate->rate);
    if (!std::isnan(inertial))
      text += ", an inertial number of " + number_text(inertial, 2) +
              " (rate times mean diameter times the square root of density over the largest mean stress, " +
              si(run.number("stress.largest_mean_stress_Pa"), "Pa") + ")";
    text += ".";
  }
  if (!protocol.is_object() || !protocol.contains("type") || !protocol["type"].is_string()) return text;
  const double unbalanced = run.number(protocol["type"].get<std::string>() + ".unbalanced_force_ratio_max_before_peak");
  if (!std::isnan(unbalanced))
    text += " The mean resultant force on a particle was at most " + percent_text(unbalanced, 2) +
            " of the mean contact force before the peak.";
  return text;
}

std::string step_text_of(const RunFiles& run) {
  std::string text;
  if (const Json damping = run.given("damping"); damping.is_object())
    text += "The coefficients of the local, non-viscous damping were " +
            value_text(damping.value("translational", Json(0))) + " (translation) and " +
            value_text(damping.value("rotational", Json(0))) + " (rotation).";
  const double step = run.number("time_step_s"), critical = run.number("critical_time_step_s");
  if (!std::isnan(step)) {
    text += " The time step was " + si(step, "s");
    if (critical > 0) text += ", " + number_text(step / critical, 3) + " of the critical one";
    text += ".";
  }
  if (const double error = run.number("energy.largest_relative_error"); !std::isnan(error))
    text += " The energy balance closed to " + percent_text(error, 2) + " of the work done at the boundary.";
  return text;
}

/// What stress and strain are, in the words that stand beside their curves.
std::string measures_text(const RunFiles& run) {
  std::string text;
  const auto tell = [&](const Json& wanted, const char* fallback, const char* what) {
    const Curve* c = run.curve(wanted.is_string() ? wanted.get<std::string>() : fallback);
    if (c && !c->doc.empty())
      text += std::string(text.empty() ? "" : " ") + what + " is the " + readable(c->name) + ": " + c->doc + ".";
  };
  const Json posts = run.given("postprocessors");
  Json constants = Json::object();
  if (posts.is_array())
    for (const Json& p : posts)
      if (p.is_object() && p.value("type", Json()) == "elastic_constants" && constants.empty()) constants = p;
  if (constants.empty()) return text;
  tell(constants.value("stress", Json()), "", "Stress");
  tell(constants.value("strain", Json()), "", "Axial strain");
  tell(constants.value("lateral", Json()), "", "Lateral strain");
  return text;
}

std::string software_text(const RunFiles& run) {
  const std::string version = program_version(run);
  if (version.empty()) return {};
  const Json commit = run.result("environment.commit");
  std::string text = "The simulation was made with Breccia " + version;
  if (commit.is_string() && !commit.get<std::string>().empty()) text += " (commit " + commit.get<std::string>() + ")";
  return text + ".";
}

}  // namespace

std::vector<std::string> methods_text(const RunFiles& run) {
  std::vector<std::string> all;
  const auto join = [](std::initializer_list<std::string> parts) {
    std::string text;
    for (const std::string& part : parts)
      if (!part.empty()) text += (text.empty() ? "" : " ") + part;
    return text;
  };
  for (const std::string& text : {join({packing_text(run), law_text(run)}),
                                  join({test_text(run), measures_text(run), step_text_of(run), software_text(run)})})
    if (!text.empty()) all.push_back(text);
  if (run.interrupted) all.emplace_back("The run was stopped before its end: its last values are not final.");
  return all;
}

std::string methods_html(const std::vector<std::string>& paragraphs) {
  std::string out;
  for (const std::string& text : paragraphs) out += paragraph(text);
  return out;
}

std::string methods_markdown(const std::string& title, const std::vector<std::string>& paragraphs,
                             const std::vector<std::pair<std::string, std::string>>& sources) {
  // Names and descriptions are a user's: nothing in them is to become a heading, a link or a tag.
  const auto plain = [](const std::string& text) {
    std::string out;
    for (const char c : text) {
      if (std::string_view("\\`*_[]<>#|").find(c) != std::string_view::npos) out += '\\';
      out += c == '\n' || c == '\r' ? ' ' : c;
    }
    for (std::size_t at; (at = out.find("\u00A0")) != out.npos;) out.replace(at, 2, " ");
    return out;
  };
  std::string out = "# Methods: " + plain(title) + "\n";
  for (const std::string& text : paragraphs) out += "\n" + plain(text) + "\n";
  if (!sources.empty()) out += "\n## Sources of the models\n\n";
  for (const auto& [name, source] : sources) out += "- " + name + ": " + plain(source) + "\n";
  return out;
}

}  // namespace breccia::report
