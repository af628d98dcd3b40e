// SPDX-License-Identifier: BSD-3-Clause
/// Charts and pictures of a report: those that the results have, else those that a renderer makes of them now.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "breccia/services.hpp"
#include "plugin/registry.hpp"
#include "report/run_files.hpp"

namespace breccia::report {

struct Figure {
  std::string name;     ///< of the file, without its ending
  std::string caption;  ///< a text
  bool chart = false;
  std::string html;  ///< `<figure>`, whole
};

/// What the input of a run says of its pictures: the field of the colours by the picture's name.
using FieldOfPicture = std::map<std::string, std::string>;
FieldOfPicture fields_of_pictures(const Json& input);

/// Of files below `folder`. An SVG stands for the PNG of its name. What is no picture, or cannot be read, is left out;
/// the latter with a warning. `prefix`: of ids in the page.
std::vector<Figure> figures_of(const std::filesystem::path& folder, const std::vector<std::string>& files,
                               const Registry& registry, const std::string& prefix, Host& host,
                               const FieldOfPicture& fields = {});

/// Of a run. When it has no chart, `renderer` draws into a folder that is gone afterwards, and what the run has not is
/// taken from there.
std::vector<Figure> figures_of_run(const RunFiles& run, const std::optional<PluginChoice>& renderer,
                                   const Registry& registry, Host& host);

/// Those that are charts, or those that are not, one after the other.
std::string charts_html(const std::vector<Figure>& figures);
std::string pictures_html(const std::vector<Figure>& figures);

}  // namespace breccia::report
