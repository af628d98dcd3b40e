// SPDX-License-Identifier: BSD-3-Clause
#include "results/results_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <set>

#include "breccia/atomic_file.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

constexpr const char* manifest_name = "breccia.json";
constexpr const char* format_mark = "breccia results 1";
constexpr const char* lock_name = ".breccia.lock";
constexpr const char* staging_name = "unfinished";
constexpr const char* growing_name = "curves.csv.partial";
constexpr const char* arriving_name = ".breccia.arriving";  ///< whole results on their way into the folder

/// What Breccia says it wrote into a folder.
struct Manifest {
  bool valid = false, finished = false;
  std::string kind = "run";
  std::set<std::string> files;  ///< relative to the folder, with '/'
};

Manifest read_manifest(const fs::path& folder) {
  std::ifstream in(folder / manifest_name, std::ios::binary);
  const Json j = in ? Json::parse(in, nullptr, false) : Json();
  Manifest m;
  if (!j.is_object() || j.value("format", Json()) != format_mark) return m;
  m.valid = true;
  m.finished = j.value("finished", Json()) == true;
  if (const Json kind = j.value("kind", Json()); kind.is_string()) m.kind = kind.get<std::string>();
  const Json files = j.value("files", Json::array());
  if (!files.is_array()) return m;
  for (const Json& name : files) {
    if (!name.is_string()) continue;
    const fs::path p = fs::path(name.get<std::string>()).lexically_normal();
    if (p.is_relative() && !p.empty() && *p.begin() != "..") m.files.insert(p.generic_string());
  }
  return m;
}

void write_manifest(const fs::path& folder, const std::string& kind, const std::set<std::string>& files,
                    bool finished) {
  const Json j = {{"format", format_mark},
                  {"about", "what Breccia wrote into this folder: --overwrite replaces these files and no others"},
                  {"kind", kind},
                  {"finished", finished},
                  {"files", files}};
  write_file(folder / manifest_name, j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

/// All files below, as a manifest names them; without Breccia's own records.
std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink()) continue;
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (name != manifest_name && name != lock_name) files.insert(name);
  }
  return files;
}

/// Removes a file and the folders that it leaves empty.
void remove_with_folders(const fs::path& folder, const std::string& file) {
  std::error_code ignored;
  fs::remove(folder / file, ignored);
  for (fs::path p = fs::path(file).parent_path(); !p.empty(); p = p.parent_path())
    if (!fs::remove(folder / p, ignored)) break;
}

/// Brings whole results to their places; goes on where a killed process stopped.
void finish_arrival(const fs::path& folder) {
  const fs::path from = folder / arriving_name;
  if (!fs::exists(from / manifest_name)) {  // killed at the very end, when only empty folders were left
    std::error_code ignored;
    fs::remove_all(from, ignored);
    return;
  }
  const Manifest before = read_manifest(folder), now = read_manifest(from);
  for (const std::string& file : now.files) {
    if (!fs::exists(fs::symlink_status(from / file))) continue;  // is there already
    fs::create_directories((folder / file).parent_path());
    fs::rename(from / file, folder / file);
  }
  for (const std::string& file : before.files)
    if (!now.files.contains(file)) remove_with_folders(folder, file);
  fs::rename(from / manifest_name, folder / manifest_name);
  fs::remove_all(from);
}

/// Empty, or the first new file for which there is no place in the folder: one of the user's has its name.
std::string not_ours(const fs::path& folder, const std::set<std::string>& files, const Manifest& before) {
  for (const std::string& file : files) {
    const fs::file_status there = fs::symlink_status(folder / file);
    if (fs::exists(there) && (!before.files.contains(file) || fs::is_directory(there))) return file;
    for (fs::path p = fs::path(file).parent_path(); !p.empty(); p = p.parent_path())
      if (fs::exists(fs::symlink_status(folder / p)) && !fs::is_directory(folder / p) &&
          !before.files.contains(p.generic_string()))
        return p.generic_string();
  }
  return {};
}

bool is_own_link(const fs::path& link) {
  std::error_code none;
  return fs::read_symlink(link, none) == fs::path(staging_name) / growing_name;
}

UserError cannot_use(const fs::path& folder, const std::error_code& why) {
  return UserError("cannot make the folder " + folder.string() + ": " + why.message());
}

}  // namespace

ResultsFolder::ResultsFolder(const fs::path& folder, FolderRules rules, Host& host) : rules_(std::move(rules)) {
  try {
    folder_ = fs::weakly_canonical(fs::absolute(folder));  // whatever the current folder is or becomes
    if (!folder_.has_filename()) folder_ = folder_.parent_path();
    work_ = folder_ / staging_name;
    if (fs::exists(folder_) && !fs::is_directory(folder_))
      throw UserError("cannot write results to " + folder_.string() + ": it is a file");
    for (fs::path p = folder_; !fs::exists(p); p = p.parent_path()) made_folders_.push_back(p);
    if (!made_folders_.empty()) fs::create_directories(folder_);
    try {
      lock_ = std::make_unique<FolderLock>(folder_, host);
      if (fs::exists(folder_ / arriving_name)) finish_arrival(folder_);
      check_place();
      replaces_ = read_manifest(folder_).finished;
      make_work();
    } catch (...) {
      lock_.reset();
      std::error_code ignored;
      for (const fs::path& p : made_folders_) fs::remove(p, ignored);  // only while they are empty
      throw;
    }
  } catch (const fs::filesystem_error& e) { throw cannot_use(fs::absolute(folder), e.code()); }
}

/// UserError when what is there must not be touched.
void ResultsFolder::check_place() const {
  bool torso = false, others = false;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name == lock_name || name == "lost+found" || (name == growing_name && is_own_link(entry.path()))) continue;
    if (!rules_.parts.empty() && name == rules_.parts) continue;
    (name == staging_name ? torso : others) = true;
  }
  if (!torso && !others) return;
  if (rules_.go_on) return;  // whoever goes on has seen that these are results
  if (!rules_.overwrite && others)
    throw UserError("the folder " + folder_.string() +
                    " already holds files; nothing was changed. Choose another with --output, or allow its results to "
                    "be replaced with --overwrite");
  if (torso && !fs::is_empty(work_) && !read_manifest(work_).valid)
    throw UserError(work_.string() + " is where new results would grow, and it is not Breccia's: rename it");
  if (!rules_.overwrite)
    throw UserError("the folder " + folder_.string() + " holds what a run left that did not come to its end (in " +
                    staging_name + "); nothing was changed. Choose another with --output, or allow it to be replaced " +
                    "with --overwrite");
  if (!others) return;
  const Manifest m = read_manifest(folder_);
  const bool has_parts = !rules_.parts.empty() && fs::is_directory(folder_ / rules_.parts);
  if (!m.valid && !has_parts)
    throw UserError("the folder " + folder_.string() + " holds files that are not known to be results of Breccia (no " +
                    manifest_name + " that lists them): nothing was changed. Choose another with --output");
  if (m.valid && m.kind != rules_.kind)
    throw UserError("the folder " + folder_.string() + " holds the results of a " + m.kind + ", which a " +
                    rules_.kind + " does not replace: nothing was changed. Choose another with --output");
  const std::string taken = not_ours(folder_, {rules_.expected.begin(), rules_.expected.end()}, m);
  if (!taken.empty())
    throw UserError("new results would replace " + (folder_ / taken).string() +
                    ", which is not Breccia's: nothing was changed. Choose another folder with --output");
}

/// Results that a run was stopped in are brought back to where they grew: as links, since what is written takes the
/// place of a file and never changes it; but for the log, which is added to.
void ResultsFolder::take_back() {
  if (read_manifest(work_).valid) return;  // a killed run left them there
  fs::remove_all(work_);
  fs::create_directory(work_);
  for (const std::string& file : read_manifest(folder_).files) {
    if (!fs::is_regular_file(folder_ / file)) continue;
    fs::create_directories((work_ / file).parent_path());
    std::error_code error;
    if (file != "run.log") fs::create_hard_link(folder_ / file, work_ / file, error);
    if (file == "run.log" || error) fs::copy_file(folder_ / file, work_ / file);
  }
}

void ResultsFolder::make_work() {
  if (rules_.go_on) {
    take_back();
  } else {
    fs::remove_all(work_);  // what a killed run left
    fs::create_directory(work_);
  }
  hold_work();
  write_manifest(work_, rules_.kind, {}, false);
  std::error_code ignored;
  const auto& files = rules_.expected;
  if (std::find(files.begin(), files.end(), "curves.csv") == files.end()) return;
  if (!fs::exists(fs::symlink_status(folder_ / growing_name)))
    fs::create_symlink(fs::path(staging_name) / growing_name, folder_ / growing_name, ignored);
}

void ResultsFolder::hold_work() {
  if (held_ >= 0) close(held_);
  held_ = open(work_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
}

bool ResultsFolder::is_gone() const {
  struct stat held, there;
  if (held_ < 0 || fstat(held_, &held) != 0) return false;
  if (stat(work_.c_str(), &there) != 0) return errno == ENOENT || errno == ENOTDIR;
  return held.st_ino != there.st_ino || held.st_dev != there.st_dev;
}

void ResultsFolder::refuse_if_gone() const {
  if (!is_gone()) return;
  throw FolderGone("the folder " + work_.string() +
                   " was removed, renamed or replaced while results grew in it: the run ends here. Nothing more was "
                   "written; if the folder was renamed, what there was of the results is in it");
}

ResultsFolder::~ResultsFolder() {
  std::error_code ignored;
  const bool gone = is_gone();
  if (held_ >= 0) close(held_);
  if (gone) return;  // what is there by that name now is another's
  if (is_own_link(folder_ / growing_name)) fs::remove(folder_ / growing_name, ignored);
  const bool begun = fs::exists(work_ / "curves.csv", ignored) || fs::exists(work_ / growing_name, ignored);
  if (!keep_ && (done_ || !begun)) fs::remove_all(work_, ignored);
  lock_.reset();
  for (const fs::path& p : made_folders_)
    if (!fs::remove(p, ignored)) break;  // only while they are empty
}

namespace {

/// All that was written to the file system that the folder is on reaches the disk: a power cut after old results went
/// must not find the new ones half there.
void reach_the_disk(const fs::path& folder) {
  const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  (void)syncfs(opened);
  close(opened);
}

}  // namespace

void ResultsFolder::take_over(bool finished) {
  refuse_if_gone();
  try {
    const Manifest before = read_manifest(folder_);
    std::set<std::string> files = files_in(work_);
    const std::string taken = not_ours(folder_, files, before);
    if (!taken.empty())
      throw UserError("the new results have a file " + taken + ", and the one in " + folder_.string() +
                      " is not Breccia's: it was not replaced" +
                      (done_ ? "" : ", and the new results are in " + work_.string()));
    if (done_) files.insert(before.files.begin(), before.files.end());
    write_manifest(work_, rules_.kind, files, finished);
    if (replaces_) reach_the_disk(work_);
    if (is_own_link(folder_ / growing_name)) fs::remove(folder_ / growing_name);
    fs::remove_all(folder_ / arriving_name);
    fs::rename(work_, folder_ / arriving_name);  // from here on these are the results
    finish_arrival(folder_);
    done_ = true;
    replaces_ = false;
    fs::create_directory(work_);
    hold_work();
    write_manifest(work_, rules_.kind, {}, false);
  } catch (const fs::filesystem_error& e) {
    throw UserError("cannot bring the new results to " + folder_.string() + ": " + e.code().message());
  }
}

void complete_results(const fs::path& folder, Host& host) {
  std::error_code none;
  if (!fs::exists(folder / arriving_name, none)) return;
  try {
    const FolderLock lock(folder, host);
    if (fs::exists(folder / arriving_name)) finish_arrival(folder);
  } catch (const std::exception&) {}  // a run is at it, or only its owner may write there
}

fs::path unfinished_results(const fs::path& folder) {
  return read_manifest(folder / staging_name).valid ? folder / staging_name : fs::path();
}

std::string kind_of_results(const fs::path& folder) {
  const Manifest m = read_manifest(folder);
  return m.valid ? m.kind : "";
}

std::vector<std::string> listed_results(const fs::path& folder) {
  std::vector<std::string> there;
  std::error_code unknown;
  for (const std::string& file : read_manifest(folder).files)
    if (fs::exists(folder / file, unknown)) there.push_back(file);
  return there;
}

namespace {

std::set<std::string> names_within(const fs::path& folder, const std::vector<fs::path>& files) {
  const fs::path whole = fs::weakly_canonical(fs::absolute(folder));
  std::set<std::string> names;
  for (const fs::path& file : files) {
    const fs::path place = fs::weakly_canonical(fs::absolute(file).parent_path()) / file.filename();
    const fs::path name = place.lexically_relative(whole);
    if (!name.empty() && *name.begin() != "..") names.insert(name.generic_string());
  }
  return names;
}

}  // namespace

void check_additions(const fs::path& folder, const std::vector<fs::path>& files) {
  const Manifest m = read_manifest(folder);
  if (!m.valid) return;
  const std::string taken = not_ours(folder, names_within(folder, files), m);
  if (!taken.empty())
    throw UserError("there is a " + taken + " in " + folder.string() +
                    " that is not Breccia's: nothing was changed. Choose another folder with --output");
}

void add_to_results(const fs::path& folder, const std::vector<fs::path>& files) {
  Manifest m = read_manifest(folder);
  if (!m.valid) return;
  m.files.merge(names_within(folder, files));
  write_manifest(folder, m.kind, m.files, m.finished);
}

}  // namespace breccia
