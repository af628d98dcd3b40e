// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of the packing share: a host that remembers, and configurations as the parser would hand them over.
#pragma once

#include <atomic>

#include "labra_onate.hpp"

namespace breccia::labra_onate {

class TestHost final : public Host {
 public:
  explicit TestHost(int threads = 1) : threads_(threads) {}
  void info(std::string_view) override {}
  void warn(std::string_view text) override { warnings += std::string(text) + "\n"; }
  void progress(std::string_view, double done) override {
    never_back = never_back && done >= last;
    last = done;
    ++calls;
  }
  bool cancelled() const override { return cancel_after >= 0 && calls >= cancel_after; }
  int threads() const override { return threads_; }

  std::string warnings;
  double last = 0;
  bool never_back = true;
  int calls = 0, cancel_after = -1;

 private:
  int threads_;
};

/// A cylinder of 10 mm x 12 mm with about 700 spheres at 25 % porosity.
inline Json small_cylinder() {
  return Json{{"container", {{"shape", "cylinder"}, {"diameter", 0.010}, {"height", 0.012}}},
              {"porosity", 0.25},
              {"radius", {{"distribution", "normal"}, {"mean", 0.6e-3}, {"standard_deviation", 0.12e-3},
                          {"min", 0.3e-3}, {"max", 1.0e-3}}},
              {"max_iterations", 200}, {"tolerance", 1e-4}};
}

inline Json small_box() {
  Json j = small_cylinder();
  j["container"] = {{"shape", "box"}, {"size", {0.008, 0.009, 0.011}}};
  return j;
}

inline Json small_rectangle() {
  Json j = small_cylinder();
  j["container"] = {{"shape", "box"}, {"size", {0.020, 0.030}}};
  j["porosity"] = 0.14;
  return j;
}

inline PackedParticles pack(const Json& config, Host& host, std::uint64_t seed = 1, int dimension = 3) {
  const FactoryOf<LabraOnate> factory;
  const auto plugin = factory.create(config);
  return dynamic_cast<Packing&>(*plugin).generate({dimension, 0.5, seed}, host);
}

inline double got(const PackedParticles& p, const std::string& name) {
  for (const AskedGot& line : p.report)
    if (line.name == name) return line.got;
  throw std::runtime_error("the report has no line " + name);
}

}  // namespace breccia::labra_onate
