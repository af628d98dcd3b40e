// SPDX-License-Identifier: BSD-3-Clause
#include "run/sweep_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "breccia/text_file.hpp"
#include "output/atomic_file.hpp"
#include "output/curve_table.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

Json read_json(const fs::path& file) {
  try {
    const Json j = Json::parse(read_bytes(file), nullptr, false);
    if (j.is_object()) return j;
  } catch (const UserError&) {}  // no such file, or none that can be read: it says nothing
  return Json::object();
}

std::string text_of(const Json& j, const char* key) {
  const auto it = j.find(key);
  return it != j.end() && it->is_string() ? it->get<std::string>() : "";
}

/// Removes what a run left; never anything else.
void clean(const fs::path& folder) {
  if (fs::is_empty(folder)) return;
  bool is_case = true;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != case_log) is_case = false;
  for (const char* mark : {"case.json", "run.log", "resolved.yaml"}) is_case = is_case || fs::exists(folder / mark);
  if (!is_case) throw UserError("the folder " + folder.string() + " holds files that are not of a case: not touched");
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != case_log) fs::remove_all(entry.path());
}

/// -1 where the file system has no locks.
int lock(const fs::path& folder, Host& host) {
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return -1;
  for (int tries = 0; flock(file, LOCK_EX | LOCK_NB) != 0; ++tries) {
    const bool busy = errno == EWOULDBLOCK;
    if (!busy || tries == 300 || host.cancelled()) close(file);
    if (!busy) return -1;
    if (host.cancelled()) throw Cancelled();
    if (tries == 300) throw UserError("the case in " + folder.string() + " is being run by another process");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return file;
}

}  // namespace

fs::path case_folder(const fs::path& results, const SweepCase& c) { return results / "cases" / c.folder; }

CaseRecord read_case(const fs::path& folder, const std::string& hash) {
  std::error_code unknown;
  if (!fs::exists(folder, unknown) || fs::is_empty(folder, unknown)) return {};
  const Json about = read_json(folder / "case.json");
  const std::string status = text_of(about, "status");
  const bool same = text_of(about, "inputs_sha256") == hash;
  if (status == "finished" && fs::exists(folder / "summary.json"))
    return {same ? CaseState::finished : CaseState::other_inputs, ""};
  if (status == "failed" && same) return {CaseState::failed, text_of(about, "error")};
  return {CaseState::unfinished, ""};
}

CaseFolder::CaseFolder(const fs::path& folder, Json about, Host& host) : folder_(folder), about_(std::move(about)) {
  try {
    fs::create_directories(folder_);
  } catch (const fs::filesystem_error& e) {
    throw UserError("cannot make the folder " + folder_.string() + ": " + e.code().message());
  }
  lock_ = lock(folder_, host);
}

void CaseFolder::begin() {
  try {
    clean(folder_);
  } catch (const fs::filesystem_error& e) {
    throw UserError("cannot empty the folder " + folder_.string() + ": " + e.code().message());
  }
  write("running");
}

CaseFolder::~CaseFolder() {
  if (lock_ >= 0) close(lock_);
}

void CaseFolder::write(const std::string& status, const std::string& error) {
  about_["status"] = status;
  if (!error.empty()) about_["error"] = error;
  write_file(folder_ / "case.json", json_text(about_, 2) + "\n");
}

Json about_case(const Sweep& sweep, const SweepCase& c, const ResolvedCase& resolved) {
  Json about = {{"study", sweep.study().study.name},
                {"case", c.number},
                {"workflow_file", sweep.study().workflow_files[c.workflow]}};
  if (sweep.has_workflows()) about["workflow"] = sweep.study().workflow_names[c.workflow];
  for (std::size_t k = 0; k < resolved.inputs.size(); ++k)
    about["inputs"][header_name({sweep.study().parameters[k].path, resolved.units[k], ""})] = resolved.inputs[k];
  about["inputs_sha256"] = resolved.hash;
  return about;
}

void record_crash(const fs::path& folder, const std::string& hash, const std::string& error) {
  Json about = read_json(folder / "case.json");
  about["inputs_sha256"] = hash;
  about["status"] = "failed";
  about["error"] = error;
  write_file(folder / "case.json", json_text(about, 2) + "\n");
}

}  // namespace breccia
