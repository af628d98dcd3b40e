// SPDX-License-Identifier: BSD-3-Clause
#include "curves_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "breccia/schema.hpp"
#include "breccia/text_file.hpp"
#include "suggest.hpp"

namespace breccia::pictures {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') cells.emplace_back();
    else if (c != '"') cells.back() += c;
  }
  return cells;
}

/// What the file beside says of names and units; nothing where there is none.
std::vector<Curve> described_curves(std::filesystem::path file, const std::vector<std::string>& headers) {
  file.replace_extension(".json");
  if (!std::filesystem::exists(file)) return {};
  const Json described = Json::parse(read_text_file(file), nullptr, false);
  const auto text = [](const Json& object, const char* name) {  // empty when it is none
    const auto at = object.find(name);
    return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
  };
  std::vector<Curve> curves;
  for (const std::string& header : headers) {
    const auto at =
        !described.is_array() ? described.end() : std::find_if(described.begin(), described.end(), [&](const Json& c) {
          return c.is_object() && text(c, "header") == header;
        });
    if (at == described.end()) return {};  // of another table
    const std::string name = text(*at, "name"), unit = text(*at, "unit");
    const std::string role = at->contains("role") ? text(*at, "role") : std::string(role::of_name(name));
    curves.push_back({name.empty() ? header : name, unit == "1" ? "" : unit, {}, text(*at, "doc"), role});
  }
  return curves;
}

/// Of a table that an older Breccia wrote, without such a file: divides "axial_stress_Pa" into name and unit: the
/// longest unit that ends the header. What ends in none is a pure number.
Curve curve_named(const std::string& header) {
  static constexpr std::pair<std::string_view, const char*> units[] = {{"Pa", "Pa"},       {"s", "s"},
                                                                       {"m", "m"},         {"N", "N"},
                                                                       {"J", "J"},         {"kg", "kg"},
                                                                       {"rad", "rad"},     {"m2", "m2"},
                                                                       {"m3", "m3"},       {"N_m", "N m"},
                                                                       {"m_s", "m/s"},     {"m_s2", "m/s2"},
                                                                       {"rad_s", "rad/s"}, {"N_s", "N s"},
                                                                       {"Pa_s", "Pa s"},   {"N_s_m", "N s/m"},
                                                                       {"J_m2", "J/m2"},   {"J_m3", "J/m3"},
                                                                       {"kg_m3", "kg/m3"}, {"Pa_m", "Pa/m"},
                                                                       {"N_m2", "N/m2"},   {"N_m_rad", "N m/rad"}};
  std::size_t length = 0;
  const char* unit = "";
  for (const auto& [suffix, shown] : units)
    if (suffix.size() > length && header.size() > suffix.size() + 1 && header.ends_with("_" + std::string(suffix))) {
      length = suffix.size();
      unit = shown;
    }
  const std::string name = length > 0 ? header.substr(0, header.size() - length - 1) : header;
  return {name, unit, {}, {}, std::string(role::of_name(name))};
}

}  // namespace

CurvesFile::CurvesFile(const std::filesystem::path& file) : file_(file) {
  std::istringstream in(read_text_file(file));
  std::string line;
  if (!std::getline(in, line)) throw UserError("renderer pictures: " + file.string() + " is empty");
  headers_ = split(line);
  curves_ = described_curves(file, headers_);
  if (curves_.empty())
    for (const std::string& h : headers_) curves_.push_back(curve_named(h));
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    const auto cells = split(line);
    const auto where = [&] {
      return "renderer pictures: " + file.string() + ", line " + std::to_string(number) + ": ";
    };
    if (cells.size() != headers_.size())
      throw UserError(where() + std::to_string(cells.size()) + " values for " + std::to_string(headers_.size()) +
                      " columns");
    for (std::size_t c = 0; c < cells.size(); ++c) {
      double value = std::numeric_limits<double>::quiet_NaN();  // an empty cell: not measured
      const char *begin = cells[c].data(), *end = begin + cells[c].size();
      if (begin != end && std::from_chars(begin, end, value).ptr != end)
        throw UserError(where() + "`" + cells[c] + "` is not a number");
      curves_[c].value.push_back(value);
    }
  }
}

const Curve* CurvesFile::find(const std::string& name) const {
  for (std::size_t c = 0; c < curves_.size(); ++c)
    if (headers_[c] == name || curves_[c].name == name) return &curves_[c];
  return nullptr;
}

const Curve& CurvesFile::at(const std::string& name) const {
  if (const Curve* c = find(name)) return *c;
  std::vector<std::string> names = headers_;
  for (const Curve& c : curves_) names.push_back(c.name);
  const auto nearest = nearest_of(name, names);
  throw UserError(
      file_.filename().string() + " has no column `" + name + "`; " +
      (nearest ? "did you mean `" + headers_[*nearest % headers_.size()] + "`?" : "it has: " + first_of(headers_)));
}

}  // namespace breccia::pictures
