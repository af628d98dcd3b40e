// SPDX-License-Identifier: BSD-3-Clause
// breccia report on a study: small cases, one of which cannot be run.
#include <gtest/gtest.h>

#include <cmath>

#include "cli/small_specimen.hpp"

namespace breccia::testing {
namespace {

class ReportOfStudy : public SmallSpecimen {
 protected:
  void SetUp() override {
    SmallSpecimen::SetUp();
    write_small();
    write("study.yaml", R"(name: "strength & <more>"
workflow: small.yaml
fixed: {protocol.max_strain: 0.1 %}
grid:
  contact_law.bond_modulus: [10 GPa, 20 GPa]
  seed: [1, 2]
list:
  packing.file: [small.csv, damaged.csv]
)");
    write("damaged.csv", "x,y,z,radius\n0,0,0,1\n0,0,0,<b>\n");
    (void)call("sweep study.yaml -j 2 -o study");
  }
};

TEST_F(ReportOfStudy, CasesMeansAndFailures) {
  const Result r = call("report study");
  ASSERT_EQ(r.code, 0) << r.text;
  const std::string html = content(folder_ / "study/report.html");
  std::vector<double> moduli;
  for (const auto& e : fs::directory_iterator(folder_ / "study/cases"))
    if (fs::exists(e.path() / "summary.json"))
      moduli.push_back(Json::parse(content(e.path() / "summary.json"))["youngs_modulus_Pa"].get<double>() / 1e9);
  ASSERT_EQ(moduli.size(), 4u);
  double mean = 0, squares = 0;
  for (const double m : moduli) mean += m / 4;
  for (const double m : moduli) squares += (m - mean) * (m - mean);
  char numbers[96];
  std::snprintf(numbers, sizeof numbers,
                "(GPa)</th><td class=\"n\">4</td><td class=\"n\">%.4g</td><td class=\"n\">%.4g</td>", mean,
                std::sqrt(squares / 3));
  EXPECT_NE(html.find(std::string("Young&#39;s modulus ") + numbers), std::string::npos) << numbers;
  EXPECT_NE(html.find("8 cases, 4 finished."), std::string::npos);
  EXPECT_NE(html.find("Bond modulus (GPa)"), std::string::npos);
  EXPECT_NE(html.find("10, 20"), std::string::npos);
  EXPECT_NE(html.find("Means over the seeds"), std::string::npos);
  EXPECT_NE(html.find("Cases without results"), std::string::npos);
  EXPECT_NE(html.find("damaged.csv"), std::string::npos);
  EXPECT_NE(html.find("strength &amp; &lt;more&gt;"), std::string::npos);
  for (const char* tag : {"<more>", "<b>`", "<script", "href=\"http"})
    EXPECT_EQ(html.find(tag), std::string::npos) << tag;
  const std::string methods = content(folder_ / "study/methods.md");
  EXPECT_NE(
      methods.find(
          "The study had 8 cases, of which 4 have results. They differed in file (“small.csv” and “damaged.csv”)"),
      std::string::npos)
      << methods;
  for (const char* part : {"and bond modulus (10 and 20 GPa).", "There were 2 packings, by as many seeds"})
    EXPECT_NE(methods.find(part), std::string::npos) << part << "\n" << methods;
  const Json crate = Json::parse(content(folder_ / "study/ro-crate-metadata.json"));
  EXPECT_NE(crate.dump().find("\"cases/"), std::string::npos);
}

TEST_F(ReportOfStudy, ThatHasNotBeenGatheredIsRefused) {
  fs::remove(folder_ / "study/results.csv");
  const Result r = call("report study");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("`breccia sweep STUDY --collect` writes it"), std::string::npos) << r.text;
}

}  // namespace
}  // namespace breccia::testing
