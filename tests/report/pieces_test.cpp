// SPDX-License-Identifier: BSD-3-Clause
// What pages are made of: texts, numbers, tables, charts.
#include <gtest/gtest.h>

#include <cmath>

#include "report/html.hpp"
#include "report/methods.hpp"
#include "report/quantity.hpp"
#include "report/study_files.hpp"
#include "report/svg.hpp"

namespace breccia::report {
namespace {

TEST(Html, NothingOfATextIsMarkup) {
  EXPECT_EQ(escaped("<script>alert('x')</script> & \"y\""),
            "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt; &amp; &quot;y&quot;");
  EXPECT_EQ(escaped("µ σ\n\tz"), "µ σ\n\tz");
  EXPECT_EQ(escaped(std::string("a\0b\x07", 4)), "a\uFFFDb\uFFFD");
  EXPECT_EQ(escaped("\xC3"), "\uFFFD") << "no UTF-8";
}

/// RFC 4648, section 10.
TEST(Html, Base64) {
  const char* pairs[][2] = {{"", ""},
                            {"f", "Zg=="},
                            {"fo", "Zm8="},
                            {"foo", "Zm9v"},
                            {"foob", "Zm9vYg=="},
                            {"fooba", "Zm9vYmE="},
                            {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : pairs) EXPECT_EQ(base64(plain), coded);
  EXPECT_EQ(base64("\xFF\xFE\xFD"), "//79");
}

TEST(Html, TablesHaveHeadersForRowsAndColumns) {
  Table table("Of <this>");
  table.column("a & b").column("n", Table::Is::number);
  EXPECT_EQ(table.html(), "") << "without rows there is no table";
  table.row({"x", "1"});
  const std::string html = table.html();
  for (const char* part : {"<caption>Of &lt;this&gt;</caption>", "<th scope=\"col\">a &amp; b</th>",
                           "<th scope=\"row\">x</th>", "<td class=\"n\">1</td>"})
    EXPECT_NE(html.find(part), std::string::npos) << part << "\n" << html;
}

TEST(Numbers, AsPeopleReadThem) {
  EXPECT_EQ(shown_quantity(2.37149615e8, "Pa").text(), "237.1\u00A0MPa");
  EXPECT_EQ(shown_quantity(1.372e-7, "s").text(), "137.2\u00A0ns");
  EXPECT_EQ(shown_quantity(0.0008, "m").text(), "0.8\u00A0mm");
  EXPECT_EQ(shown_quantity(2650, "kg/m3").text(), "2650\u00A0kg/m³");
  EXPECT_EQ(shown_quantity(0, "Pa").text(), "0\u00A0Pa");
  EXPECT_EQ(shown_quantity(std::acos(-1.0) / 6, "rad").text(), "30°");
  EXPECT_EQ(shown_quantity(-3e6, "Pa").text(), "−3\u00A0MPa");
  EXPECT_EQ(shown_quantity(0.5e6, "Pa", 100e6).text(), "0.5\u00A0MPa") << "in the unit of the number beside it";
  const ChosenUnit mpa{"MPa", 1e6}, pa{"Pa", 1};
  EXPECT_EQ(shown_quantity(1.2e9, "Pa", mpa, 2e8).text(" "), "1200 MPa") << "as the user has it";
  EXPECT_EQ(shown_quantity(7.3176e10, "Pa", pa, 7.3176e10).text(" "), "73.18 GPa") << "nobody reads 7.318e+10 Pa";
  EXPECT_EQ(shown_quantity(6.62e8, "Pa", pa, 7.3176e10, 2).text(" "), "0.66 GPa");
  EXPECT_EQ(shown_quantity(1.3807e9, "Pa", mpa, 1.5e9, 3).text(" "), "1380 MPa");
  EXPECT_EQ(shown_quantity(1.234e8, "Pa", mpa, 1.5e9, 2).text(" "), "120 MPa");
  EXPECT_EQ(shown_quantity(0.5, "rad", {"deg", 0.01745329251994}, 0.5, 3).text(" "), "28.6°");
  EXPECT_EQ(shown_quantity(0.2, "1", ChosenUnit{}, 1).text(" "), "0.2");
  EXPECT_EQ(number_text(2.18e-5), "2.18\u00A0×\u00A010⁻⁵");
  EXPECT_EQ(number_text(10225), "10225") << "a count keeps its digits";
  EXPECT_EQ(number_text(std::nan("")), "–");
}

TEST(Numbers, AsResolvedYamlHasThem) {
  EXPECT_EQ(value_text("3e10 Pa"), "30\u00A0GPa");
  EXPECT_EQ(value_text("initial_distance"), "initial distance");
  EXPECT_EQ(value_text("3 things and more"), "3\u00A0things and more") << "no unit that is scaled";
  EXPECT_EQ(value_text(true), "yes");
  EXPECT_EQ(
      value_text(Json::parse(R"({"distribution": "normal", "mean": "1.75e8 Pa", "standard_deviation": "4e7 Pa"})")),
      "normal distribution, mean 175\u00A0MPa, standard deviation 40\u00A0MPa");
  EXPECT_EQ(value_text(Json::object()), "");
  EXPECT_DOUBLE_EQ(number_of("0.008 m"), 0.008);
  EXPECT_TRUE(std::isnan(number_of("0.2.0")));
}

TEST(Svg, IdsAreMadeUniqueAndTheSizeIsThePages) {
  const auto made =
      inline_svg(R"svg(<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" width="20" height="10">
<title>load &amp; more</title><defs><clipPath id="a"><rect width="1" height="1"/></clipPath></defs>
<g clip-path="url(#a)"><use href="#a"/></g></svg>)svg",
                 "f1-", "fallback");
  ASSERT_TRUE(made);
  EXPECT_EQ(made->title, "load & more");
  for (const char* part : {"id=\"f1-a\"", "url(#f1-a)", "href=\"#f1-a\"", "viewBox=\"0 0 20 10\"", "role=\"img\"",
                           "aria-labelledby=\"f1-title\"", "<title id=\"f1-title\">load &amp; more</title>"})
    EXPECT_NE(made->markup.find(part), std::string::npos) << part << "\n" << made->markup;
  EXPECT_EQ(made->markup.find("width=\"20\""), std::string::npos) << "would overflow a telephone";
  EXPECT_EQ(made->markup.substr(0, 4), "<svg");
}

TEST(Svg, WhatIsNotPlainDrawingIsNotInlined) {
  const auto refused = [](const std::string& inner, const std::string& attributes = "") {
    return !inline_svg(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\" " + attributes + ">" + inner + "</svg>", "p-",
        "x");
  };
  EXPECT_FALSE(refused("<rect width=\"1\" height=\"1\"/>"));
  for (const char* inner :
       {"<script>alert(1)</script>", "<style>body {display: none}</style>", "<image href=\"http://x/y.png\"/>",
        "<foreignObject><p/></foreignObject>", "<use href=\"other.svg#a\"/>", "<rect fill=\"url(http://x)\"/>",
        "<rect fill=\"url(#nowhere)\"/>", "<a href=\"http://x\"><rect/></a>", "<rect onclick=\"x()\"/>",
        "<g><svg onload=\"x()\"/></g>"})
    EXPECT_TRUE(refused(inner)) << inner;
  EXPECT_TRUE(refused("", "onload=\"x()\""));
  EXPECT_FALSE(inline_svg("not XML", "p-", "x"));
  EXPECT_FALSE(inline_svg("<html/>", "p-", "x"));
}

TEST(Study, CellsInQuotes) {
  const auto rows = csv_rows("a,b\n\"x, \"\"y\"\"\nz\",2\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1], (std::vector<std::string>{"x, \"y\"\nz", "2"}));
  EXPECT_THROW(csv_rows("a\n\"b"), UserError);
}

/// 2, 4, 4, 4, 5, 5, 7, 9: mean 5, sum of squares 32.
TEST(Study, Scatter) {
  const Scatter s = scatter_of({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(s.count, 8u);
  EXPECT_DOUBLE_EQ(s.mean, 5);
  EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(32.0 / 7));
  EXPECT_EQ(s.least, 2);
  EXPECT_EQ(s.largest, 9);
  EXPECT_TRUE(std::isnan(scatter_of({3}).deviation)) << "one number has no scatter";
}

/// Strain 0.002 in 1 ms up to the largest load, whatever comes after it.
TEST(Methods, StrainRateAndInertialNumber) {
  RunFiles run;
  run.summary =
      Json::parse(R"({"stress": {"largest_mean_stress_Pa": 1e6}, "packing": {"radius_mean": {"got": 0.5e-3}}})");
  run.input = Json::parse(R"({"material": {"density": "2500 kg/m3"}})");
  EXPECT_FALSE(strain_rate(run)) << "without curves";
  run.curves = {{"time", "s", "", "", {1e-3, 1.5e-3, 2e-3, 9e-3}},
                {"platen_strain", "1", "", "machine_strain", {0, 0.001, 0.002, 0.5}},
                {"platen_stress", "Pa", "", "machine_stress", {0, 1e6, 3e6, 2e6}}};
  const auto rate = strain_rate(run);
  ASSERT_TRUE(rate);
  EXPECT_EQ(rate->curve, "platen_strain");
  EXPECT_DOUBLE_EQ(rate->rate, 2);
  EXPECT_DOUBLE_EQ(inertial_number(run, 2), 2 * 1e-3 * std::sqrt(2500 / 1e6));
  run.summary.erase("stress");
  EXPECT_TRUE(std::isnan(inertial_number(run, 2))) << "what the files do not say is not told";
}

TEST(Methods, MarkdownOfAUsersNamesStaysText) {
  const std::string text = methods_markdown("a_*b*\n# c", {"x <b> [y](z)"}, {{"law `l`", "A_b (2020)"}});
  EXPECT_NE(text.find("# Methods: a\\_\\*b\\* \\# c\n"), std::string::npos) << text;
  EXPECT_NE(text.find("x \\<b\\> \\[y\\](z)"), std::string::npos) << text;
}

}  // namespace
}  // namespace breccia::report
