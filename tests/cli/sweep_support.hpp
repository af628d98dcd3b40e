// SPDX-License-Identifier: BSD-3-Clause
/// Small studies for the tests of `breccia sweep`, and what they leave.
#pragma once

#include <dirent.h>

#include <map>
#include <set>

#include "program.hpp"

namespace breccia::testing {

using Rows = std::vector<std::map<std::string, std::string>>;

/// Cells without quotes inside them: enough for these studies.
inline Rows rows_of(const std::string& csv) {
  const auto cells = [](const std::string& line) {
    std::vector<std::string> all(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      else if (c == ',' && !quoted) all.emplace_back();
      else all.back() += c;
    }
    return all;
  };
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> header = cells(line);
  Rows rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> row = cells(line);
    EXPECT_EQ(row.size(), header.size()) << line;
    rows.emplace_back();
    for (std::size_t k = 0; k < std::min(row.size(), header.size()); ++k) rows.back()[header[k]] = row[k];
  }
  return rows;
}

class SweepProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::ostringstream csv;
    csv << "x,y,z,radius\n";
    for (int k = 0; k < 6; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          csv << 2 * i + 1 + 0.2 * ((i * 7 + j * 3 + k) % 5) << ',' << 2 * j + 1 << ',' << 2 * k + 1 << ",1\n";
    write("small.csv", csv.str());
    write("bad.csv", "x,y,z,radius\n0,0,0,-1\n");
    write("small.yaml", small);
    write("weak.yaml", "base: small.yaml\ncontact_law: {bond_modulus: 20 GPa}\n");
  }

  Rows results(const std::string& study) const { return rows_of(content(folder_ / "results" / study / "results.csv")); }
  fs::path case_of(const std::string& study, const std::string& name) const {
    return folder_ / "results" / study / "cases" / name;
  }
  Json about(const std::string& study, const std::string& name) const {
    return Json::parse(content(case_of(study, name) / "case.json"), nullptr, false);
  }

  /// Starts the program in the folder and leaves it running.
  pid_t start(const std::vector<std::string>& arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    std::vector<char*> raw{const_cast<char*>(program.c_str())};
    for (const std::string& a : arguments) raw.push_back(const_cast<char*>(a.c_str()));
    raw.push_back(nullptr);
    if (!std::freopen("/dev/null", "w", stderr) || chdir(folder_.c_str()) != 0) _exit(99);
    execv(program.c_str(), raw.data());
    _exit(98);
  }
  template <class Condition>
  static bool within_a_minute(Condition&& condition) {
    for (int k = 0; k < 6000; ++k) {
      if (condition()) return true;
      usleep(10000);
    }
    return false;
  }
  /// The processes of cases that work in the folder.
  std::vector<pid_t> case_processes() const {
    std::vector<pid_t> all;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::error_code gone;
      const std::string arguments = content(entry.path() / "cmdline");
      if (arguments.find("--case") != arguments.npos && fs::read_symlink(entry.path() / "cwd", gone) == folder_)
        all.push_back(std::stoi(entry.path().filename()));
    }
    return all;
  }

  static constexpr const char* small = R"(packing: {type: from_file, file: small.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
damping: {translational: 0.7, rotational: 0.7}
protocol: {type: uniaxial_compression, platen_velocity: 0.2 m/s, platen_stiffness: 15 MN/m, max_strain: 0.2 %}
sampling: {every_steps: 5}
postprocessors: [{type: stress}, {type: bagi_strain}, {type: elastic_constants}, {type: damage}, {type: bond_statistics}, {type: energy}]
)";
};

}  // namespace breccia::testing
