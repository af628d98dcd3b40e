// SPDX-License-Identifier: BSD-3-Clause
/// Biaxial compression of a rectangle of discs: what triaxial compression is in two dimensions.
/// Source: named as work to come by Ouyang, Yang & Chen (2017), Appl. Sci. 7(7), 686; the procedure is that of Oñate et
/// al. (2015), section 10.1.1.
#include "breccia/protocol_tools/confined_test.hpp"

namespace breccia {

class BiaxialCompression final : public ConfinedTest {
 public:
  using Config = ConfinedConfig;

  static void describe(Schema<Config>& s) {
    s.summary(
         "Two dimensions: equal pressure all round, then compression along the axis with the lateral pressure held")
        .source("procedure: Oñate et al. (2015), section 10.1.1")
        .details(
            "A rectangle of discs. The platens and the pressure on the two free sides are first led to "
            "`confining_pressure` together; once "
            "the platens carry it and the specimen is at rest, they close while the lateral pressure is held. With "
            "`stages` any sequence. "
            "The pressure acts on the discs that are seen from outside, each over its share of the side's length times "
            "the thickness. "
            "There is no stress out of plane to control: discs have none.\n\n"
            "Curves: those of `triaxial_compression`.");
    describe_confined(s, "on all four sides at first, then held on the two lateral ones");
  }

  using ConfinedTest::ConfinedTest;

  void setup(const SimulationView& view, LoadControl& control, Recorder& recorder, Host& host) override {
    if (view.dimension != 2)
      throw UserError(
          "protocol biaxial_compression: this is a test of discs (`dimension: 2`); of spheres it is "
          "triaxial_compression");
    ConfinedTest::setup(view, control, recorder, host);
  }
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::BiaxialCompression, "protocol", "biaxial_compression")
