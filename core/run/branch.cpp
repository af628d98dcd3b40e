// SPDX-License-Identifier: BSD-3-Clause
#include "run/branch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "breccia/protocol.hpp"
#include "breccia/sdk_abi.hpp"
#include "engine/simulation.hpp"
#include "results/results_folder.hpp"
#include "run/listed.hpp"
#include "run/load_workflow.hpp"
#include "run/provenance.hpp"
#include "workflow/contact_laws.hpp"

namespace breccia {
namespace fs = std::filesystem;

fs::path checkpoint_of(const fs::path& file_or_folder) {
  if (fs::is_regular_file(file_or_folder)) return file_or_folder;
  for (const fs::path& folder :
       {file_or_folder / "checkpoints", unfinished_results(file_or_folder) / "checkpoints", file_or_folder})
    if (const auto files = checkpoints_in(folder); !files.empty()) return files.front();
  throw AtPath("from.checkpoint", fmt::format("from.checkpoint: {} is neither a checkpoint nor a folder with one",
                                              file_or_folder.string()));
}

namespace {

/// The values of a resolved workflow by their paths, as they are written there.
using Leaves = std::map<std::string, std::string>;

void collect(const YamlNode& node, const std::string& path, Leaves& to) {
  for (const YamlEntry& e : node.entries) collect(*e.value, member_path(path, e.key), to);
  for (std::size_t k = 0; k < node.items.size(); ++k) collect(*node.items[k], item_path(path, k), to);
  if (node.entries.empty() && node.items.empty()) to[path] = node.text;
}

Leaves leaves_of(const std::string& resolved) {
  std::vector<Finding> findings;
  const YamlPtr tree = parse_yaml(resolved, {}, findings);
  Leaves leaves;
  if (tree) collect(*tree, "", leaves);
  return leaves;
}

struct Difference {
  std::string path, there, here;  ///< empty: not given
  std::string text() const {
    const auto shown = [](const std::string& value) { return value.empty() ? "not given" : value; };
    return fmt::format("{}: {} there, {} here", path, shown(there), shown(here));
  }
};

std::vector<Difference> differences_between(const Leaves& there, const Leaves& here) {
  std::vector<Difference> found;
  for (const auto& [path, value] : there) {
    const auto at = here.find(path);
    if (at == here.end() || at->second != value) found.push_back({path, value, at == here.end() ? "" : at->second});
  }
  for (const auto& [path, value] : here)
    if (!there.contains(path)) found.push_back({path, "", value});
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return found;
}

/// The section of the workflow in which a value stands.
std::string section_of(const std::string& path) { return path.substr(0, path.find_first_of(".[")); }

bool one_of(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> types_of(const PluginStack& laws) {
  std::vector<std::string> types;
  for (const PluginChoice& c : laws.plugins) types.push_back(c.type);
  return types;
}

/// Of the plugins in a provenance those of the kinds that matter.
Json plugins_of(const Json& provenance, std::initializer_list<const char*> kinds) {
  Json chosen = Json::object();
  if (provenance.contains("plugins"))
    for (const auto& [name, made_with] : provenance["plugins"].items())
      if (one_of(name.substr(0, name.find('/')), kinds)) chosen[name] = made_with;
  return {{"plugins", chosen}};
}

/// Specimens of that packing with the laws of a workflow; on several ranks each has its part of them.
class Trial {
 public:
  Trial(const Workflow& laws_of, const Beginner& run, int threads)
      : laws_(run.registry, laws_of.contact_law, run.workflow.material_list(), std::uint64_t(laws_of.seed)),
        run_(run),
        threads_(threads) {
    laws_.meet(run.others);
  }
  /// Of each pair here before the test.
  std::vector<std::vector<double>> history() {
    make();
    laws_.within([&] { specimen_->prepare(); });
    return specimen_->state().pairs.columns;
  }
  /// What the pairs of a checkpoint store with these laws [J].
  double energy(Archive& checkpoint) {
    make();
    double stored = 0;
    const Archive::Group group(checkpoint, "engine");
    laws_.within([&] {
      specimen_->take_specimen(checkpoint);
      stored = specimen_->energy_of_pairs();
    });
    return stored;
  }

 private:
  void make() {
    const Workflow& w = run_.workflow;
    RankLink* const link = run_.others.link();
    EngineSettings settings = w.engine_settings(threads_);
    settings.link = link;
    laws_.within([&] {
      specimen_.emplace(assemble(run_.packing, run_.materials, int(w.dimension), w.thickness, link),
                        laws_.interactions(), settings);
      specimen_->bond(w.bonding.rule());
    });
  }
  ContactLaws laws_;
  const Beginner& run_;
  int threads_;
  std::optional<Simulation> specimen_;
};

}  // namespace

Branch::Branch(const Beginner& run, Host& host) : file_(run.workflow.from->checkpoint) {
  reader_ = read_checkpoint(file_);
  (*reader_)("about", about_);
  refuse_other_sdk(about_, file_);
  {
    const Archive::Group engine(*reader_, "engine");
    (*reader_)("loading_started", had_begun_);
    (*reader_)("time", time_);
    (*reader_)("step", step_);
  }
  compare(run, host);
}

std::string Branch::text() const {
  return fmt::format("{} {}: step {}, {:.4g} s", goes_on_ ? "goes on with the test of" : "begins on the specimen of",
                     file_.string(), step_, time_);
}

void Branch::compare(const Beginner& run, Host& host) {
  const Workflow& w = run.workflow;
  const Leaves there = leaves_of(about_.resolved), here = leaves_of(run.resolved);
  const auto value_there = [&](const std::string& path) {
    const auto at = there.find(path);
    return at == there.end() ? std::string() : at->second;
  };
  std::vector<std::string> refused;
  const auto refuse = [&](const std::string& path, const std::string& text) {
    refused.push_back(run.places.with_place(path, text));
  };

  const bool same_protocol = value_there("protocol.type") == w.protocol.type;
  goes_on_ = w.from->protocol ? *w.from->protocol == BranchProtocol::go_on : same_protocol;
  if (goes_on_ && !same_protocol)
    refuse("from.protocol",
           fmt::format("from.protocol: there is no `{}` to continue, the checkpoint is of a test by `{}`",
                       w.protocol.type, value_there("protocol.type")));
  const Json made_with = Json::parse(about_.provenance);
  if (made_with.value("packing_content", "") != run.provenance.value("packing_content", ""))
    refuse("packing", "packing: its particles are not those of the checkpoint");

  bool other_law = false;
  for (const Difference& d : differences_between(there, here)) {
    const std::string section = section_of(d.path);
    if (one_of(section,
               {"dimension", "thickness", "periodic", "seed", "bonding", "material", "materials", "material_of"}) ||
        (goes_on_ && d.path == "engine.added_mass")) {
      refuse(d.path, d.text() + "; it must agree with the checkpoint");
    } else if (section == "contact_law") {
      other_law = true;
      differences_.push_back(d.text());
    } else if (one_of(section, {"damping", "engine", "sampling"}) || (section == "protocol" && goes_on_)) {
      adapt_ = adapt_ || one_of(section, {"damping", "engine"});
      differences_.push_back(d.text());
    } else if (section == "postprocessors" && measured() && here.contains(d.path)) {
      refuse(d.path, d.text() + "; what is measured from the start of loading cannot change after it");
    }
  }
  adapt_ = adapt_ || other_law;
  std::vector<std::string> laws_there;
  if (const std::string one = value_there("contact_law.type"); !one.empty()) laws_there = {one};
  else
    for (std::size_t l = 0; there.contains(item_path("contact_law", l) + ".type"); ++l)
      laws_there.push_back(value_there(item_path("contact_law", l) + ".type"));
  if (laws_there != types_of(w.contact_law)) {
    refuse("contact_law", fmt::format("contact_law: the checkpoint holds histories of `{}`, not of `{}`",
                                      fmt::join(laws_there, "`, `"), fmt::join(types_of(w.contact_law), "`, `")));
    other_law = false;  // no further question
  }
  if (!refused.empty()) throw UserError(fmt::format("{}", fmt::join(refused, "\n")));

  Json then = goes_on_
                  ? plugins_of(made_with, {"contact_law", "protocol", measured() ? "postprocessor" : "contact_law"})
                  : plugins_of(made_with, {"contact_law"});
  CheckpointAbout about = about_;
  about.provenance = then.dump();
  refuse_changes(about, run.provenance, run.accept_changes, host);
  if (other_law) check_law(run, host);
}

/// The parameters of a law may be others if it kept nothing of the old ones when bonds and contacts were made, and if
/// what is stored stays what it was where its balance goes on. No declaration says so: it is tried, on a specimen with
/// the old parameters and on one with the new.
void Branch::check_law(const Beginner& run, Host& host) {
  const LoadedWorkflow old = load_resolved(about_.resolved, file_, run.registry);
  std::vector<std::vector<double>> before;
  double stored_before = 0;
  {
    Trial specimen(old.workflow, run, host.threads());
    before = specimen.history();
    if (measured()) stored_before = specimen.energy(*reader_);
  }
  Trial specimen(run.workflow, run, host.threads());
  std::string changed;
  for (const std::string& d : differences_)
    if (section_of(d) == "contact_law") changed += "\n  " + d;
  if (any_rank(run.others.link(), before != specimen.history()))
    throw UserError(
        run.places.with_place("contact_law",
                              "contact_law: bonds and contacts keep what the law made of its parameters when they came "
                              "about, and with those given here it would have been something else:" +
                                  changed));
  if (!measured()) return;
  const double stored = specimen.energy(*reader_);
  constexpr double rounding = 1e-9;
  if (std::abs(stored - stored_before) > rounding * std::max(std::abs(stored), std::abs(stored_before)))
    throw UserError(run.places.with_place(
        "contact_law",
        fmt::format(
            "contact_law: with these parameters the bonds and contacts would at once store {:.6g} J, where they "
            "store {:.6g} J, and the balance of energy is under way: change them in a checkpoint from before "
            "the loading, or begin a new test (from.protocol: new):{}",
            stored, stored_before, changed)));
}

}  // namespace breccia
