// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "archive/memory_archive.hpp"
#include "breccia/output.hpp"
#include "check/attempt.hpp"
#include "check/check.hpp"
#include "check/example.hpp"
#include "check/files.hpp"
#include "check/made_specimen.hpp"
#include "results/temporary_folder.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;
class OutputCheck {
 public:
  OutputCheck(const Registry& registry, PluginChoice choice, const Host& user)
      : registry_(registry),
        choice_(std::move(choice)),
        folder_(fs::temp_directory_path(), "breccia-check"),
        trials_(user) {}

  CheckFindings operator()() {
    for (const MadeForm& form : made_forms()) {
      where_ = form.name;
      states_.clear();
      MadeSimulation s = made_simulation(made_packing(form, true), form.dimension);
      for (int k = 0; k < 3; ++k) {
        displace(s, 1e-3 * k * Mat3::Identity(), Vec3::Zero(), 1e-5 * k);
        if (k == 1) s.break_bond(1, BondState::broken_tension);
        states_.push_back(s);
      }
      const Attempt end = attempt([&] { one_form(); });
      if (!end)
        trials_.see("writes frames", where_, false, end.text,
                    "an output takes any specimen: with or without bonds, in two and three dimensions");
    }
    return trials_.findings();
  }

 private:
  std::unique_ptr<Output> begin(const fs::path& folder) const {
    fs::create_directories(folder);
    SilentHost host;
    auto output = registry_.create<Output>(choice_);
    output->begin(folder, host);
    return output;
  }
  static void frame(Output& output, const MadeSimulation& s) {
    std::vector<Field> fields = {
        {Field::On::particles, "one_each", "Pa", 1, std::vector<double>(s.radius.size(), 0.5)},
        {Field::On::particles, "three_each", "m", 3, std::vector<double>(3 * s.radius.size(), 0.1)},
        {Field::On::bonds, "of_bonds", "1", 1, std::vector<double>(s.bond_i.size(), 2)}};
    output.frame(s.view(), fields);
  }
  fs::path fresh() { return folder_.path() / std::to_string(count_++); }

  void one_form() {
    Files written[2];
    for (Files& files : written) {
      const fs::path folder = fresh();
      const auto output = begin(folder);
      for (const MadeSimulation& s : states_) frame(*output, s);
      output->finish();
      files = files_in(folder);
      trials_.see("time between frames", where_, std::isfinite(output->interval()) && output->interval() > 0,
                  fmt::format("{} s", output->interval()), "`interval` is a number above 0");
    }
    std::string fault = written[0].empty() ? "no file is there" : "";
    for (const auto& [name, bytes] : written[0])
      if (bytes.empty() || name.ends_with(".partial")) fault = "`" + name + "` is not whole";
    trials_.see("writes frames", where_, fault.empty(),
                fault.empty() ? fmt::format("{} files of 3 states", written[0].size()) : fault,
                "a file has its name when it is whole: `breccia/atomic_file.hpp`");
    trials_.see("the same twice", where_, written[0] == written[1], "the same bytes",
                "files hold no clock, no name of a folder and nothing that was not set");
    resumed(written[0]);
    gone();
    const auto output = begin(fresh());
    frame(*output, without_pairs(states_.front()));
    output->finish();
  }

  void resumed(const Files& whole) {
    const fs::path folder = fresh();
    MemoryArchive archive;
    {
      const auto before = begin(folder);
      frame(*before, states_[0]);
      frame(*before, states_[1]);
      if (!before->archive(archive))
        return trials_.skip("archive and resume", "",
                            "`archive` returns false: runs with this output have no checkpoints");
    }
    archive.read_back();
    const auto after = begin(folder);
    after->archive(archive);
    frame(*after, states_[2]);
    after->finish();
    trials_.see("archive and resume", where_, files_in(folder) == whole, "the same files",
                "`archive` misses a member that changes after `begin`: the number of the frame, say");
  }

  /// The folder is taken away: a message, and nothing that looks like a file.
  void gone() {
    const fs::path folder = fresh();
    const auto output = begin(folder);
    frame(*output, states_[0]);
    fs::remove_all(folder);
    const Attempt end = attempt([&] {
      frame(*output, states_[1]);
      output->finish();
    });
    const bool left = !files_in(folder).empty();
    trials_.see(
        "a write that fails", where_, end.end == Attempt::End::refused && !left,
        end    ? "its folder is gone, and it says nothing"
        : left ? "files are left"
               : end.text,
        "a failed write is a UserError that names the file (`CannotWrite`), and leaves nothing behind: write by "
        "`breccia/atomic_file.hpp`");
  }

  const Registry& registry_;
  PluginChoice choice_;
  TemporaryFolder folder_;
  std::vector<MadeSimulation> states_;
  Trials trials_;
  std::string where_;
  int count_ = 0;
};

}  // namespace

CheckFindings check_output(const Registry& registry, const std::string& name,
                           const std::vector<std::string>& parameters, const Host& user) {
  return OutputCheck(registry, example_plugin(registry, Output::kind, name, parameters), user)();
}

}  // namespace breccia
