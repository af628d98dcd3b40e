// SPDX-License-Identifier: BSD-3-Clause
/// Uniaxial compression between two rigid platens that move toward each other.
/// Source: Rojek et al. (2012), section 5.2 (platens, stiffness, velocity); seating, ramp and stop are ours.
#include "breccia/protocol_tools/axial_test.hpp"

namespace breccia {

class UniaxialCompression final : public AxialTest {
 public:
  struct Config : AxialConfig {
    double seating_stress, jacket_pressure;
    PressureArea pressure_area;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Unconfined compression between two rigid platens, to failure, to a strain, or in stages")
        .source("Rojek et al. (2012), section 5.2")
        .details(
            "Two rigid planes start at the measured ends of the specimen and move toward each other along its axis, "
            "each at `platen_velocity`, reached over `ramp_time` with a smooth (cosine) rise. Strain is counted, and "
            "rows of curves.csv are written, from the moment both platens carry `seating_stress`.\n\n"
            "Curves: `platen_stress` (mean of the two platens' forces over the measured cross-section), "
            "`platen_strain` "
            "(approach of the platens since seating over the height then), `platen_imbalance` (difference of the two "
            "forces over their mean), `unbalanced_force_ratio` (mean resultant on a particle over mean contact "
            "force): small values say that the run is quasi-static; `stage`. With a jacket also those of "
            "`triaxial_compression`.");
    describe_axial(s, 0.3);
    s.param("seating_stress", &Config::seating_stress)
        .unit("Pa")
        .at_least(0)
        .fallback(0.5e6)
        .doc("both platens must carry this stress before strain is counted");
    s.param("jacket_pressure", &Config::jacket_pressure)
        .unit("Pa")
        .at_least(0)
        .fallback(0.0)
        .example("70 psi")
        .doc("of a sleeve on the lateral surface, held while the specimen is loaded")
        .source("Oñate et al. (2015), section 10.1.1: 70 psi");
    describe_pressure_area(s, &Config::pressure_area);
    s.check([](const Config& c, Issues& issues) {
      if (c.failure_stress && *c.failure_stress < c.seating_stress)
        issues.push_back({"failure_stress", "must not be below seating_stress"});
      refuse_confining_stages(c, "there is none in an unconfined test: use triaxial_compression", issues);
    });
  }

  explicit UniaxialCompression(const Config& c) : AxialTest(c, {}, jacket(c), c.seating_stress) {}

 private:
  static std::unique_ptr<Confinement> jacket(const Config& c) {
    if (c.jacket_pressure > 0) return std::make_unique<PressureConfinement>(c.pressure_area, c.jacket_pressure);
    return std::make_unique<Confinement>();
  }
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::UniaxialCompression, "protocol", "uniaxial_compression")
