// SPDX-License-Identifier: BSD-3-Clause
#include "study/case_folder.hpp"

#include <chrono>
#include <thread>

#include "breccia/atomic_file.hpp"
#include "breccia/text_file.hpp"
#include "results/curve_table.hpp"

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

}  // namespace

fs::path case_folder(const fs::path& results, const SweepCase& c) { return results / "cases" / c.folder; }

CaseRecord read_case(const fs::path& folder, const std::string& hash, Host& host) {
  std::error_code unknown;
  if (!fs::exists(folder, unknown) || fs::is_empty(folder, unknown)) return {};
  complete_results(folder, host);
  const Json whole = read_json(folder / case_file);
  const bool is_finished = text_of(whole, "status") == "finished" && fs::exists(folder / "summary.json");
  if (is_finished && text_of(whole, "inputs_sha256") == hash) return {CaseState::finished, ""};
  // What came to no end is told of apart when finished results of other inputs are there.
  const fs::path growing = unfinished_results(folder);
  const Json latest = growing.empty() ? Json::object() : read_json(growing / case_file);
  for (const Json& about : {latest, whole}) {
    if (text_of(about, "inputs_sha256") != hash) continue;
    if (text_of(about, "status") == "failed")
      return {CaseState::failed, text_of(about, "error"), about.value("out_of_time", Json()) == true, is_finished};
    return {CaseState::unfinished, "", false, is_finished};
  }
  if (is_finished) return {CaseState::other_inputs, "", false, true};
  return {CaseState::unfinished, ""};
}

std::optional<ResumePoint> resume_case(const fs::path& folder, const std::string& hash, Host& host) {
  const fs::path growing = unfinished_results(folder);
  const fs::path& latest = growing.empty() ? folder : growing;
  const Json about = read_json(latest / case_file);
  if (text_of(about, "inputs_sha256") != hash || text_of(about, "status") == "failed") return std::nullopt;
  if (checkpoints_in(latest / "checkpoints").empty()) return std::nullopt;
  try {
    return find_resume_point(folder, host);
  } catch (const UserError& e) {
    host.warn(std::string("the case begins anew: ") + e.what());
    return std::nullopt;
  }
}

CaseFolder::CaseFolder(const fs::path& folder, Json about, bool wait, bool go_on, Host& host)
    : about_(std::move(about)) {
  FolderRules rules{true};
  rules.go_on = go_on;
  rules.expected.emplace_back(case_file);
  for (int tries = 0; !results_; ++tries) {
    try {
      results_.emplace(folder, rules, host);
    } catch (const FolderInUse&) {
      if (host.cancelled()) throw Cancelled();
      if (!wait || tries == 300) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
}

fs::path CaseFolder::whole(bool stopped) {
  write(stopped ? "interrupted" : "finished", "");
  if (stopped && results_->replaces_finished()) return results_->work();
  results_->take_over(!stopped);
  return results_->path();
}

void CaseFolder::end(const std::string& status, const std::string& error) {
  write(status, error);
  if (status != "finished" && results_->replaces_finished()) results_->keep_work();
  else results_->take_over(status == "finished");
}

void CaseFolder::write(const std::string& status, const std::string& error) {
  about_["status"] = status;
  if (!error.empty()) about_["error"] = error;
  write_file(results_->work() / case_file, json_text(about_, 2) + "\n");
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

void record_crash(const fs::path& folder, const std::string& hash, const std::string& error, Host& host) {
  const fs::path growing = unfinished_results(folder);
  if (growing.empty()) return;  // it had not begun, or the folder is not Breccia's
  const FolderLock lock(folder, host);
  Json about = read_json(growing / case_file);
  about["inputs_sha256"] = hash;
  about["status"] = "failed";
  about["error"] = error;
  write_file(growing / case_file, json_text(about, 2) + "\n");
}

}  // namespace breccia
