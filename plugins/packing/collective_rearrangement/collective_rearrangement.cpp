// SPDX-License-Identifier: BSD-3-Clause
/// Packing of spheres with exactly given radii by collective rearrangement.
#include <cmath>

#include "../../shared/printed.hpp"
#include "breccia/plugin.hpp"
#include "cut.hpp"
#include "mesh_region.hpp"
#include "report.hpp"
#include "vessel.hpp"

namespace breccia::collective_rearrangement {

namespace {

std::size_t number_for(double porosity, const RadiusLaw& law, double measure, int dimension) {
  constexpr std::size_t samples = 10000;
  const double each = solid_measure(quantile_radii(law, samples), dimension) / samples;
  const double wanted = (1 - porosity) * measure / each;
  if (wanted > 50e6)
    throw UserError(printed("this porosity takes %.3g particles, more than 50 million: use larger radii", wanted));
  return std::size_t(std::max(1.0, std::round(wanted)));
}

}  // namespace

class CollectiveRearrangement final : public Packing {
 public:
  using Config = collective_rearrangement::Config;

  static void describe(Schema<Config>& s) {
    s.summary("Packing of spheres with exactly the radii given, by collective rearrangement of overlapping spheres")
        .source(
            "force-biased algorithm: Mościński & Bargieł (1991), Comput. Phys. Commun. 64, 183-192; after Jodrey & "
            "Tory (1985), Phys. Rev. A 32, 2347; Rojek et al. (2012), section 5.1")
        .details(
            "Spheres are strewn at random with 60 % of their radii, which then grow in steps; at each size all "
            "overlapping "
            "pairs push each other apart until the energy 1/2 sum (1 - d/s)^2, s = r_i + r_j, is least. The radii end "
            "as "
            "they were asked for, to the last bit. Down to the density at which such a packing jams no overlap is "
            "left; "
            "beyond it the overlaps are spread evenly, and `overlap_tolerance` says how large the largest may be. "
            "Number and radii "
            "fix the porosity, so only one of particles and porosity is given. With a margin the packing is made "
            "larger "
            "and the specimen cut out of it, so that no layers form along the walls: spheres belong to it when their "
            "centres do. Where space repeats itself (`periodic`) a box has no walls. In two dimensions the particles "
            "are "
            "discs.");
    s.param("container", &Config::container).doc("the space to be filled");
    s.param("mesh", &Config::mesh).doc("a closed surface that is filled instead");
    s.param("radius", &Config::radius).doc("of the particles");
    s.param("particles", &Config::particles).at_least(1).at_most(50e6).example("5868").doc("how many");
    s.param("porosity", &Config::porosity)
        .above(0)
        .below(1)
        .example("0.40")
        .doc("void fraction, overlaps counted twice: the number of particles that comes nearest to it is packed");
    s.param("neighbours_per_particle", &Config::neighbours_per_particle)
        .above(0)
        .at_most(20)
        .example("10.7")
        .doc(
            "after the rearrangement, draw so many neighbours per particle toward touching each other: evens gaps out "
            "against overlaps, for packings that are to be bonded. Without it gaps stay as they are")
        .source("objective of Labra & Oñate (2009), with the radii kept");
    s.param("margin", &Config::margin)
        .unit("m")
        .at_least(0)
        .example("2 mm")
        .doc("pack a space larger by this all round, and cut the specimen out of it; if absent nothing is cut");
    s.param("flat_ends", &Config::flat_ends)
        .fallback(true)
        .doc(
            "with a margin: leave the ends of a cylinder or box where they are, so that platens find spheres that "
            "touch them");
    s.param("vessel", &Config::vessel)
        .unit("m")
        .items(2, 3)
        .example("[31.7 mm, 63.4 mm]")
        .doc(
            "instead of a margin: pack a box of this size along x, y, z and cut the container out of its middle. Where "
            "the two are equally wide, the particles lie flush against what may become a platen")
        .source("Potyondy & Cundall (2004), Int. J. Rock Mech. Min. Sci. 41, 1329-1364");
    s.param("overlap_tolerance", &Config::overlap_tolerance)
        .at_least(1e-6)
        .at_most(0.5)
        .fallback(1e-3)
        .doc("largest overlap allowed in the packing, over the sum of the radii; a denser packing is refused");
    s.param("max_iterations", &Config::max_iterations)
        .at_least(1)
        .at_most(1000000)
        .fallback(5000)
        .doc("largest number of steps at the final size");
    s.param("tolerance", &Config::tolerance)
        .above(0)
        .below(1)
        .fallback(2e-3)
        .doc("ends when fifty steps lower the energy by less than this share");
    s.exactly_one_of({"container", "mesh"});
    s.exactly_one_of({"particles", "porosity"});
    // The porosity is that of the vessel; how many particles of it the specimen gets is known when it is cut out.
    s.at_most_one_of({"vessel", "margin"}).at_most_one_of({"vessel", "mesh"}).at_most_one_of({"vessel", "particles"});
    s.check([](const Config& c, Issues& issues) { check_fit(c.container, c.radius, issues); });
  }

  explicit CollectiveRearrangement(const Config& config) : config_(config) {}

  std::vector<std::filesystem::path> inputs() const override {
    if (!config_.mesh) return {};
    return {config_.mesh->file};
  }

  std::string why_not(const PackingRequest& request) const override {
    if (request.repeats() && (config_.mesh || margin() > 0 || config_.vessel))
      return std::string("where space repeats itself (`periodic`) ") +
             (config_.mesh     ? "a mesh cannot be filled: use a box"
              : config_.vessel ? "nothing is cut out of a vessel: leave `vessel` out"
                               : "there is no boundary to keep off: leave `margin` out");
    if (config_.mesh) return request.dimension == 2 ? "a mesh cannot be packed in two dimensions: use a container" : "";
    const std::string why = why_not_in(*config_.container, request);
    return why.empty() && config_.vessel ? why_not_out_of(*config_.vessel, config_.container->make(request.dimension))
                                         : why;
  }

  bool can_repeat() const override { return true; }

  PackedParticles generate(const PackingRequest& request, Host& host) override {
    const int dimension = request.dimension;
    const std::unique_ptr<Region> region = make_region(request, std::max(1, host.threads()));
    Vec3 period = Vec3::Zero();
    for (int k = 0; k < dimension; ++k)
      if (request.periodic[std::size_t(k)]) period[k] = config_.container->make(dimension).size()[k];
    Space within = request;
    within.cell = Cell::box(period);
    const RadiusLaw law = config_.radius.law();
    const std::size_t wanted = config_.particles ? std::size_t(*config_.particles)
                                                 : number_for(*config_.porosity, law, region->measure(), dimension);
    const bool ends = !config_.flat_ends;
    const std::unique_ptr<Region> larger = config_.vessel ? vessel(dimension)
                                           : margin() > 0 ? region->grown(margin(), ends)
                                                          : nullptr;
    const Region& space = larger ? *larger : *region;
    auto packed_number = config_.vessel
                             ? number_for(*config_.porosity, law, space.measure(), dimension)
                             : std::size_t(std::llround(double(wanted) * space.measure() / region->measure()));
    Outcome outcome;
    Cut cut;
    for (int attempt = 1;; ++attempt) {
      cut.spheres = rearrange(space, within, quantile_radii(law, packed_number), request.seed, host, outcome);
      if (!larger) break;
      if (config_.vessel) {
        const Vec3 place = place_in(vessel_box(*config_.vessel, dimension), config_.container->make(dimension));
        cut.spheres = cut_at(cut.spheres, *region, place);
        break;
      }
      cut = cut_out(cut.spheres, *region, margin(), ends, dimension, wanted,
                    solid_measure(quantile_radii(law, wanted), dimension), request.seed);
      if (cut.spheres.size() == wanted || attempt == most_attempts || cut.mean_number == 0) break;
      // Along its walls the larger packing is looser than inside: there it has more than its share.
      packed_number = std::size_t(std::llround(double(packed_number) * double(wanted) / cut.mean_number));
    }
    if (!outcome.converged)
      host.warn("the packing still improved when max_iterations was reached: raise it for a better one");
    if (cut.spheres.size() == 0)
      throw UserError(
          "no particle has its centre in the specimen cut out: use more or smaller ones, or a smaller margin");
    const Quality q = measure(cut.spheres, region->measure(), within);
    host.info(printed(
        "packed %zu particles: porosity %.4f, %.2f contacts each, overlaps up to %.3g %% of the sum of the radii",
        cut.spheres.size(), q.porosity, q.contacts, 100 * q.max_overlap));
    if (q.max_overlap > config_.overlap_tolerance)
      throw UserError(
          printed("spheres of these radii cannot be packed so densely: the best packing found, with a porosity of "
                  "%.2f %%, has overlaps of %.3g %% of the sum of the radii at most and %.3g %% on average. Ask "
                  "for fewer particles or more porosity, or allow these overlaps with overlap_tolerance",
                  100 * q.porosity, 100 * q.max_overlap, 100 * q.mean_overlap));
    PackedParticles packed;
    packed.report = report(q, law, wanted, cut.spheres.size(), packed_number, outcome);
    packed.position = std::move(cut.spheres.x);
    packed.period = period;
    if (request.repeats()) {  // all into the box
      const Vec3 low = config_.container->make(dimension).low();
      for (Vec3& x : packed.position)
        x -= within.cell.vectors() * Vec3((within.cell.inverse() * (x - low)).array().floor());
    }
    packed.radius = std::move(cut.spheres.r);
    packed.outline = region->outline();
    packed.axis = region->axis();
    packed.container_volume = region->measure() * (dimension == 2 ? request.thickness : 1.0);
    return packed;
  }

 private:
  static constexpr int most_attempts = 3;  // to cut out the number asked for

  Spheres rearrange(const Region& region, const Space& space, std::vector<double> radii, std::uint64_t seed, Host& host,
                    Outcome& outcome) const {
    const std::size_t n = radii.size();
    if (n == 0) throw UserError("not one particle goes into the space to be filled: use smaller ones");
    if (radii.back() > region.largest_radius())
      throw UserError(
          printed("the largest particle, of radius %.4g m, does not fit into the space to be filled", radii.back()));
    const double share = solid_measure(radii, space.dimension) / region.measure();
    if (n > 1 && share > 0.95)
      throw UserError(printed(
          "%zu particles of these radii have %.3g of the volume to be filled: use fewer or smaller ones", n, share));
    Rearrangement rearrangement(region, space, std::move(radii), seed,
                                {int(config_.max_iterations), config_.tolerance, std::max(1, host.threads())}, host);
    outcome = rearrangement.run();
    if (config_.neighbours_per_particle) {
      const Outcome closed =
          rearrangement.close(std::size_t(std::llround(0.5 * *config_.neighbours_per_particle * double(n))));
      outcome = {outcome.converged && closed.converged, outcome.iterations + closed.iterations};
    }
    return rearrangement.spheres();
  }

  std::unique_ptr<Region> make_region(const PackingRequest& request, int threads) const {
    if (!config_.mesh) {
      const Container box = config_.container->make(request.dimension);
      return std::make_unique<ContainerRegion>(request.repeats() ? box.opened(request.periodic) : box);
    }
    return read_mesh(*config_.mesh, threads);
  }

  double margin() const { return config_.margin.value_or(0); }

  std::unique_ptr<Region> vessel(int dimension) const {
    return std::make_unique<ContainerRegion>(vessel_box(*config_.vessel, dimension));
  }

  std::vector<AskedGot> report(const Quality& q, const RadiusLaw& law, std::size_t wanted, std::size_t got,
                               std::size_t packed, const Outcome& outcome) const {
    std::vector<AskedGot> lines = {
        {"particles", "1", config_.vessel ? std::nullopt : std::optional<double>(double(wanted)), double(got)},
        {"porosity", "1", config_.porosity, q.porosity},
        {"radius_mean", "m", law.mean, q.radius_mean},
        {"radius_standard_deviation", "m", law.standard_deviation, q.radius_deviation},
        {"radius_min", "m", law.min, q.radius_min},
        {"radius_max", "m", law.max, q.radius_max},
        {"contacts_per_particle", "1", std::nullopt, q.contacts},
        {"mean_overlap", "1", std::nullopt, q.mean_overlap},
        {"max_overlap", "1", config_.overlap_tolerance, q.max_overlap},
        {"fabric_xx", "1", std::nullopt, q.fabric.x()},
        {"fabric_yy", "1", std::nullopt, q.fabric.y()},
        {"fabric_zz", "1", std::nullopt, q.fabric.z()},
        {"iterations", "1", std::nullopt, double(outcome.iterations)},
    };
    if (margin() > 0 || config_.vessel)
      lines.push_back({"particles_before_cutting", "1", std::nullopt, double(packed)});
    return lines;
  }

  Config config_;
};

}  // namespace breccia::collective_rearrangement

BRECCIA_PLUGIN(breccia::collective_rearrangement::CollectiveRearrangement, "packing", "collective_rearrangement")
