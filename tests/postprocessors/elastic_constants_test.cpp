// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

struct Rock {
  double modulus = 20e9, poisson = 0.17, peak = 300e6;
  double seating = 0;       // strain before the stress rises
  double drop_to = 0.2;     // last stress over peak
  bool ends_early = false;  // at 80 % of the peak
};

/// Linear to half of the peak, then at half the slope up to the peak, then a straight fall over a strain of 1e-3.
void fill(LoadedPostprocessor& p, const Rock& rock, double sign = 1) {
  const double yield = 0.5 * rock.peak, knee = rock.seating + yield / rock.modulus;
  const double top = knee + (rock.peak - yield) / (0.5 * rock.modulus);
  std::vector<double> stress, strain, lateral;
  for (int k = 0;; ++k) {
    const double e = 1e-5 * k;
    double s = 0;
    if (e > top) s = rock.peak * (1 - (1 - rock.drop_to) * (e - top) / 1e-3);
    else if (e > knee) s = yield + 0.5 * rock.modulus * (e - knee);
    else if (e > rock.seating) s = rock.modulus * (e - rock.seating);
    if ((rock.ends_early && s > 0.8 * rock.peak) || e > top + 1e-3) break;
    stress.push_back(sign * s);
    strain.push_back(sign * e);
    lateral.push_back(sign * rock.poisson * e);
  }
  p.curves.add_column("axial_stress", stress);
  p.curves.add_column("axial_strain", strain);
  p.curves.add_column("lateral_strain", lateral);
}

double number(const Json& j) { return j.get<double>(); }

TEST(ElasticConstants, OfABilinearCurve) {
  const Rock rock;
  LoadedPostprocessor p("elastic_constants");
  fill(p, rock);
  FakeSummary s = p.finish({});
  EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), rock.modulus, 1e-9 * rock.modulus);
  EXPECT_NEAR(number(s.headlines["poisson_ratio"]), rock.poisson, 1e-12);
  // The sample nearest the peak is within half a strain step of it.
  EXPECT_NEAR(number(s.headlines["peak_stress_Pa"]), rock.peak, 0.4e6);
  EXPECT_NEAR(number(s.headlines["peak_strain"]), 22.5e-3, 1e-5);
  EXPECT_EQ(s.headlines["peak_reached"], true);
  EXPECT_NEAR(number(s.owned["average"]["range"]["r2_stress"]), 1, 1e-12);
  const double peak = number(s.headlines["peak_stress_Pa"]);
  EXPECT_GE(number(s.owned["average"]["range"]["stress_Pa"][0]), 0.1 * peak);
  EXPECT_LE(number(s.owned["average"]["range"]["stress_Pa"][1]), 0.4 * peak);
  EXPECT_NEAR(number(s.owned["secant"]["youngs_modulus_Pa"]), rock.modulus, 1e-9 * rock.modulus);
  EXPECT_NEAR(number(s.owned["after_peak"]["last_stress_over_peak"]), rock.drop_to, 0.01);
  EXPECT_NEAR(number(s.owned["after_peak"]["strain_to_half_of_peak"]), 0.5 / 0.8 * 1e-3, 1e-5);
  EXPECT_EQ(s.owned.count("note"), 0u);
}

/// A rigid cell, and one that gives way a little: a slope of stress over strain is not Young's modulus there.
TEST(ElasticConstants, OfAConfinedSpecimenByHookesLaw) {
  const double modulus = 20e9, poisson = 0.2;
  for (const int dimension : {3, 2})
    for (const double bulging : {0.0, 0.05}) {
      LoadedPostprocessor p("elastic_constants");
      std::vector<double> axial, lateral, strain, bulge;
      const double m = dimension - 1;
      for (int k = 0; k <= 200; ++k) {
        const double e = 1e-5 * k, l = -bulging * e;  // compression positive
        // Lame's form of Hooke's law; a plane has one cross direction and no stress out of it.
        const double lame = modulus * poisson / ((1 + poisson) * (dimension == 3 ? 1 - 2 * poisson : 1 - poisson)),
                     shear = modulus / (2 * (1 + poisson)), volume = e + m * l;
        axial.push_back(lame * volume + 2 * shear * e);
        lateral.push_back(lame * volume + 2 * shear * l);
        strain.push_back(e);
        bulge.push_back(-l);
      }
      p.curves.add_column("axial_stress", axial);
      p.curves.add_column("lateral_stress", lateral);
      p.curves.add_column("axial_strain", strain);
      p.curves.add_column("lateral_strain", bulge);
      SimulationView view;
      view.dimension = dimension;
      FakeSummary s = p.finish(view);
      EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), modulus, 1e-9 * modulus) << dimension << ' ' << bulging;
      EXPECT_NEAR(number(s.headlines["poisson_ratio"]), poisson, 1e-9);
      EXPECT_NEAR(number(s.owned["confinement"]["axial_stress_over_strain_Pa"]), axial.back() / strain.back(), 1e3);
    }
}

TEST(ElasticConstants, SeatingShiftsTheSecantOnly) {
  Rock rock;
  rock.seating = 1e-3;
  LoadedPostprocessor p("elastic_constants");
  fill(p, rock);
  FakeSummary s = p.finish({});
  EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), rock.modulus, 1e-9 * rock.modulus);
  const double half = 0.5 * number(s.headlines["peak_stress_Pa"]);
  const double expected = half / (half / rock.modulus + rock.seating);
  EXPECT_NEAR(number(s.owned["secant"]["youngs_modulus_Pa"]), expected, 1e-6 * rock.modulus);
}

/// Strain is counted from seating, where the specimen already carries stress: 1 GPa, not 1.67.
TEST(ElasticConstants, SecantOfASeatedSpecimen) {
  LoadedPostprocessor p("elastic_constants", {{"modulus", "secant"}});
  std::vector<double> stress, strain, lateral;
  for (int k = 0; k <= 20; ++k) {
    strain.push_back(1e-4 * k);
    stress.push_back(0.5e6 + 1e9 * strain.back());
    lateral.push_back(0.1 + 0.3 * strain.back());
  }
  p.curves.add_column("axial_stress", stress);
  p.curves.add_column("axial_strain", strain);
  p.curves.add_column("lateral_strain", lateral);
  FakeSummary s = p.finish({});
  EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), 1e9, 1);
  EXPECT_NEAR(number(s.headlines["poisson_ratio"]), 0.3, 1e-9);
  EXPECT_EQ(number(s.owned["secant"]["origin_stress_Pa"]), 0.5e6);
}

TEST(ElasticConstants, UnloadingIsNoFailure) {
  const std::vector<double> stress{0, 10, 20, 10, 2, 10, 20, 15}, strain{0, 1, 2, 1, 0.2, 1, 2, 1.5};
  for (const bool fails : {false, true}) {
    LoadedPostprocessor p("elastic_constants");
    p.curves.add_column("axial_stress", stress);
    p.curves.add_column("axial_strain", strain);
    p.curves.add_column("lateral_strain", strain);
    // The specimen's own strain shrinks in both; only the machine tells whether it was led back or gave way.
    p.curves.add_column("platen_strain", fails ? std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7} : strain);
    FakeSummary s = p.finish({});
    EXPECT_EQ(s.headlines["peak_reached"], fails);
    EXPECT_EQ(s.owned["after_peak"]["strain_to_half_of_peak"].is_null(), !fails);
  }
}

TEST(ElasticConstants, SecantAsHeadline) {
  const Rock rock;
  LoadedPostprocessor p("elastic_constants", {{"modulus", "secant"}, {"secant_at", 0.75}});
  fill(p, rock);
  FakeSummary s = p.finish({});
  const double level = 0.75 * number(s.headlines["peak_stress_Pa"]), yield = 0.5 * rock.peak;
  const double strain = yield / rock.modulus + (level - yield) / (0.5 * rock.modulus);
  EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), level / strain, 1e-9 * rock.modulus);
  EXPECT_NEAR(number(s.headlines["poisson_ratio"]), rock.poisson, 1e-12);
}

/// At half the strain of the peak, 11.25e-3, the bilinear curve carries 187.5 MPa.
TEST(ElasticConstants, SecantAtAShareOfTheStrain) {
  const Rock rock;
  LoadedPostprocessor p("elastic_constants", {{"modulus", "secant"}, {"secant_of", "strain"}});
  fill(p, rock);
  FakeSummary s = p.finish({});
  const double strain = 0.5 * number(s.headlines["peak_strain"]);
  const double stress = 150e6 + 10e9 * (strain - 7.5e-3);
  EXPECT_NEAR(strain, 11.25e-3, 1e-5);
  EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), stress / strain, 1e-9 * rock.modulus);
  EXPECT_NEAR(number(s.headlines["poisson_ratio"]), rock.poisson, 1e-12);
  EXPECT_EQ(s.owned["secant"]["of"], "strain");
}

/// Eq. 3 of Ouyang et al. (2017) with b = 0.2, 20 GPa at the beginning and a peak at a strain of 4e-3, pulled from a
/// seat of 1 MPa at a strain of 1e-3: at half the strain the secant is 0.2 (1 - exp(-2.5))/0.5 of the initial slope,
/// the samples do not meet it, and the lateral strain, which grows with the square, has done a quarter of its way.
TEST(ElasticConstants, SecantAtHalfTheStrainOfACurveThatBends) {
  for (const bool tension : {false, true}) {
    const double sign = tension ? -1 : 1, peak = 4e-3, b = 0.2, slope = 20e9;
    LoadedPostprocessor p(
        "elastic_constants",
        {{"modulus", "secant"}, {"secant_of", "strain"}, {"sense", tension ? "tension" : "compression"}});
    std::vector<double> stress, strain, lateral;
    for (int k = 0; k <= 2001; ++k) {
      const double e = peak * k / 2001;
      stress.push_back(sign * (1e6 + slope * b * peak * (1 - std::exp(-e / (b * peak)))));
      strain.push_back(sign * (1e-3 + e));
      lateral.push_back(sign * (5e-4 + 0.3 * e * e / peak));
    }
    p.curves.add_column("axial_stress", stress);
    p.curves.add_column("axial_strain", strain);
    p.curves.add_column("lateral_strain", lateral);
    FakeSummary s = p.finish({});
    // Linear between samples 2e-6 apart: within (2e-6)^2/8 of the curvature, slope/(b peak) exp(-2.5).
    EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), slope * 0.4 * (1 - std::exp(-2.5)), 1e-6 * slope);
    EXPECT_NEAR(number(s.headlines["poisson_ratio"]), 0.15, 1e-6);
  }
}

TEST(ElasticConstants, TensionTestIsMirrored) {
  Rock rock;
  rock.peak = 10e6;
  LoadedPostprocessor p("elastic_constants", {{"sense", "tension"}});
  fill(p, rock, -1);
  FakeSummary s = p.finish({});
  EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), rock.modulus, 1e-9 * rock.modulus);
  EXPECT_NEAR(number(s.headlines["poisson_ratio"]), rock.poisson, 1e-12);
  EXPECT_GT(number(s.headlines["peak_strain"]), 0);

  LoadedPostprocessor wrong("elastic_constants");
  fill(wrong, rock, -1);
  s = wrong.finish({});
  EXPECT_TRUE(s.headlines["youngs_modulus_Pa"].is_null());
  EXPECT_EQ(s.headlines["peak_reached"], false);
  EXPECT_NE(s.owned["note"].get<std::string>().find("compression"), std::string::npos);
}

TEST(ElasticConstants, SaysWhenThePeakWasNotReached) {
  Rock rock;
  rock.ends_early = true;
  LoadedPostprocessor p("elastic_constants");
  fill(p, rock);
  FakeSummary s = p.finish({});
  EXPECT_EQ(s.headlines["peak_reached"], false);
  EXPECT_EQ(s.owned.count("note"), 1u);
  EXPECT_TRUE(s.owned["after_peak"]["strain_to_half_of_peak"].is_null());
  EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), rock.modulus, 1e-9 * rock.modulus);
}

/// Unloading below the range and loading again along the same line: the range is that of the first way up.
TEST(ElasticConstants, TakesTheFirstWayUp) {
  LoadedPostprocessor p("elastic_constants");
  std::vector<double> stress{0, 10, 20, 30, 40, 60, 30, 5, 20, 40, 100, 50};
  std::vector<double> strain{0, 1, 2, 3, 4, 6, 5, 4.5, 4.75, 5, 10, 11};
  p.curves.add_column("axial_stress", stress);
  p.curves.add_column("axial_strain", strain);
  p.curves.add_column("lateral_strain", std::vector<double>(stress.size(), 0.0));
  FakeSummary s = p.finish({});
  EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), 10, 1e-12);
  EXPECT_EQ(s.owned["average"]["range"]["samples"], 4);
}

TEST(ElasticConstants, TooFewSamplesGiveNullNotANumber) {
  LoadedPostprocessor p("elastic_constants");
  p.curves.add_column("axial_stress", {0, 30, 100, 10});
  p.curves.add_column("axial_strain", {0, 3, 10, 12});
  p.curves.add_column("lateral_strain", {0, 1, 2, 3});
  FakeSummary s = p.finish({});
  EXPECT_TRUE(s.headlines["youngs_modulus_Pa"].is_null());
  EXPECT_TRUE(s.headlines["poisson_ratio"].is_null());
  EXPECT_EQ(s.owned.count("note"), 1u);
}

/// Of a specimen that rings the slope is what the samples happen to hit; of one that is straight, or bends as rock
/// does, nothing is said.
TEST(ElasticConstants, DoubtsALineThatTheStressDoesNotFollow) {
  const auto warnings = [](double ringing, double bend) {
    LoadedPostprocessor p("elastic_constants");
    std::vector<double> stress, strain, lateral;
    for (int k = 0; k <= 100; ++k) {
      const double e = 1e-5 * k, s = e * (1 - bend * k / 100);
      strain.push_back(e);
      stress.push_back(20e9 * (s + ringing * std::sin(0.7 * k)));
      lateral.push_back(0.2 * e);
    }
    p.curves.add_column("axial_stress", stress);
    p.curves.add_column("axial_strain", strain);
    p.curves.add_column("lateral_strain", lateral);
    p.begin({});
    p.finish({});
    return p.host.warnings;
  };
  EXPECT_TRUE(warnings(0, 0).empty());
  EXPECT_TRUE(warnings(0, 0.4).empty());
  ASSERT_EQ(warnings(5e-5, 0).size(), 1u);
  EXPECT_NE(warnings(5e-5, 0)[0].find("The specimen rings"), std::string::npos) << warnings(5e-5, 0)[0];
}

TEST(ElasticConstants, ReadsTheCurvesItIsTold) {
  LoadedPostprocessor p("elastic_constants", {{"stress", "platen_stress"}, {"strain", "platen_strain"}});
  p.curves.add_column("platen_stress", {0, 10, 20, 30, 100, 0});
  p.curves.add_column("platen_strain", {0, 2, 4, 6, 20, 21});
  p.curves.add_column("lateral_strain", {0, 1, 2, 3, 4, 5});
  FakeSummary s = p.finish({});
  EXPECT_NEAR(number(s.headlines["youngs_modulus_Pa"]), 5, 1e-12);
  EXPECT_NEAR(number(s.headlines["poisson_ratio"]), 0.5, 1e-12);
  LoadedPostprocessor q("elastic_constants");
  EXPECT_THROW(q.finish({}), UserError);
}

TEST(ElasticConstants, RefusesAnEmptyRange) {
  LoadedPostprocessor p("elastic_constants", {{"range_lower", 0.5}, {"range_upper", 0.4}});
  ASSERT_EQ(p.issues.size(), 1u);
  EXPECT_EQ(p.issues[0].path, "range_lower");
}

TEST(ElasticConstants, OfARunWithoutSamples) {
  LoadedPostprocessor p("elastic_constants");
  for (const char* name : {"axial_stress", "axial_strain", "lateral_strain"}) p.curves.add_column(name, {});
  EXPECT_TRUE(p.finish({}).headlines.at("peak_stress_Pa").is_null());
}

}  // namespace
}  // namespace breccia::test
