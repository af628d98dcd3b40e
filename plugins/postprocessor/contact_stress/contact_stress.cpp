// SPDX-License-Identifier: BSD-3-Clause
/// Micro-macro stress ratio: normal stress of the contacts over the axial stress of the specimen, by direction.
/// Source: Oñate et al. (2015), section 9, Fig. 11.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "breccia/postprocessor.hpp"
#include "loading.hpp"

namespace breccia {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double over(double sum, double count) { return count > 0 ? sum / count : nothing; }
Json number(double v) { return std::isfinite(v) ? Json(v) : Json(); }

/// What is said of an interval of directions and of all of them.
struct Means {
  double all, compressed, tensile, yielded;  // [Pa], `all` signed, compression positive
  explicit Means(const DirectionBin& b)
      : all(over(b.compression - b.tension, double(b.contacts))),
        compressed(over(b.compression, double(b.compressed))),
        tensile(over(b.tension, double(b.tensile))),
        yielded(over(b.yield, double(b.yielded))) {}
};

std::string percent(double share) {
  const double v = 100 * share;
  std::string text = v == std::round(v) ? std::to_string(std::lround(v)) : std::to_string(v);
  std::replace(text.begin(), text.end(), '.', '_');
  return text;
}

}  // namespace

class ContactStress final : public Postprocessor {
 public:
  struct Config {
    std::vector<double> at;
    long bins;
    double area_factor;
    std::optional<double> limit;
  };
  static void describe(Schema<Config>& s) {
    s.summary("Normal stress of the contacts over the axial stress of the specimen, by the direction of the contact")
        .source("Oñate et al. (2015), Comput. Part. Mech. 2, 301-314, section 9 and Fig. 11")
        .details(
            "sigma_c = F_n/(area_factor pi min(r_i, r_j)^2), in two dimensions F_n/(area_factor 2 min(r_i, r_j) t), "
            "over the mean "
            "stress along the axis of the specimen. Contacts are the intact bonds and all pairs that exert a force; "
            "the angle is "
            "that between the contact normal and the plane across the axis: 0 is lateral, pi/2 axial. Means over the "
            "contacts of "
            "each interval of angles: of all contacts (signed), of the compressed, of the tensile, and of those that "
            "carry `limit` "
            "or more. Taken on the first way up, at shares of the peak that are found at the end of the run (to 2 %).");
    s.param("at", &Config::at)
        .items(1, 20)
        .above(0)
        .at_most(1)
        .fallback({0.5, 1.0})
        .doc("shares of the highest axial stress; each gives a table");
    s.param("bins", &Config::bins)
        .at_least(1)
        .at_most(90)
        .fallback(18)
        .doc("equal intervals of the angle from 0 to pi/2");
    s.param("area_factor", &Config::area_factor)
        .above(0)
        .fallback(1.0)
        .doc("factor of the contact area, as in the contact law");
    s.param("limit", &Config::limit)
        .unit("Pa")
        .above(0)
        .example("8.5 MPa")
        .doc("compressive stress from which a contact counts as yielded: the law's first compressive limit");
    s.check([](const Config& c, Issues& issues) {
      for (std::size_t k = 0; k < c.at.size(); ++k)
        if (std::count(c.at.begin(), c.at.begin() + std::ptrdiff_t(k), c.at[k]) > 0)
          issues.push_back({"at[" + std::to_string(k) + "]", "is given twice"});
    });
  }

  explicit ContactStress(const Config& c)
      : c_(c), loading_(std::size_t(c.bins), *std::min_element(c.at.begin(), c.at.end())) {}

  bool sees_parts() const override { return true; }
  void begin(const SimulationView& view, Recorder&, Host&) override {
    if (!(view.specimen.volume > 0))
      throw UserError("contact_stress: the specimen has no volume to average over; check the packing");
  }
  void sample(const SimulationView& view, Recorder&) override { loading_.sample(view, c_.area_factor, c_.limit); }

  void finish(const SimulationView&, const Curves&, Summary& summary) override {
    const Snapshot* peak = loading_.peak();
    summary.own({"highest_axial_stress", "Pa"}, peak ? Json(peak->axial_stress) : Json());
    if (!peak) return;
    for (const double share : c_.at) {
      const Snapshot& s = *loading_.at(share);
      const std::string when = "at_" + percent(share) + "_percent";
      summary.table(table(s, "contact_stress_" + when));
      report(s, when + ".", summary);
    }
  }
  bool archive(Archive& archive) override {
    archive("loading", loading_);
    return true;
  }

 private:
  /// Of all contacts together.
  void report(const Snapshot& s, const std::string& section, Summary& summary) const {
    DirectionBin sum;
    for (const DirectionBin& b : s.bins) sum += b;
    const Means m(sum);
    summary.own({section + "axial_stress", "Pa"}, s.axial_stress);
    summary.own({section + "time", "s"}, s.time);
    summary.own(section + "contacts", sum.contacts);
    summary.own(section + "compressed", sum.compressed);
    summary.own(section + "ratio_all", number(m.all / s.axial_stress));
    summary.own(section + "ratio_compressed", number(m.compressed / s.axial_stress));
    summary.own(section + "ratio_tensile", number(m.tensile / s.axial_stress));
    if (!c_.limit) return;
    summary.own(section + "yielded", sum.yielded);
    summary.own(section + "ratio_yielded", number(m.yielded / s.axial_stress));
  }

  Table table(const Snapshot& s, std::string name) const {
    Table t{std::move(name),
            {{"angle_from", "rad", "between the contact normal and the plane across the axis"},
             {"angle_to", "rad", "upper edge"},
             {"contacts", "1", "intact bonds and pairs with a force"},
             {"compressed", "1", "of these"},
             {"tensile", "1", "of these"},
             {"normal_stress", "Pa", "mean over all contacts, compression positive"},
             {"ratio_all", "1", "that over the axial stress"},
             {"ratio_compressed", "1", "mean over the compressed contacts"},
             {"ratio_tensile", "1", "mean magnitude over the tensile contacts"}},
            {}};
    if (c_.limit) {
      t.columns.insert(t.columns.begin() + 5, {"yielded", "1", "contacts that carry the limit or more"});
      t.columns.push_back({"ratio_yielded", "1", "mean over these"});
    }
    t.values.resize(t.columns.size());
    const double width = 0.5 * std::numbers::pi / double(s.bins.size());
    for (std::size_t k = 0; k < s.bins.size(); ++k) {
      const DirectionBin& b = s.bins[k];
      const Means m(b);
      std::vector<double> row{double(k) * width, double(k + 1) * width, double(b.contacts), double(b.compressed),
                              double(b.tensile)};
      if (c_.limit) row.push_back(double(b.yielded));
      for (const double v : {m.all, m.all / s.axial_stress, m.compressed / s.axial_stress, m.tensile / s.axial_stress})
        row.push_back(v);
      if (c_.limit) row.push_back(m.yielded / s.axial_stress);
      for (std::size_t c = 0; c < row.size(); ++c) t.values[c].push_back(row[c]);
    }
    return t;
  }

  Config c_;
  FirstLoading loading_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::ContactStress, "postprocessor", "contact_stress")
