// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "breccia/renderer.hpp"
#include "check/attempt.hpp"
#include "check/check.hpp"
#include "check/example.hpp"
#include "check/files.hpp"
#include "results/temporary_folder.hpp"
#include "run/load_workflow.hpp"
#include "run/runner.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

class SilentMonitor final : public Silent<RunMonitor> {
  void status(const RunStatus&) override {}
};

/// A run of a few steps, with whatever of Breccia's plugins is installed.
std::string small_run(const Registry& registry) {
  const auto there = [&](const char* kind, const char* name) {
    const auto names = registry.names(kind);
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::string posts;
  for (const char* name : {"stress", "bagi_strain", "damage", "statistics"})
    if (there("postprocessor", name)) posts += std::string(posts.empty() ? "" : ", ") + "{type: " + name + "}";
  std::string text =
      "name: small\n"
      "packing: {type: regular, lattice: sc, container: {shape: box, size: [10 mm, 10 mm, 16 mm]}, radius: 1 mm}\n"
      "contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 15 MPa,\n"
      "  shear_strength: 15 MPa, friction: 0.5}\n"
      "material: {density: 2650 kg/m3}\nbonding: {tolerance: 0.01}\n"
      "damping: {translational: 0.5, rotational: 0.5}\n"
      "protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, max_strain: 0.5 %}\n"
      "checkpoints: {keep: 0}\nsampling: {every_steps: 10}\n";
  if (!posts.empty()) text += "postprocessors: [" + posts + "]\n";
  if (there("output", "vtk")) text += "outputs: [{type: vtk, interval: 20 us}]\n";
  return text;
}

class RendererCheck {
 public:
  RendererCheck(const Registry& registry, PluginChoice choice, const Host& user)
      : registry_(registry),
        choice_(std::move(choice)),
        folder_(fs::temp_directory_path(), "breccia-check"),
        trials_(user) {}

  CheckFindings operator()() {
    source_ = folder_.path() / "run";
    fs::create_directory(source_);
    const Attempt run = attempt([&] {
      const LoadedWorkflow loaded = load_resolved(small_run(registry_), source_ / "resolved.yaml", registry_);
      SilentMonitor monitor;
      run_workflow(loaded, registry_, {source_, {}}, monitor);
    });
    if (!run) {
      trials_.skip(draws, "", "there is no run to draw: " + run.text);
      return trials_.findings();
    }
    const auto before = files_in(source_);
    pictures(before);
    nothing();
    trials_.skip("comparisons and charts of studies", "", "they need several runs");
    return trials_.findings();
  }

 private:
  static constexpr const char* draws = "draws a run";
  std::vector<fs::path> draw(const fs::path& source, const fs::path& into) const {
    fs::create_directory(into);
    SilentHost host;
    return registry_.create<Renderer>(choice_)->render({source, into}, host);
  }

  void pictures(const Files& before) {
    const fs::path into = folder_.path() / "pictures";
    std::vector<fs::path> made;
    std::string unavailable;
    const Attempt end = attempt([&] {
      try {
        made = draw(source_, into);
      } catch (const Unavailable& e) { unavailable = e.what(); }
    });
    if (!unavailable.empty())
      return trials_.skip(draws, "", "it says that it cannot draw on this machine: " + unavailable);
    std::string fault = end.text;
    if (end && made.empty()) fault = "it made no picture";
    for (const fs::path& file : made)
      if (!fs::is_regular_file(file) || fs::file_size(file) == 0 ||
          file.lexically_relative(into).string().starts_with(".."))
        fault = "`" + file.filename().string() + "` is not a whole file in the folder of the pictures";
    for (const auto& file : files_in(into)) {
      const std::string& name = file.first;
      const bool told =
          std::any_of(made.begin(), made.end(), [&](const fs::path& f) { return f.lexically_relative(into) == name; });
      if (!told) fault = "`" + name + "` is left, and is not among the pictures";
    }
    trials_.see(draws, "a small compression", fault.empty(),
                fault.empty() ? fmt::format("{} pictures", made.size()) : fault,
                "return the files that were made in `directory`, whole ones only; throw `Unavailable` where there is "
                "nothing to draw with");
    trials_.see("leaves the run alone", "a small compression", files_in(source_) == before,
                "its files are as they were", "a renderer writes into `directory` and nowhere else");
  }

  void nothing() {
    const fs::path empty = folder_.path() / "empty", into = folder_.path() / "of_nothing";
    fs::create_directory(empty);
    std::vector<fs::path> made;
    bool unavailable = false;
    const Attempt end = attempt([&] {
      try {
        made = draw(empty, into);
      } catch (const Unavailable&) { unavailable = true; }
    });
    const bool left = !files_in(into).empty();
    trials_.see("a folder without results", "empty", (unavailable || end.end == Attempt::End::refused) && !left,
                left  ? "files are left"
                : end ? "it says nothing"
                      : end.text,
                "a source that is of no use is a UserError, and leaves nothing behind");
  }

  const Registry& registry_;
  PluginChoice choice_;
  TemporaryFolder folder_;
  fs::path source_;
  Trials trials_;
};

}  // namespace

CheckFindings check_renderer(const Registry& registry, const std::string& name,
                             const std::vector<std::string>& parameters, const Host& user) {
  return RendererCheck(registry, example_plugin(registry, Renderer::kind, name, parameters), user)();
}

}  // namespace breccia
