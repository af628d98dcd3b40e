// SPDX-License-Identifier: BSD-3-Clause
/// The names of plugins in lists.
#include <algorithm>

#include "config/listed_plugin.hpp"
#include "config/result_name.hpp"
#include "config/section_reader.hpp"

namespace breccia {

const ParamSpec& name_in_list() {
  static const ParamSpec spec = [] {
    ParamSpec s;
    s.name = "name";
    s.type = ParamType::text;
    s.doc =
        "tells it from others of its type in this list: goes in front of its curves, fields, tables and results "
        "(`upper_...`), and before the type in the folder of its files. Letters, digits, `_` and `-`";
    s.example = "upper";
    s.required = false;
    return s;
  }();
  return spec;
}

bool takes_name(const ParamSpec& plugin) {
  return std::none_of(plugin.members.begin(), plugin.members.end(),
                      [](const ParamSpec& m) { return m.name == name_in_list().name; });
}

ParamSpec as_listed(const ParamSpec& plugin) {
  ParamSpec listed = plugin;
  if (takes_name(plugin)) listed.members.insert(listed.members.begin(), name_in_list());
  return listed;
}

/// It becomes part of the names of columns, fields, keys and files.
void SectionReader::check_name(const YamlNode& plugin, const Json& section, const Site& site) {
  const auto name = section.find(name_in_list().name);
  if (name == section.end() || !name->is_string()) return;
  const std::string text = *name;
  std::string why = why_not_a_file_name(text);
  const auto is_fine = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || static_cast<unsigned char>(c) > 127;
  };
  if (why.empty())
    if (const auto bad = std::find_if_not(text.begin(), text.end(), is_fine); bad != text.end())
      why = std::string("has `") + *bad + "` in it: letters, digits, `_` and `-` are possible";
  if (!why.empty())
    report(plugin.find(name_in_list().name)->value->place, member_path(site.path, name_in_list().name),
           "`" + text + "` cannot be the name of a plugin, it " + why);
}

/// Two that go by one name would write the same curves, results, files or pictures over each other.
void SectionReader::check_twins(const ParamSpec& list, const Json& all, const std::vector<Site>& sites) {
  const auto text = [](const Json& section, const char* key) {
    const auto found = section.is_object() ? section.find(key) : section.end();
    return found != section.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto label = [&](const Json& section) {  // as `result_label` makes it
    const std::string name = text(section, "name");
    return name.empty() ? text(section, "type") : name + "_" + text(section, "type");
  };
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t first = 0; first < k; ++first) {
      const std::string type = text(all[k], "type"), name = text(all[k], "name");
      if (type.empty() || label(all[k]) != label(all[first])) continue;
      const std::string both =
          ": both would write the same " + std::string(list.plugin_kind == "postprocessor" ? "curves and results"
                                                       : list.plugin_kind == "renderer"    ? "pictures"
                                                       : list.plugin_kind == "contact_law" ? "history and results"
                                                                                           : "files");
      const std::string other = " (the first is " + sites[first].path + ")" + both;
      report(sites[k].place, sites[k].path,
             name.empty()
                 ? "a second `" + type + "`" + other + "; keep one of them, or give it a name: `{type: " + type +
                       ", name: upper}`"
                 : "a second `" + type + "` that goes by `" + label(all[k]) + "`" + other + "; give it another `name`");
      break;
    }
}

}  // namespace breccia
