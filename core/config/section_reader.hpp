// SPDX-License-Identifier: BSD-3-Clause
/// Walks a YAML tree along its schema. Internal to the configuration.
#pragma once

#include <optional>
#include <set>

#include "config/base_chain.hpp"
#include "config/plugin_directory.hpp"
#include "config/yaml_tree.hpp"

namespace breccia {

/// Where a value stands: its path, and the place to blame for what is not there.
struct Site {
  std::string path;
  Place place;
};

class SectionReader {
 public:
  /// `files` are the sources of the places. `root` and `tree` serve to tell where a misplaced key belongs.
  SectionReader(const PluginDirectory& plugins, const std::vector<InputFile>& files, const ParamSpec& root,
                const YamlNode& tree)
      : plugins_(plugins), files_(files), root_(root), tree_(tree) {}

  /// The value in the form that ParamType documents. Meaningful only when no finding was added.
  Json read(const ParamSpec& spec, const YamlNode& node, const Site& site);
  /// The members of a group; `own_key` is not one of them ("type" of a plugin).
  Json read_members(const ParamSpec& group, const YamlNode& node, const Site& site, std::string_view own_key = {});
  /// Findings of a rule, put at the places of the values that they name.
  void add_issues(const Issues& issues, const YamlNode& node, const Site& site);

  std::vector<Finding>& findings() { return findings_; }

 private:
  // reader_sections.cpp
  Json read_list(const ParamSpec& spec, const YamlNode& node, const Site& site);
  static YamlPtr written_out(const ParamSpec& only_key, const YamlPtr& item);
  enum class In { section, list };
  Json read_plugin(const ParamSpec& spec, const YamlNode& node, const Site& site, In where);
  Json read_plugin_type(const ParamSpec& spec, const YamlNode& node, const Site& site);
  bool check_mapping(const YamlNode& node, const Site& site, const ParamSpec& spec);
  void check_known(const ParamSpec& group, const YamlNode& node, const Site& site, std::string_view own_key,
                   std::set<std::string>& meant);
  void check_alternatives(const ParamSpec& group, const YamlNode& node, const Site& site,
                          const std::set<std::string>& meant);
  bool is_decided_otherwise(const ParamSpec& group, const std::string& member, const YamlNode& node) const;
  void report_missing(const ParamSpec& member, const Site& site);
  // reader_maps.cpp
  Json read_map(const ParamSpec& spec, const YamlNode& node, const Site& site);
  Json read_distribution(const ParamSpec& spec, const YamlNode& node, const Site& site);
  Json read_changes(const ParamSpec& list, const ParamSpec& group, const YamlNode& section, const YamlNode& node,
                    const Site& site, std::string_view own_key);
  void check_changes(const ParamSpec& group, const std::string& kind, const std::string& name, const Json& config,
                     const YamlNode& node, const Site& site);
  // reader_names.cpp
  void check_name(const YamlNode& plugin, const Json& section, const Site& site);
  void check_twins(const ParamSpec& list, const Json& all, const std::vector<Site>& sites);
  // reader_values.cpp
  Json read_scalar(const ParamSpec& spec, const YamlNode& node, const Site& site);
  Json read_quantity_value(const ParamSpec& spec, const YamlNode& node, const Site& site);
  Json read_integer(const ParamSpec& spec, const YamlNode& node, const Site& site);
  Json read_boolean(const YamlNode& node, const Site& site);
  Json read_choice(const ParamSpec& spec, const YamlNode& node, const Site& site);
  Json read_path(const YamlNode& node, const Site& site);

  void report(Place place, const std::string& path, std::string text) {
    findings_.push_back({place, path, std::move(text)});
  }

  bool in_base(Place place) const { return place.source > 0 && std::size_t(place.source) < files_.size(); }
  /// The place to blame for what nobody wrote. A base need not be complete, so that is the workflow that builds on it.
  Place place_of_absent(const Site& site) const {
    return in_base(site.place) && !files_[std::size_t(site.place.source)].on_top ? files_[0].base : site.place;
  }

  const PluginDirectory& plugins_;
  const std::vector<InputFile>& files_;
  const ParamSpec& root_;
  const YamlNode& tree_;
  std::vector<Finding> findings_;
};

/// Of the value at `path` below `node`, as far down as the path names something that was written.
Place place_of(const YamlNode& node, const std::string& path, Place otherwise);

/// The section under which `key` is known elsewhere in the workflow ("contact_law"), or nothing. "" is the top level.
std::optional<std::string> section_with_key(const std::string& key, const std::string& not_this_section,
                                            const ParamSpec& root, const YamlNode& tree,
                                            const PluginDirectory& plugins);

/// What kind of value a parameter wants, with its article: "a pressure", "true or false", "a list of lengths".
std::string wanted_value(const ParamSpec& spec);

/// A line that could stand in a workflow for this parameter: "bond_modulus: 10 GPa"; empty when there is no example.
std::string example_line(const ParamSpec& spec);

}  // namespace breccia
