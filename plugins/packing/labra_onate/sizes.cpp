// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "../../shared/printed.hpp"
#include "config.hpp"

namespace breccia::labra_onate {

namespace {

void judge_porosity(double porosity, int dimension, Host& host) {
  // Overlaps grow without bound below, and spheres no longer touch above: measured, see the README.
  // 1e-9: a porosity that was asked for comes back with a rounding error.
  const double impossible = dimension == 2 ? 0.03 : 0.10, tight = dimension == 2 ? 0.08 : 0.18;
  const double loose = dimension == 2 ? 0.25 : 0.45;
  if (porosity < impossible - 1e-9)
    throw UserError(
        printed("a porosity of %.3g %% is out of reach: particles would mostly lie inside each other. Ask for "
                "at least %.3g %%, with fewer particles or smaller radii",
                100 * porosity, 100 * impossible));
  if (porosity < tight - 1e-9)
    host.warn(printed("a porosity of %.3g %% means large overlaps: see the overlaps in the report of the packing",
                      100 * porosity));
  if (porosity > loose + 1e-9)
    host.warn(
        printed("a porosity of %.3g %% is too loose for a dense packing: particles will gather in clusters with "
                "voids between them",
                100 * porosity));
}

}  // namespace

Sizes choose_sizes(const Config& c, const RadiusLaw& law, const Container& box, Host& host) {
  const int dimension = box.dimension();
  std::size_t n = c.particles ? std::size_t(*c.particles) : 0;
  if (!c.particles) {
    BRECCIA_ASSERT(c.porosity);
    constexpr std::size_t samples = 1000;
    const double each = solid_measure(quantile_radii(law, samples), dimension) / samples;
    const double wanted = (1 - *c.porosity) * box.measure() / each;
    if (wanted > 50e6)
      throw UserError(printed("this porosity takes %.3g particles, more than 50 million: use larger radii", wanted));
    n = std::size_t(std::max(1.0, std::round(wanted)));
  }
  Sizes sizes{quantile_radii(law, n), 1};
  if (c.porosity) {
    const double ratio = (1 - *c.porosity) * box.measure() / solid_measure(sizes.radii, dimension);
    sizes.factor = std::pow(ratio, 1.0 / dimension);
    if (sizes.factor > 1.5 || sizes.factor < 1 / 1.5)
      throw UserError(
          printed("these radii do not go with this porosity: they would have to be multiplied by %.3g. About "
                  "%.0f particles of these radii give it; change particles, porosity, radius or container",
                  sizes.factor, double(n) * ratio));
    if (std::abs(sizes.factor - 1) > 0.02)
      host.warn(printed("all radii were multiplied by %.4f, so that %.0f particles give the porosity asked for",
                        sizes.factor, double(n)));
    for (double& r : sizes.radii) r *= sizes.factor;
  }
  judge_porosity(1 - solid_measure(sizes.radii, dimension) / box.measure(), dimension, host);
  if (sizes.radii.back() > box.largest_radius())
    throw UserError(
        printed("the largest particle, of radius %.4g m, does not fit into the container, where %.4g m is the "
                "largest that does",
                sizes.radii.back(), box.largest_radius()));
  return sizes;
}

}  // namespace breccia::labra_onate
