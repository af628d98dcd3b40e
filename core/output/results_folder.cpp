// SPDX-License-Identifier: BSD-3-Clause
#include "output/results_folder.hpp"

#include "breccia/error.hpp"

namespace breccia {

namespace fs = std::filesystem;

void make_results_folder(const fs::path& folder, bool overwrite) {
  std::error_code error;
  if (fs::exists(folder, error)) {
    if (!fs::is_directory(folder)) throw UserError("cannot write results to " + folder.string() + ": it is a file");
    if (!fs::is_empty(folder, error)) {
      if (!overwrite)
        throw UserError("the folder " + folder.string() + " already holds files; nothing was changed. "
                        "Choose another with --output, or allow its results to be replaced with --overwrite");
      if (!fs::exists(folder / "resolved.yaml") && !fs::exists(folder / "run.log"))
        throw UserError("the folder " + folder.string() + " does not look like the results of a run (no resolved.yaml, no run.log): "
                        "not replaced. Choose another with --output");
      for (const auto& entry : fs::directory_iterator(folder)) {
        fs::remove_all(entry.path(), error);
        if (error) throw UserError("cannot replace " + entry.path().string() + ": " + error.message());
      }
    }
  }
  fs::create_directories(folder, error);
  if (error) throw UserError("cannot make the folder " + folder.string() + ": " + error.message());
}

}  // namespace breccia
