// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of all packings share: a host that remembers, and looks at a finished packing.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>

#include "../support/generate.hpp"
#include "breccia/packing.hpp"

namespace breccia {

class TestHost final : public SilentHost {
 public:
  explicit TestHost(int threads = 1) : threads_(threads) {}
  void warn(std::string_view text) override { warnings += std::string(text) + "\n"; }
  void progress(std::string_view what, double done) override {
    never_back = never_back && (done >= last || what != last_what);
    last = done;
    last_what = what;
    ++calls;
  }
  bool cancelled() const override { return cancel_after >= 0 && calls >= cancel_after; }
  int threads() const override { return threads_; }

  std::string warnings, last_what;
  double last = 0;
  bool never_back = true;
  int calls = 0, cancel_after = -1;

 private:
  int threads_;
};

inline double got(const PackedParticles& p, const std::string& name) {
  for (const AskedGot& line : p.report)
    if (line.name == name) return line.got;
  throw std::runtime_error("the report has no line " + name);
}

inline bool same_bits(const PackedParticles& a, const PackedParticles& b) {
  return a.radius == b.radius && a.position.size() == b.position.size() &&
         std::memcmp(a.position.data(), b.position.data(), a.position.size() * sizeof(Vec3)) == 0;
}

}  // namespace breccia
