// SPDX-License-Identifier: BSD-3-Clause
/// The verbs of the command line; one source file each. Each returns the exit code.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/calibration_request.hpp"
#include "drive/drive_request.hpp"
#include "run/run_request.hpp"
#include "study/study_request.hpp"

namespace breccia::cli {

constexpr int ok = 0, failure = 1, bad_input = 2, interrupted = 130;

struct RunArguments : RunRequest {
  int threads = 0;  ///< 0: as many as the machine has
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

using DriveArguments = DriveRequest;

struct ReportArguments {
  std::filesystem::path folder, output;  ///< of a run or a study; of the page, empty: report.html in that folder
  std::vector<std::string> authors;
  std::string licence;
  bool overwrite = false;
};

struct SweepArguments : StudyRequest {
  bool cases = false;  ///< only lists them
};

struct CalibrateArguments : CalibrationRequest {
  bool cases = false;  ///< only lists the runs
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
int calibrate(const CalibrateArguments& arguments);
int schema(const std::string& of);

}  // namespace breccia::cli
