// SPDX-License-Identifier: BSD-3-Clause
// The workflows of Potyondy & Cundall (2004) with specimens so small that each runs in a second: same grains, laws,
// protocols.
#include <cmath>

#include "program.hpp"

namespace breccia::testing {
namespace {

class GraniteWorkflows : public Program {
 protected:
  Json run(const std::string& name) const {
    const Result r = call("run '" BRECCIA_SOURCE_DIR "/workflows/potyondy2004/" + name + ".yaml' --output '" + name +
                          "' --threads 1 --variant small");
    EXPECT_EQ(r.code, 0) << name << "\n" << r.text;
    return r.code == 0 ? Json::parse(content(folder_ / name / "summary.json")) : Json();
  }
};

TEST_F(GraniteWorkflows, GrainsAndCementShareTheLoad) {
  for (const std::string space : {"2d", "3d"}) {
    const Json c = run("ucs_" + space), t = run("tension_" + space), b = run("brazilian_" + space);
    if (HasFailure()) return;
    const auto value = [](const Json& s, const char* key) { return s[key].get<double>(); };
    EXPECT_TRUE(c["peak_reached"].get<bool>() && t["peak_reached"].get<bool>()) << space;
    // In tension the cement carries alone: a grain's own contact, as stiff, only presses.
    EXPECT_LT(value(t, "youngs_modulus_Pa"), 0.8 * value(c, "youngs_modulus_Pa")) << space;
    EXPECT_GT(value(c, "peak_stress_Pa"), 2 * value(t, "peak_stress_Pa")) << space;
    EXPECT_GT(c["bonds_broken_tension"].get<int>(), c["bonds_broken_shear"].get<int>()) << space;
    EXPECT_GT(b["brazilian"]["peak_tensile_stress_Pa"].get<double>(), 1e6) << space;
    // Strengths of the bonds scatter as the paper has it: mean and deviation within four of their own errors.
    for (const Json& of : c["linear_parallel_bond"]["scatter"]) {
      const double n = of["bonds"].get<double>(), asked = of["standard_deviation"]["asked"].get<double>();
      EXPECT_NEAR(of["mean"]["got"].get<double>(), of["mean"]["asked"].get<double>(), 4 * asked / std::sqrt(n));
      EXPECT_NEAR(of["standard_deviation"]["got"].get<double>(), asked, 4 * asked / std::sqrt(2 * n));
    }
  }
}

// Flush against the platens or standing on single grains: the first splits at more, the second is doubted in words.
TEST_F(GraniteWorkflows, ADiscAsWideAsItsVesselDoesNotStandOnOneGrain) {
  const Json flush = run("brazilian_2d");
  const Result r = call("run '" BRECCIA_SOURCE_DIR
                        "/workflows/potyondy2004/brazilian_2d.yaml' --output free --threads 1 --variant cut_free "
                        "--set packing.container.diameter='10 mm' --set packing.overlap_tolerance='15 %' --set "
                        "protocol.max_displacement='3 %' "
                        "--set outputs=[] --set renderers=[]");
  ASSERT_EQ(r.code, 0) << r.text;
  const Json free = Json::parse(content(folder_ / "free" / "summary.json"));
  const auto value = [](const Json& s, const char* key) { return s["brazilian"][key].get<double>(); };
  EXPECT_GE(value(flush, "platen_particles_at_peak"), 3);
  EXPECT_LE(value(free, "platen_particles_at_peak"), 2);
  EXPECT_GT(value(flush, "peak_tensile_stress_Pa"), value(free, "peak_tensile_stress_Pa"));
  EXPECT_NE(r.text.find("split the disc like a wedge"), std::string::npos) << r.text;
}

}  // namespace
}  // namespace breccia::testing
