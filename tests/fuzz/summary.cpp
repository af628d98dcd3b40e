// SPDX-License-Identifier: BSD-3-Clause
/// summary.json as `breccia compare` reads it, and what the comparison makes of it.
#include <filesystem>

#include "compare/compare.hpp"
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace breccia;
  static const bool prepared = [] {
    for (const char* run : {"fuzzed", "sound"}) {
      std::filesystem::create_directory(run);
      fuzz::write((std::string(run) + "/curves.csv").c_str(), "time_s\n0\n");
    }
    fuzz::write("sound/summary.json",
                R"({"peak_stress_Pa": 1e8, "confining_pressure_Pa": 1e6, "reference": {"peak_stress_Pa": 2e8},
                    "units": {"peak_stress_Pa": "Pa"}})");
    return true;
  }();
  (void)prepared;
  fuzz::write("fuzzed/summary.json", fuzz::text(data, size));
  fuzz::is_read([&] {
    const auto runs = read_runs({"fuzzed", "sound"}, {});
    comparison_csv(runs);
    comparison_markdown(runs, {});
    if (const auto envelope = strength_envelope(runs)) strength_markdown(*envelope);
  });
  return 0;
}
