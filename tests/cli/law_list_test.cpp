// SPDX-License-Identifier: BSD-3-Clause
// Contact laws that add up, as a user writes them.
#include <cstring>

#include "small_specimen.hpp"

namespace breccia::testing {
namespace {

using LawList = SmallSpecimen;

/// A list of laws: each has its section in the summary, `resolved.yaml` runs again to the same bits, a later file or
/// `--set` reaches into the list, and what cannot be added is refused.
TEST_F(LawList, AddsUp) {
  write_small();
  const std::string brittle(std::strchr(std::strstr(small, "contact_law:"), '{'),
                            std::strchr(std::strstr(small, "contact_law:"), '}') + 1);
  std::string text = small;
  const std::string viscous = "{type: viscous, normal_ratio: 0.1, stiffness_modulus: 10 GPa}",
                    rolling = "{type: rolling_resistance, rolling_friction: 0.1, rolling_modulus: 10 GPa}";
  text.replace(text.find(brittle), brittle.size(), "[" + brittle + ", " + viscous + ", " + rolling + "]");
  write("list.yaml", text);
  ASSERT_EQ(call("run list.yaml --output a --threads 1").code, 0);
  ASSERT_EQ(call("run a/resolved.yaml --output b --threads 2").code, 0);
  EXPECT_EQ(content(folder_ / "a/curves.csv"), content(folder_ / "b/curves.csv"));
  const Json s = summary("a");
  EXPECT_GT(s["viscous"]["contact_J"].get<double>(), 0);
  EXPECT_GT(s["rolling_resistance"]["friction_J"].get<double>(), 0);
  EXPECT_LT(s["energy_error"].get<double>(), 0.01);
  ASSERT_EQ(call("run small.yaml --output one --threads 1").code, 0);
  ASSERT_EQ(call("run small.yaml --output list_of_one --threads 1 --set 'contact_law=[" + brittle + "]'").code, 0);
  EXPECT_EQ(content(folder_ / "one/curves.csv"), content(folder_ / "list_of_one/curves.csv"));
  EXPECT_NE(content(folder_ / "one/curves.csv"), content(folder_ / "a/curves.csv"));

  ASSERT_EQ(call("run list.yaml --output none --threads 1 --set contact_law.1.normal_ratio=0").code, 0);
  EXPECT_EQ(summary("none")["viscous"]["contact_J"], 0);
  const Result twice = call("validate list.yaml --set 'contact_law=[" + viscous + ", " + viscous + "]'");
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.text.find("a second `viscous`"), std::string::npos) << twice.text;
  const std::string named = "{type: viscous, name: second, normal_ratio: 0.1, stiffness_modulus: 10 GPa}";
  ASSERT_EQ(call("run list.yaml --output named --threads 1 --set 'contact_law=[" + brittle + ", " + viscous + ", " +
                 named + "]'")
                .code,
            0);
  EXPECT_EQ(summary("named")["viscous"]["contact_J"], summary("named")["second_viscous"]["contact_J"]);
  const Result unknown = call("validate list.yaml --set contact_law.1.normal_ration=0");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.text.find("contact_law[1].normal_ration: is not a known parameter; did you mean `normal_ratio`?"),
            std::string::npos)
      << unknown.text;
  const Result makers =
      call("validate list.yaml --set 'contact_law=[" + brittle +
           ", {type: nonlinear_tension, bond_modulus: 10 GPa, shear_stiffness_ratio: 0.5, bending_ratio: 0.256, "
           "tensile_strain_limit: 4e-3, tension_shape: 0.2, bond_width: 0.8, shear_strain_ratio: 3.5, "
           "shear_strain_cap_ratio: 10, internal_friction_angle: 45 deg, friction_angle: 39 deg}]'");
  EXPECT_EQ(makers.code, 2);
  EXPECT_NE(makers.text.find("both make bonds"), std::string::npos) << makers.text;
}

}  // namespace
}  // namespace breccia::testing
