// SPDX-License-Identifier: BSD-3-Clause
/// Triaxial compression: hydrostatic confinement, then loading along the axis while the lateral pressure is held.
/// Source: Oñate et al. (2015), section 10.1.1 (procedure, forces on the surface particles); servo and stages are ours.
#include "breccia/protocol_tools/confined_test.hpp"

namespace breccia {

class TriaxialCompression final : public ConfinedTest {
 public:
  using Config = ConfinedConfig;

  static void describe(Schema<Config>& s) {
    s.summary("Hydrostatic confinement, then compression along the axis with the lateral pressure held")
        .source("Oñate et al. (2015), section 10.1.1")
        .details(
            "The platens and the pressure on the lateral surface are first led to `confining_pressure` together; once "
            "the platens carry it and "
            "the specimen is at rest, they close at `platen_velocity` while the lateral pressure is held. With "
            "`stages` any sequence of these, "
            "cycles of unloading and reloading included. Nothing is to be tuned: the servo of the platens and the time "
            "of the confinement "
            "follow from the stiffness and wave speed of the bonds.\n\n"
            "The pressure acts on the particles that are seen from outside, normal to the surface. Rows of curves.csv "
            "begin with the "
            "confinement: strains of other post-processors count from the specimen without load, `platen_strain` from "
            "the end of the first "
            "confining stage. In two dimensions this is biaxial compression.\n\n"
            "Curves: those of `uniaxial_compression`; `confining_pressure` (asked for), `confining_pressure_applied` "
            "(sum of the forces over "
            "the lateral surface as measured), `deviatoric_platen_stress` (platen stress minus the applied pressure).");
    describe_confined(s, "hydrostatic at first, then held on the lateral surface");
  }

  using ConfinedTest::ConfinedTest;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::TriaxialCompression, "protocol", "triaxial_compression")
