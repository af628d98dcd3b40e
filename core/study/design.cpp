// SPDX-License-Identifier: BSD-3-Clause
#include "study/design.hpp"

#include <algorithm>
#include <cmath>

#include "config/number.hpp"

namespace breccia {

namespace {

/// Values of several parameters that belong together: a part of every point.
struct Part {
  std::vector<StudyParameter> parameters;
  std::vector<StudyPoint> points;
};

class Designer {
 public:
  explicit Designer(std::vector<Finding>& findings) : findings_(findings) {}

  /// "parameter: [values]" lines; nothing is left of a line that is not in order.
  std::vector<std::pair<const YamlEntry*, StudyPoint>> columns(const std::string& section, const YamlNode& mapping) {
    std::vector<std::pair<const YamlEntry*, StudyPoint>> all;
    if (mapping.entries.empty())
      report(mapping.place, section, "names no parameter; write lines such as `contact_law.friction: [0.2, 0.4]`");
    for (const YamlEntry& entry : mapping.entries) {
      const std::string path = section + "." + entry.key;
      const YamlNode& list = *entry.value;
      take(entry.key, entry.place, path);
      if (list.kind == YamlNode::Kind::sequence && list.items.empty()) report(list.place, path, "has no values");
      if (list.kind == YamlNode::Kind::null)
        report(entry.place, path, "has no values; a list such as `[0.2, 0.4]` is needed");
      if (list.kind == YamlNode::Kind::scalar)
        report(list.place, path, "must be a list of values, such as `[0.2, 0.4]`, not the value `" + list.text + "`");
      if (list.kind == YamlNode::Kind::mapping)
        report(list.place, path, "must be a list of values, such as `[0.2, 0.4]`, not a mapping");
      StudyPoint values;
      for (const YamlPtr& item : list.items) {
        if (item->kind == YamlNode::Kind::null) report(item->place, path, "an item of the list has no value");
        values.push_back({entry.key, entry.place, item});
      }
      all.emplace_back(&entry, std::move(values));
    }
    return all;
  }

  Part grid(const YamlNode& mapping) {
    Part part;
    part.points.emplace_back();
    for (const auto& [entry, values] : columns("grid", mapping)) {
      part.parameters.push_back({entry->key, false});
      for (std::size_t k = 0; k < values.size(); ++k)
        for (std::size_t i = 0; i < k; ++i)
          if (value_text(*values[i].value) == value_text(*values[k].value)) {
            report(values[k].value->place, "grid." + entry->key,
                   "the value `" + value_text(*values[k].value) + "` is given twice");
            break;
          }
      std::vector<StudyPoint> more;
      for (const StudyPoint& point : part.points)
        for (const PlacedValue& value : values) {
          if (more.size() > max_cases) break;  // too many, which is told later
          more.push_back(point);
          more.back().push_back(value);
        }
      part.points = std::move(more);
    }
    return part;
  }

  Part list(const YamlNode& mapping) {
    Part part;
    const auto all = columns("list", mapping);
    for (const auto& [entry, values] : all) {
      const auto& [first, first_values] = all.front();
      part.parameters.push_back({entry->key, false});
      part.points.resize(std::max(part.points.size(), values.size()));
      for (std::size_t k = 0; k < values.size(); ++k) part.points[k].push_back(values[k]);
      if (values.size() != first_values.size() && !values.empty() && !first_values.empty())
        report(entry->value->place, "list." + entry->key,
               "has " + std::to_string(values.size()) + " values where `" + first->key + "` has " +
                   std::to_string(first_values.size()) + ": case by case, every parameter of a list needs one");
    }
    return part;
  }

  Part latin(const YamlNode& section, const LatinHypercube& hypercube) {
    Part part;
    part.points.resize(std::size_t(hypercube.samples));
    const auto unit_cube = latin_hypercube(hypercube.ranges.size(), part.points.size(), std::uint64_t(hypercube.seed));
    for (std::size_t p = 0; p < hypercube.ranges.size(); ++p) {
      const YamlNode& range = *section.find("ranges")->value->items[p];
      const std::string path = item_path("latin_hypercube.ranges", p);
      const YamlNode& parameter = *range.find("parameter")->value;
      part.parameters.push_back({hypercube.ranges[p].parameter, true});
      take(parameter.text, parameter.place, path + ".parameter");
      const auto texts = samples(hypercube.ranges[p], range, path, unit_cube[p]);
      for (std::size_t k = 0; k < texts.size(); ++k) {
        auto value = std::make_shared<YamlNode>(*range.find("from")->value);
        value->text = texts[k];
        value->plain = true;
        part.points[k].push_back({parameter.text, parameter.place, value});
      }
    }
    return part;
  }

 private:
  void report(Place place, const std::string& path, std::string text) {
    findings_.push_back({place, path, std::move(text)});
  }

  void take(const std::string& parameter, Place place, const std::string& path) {
    if (std::find(taken_.begin(), taken_.end(), parameter) != taken_.end())
      report(place, path, "`" + parameter + "` gets its values from another place of the study as well");
    taken_.push_back(parameter);
  }

  struct End {
    double value;
    std::string unit;  ///< with the blank before it
  };
  std::optional<End> end(const YamlNode& node, const std::string& path) {
    const auto number = scan_decimal(node.text);
    const auto value = number ? to_double(*number) : std::nullopt;
    if (!value) {
      report(node.place, path, "`" + node.text + "` does not begin with a number");
      return {};
    }
    return End{*value, node.text.substr(number->length)};
  }

  /// What lies at those shares of the range, as a user would write it.
  std::vector<std::string> samples(const LatinRange& range, const YamlNode& node, const std::string& path,
                                   const std::vector<double>& shares) {
    const YamlNode& to_node = *node.find("to")->value;
    const auto from = end(*node.find("from")->value, path + ".from"), to = end(to_node, path + ".to");
    if (!from || !to) return {};
    if (from->unit != to->unit) {
      report(to_node.place, path + ".to",
             "must be in the unit of `from`, `" + range.from + "`, not `" + range.to + "`");
      return {};
    }
    const bool log = range.scale == LatinScale::log;
    if (log && !(from->value > 0))
      report(node.find("from")->value->place, path + ".from",
             "must be above 0 on a log scale, not `" + range.from + "`");
    if (!(from->value < to->value))
      report(to_node.place, path + ".to", "must be above `from`, `" + range.from + "`, not `" + range.to + "`");
    if (!findings_.empty()) return {};
    const auto at = [&](double share) {
      return log ? from->value * std::pow(to->value / from->value, share)
                 : from->value + share * (to->value - from->value);
    };
    std::vector<std::string> texts;
    for (const double share : shares) {
      // Six digits are enough to read, unless they lead out of the stratum.
      const double stratum = std::floor(share * double(shares.size())), value = at(share);
      char buffer[32];
      std::snprintf(buffer, sizeof buffer, "%.6g", value);
      const double rounded = *to_double(*scan_decimal(buffer));
      const bool inside =
          rounded >= at(stratum / double(shares.size())) && rounded <= at((stratum + 1) / double(shares.size()));
      texts.push_back(format_number(inside ? rounded : value) + from->unit);
    }
    return texts;
  }

  std::vector<Finding>& findings_;
  std::vector<std::string> taken_;
};

}  // namespace

std::string value_text(const YamlNode& value) {
  return value.kind == YamlNode::Kind::scalar ? value.text : plain_json(value).dump();
}

StudyDesign make_design(const YamlNode& study, const std::optional<LatinHypercube>& hypercube,
                        std::vector<Finding>& findings) {
  Designer designer(findings);
  std::vector<Part> parts;
  if (const YamlEntry* list = study.find("list")) parts.push_back(designer.list(*list->value));
  if (hypercube) parts.push_back(designer.latin(*study.find("latin_hypercube")->value, *hypercube));
  if (const YamlEntry* grid = study.find("grid")) parts.push_back(designer.grid(*grid->value));
  if (parts.empty())
    findings.push_back(
        {study.place, "", "there is nothing to vary; one of `grid`, `list` and `latin_hypercube` is needed"});
  StudyDesign design;
  if (!findings.empty()) return design;
  double count = 1;
  for (const Part& part : parts) count *= double(part.points.size());
  if (count > double(max_cases)) {
    findings.push_back({study.place, "", "the study has more than " + std::to_string(max_cases) + " cases"});
    return design;
  }
  design.points.emplace_back();
  for (const Part& part : parts) {
    design.parameters.insert(design.parameters.end(), part.parameters.begin(), part.parameters.end());
    std::vector<StudyPoint> more;
    for (const StudyPoint& point : design.points)
      for (const StudyPoint& addition : part.points) {
        more.push_back(point);
        more.back().insert(more.back().end(), addition.begin(), addition.end());
      }
    design.points = std::move(more);
  }
  return design;
}

}  // namespace breccia
