// SPDX-License-Identifier: BSD-3-Clause
/// The folder of one run: whose it is, who writes into it now, and when new results take the place of old ones.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "breccia/services.hpp"
#include "results/file_lock.hpp"

namespace breccia {

/// Another process has the folder.
struct FolderInUse : UserError {
  using UserError::UserError;
};

/// The results have no place any more.
struct FolderGone : UserError {
  using UserError::UserError;
};

/// A folder closed to other processes until this object goes; the file `.breccia.lock` says who has it. Where the file
/// system has no locks: a warning.
class FolderLock {
 public:
  /// The folder exists. FolderInUse with the other's process and host when another has it; UserError when nothing can
  /// be written.
  FolderLock(const std::filesystem::path& folder, Host& host);

 private:
  FileLock lock_;
};

/// What a results folder is for.
struct FolderRules {
  bool overwrite = false;    ///< earlier results of Breccia may be replaced
  std::string kind = "run";  ///< `run`, `study`, `calibration` or `comparison`: none replaces one of another kind
  std::vector<std::string> expected = {"curves.csv", "curves.json", "resolved.yaml", "run.log",
                                       "summary.json"};  ///< will be written
  std::string parts = {};  ///< a folder within whose parts look after themselves (the cases of a study); not touched
  bool go_on = false;      ///< what a run has left is kept, for it to go on
};

/// Where a run leaves its results. What is there already is touched only with `overwrite`, and of that only what
/// Breccia wrote: `breccia.json`, the manifest, lists it.
///
/// Results grow in `<folder>/unfinished` and take the place of others when they are whole; until then, through any
/// number of kills and failures, the earlier ones stay as they are. The change itself is a rename after which the new
/// ones are the results: a kill in the middle is made good by the next run in the folder (`complete_results`). Links
/// and mount points stay, as the folder itself is never moved. While the run goes, the link `curves.csv.partial` leads
/// to the curves that grow.
class ResultsFolder {
 public:
  /// UserError when the folder cannot be used; then nothing has been changed.
  ResultsFolder(const std::filesystem::path& folder, FolderRules rules, Host& host);
  ResultsFolder(const std::filesystem::path& folder, bool overwrite, Host& host)
      : ResultsFolder(folder, FolderRules{overwrite}, host) {}
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;
  /// Without `take_over`: if no curves were begun, all is as before; else what there is of them stays in `work`.
  ~ResultsFolder();

  const std::filesystem::path& path() const { return folder_; }  ///< absolute
  const std::filesystem::path& work() const { return work_; }    ///< where files are to be written now
  /// What is in `work` now is whole: it takes the place of earlier results, or is added to those that this object has
  /// brought before (pictures). `finished`: these are to survive until others have finished, too. UserError, with all
  /// left as it was, if a file of the user's would be replaced.
  void take_over(bool finished);
  /// FolderGone if `work` was removed or renamed since: what is written there by its name is lost, or lands in the
  /// results of another run. Costs two calls of the system.
  void refuse_if_gone() const;
  /// What is in `work` stays there, even if no curves were begun.
  void keep_work() { keep_ = true; }
  bool replaces_finished() const { return replaces_; }  ///< earlier whole results are there, and not yet replaced

 private:
  void check_place() const;
  void make_work();
  void take_back();
  void hold_work();
  bool is_gone() const;
  FolderRules rules_;
  std::filesystem::path folder_, work_;
  bool replaces_ = false, done_ = false, keep_ = false;
  std::vector<std::filesystem::path> made_folders_;
  std::unique_ptr<FolderLock> lock_;
  int held_ = -1;  ///< `work`, so that its number in the file system is given to no other folder
};

/// Makes good what a kill has left half-way between old and new results; nothing if there is no such thing, or if a run
/// is at it. For those who read a folder.
void complete_results(const std::filesystem::path& folder, Host& host);

/// Where results grow within their folder; only if Breccia made it, else empty.
std::filesystem::path unfinished_results(const std::filesystem::path& folder);

/// What the folder's list says: `run`, `study` or `comparison`; empty without a list.
std::string kind_of_results(const std::filesystem::path& folder);
/// Its results, relative to it, in order of the alphabet: those of its list that are there; without a list none.
std::vector<std::string> listed_results(const std::filesystem::path& folder);

/// UserError if one of the files is there and is not Breccia's, in a folder of results. The caller has the lock.
void check_additions(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);
/// Files that were written into a folder of results belong to these from now on. The caller has the lock.
void add_to_results(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace breccia
