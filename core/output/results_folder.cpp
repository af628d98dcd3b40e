// SPDX-License-Identifier: BSD-3-Clause
#include "output/results_folder.hpp"

#include "breccia/error.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

/// Whether somebody's results are there, to be set aside; UserError when that must not be.
bool holds_results(const fs::path& folder, bool overwrite) {
  if (!fs::exists(folder)) return false;
  if (!fs::is_directory(folder)) throw UserError("cannot write results to " + folder.string() + ": it is a file");
  if (fs::is_empty(folder)) return false;
  if (!overwrite)
    throw UserError("the folder " + folder.string() +
                    " already holds files; nothing was changed. "
                    "Choose another with --output, or allow its results to be replaced with --overwrite");
  if (!fs::exists(folder / "resolved.yaml") && !fs::exists(folder / "run.log"))
    throw UserError("the folder " + folder.string() +
                    " does not look like the results of a run (no resolved.yaml, no run.log): "
                    "not replaced. Choose another with --output");
  return true;
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path folder, bool overwrite) : folder_(fs::absolute(folder).lexically_normal()) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();
  try {
    if (holds_results(folder_, overwrite)) {
      previous_ = folder_.string() + ".previous";
      fs::remove_all(previous_);
      fs::rename(folder_, previous_);
    }
    fs::create_directories(folder_);
  } catch (const fs::filesystem_error& e) {
    throw UserError("cannot make the folder " + folder_.string() + ": " + e.code().message());
  }
}

ResultsFolder::~ResultsFolder() {
  if (kept_) return;
  std::error_code ignored;
  const bool begun = fs::exists(folder_ / "curves.csv", ignored) || fs::exists(folder_ / "curves.csv.partial", ignored);
  if (!begun) {
    fs::remove_all(folder_, ignored);
  } else if (!previous_.empty()) {
    const fs::path failed = folder_.string() + ".failed";
    fs::remove_all(failed, ignored);
    fs::rename(folder_, failed, ignored);
  }
  if (!previous_.empty()) fs::rename(previous_, folder_, ignored);
}

void ResultsFolder::keep() {
  kept_ = true;
  std::error_code ignored;
  if (!previous_.empty()) fs::remove_all(previous_, ignored);
}

}  // namespace breccia
