// SPDX-License-Identifier: BSD-3-Clause
#include "labra_onate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "optimiser.hpp"
#include "quality.hpp"

namespace breccia::labra_onate {

namespace {
// With fewer spheres the loops are so short that waiting for each other costs more than the threads bring.
constexpr std::size_t worth_threads = 20000;
}  // namespace

PackedParticles LabraOnate::generate(const PackingRequest& request, Host& host) {
  BRECCIA_ASSERT(request.dimension == 2 || request.dimension == 3);
  const Container box = config_.container.make(request.dimension);
  const RadiusLaw law = config_.radius.law();
  const Sizes sizes = choose_sizes(config_, law, box, host);
  const std::size_t n = sizes.radii.size();

  OptimiserSettings settings;
  const double neighbours = config_.neighbours_per_particle.value_or(request.dimension == 2 ? 5.0 : 12.0);
  settings.pairs = std::max<std::size_t>(1, std::size_t(std::llround(0.5 * neighbours * double(n))));
  settings.max_iterations = int(config_.max_iterations);
  settings.tolerance = config_.tolerance;
  settings.size_correlation = config_.neighbour_size_correlation;
  settings.threads = n < worth_threads ? 1 : std::max(1, host.threads());

  Optimiser optimiser(box, sizes.radii, settings, host);
  Spheres s = optimiser.arrange(request.seed);
  optimiser.optimise_all(s);
  const StageRecord last = optimiser.optimise_centres(s);
  if (!last.converged)
    host.warn("the packing still improved when max_iterations was reached: raise it for a better one");
  host.progress("packing", 1);

  const Quality quality = measure(s, box, NeighbourFinder(box, settings.threads).find(s, settings.pairs));
  char line[200];
  std::snprintf(line, sizeof line, "packed %zu particles: porosity %.4f, %.2f neighbours each within %.3f of touching",
                n, quality.porosity, quality.neighbours, quality.tolerance);
  host.info(line);

  PackedParticles packed;
  packed.report = report(quality, config_, law, sizes.factor, neighbours, box, n);
  packed.position = std::move(s.x);
  packed.radius = std::move(s.r);
  packed.outline = box.outline();
  packed.axis = box.axis();
  packed.container_volume = box.measure() * (request.dimension == 2 ? request.thickness : 1.0);
  return packed;
}

}  // namespace breccia::labra_onate

BRECCIA_PLUGIN(breccia::labra_onate::LabraOnate, "packing", "labra_onate")
