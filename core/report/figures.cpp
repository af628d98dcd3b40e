// SPDX-License-Identifier: BSD-3-Clause
#include "report/figures.hpp"

#include <algorithm>

#include "breccia/text_file.hpp"
#include "config/at_path.hpp"
#include "report/html.hpp"
#include "report/quantity.hpp"
#include "report/svg.hpp"
#include "results/summary_keys.hpp"
#include "results/temporary_folder.hpp"
#include "run/render.hpp"

namespace breccia::report {

namespace fs = std::filesystem;

namespace {

/// The meaning of a choice of that name in the parameters of a renderer: pictures are named after what they show.
std::string meaning_of(const ParamSpec& spec, const std::string& name) {
  for (const Choice& c : spec.choices)
    if (c.name == name && spec.name == "show") return c.doc;
  for (const ParamSpec& member : spec.members)
    if (std::string found = meaning_of(member, name); !found.empty()) return found;
  return {};
}

std::string caption_of(const std::string& name, const Registry& registry, const FieldOfPicture& fields) {
  if (const auto field = fields.find(name); field != fields.end())
    return capital(readable(name)) + ": coloured by " + readable(field->second);
  for (const std::string& renderer : registry.names("renderer")) {
    try {
      std::string doc = meaning_of(registry.documentation("renderer", renderer).root, name);
      doc = doc.substr(0, doc.find(", .png"));
      doc = doc.substr(0, doc.find(" ("));
      std::erase(doc, '`');
      if (!doc.empty()) return capital(readable(name)) + ": " + doc;
    } catch (const UserError&) {}  // of no use here: the name says enough
  }
  return capital(readable(name));
}

std::string media_type(const fs::path& file) {
  if (has_ending(file, ".svg")) return "image/svg+xml";
  if (has_ending(file, ".png")) return "image/png";
  if (has_ending(file, ".jpg") || has_ending(file, ".jpeg")) return "image/jpeg";
  return {};
}

bool begins_as_it_should(const fs::path& file, const std::string& bytes) {
  if (has_ending(file, ".png")) return bytes.starts_with("\x89PNG\r\n\x1A\n");
  if (has_ending(file, ".svg")) return bytes.find("<svg") != bytes.npos;
  return bytes.starts_with("\xFF\xD8");  // JPEG
}

/// "upper_vtk/cracks" is told apart from "cracks".
std::string stem_of(const std::string& file) { return (fs::path(file).parent_path() / fs::path(file).stem()).string(); }

Figure figure_of(const fs::path& folder, const std::string& file, const std::string& prefix, const Registry& registry,
                 const FieldOfPicture& fields) {
  Figure f;
  f.name = stem_of(file);
  f.chart = has_ending(file, ".svg");
  const std::string bytes = read_bytes(folder / file), stem = fs::path(file).stem().string();
  if (!begins_as_it_should(file, bytes))
    throw UserError((folder / file).string() + " is not the picture that its name says");
  f.caption = caption_of(stem, registry, fields);
  std::string markup;
  if (f.chart) {
    if (auto svg = inline_svg(bytes, prefix, f.caption)) {
      if (!svg->title.empty()) f.caption = capital(svg->title);
      markup = std::move(svg->markup);
    }
  }
  if (fs::path(file).has_parent_path()) f.caption += " (" + fs::path(file).parent_path().string() + ")";
  if (markup.empty())
    markup =
        "<img alt=\"" + escaped(f.caption) + "\" src=\"data:" + media_type(file) + ";base64," + base64(bytes) + "\">";
  f.html = std::string("<figure") + (f.chart ? " class=\"chart\"" : "") + ">\n" + markup + "\n<figcaption>" +
           escaped(f.caption) + "</figcaption>\n</figure>\n";
  return f;
}

bool has_chart(const std::vector<std::string>& files) {
  return std::any_of(files.begin(), files.end(), [](const std::string& f) { return has_ending(f, ".svg"); });
}

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) all.push_back(entry.path().lexically_relative(folder).generic_string());
  std::sort(all.begin(), all.end());
  return all;
}

/// Which kind of chart is looked at first.
int rank(const Figure& f) {
  static constexpr const char* first[] = {"stress_strain", "load_curve", "strains", "specimen", "cutaway", "cracks"};
  return int(std::find(std::begin(first), std::end(first), f.name) - std::begin(first));
}

}  // namespace

std::vector<Figure> figures_of(const fs::path& folder, const std::vector<std::string>& files, const Registry& registry,
                               const std::string& prefix, Host& host, const FieldOfPicture& fields) {
  std::vector<Figure> all;
  for (const std::string& file : files) {
    if (media_type(file).empty()) continue;
    const bool drawn_too =
        !has_ending(file, ".svg") && std::any_of(files.begin(), files.end(), [&](const std::string& other) {
          return has_ending(other, ".svg") && stem_of(other) == stem_of(file);
        });
    if (drawn_too) continue;
    try {
      all.push_back(figure_of(folder, file, prefix + std::to_string(all.size() + 1) + "-", registry, fields));
    } catch (const UserError& e) { host.warn(std::string("left out of the report: ") + e.what()); }
  }
  std::stable_sort(all.begin(), all.end(), [](const Figure& a, const Figure& b) { return rank(a) < rank(b); });
  return all;
}

FieldOfPicture fields_of_pictures(const Json& input) {
  FieldOfPicture fields;
  const Json* renderers = value_at(input, "renderers");
  if (!renderers || !renderers->is_array()) return fields;
  for (const Json& renderer : *renderers) {
    const Json* pictures = value_at(renderer, "pictures");
    if (!pictures || !pictures->is_array()) continue;
    for (const Json& p : *pictures) {
      const Json *field = value_at(p, "field"), *name = value_at(p, value_at(p, "name") ? "name" : "show");
      if (field && name && field->is_string() && name->is_string())
        fields[name->get<std::string>()] = field->get<std::string>();
    }
  }
  return fields;
}

std::vector<Figure> figures_of_run(const RunFiles& run, const std::optional<PluginChoice>& renderer,
                                   const Registry& registry, Host& host) {
  std::vector<Figure> all = figures_of(run.folder, run.files, registry, "figure-", host, fields_of_pictures(run.input));
  if (has_chart(run.files) || !renderer) return all;
  const TemporaryFolder workshop(fs::temp_directory_path(), "breccia-report");
  host.info("drawing charts: the run has none");
  render_all({*renderer}, registry, {run.folder, workshop.path()}, host);
  const bool has_pictures = !all.empty();
  for (Figure& f : figures_of(workshop.path(), files_below(workshop.path()), registry, "drawn-", host))
    if (f.chart || !has_pictures) all.push_back(std::move(f));  // the run chose its own pictures
  std::stable_sort(all.begin(), all.end(), [](const Figure& a, const Figure& b) { return rank(a) < rank(b); });
  return all;
}

std::string charts_html(const std::vector<Figure>& figures) {
  std::string out;
  for (const Figure& f : figures)
    if (f.chart) out += f.html;
  return out;
}

std::string pictures_html(const std::vector<Figure>& figures) {
  std::string out;
  for (const Figure& f : figures)
    if (!f.chart) out += f.html;
  return out.empty() ? "" : "<div class=\"figures\">\n" + out + "</div>\n";
}

}  // namespace breccia::report
