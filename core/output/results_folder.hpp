// SPDX-License-Identifier: BSD-3-Clause
/// The folder of one run.
#pragma once

#include <filesystem>

namespace breccia {

/// An empty folder for a run. What an earlier run left there is never touched unless `overwrite`; then it is set aside
/// and goes only once the new run has ended (`keep`). If that fails instead, the earlier results come back and what
/// there is of the new ones is left in `<folder>.failed`; without earlier results, a folder in which no curves were
/// begun is removed. UserError when the folder cannot be used.
class ResultsFolder {
 public:
  ResultsFolder(std::filesystem::path folder, bool overwrite);
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;
  ~ResultsFolder();

  const std::filesystem::path& path() const { return folder_; }
  void keep();

 private:
  std::filesystem::path folder_, previous_;  ///< previous_ is empty when there were no results before
  bool kept_ = false;
};

}  // namespace breccia
