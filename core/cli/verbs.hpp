// SPDX-License-Identifier: BSD-3-Clause
/// The verbs of the command line; one source file each. Each returns the exit code.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breccia::cli {

constexpr int ok = 0, failure = 1, bad_input = 2, interrupted = 130;

struct RunArguments {
  std::filesystem::path file, output, resume, from;
  std::vector<std::string> overrides;
  std::string variant;
  int threads = 0;  ///< 0: as many as the machine has
  bool overwrite = false, accept_changed_plugins = false;
};

struct RenderArguments {
  std::filesystem::path source, output;
  std::string renderer = "pictures";
  std::vector<std::string> overrides;
  bool overwrite = false;
};

struct CompareArguments {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path output = "results/comparison";
  std::vector<std::string> labels, overrides;
  std::string renderer;  ///< empty: `pictures`, if there is one
  bool overwrite = false;
};

struct ReportArguments {
  std::filesystem::path folder, output;  ///< of a run or a study; of the page, empty: report.html in that folder
  std::vector<std::string> authors;
  std::string licence;
  bool overwrite = false;
};

struct DriveArguments {
  std::string target;  ///< a workflow, or the name of a contact law
  std::filesystem::path path, output;
  std::vector<std::string> radius, overrides;
  std::string gap, porosity;  ///< with units; empty: the default
  double coordination_number = 10;
  int steps = 200;
  bool unbonded = false, overwrite = false;
};

struct SweepArguments {
  std::filesystem::path study, output;
  int jobs = 0, threads = 1;  ///< jobs 0: as many as keep all cores busy
  bool cases = false, collect = false, overwrite = false;
  std::string one;     ///< number or folder of the case to run; empty: all
  std::string expect;  ///< hash of the inputs that this case is to have; empty: any
  int parent = 0;      ///< the process that started this one; 0: the user
};

struct CheckArguments {
  std::string plugin;  ///< KIND/NAME or NAME
  std::vector<std::filesystem::path> plugins;
  std::vector<std::string> overrides;
};

struct NewArguments {
  std::string kind, name;
  std::filesystem::path folder;  ///< of the project; empty: the name, here
};

int check(const CheckArguments& arguments);
int new_plugin(const NewArguments& arguments);
int run(const RunArguments& arguments);
int validate(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& overrides,
             const std::string& variant);  ///< empty: the workflow and each of its variants
int list(const std::string& kind);
int describe(const std::string& plugin, const std::string& format);
int render(const RenderArguments& arguments);
int compare(const CompareArguments& arguments);
int report(const ReportArguments& arguments);
int drive(const DriveArguments& arguments);
int sweep(const SweepArguments& arguments);
int schema(const std::string& of);

}  // namespace breccia::cli
