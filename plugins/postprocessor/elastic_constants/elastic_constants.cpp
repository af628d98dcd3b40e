// SPDX-License-Identifier: BSD-3-Clause
/// Young's modulus, Poisson's ratio, peak and brittleness from the curves of the run.
/// Source: ISRM (1979), Suggested methods for determining the uniaxial compressive strength and deformability of rock
/// materials, Int. J. Rock Mech. Min. Sci. 16, 135-140.
#include <cstdio>
#include <string>

#include "breccia/postprocessor.hpp"
#include "curve_analysis.hpp"

namespace breccia {
namespace {

enum class Modulus { average, secant };
enum class Sense { compression, tension };
enum class SecantOf { stress, strain };

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

std::optional<double> ratio(double a, double b) {
  if (b == 0) return {};
  return a / b;
}

}  // namespace

class ElasticConstants final : public Postprocessor {
 public:
  struct Config {
    std::string stress, strain, lateral;
    Modulus modulus;
    Sense sense;
    double range_lower, range_upper, secant_at;
    SecantOf secant_of;
  };
  static void describe(Schema<Config>& s) {
    s.summary("Young's modulus, Poisson's ratio, peak stress and brittleness from the curves of the run")
        .source("ISRM (1979), Int. J. Rock Mech. Min. Sci. 16, 135-140; Rojek et al. (2012), Eq. 61")
        .details(
            "`average`: least-squares slope of the samples from `range_lower` to `range_upper` of the peak stress, on "
            "the first way up (ISRM's average modulus of the straight part). `secant`: from the first sample (the "
            "stress of seating) to `secant_at` of the peak, of its stress or of its strain. Poisson's ratio is lateral "
            "over axial strain, taken in the "
            "same way. Name the stress "
            "`deviatoric_stress` in a confined test, so that it starts at zero. Where the lateral stress grows by more "
            "than a twentieth of what the axial one does in that range (a rigid cell), modulus and Poisson's ratio are "
            "those of Hooke's law with both, `axial_stress` and `lateral_stress` of the post-processor `stress`.");
    s.param("stress", &Config::stress).fallback("axial_stress").doc("curve of the stress, compression positive");
    s.param("strain", &Config::strain).fallback("axial_strain").doc("curve of the axial strain, compression positive");
    s.param("lateral", &Config::lateral)
        .fallback("lateral_strain")
        .doc("curve of the lateral strain, extension positive");
    s.param("sense", &Config::sense)
        .choice("compression", Sense::compression, "the curves grow with the load")
        .choice("tension", Sense::tension, "a tension test: all three curves are taken with the opposite sign")
        .doc("which way the specimen is loaded")
        .fallback("compression");
    s.param("modulus", &Config::modulus)
        .choice("average", Modulus::average, "slope of the straight part")
        .choice("secant", Modulus::secant, "secant from the first sample")
        .doc("what the headline modulus and Poisson's ratio are; the summary has both")
        .fallback("average");
    s.param("range_lower", &Config::range_lower)
        .at_least(0)
        .below(1)
        .fallback(0.1)
        .doc("share of the peak stress where the straight part begins, past seating");
    s.param("range_upper", &Config::range_upper)
        .above(0)
        .at_most(1)
        .fallback(0.4)
        .doc("share of the peak stress where the straight part ends, before cracks begin to grow");
    s.param("secant_at", &Config::secant_at)
        .above(0)
        .at_most(1)
        .fallback(0.5)
        .doc("share of the peak at which the secant is read, as `secant_of` says");
    s.param("secant_of", &Config::secant_of)
        .choice("stress", SecantOf::stress, "where the stress first reaches that share of the peak stress")
        .choice("strain", SecantOf::strain,
                "where the strain, counted from the first sample, first reaches that share of its value at the peak")
        .fallback("stress")
        .doc("what `secant_at` is a share of");
    s.check([](const Config& c, Issues& issues) {
      if (c.range_lower >= c.range_upper) issues.push_back({"range_lower", "must be less than range_upper"});
    });
  }

  explicit ElasticConstants(const Config& config) : config_(config) {}
  bool sees_parts() const override { return true; }  // of curves alone

  std::vector<std::string> needed_curves() const override { return {config_.stress, config_.strain, config_.lateral}; }

  void begin(const SimulationView&, Recorder&, Host& host) override { host_ = &host; }

  void finish(const SimulationView& view, const Curves& curves, Summary& summary) override {
    const StressStrainCurve c{load(curves, config_.stress), load(curves, config_.strain), load(curves, config_.lateral),
                              machine(curves)};
    const Peak peak = c.stress.empty() ? Peak{} : find_peak(c);
    if (!(peak.stress > 0)) {
      for (const ResultName& name : {ResultName("youngs_modulus", "Pa"), ResultName("poisson_ratio"),
                                     ResultName("peak_stress", "Pa"), ResultName("peak_strain")})
        summary.headline(name, nullptr);
      summary.headline("peak_reached", false);
      summary.own("note", "the stress never rose above zero in " + name_of_sense());
      return;
    }
    const FitRange range = loading_range(c, config_.range_lower * peak.stress, config_.range_upper * peak.stress);
    const auto slope = fit_line(c.strain, c.stress, range), lateral = fit_line(c.strain, c.lateral, range);
    const auto slope_modulus = slope ? std::optional(slope->slope) : std::nullopt;
    const auto slope_poisson = lateral ? std::optional(lateral->slope) : std::nullopt;
    // From the first sample: strain is counted from there, and a seated specimen already carries stress.
    const CurvePoint origin{c.stress[0], c.strain[0], c.lateral[0]};
    const bool of_stress = config_.secant_of == SecantOf::stress;
    const auto secant = of_stress ? first_rise_to(c, &StressStrainCurve::stress, config_.secant_at * peak.stress)
                                  : first_rise_to(c, &StressStrainCurve::strain,
                                                  origin.strain + config_.secant_at * (peak.strain - origin.strain));
    const auto from_origin = [&](double CurvePoint::*of) {
      return secant ? ratio((*secant).*of - origin.*of, secant->strain - origin.strain) : std::nullopt;
    };
    const auto secant_modulus = from_origin(&CurvePoint::stress), secant_poisson = from_origin(&CurvePoint::lateral);

    const bool average = config_.modulus == Modulus::average;
    const auto confined = slope ? confinement(curves, c, range, view.dimension) : std::nullopt;
    if (confined) {
      summary.headline({"youngs_modulus", "Pa"}, confined->youngs_modulus);
      summary.headline("poisson_ratio", confined->poisson_ratio);
      summary.own("confinement.lateral_over_axial_stress", confined->stress_ratio);
      summary.own({"confinement.axial_stress_over_strain", "Pa"}, confined->constrained_modulus);
    } else {
      summary.headline({"youngs_modulus", "Pa"}, or_null(average ? slope_modulus : secant_modulus));
      summary.headline("poisson_ratio", or_null(average ? slope_poisson : secant_poisson));
    }
    summary.headline({"peak_stress", "Pa"}, peak.stress);
    summary.headline("peak_strain", peak.strain);
    summary.headline("peak_reached", peak.passed);

    summary.own("sense", name_of_sense());
    summary.own("modulus", confined ? "average, of a confined specimen" : average ? "average" : "secant");
    summary.own({"average.youngs_modulus", "Pa"}, or_null(slope_modulus));
    summary.own("average.poisson_ratio", or_null(slope_poisson));
    report_fit(c, range, slope, lateral, summary);
    if (average && slope && host_) doubt_line(c, range, slope->r2);
    summary.own({"secant.youngs_modulus", "Pa"}, or_null(secant_modulus));
    summary.own("secant.poisson_ratio", or_null(secant_poisson));
    summary.own("secant.share_of_peak", config_.secant_at);
    summary.own("secant.of", of_stress ? "stress" : "strain");
    summary.own({"secant.origin_stress", "Pa"}, origin.stress);
    summary.own("secant.origin_strain", origin.strain);
    const auto half = first_fall_to(c, 0.5 * peak.stress, peak.row);
    summary.own("after_peak", Json{{"last_stress_over_peak", c.stress.back() / peak.stress},
                                   {"strain_to_half_of_peak", half ? Json(half->strain - peak.strain) : Json()}});
    if (!peak.passed)
      summary.own("note",
                  "the run ended before the stress had fallen by 5 % from its largest value, which need not be "
                  "the strength; all shares of the peak refer to it");
    else if (!slope)
      summary.own("note", "fewer than three samples lie in the range of the slope; sample more often or widen it");
  }
  bool archive(Archive&) override { return true; }

 private:
  std::vector<double> load(const Curves& curves, const std::string& name) const {
    const auto column = curves.column(name);
    std::vector<double> values(column.begin(), column.end());
    if (config_.sense == Sense::tension)
      for (double& v : values) v = -v;
    return values;
  }

  /// The platens' approach, of tests that have one; in its sense of growing with the load.
  std::vector<double> machine(const Curves& curves) const {
    const Column* const way = role::find(curves.columns(), {role::machine_strain});
    return way ? load(curves, way->name) : std::vector<double>{};
  }

  /// Where the lateral stress grows with the axial one, a slope of stress over strain is no Young's modulus: Hooke's
  /// law with both stresses as the particles carry them. None where it stays (or is not measured).
  std::optional<ConfinedSlopes> confinement(const Curves& curves, const StressStrainCurve& c, const FitRange& range,
                                            int dimension) const {
    const auto slope_of = [&](const char* name) -> std::optional<double> {
      for (const Column& column : curves.columns())
        if (column.name == name)
          if (const auto line = fit_line(c.strain, load(curves, name), range)) return line->slope;
      return {};
    };
    const auto axial = slope_of("axial_stress"), lateral = slope_of("lateral_stress");
    const auto bulging = fit_line(c.strain, c.lateral, range);
    if (!axial || !lateral || !bulging) return {};
    return confined_slopes(*axial, *lateral, bulging->slope, dimension);
  }

  std::string name_of_sense() const { return config_.sense == Sense::compression ? "compression" : "tension"; }

  /// A modulus that other samples of the same test would not give is not the specimen's.
  void doubt_line(const StressStrainCurve& c, const FitRange& range, double r2) const {
    constexpr double least_r2 = 0.99, most_apart = 0.01;
    const double apart = slopes_apart(c.strain, c.stress, range);
    if (r2 >= least_r2 && apart <= most_apart) return;
    char text[480];
    std::snprintf(
        text, sizeof text,
        "Young's modulus is the slope of a line that the stress does not follow: from %.3g to %.3g of the peak "
        "r2 is %.4f, and every other one of the %zu samples gives a slope %.2g %% away from that of the rest. "
        "The specimen rings, or the range is not straight: load it more slowly or from rest, look at the "
        "curve, choose `range_lower` and `range_upper` by it",
        config_.range_lower, config_.range_upper, r2, range.size(), 100 * apart);
    host_->warn(text);
  }

  static void report_fit(const StressStrainCurve& c, const FitRange& range, const std::optional<Line>& slope,
                         const std::optional<Line>& lateral, Summary& summary) {
    summary.own("average.range.samples", range.size());
    if (range.size() > 0) {
      summary.own({"average.range.stress", "Pa"}, {c.stress[range.begin], c.stress[range.end - 1]});
      summary.own("average.range.strain", {c.strain[range.begin], c.strain[range.end - 1]});
    }
    if (slope) summary.own("average.range.r2_stress", slope->r2);
    if (lateral) summary.own("average.range.r2_lateral", lateral->r2);
  }

  Config config_;
  Host* host_ = nullptr;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::ElasticConstants, "postprocessor", "elastic_constants")
