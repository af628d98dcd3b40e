// SPDX-License-Identifier: BSD-3-Clause
#include "run/render.hpp"

#include "plugin/drawing.hpp"
#include "results/results_folder.hpp"
#include "results/temporary_folder.hpp"
#include "run/listed.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

/// Removes a new folder that nothing was put into.
struct EmptyFolder {
  fs::path folder;
  ~EmptyFolder() {
    std::error_code ignored;
    if (!folder.empty() && fs::is_empty(folder, ignored) && !ignored) fs::remove(folder, ignored);
  }
};

/// Where pictures are made, within the folder that they are for.
class Workshop {
 public:
  explicit Workshop(const fs::path& folder) : folder_(folder), own_(folder, ".pictures") {}

  const fs::path& path() const { return own_.path(); }
  fs::path place_of(const fs::path& file) const { return folder_ / file.lexically_relative(path()); }
  /// A message as it would be without the workshop.
  std::string told(std::string_view text) const {
    std::string out(text);
    const std::string own = path().string(), user = folder_.string();
    for (std::size_t at = 0; (at = out.find(own, at)) != out.npos; at += user.size()) out.replace(at, own.size(), user);
    return out;
  }

 private:
  fs::path folder_;
  TemporaryFolder own_;
};

class WorkshopHost final : public Host {
 public:
  WorkshopHost(const Workshop& workshop, Host& to) : workshop_(workshop), to_(to) {}
  void info(std::string_view text) override { to_.info(workshop_.told(text)); }
  void warn(std::string_view text) override { to_.warn(workshop_.told(text)); }
  void progress(std::string_view what, double done) override { to_.progress(what, done); }
  bool cancelled() const override { return to_.cancelled(); }
  int threads() const override { return to_.threads(); }

 private:
  const Workshop& workshop_;
  Host& to_;
};

void refuse_to_replace(const std::vector<fs::path>& places, const fs::path& folder) {
  std::error_code unknown;
  std::string first;
  std::size_t more = 0;
  for (const fs::path& place : places) {
    if (!fs::exists(fs::symlink_status(place, unknown))) continue;
    if (first.empty()) first = place.lexically_relative(folder).string();
    else ++more;
  }
  if (first.empty()) return;
  throw UserError("the folder " + folder.string() + " already holds " + first +
                  (more == 0   ? ""
                   : more == 1 ? " and one more of the pictures"
                               : " and " + std::to_string(more) + " more of the pictures") +
                  "; nothing was changed. Choose another with --output, or allow them to be replaced with --overwrite");
}

}  // namespace

namespace {

/// Those of a named renderer go into a folder of its own.
std::vector<fs::path> draw(const PluginChoice& choice, const Registry& registry, const RenderRequest& request,
                           Host& host) {
  Listed<Renderer> renderer(choice, registry);
  RenderRequest own = request;
  EmptyFolder left_over;
  if (renderer.is_named()) {
    own.directory /= renderer.label();
    std::error_code error;
    if (fs::create_directories(own.directory, error)) left_over.folder = own.directory;
    if (error) throw CannotWrite(own.directory, error.value());
  }
  return renderer.call("drawing", [&](Renderer& r) { return r.render(own, host); });
}

std::vector<fs::path> draw_all(const std::vector<PluginChoice>& renderers, const Registry& registry,
                               const RenderRequest& request, Refusal refusal, Host& host) {
  std::vector<fs::path> made;
  for (const PluginChoice& choice : renderers) {
    const auto files =
        drawn("pictures", result_label(choice), refusal, host, [&] { return draw(choice, registry, request, host); });
    made.insert(made.end(), files.begin(), files.end());
  }
  return made;
}

}  // namespace

std::vector<fs::path> render_all(const std::vector<PluginChoice>& renderers, const Registry& registry,
                                 const RenderRequest& request, Host& host) {
  return draw_all(renderers, registry, request, Refusal::warns, host);
}

std::vector<fs::path> render_apart(const std::vector<PluginChoice>& renderers, const Registry& registry,
                                   const RenderRequest& request, bool overwrite, Host& host) {
  const fs::path& folder = request.directory;
  std::error_code error;
  const bool is_new = fs::create_directories(folder, error);
  if (error) throw UserError("cannot make the folder " + folder.string() + ": " + error.message());
  const EmptyFolder left_over{is_new ? folder : fs::path()};
  const Workshop workshop(folder);
  WorkshopHost within(workshop, host);
  std::vector<fs::path> made, places;
  try {
    made = draw_all(renderers, registry, {request.source, workshop.path()}, Refusal::ends, within);
  } catch (const UserError& e) { throw UserError(workshop.told(e.what())); }
  for (const fs::path& file : made) places.push_back(workshop.place_of(file));
  if (!overwrite) refuse_to_replace(places, folder);
  check_additions(folder, places);
  for (std::size_t k = 0; k < made.size(); ++k) {
    fs::create_directories(places[k].parent_path(), error);
    fs::rename(made[k], places[k], error);
    if (error) throw UserError("cannot write " + places[k].string() + ": " + error.message());
  }
  add_to_results(folder, places);
  return places;
}

}  // namespace breccia
