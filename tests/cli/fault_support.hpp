// SPDX-License-Identifier: BSD-3-Clause
/// Real faults for the tests: a small disk that can be full, folders that cannot be written, files that are whole or
/// not.
#pragma once

#include <sched.h>
#include <sys/mount.h>

#include <map>

#include "small_specimen.hpp"

namespace breccia::testing {

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Whether this process may mount: from now on it sees a file system of its own, which nobody else does.
inline bool has_own_mounts() {
  static const bool own = [] {
    const auto uid = std::to_string(geteuid()), gid = std::to_string(getegid());
    if (unshare(CLONE_NEWNS) != 0) {
      if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
      std::ofstream("/proc/self/setgroups") << "deny";
      std::ofstream("/proc/self/uid_map") << "0 " + uid + " 1";
      std::ofstream("/proc/self/gid_map") << "0 " + gid + " 1";
    }
    return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
  }();
  return own;
}

/// What stands before a program that is to be refused by a folder's mode, as root is not.
inline const std::string unprivileged = "setpriv --bounding-set=-all --inh-caps=-all";

class FaultyPrograms : public SmallSpecimen {
 protected:
  void SetUp() override {
    SmallSpecimen::SetUp();
    write_spheres();
  }
  void TearDown() override {
    call_shell("find . -type d -exec chmod u+w {} +");
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
    SmallSpecimen::TearDown();
  }
  /// The test's folder becomes a disk of so many bytes; false where that cannot be had.
  bool is_on_a_small_disk(std::size_t size) {
    if (!has_own_mounts()) return false;
    mounted_ = mount("none", folder_.c_str(), "tmpfs", 0, ("size=" + std::to_string(size)).c_str()) == 0;
    return mounted_;
  }
  bool modes_are_minded() const {
    return geteuid() != 0 ||
           call_shell("mkdir closed && chmod a-w closed && ! " + unprivileged + " touch closed/x 2>&1");
  }
  bool call_shell(const std::string& command) const {
    return std::system(("cd '" + folder_.string() + "' && { " + command + "; } >/dev/null").c_str()) == 0;
  }

  /// What is wrong with what stands in the folder under a final name; empty when all is whole.
  static std::string torsos(const fs::path& folder) {
    std::string wrong;
    std::error_code gone;
    for (fs::recursive_directory_iterator at(folder, gone), end; !gone && at != end; at.increment(gone)) {
      if (!at->is_regular_file() || at->is_symlink()) continue;
      const std::string name = at->path().filename().string(), kind = at->path().extension().string(),
                        text = content(at->path());
      const auto ends = [&](const std::string& tail) {
        return text.find(tail, text.size() - std::min<std::size_t>(text.size(), 20)) != text.npos;
      };
      bool whole = true;
      if (name == "curves.csv.partial") continue;  // says so itself
      if (kind == ".json") whole = !Json::parse(text, nullptr, false).is_discarded();
      else if (kind == ".csv" || kind == ".yaml") whole = ends("\n");
      else if (kind == ".vtp" || kind == ".pvd") whole = ends("</VTKFile>");
      else if (kind == ".svg") whole = ends("</svg>");
      else if (kind == ".png") whole = ends("IEND");
      else if (kind == ".h5") whole = text.starts_with("breccia checkpoint 2\n");
      else whole = kind != ".partial" && kind != ".arriving";
      if (!whole) wrong += at->path().string() + "\n";
    }
    return wrong;
  }
  static std::map<std::string, std::string> all_files(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file() && !entry.is_symlink() && !entry.path().filename().string().starts_with(".breccia"))
        files[entry.path().filename().string()] = content(entry.path());
    return files;
  }

  static std::string plugins() {
    std::string list;
    for (const char* kind : {"packing", "contact_law", "protocol", "postprocessor", "renderer"})
      list += (list.empty() ? "" : ", ") + std::string("'" BRECCIA_BINARY_DIR "/tests/plugins/fixtures/faulty_") +
              kind + ".so'";
    return "plugins: [" + list + "]\n";
  }
  static constexpr const char* specimen = R"(packing: {type: from_file, file: small.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
damping: {translational: 0.7, rotational: 0.7}
protocol: {type: uniaxial_compression, platen_velocity: 0.5 m/s, platen_stiffness: 15 MN/m, max_strain: 0.2 %}
sampling: {every_steps: 5}
)";

 private:
  bool mounted_ = false;
};

}  // namespace breccia::testing
