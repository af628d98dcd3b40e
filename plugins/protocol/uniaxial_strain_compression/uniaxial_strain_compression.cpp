// SPDX-License-Identifier: BSD-3-Clause
/// Oedometer: compression along the axis in a rigid cell that allows no lateral strain.
/// Source: Oñate et al. (2015), section 10.1.2.
#include "breccia/protocol_tools/axial_test.hpp"

namespace breccia {

class UniaxialStrainCompression final : public AxialTest {
 public:
  struct Config : AxialConfig {
    double seating_stress;
    std::optional<double> cell_stiffness;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Compression along the axis without lateral strain, in a rigid cell (oedometer)")
        .source("Oñate et al. (2015), section 10.1.2")
        .details(
            "As `uniaxial_compression`, in a rigid and frictionless cell that the specimen just fills: a cylinder, or "
            "the sides of a box or "
            "rectangle. The curve `confining_pressure` is the mean normal stress on the cell, measured; "
            "`deviatoric_platen_stress` is the "
            "platen stress minus it (the \"differential stress\" of rock laboratories). What lateral strain the "
            "springs of the "
            "cell still let through is in the summary and in the measured lateral strain.");
    describe_axial(s, 0.0);
    s.param("seating_stress", &Config::seating_stress)
        .unit("Pa")
        .at_least(0)
        .fallback(0.1e6)
        .doc("both platens must carry this stress before strain is counted");
    s.param("cell_stiffness", &Config::cell_stiffness)
        .unit("N/m")
        .above(0)
        .doc("penalty stiffness of the contact of a particle with the cell; if absent that of the platens");
    s.check([](const Config& c, Issues& issues) {
      refuse_confining_stages(c, "in a rigid cell it follows from the axial strain: use triaxial_compression", issues);
    });
  }

  explicit UniaxialStrainCompression(const Config& c)
      : AxialTest(c, {}, std::make_unique<RigidConfinement>(c.cell_stiffness), c.seating_stress) {}
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::UniaxialStrainCompression, "protocol", "uniaxial_strain_compression")
