// SPDX-License-Identifier: BSD-3-Clause
/// Large specimens cheaply: a cell that repeats itself, packed once, side by side with copies of itself.
#include <cmath>

#include "../../shared/printed.hpp"
#include "../../shared/sphere_file/source.hpp"
#include "breccia/text_file.hpp"
#include "copied.hpp"
#include "seams.hpp"

namespace breccia::replicated_cell {

namespace {

constexpr double most_particles = 400e6;  // rows of pairs are counted in 32 bits
constexpr double bytes_each = 2000;       // of a run with some six bonds a particle, as measured

}  // namespace

class ReplicatedCell final : public Packing {
 public:
  struct Config : sphere_file::Source {
    std::optional<Counts> copies;
    std::optional<ContainerConfig> cut;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Copies of a periodic cell side by side: a large specimen of a small packing")
        .source("bricks as in PFC (Itasca); what is compared at the seams is Breccia's own")
        .details(
            std::string("The cell is a file whose particles repeat themselves after `period`, such as a frame of a "
                        "run with `periodic`. Each copy is the cell moved by whole periods: contacts across the "
                        "seams are those of the cell across its own boundary, and porosity, sizes and coordination "
                        "number are the cell's. With `copies` all of the block is the specimen; where space does "
                        "not repeat itself particles reach out of its faces by up to a radius. With `cut` the "
                        "particles with their centres in that shape are. ") +
            sphere_file::form_of_files);
    sphere_file::describe(s);
    s.param("copies", &Config::copies)
        .example("{x: 2, y: 3}")
        .doc("how many cells side by side, the first as in the file");
    s.param("cut", &Config::cut)
        .example("{shape: cylinder, diameter: 50 mm, height: 100 mm}")
        .doc(
            "instead: what is cut out of as many copies as it takes. Where space repeats itself (`periodic`) a box is "
            "made as long as the nearest whole number of cells");
    s.exactly_one_of({"copies", "cut"});
    s.check([](const Config& c, Issues& issues) {
      if (c.cut) {
        try {
          c.cut->make();
        } catch (const UserError& e) { issues.push_back({"cut", e.what()}); }
      }
      if (has_ending(c.file, ".csv") && !c.period)
        issues.push_back({"period", "a .csv file does not say after which length it repeats itself: add `period`"});
    });
  }

  explicit ReplicatedCell(const Config& config) : config_(config) {}

  std::vector<std::filesystem::path> inputs() const override { return sphere_file::inputs(config_); }
  bool can_repeat() const override { return true; }
  bool makes_shares() const override { return true; }

  std::string why_not(const PackingRequest& request) const override {
    const bool flat = request.dimension == 2;
    if (flat && config_.copies && config_.copies->z > 1) return "in two dimensions there are no copies along z";
    if (flat && config_.period && config_.period->size() > 2 && (*config_.period)[2] > 0)
      return "in two dimensions nothing repeats itself along z: leave the third entry of `period` out";
    return config_.cut ? why_not_in(*config_.cut, request) : "";
  }

  PackedParticles generate(const PackingRequest& request, Host& host) override {
    const std::string file = config_.file.string();
    Vec3 period;
    const PackedParticles as_read = read(request, period, host), cell = folded(as_read, period);
    Space of_cell = request;
    of_cell.cell = Cell::box(period);
    Extent extent{cell.position[0], cell.position[0], *std::max_element(cell.radius.begin(), cell.radius.end())};
    for (const Vec3& x : cell.position) {
      extent.low = extent.low.cwiseMin(x);
      extent.high = extent.high.cwiseMax(x);
    }
    const Placing place = config_.cut ? place_cut(*config_.cut, period, extent, request, file)
                                      : place_block(*config_.copies, period, extent, request, file);
    refuse_too_many(place, cell.radius.size(), host);
    std::array<bool, 3> seams{};
    for (std::size_t k = 0; k < 3; ++k) {
      seams[k] = request.periodic[k] || place.copies.count[k] > 1;
      for (std::size_t p = 0; p < cell.radius.size(); ++p)
        seams[k] = seams[k] || cell.position[p][int(k)] != as_read.position[p][int(k)];
    }
    if (const std::string fault = fault_at_seams(as_read, of_cell, seams); !fault.empty())
      throw UserError(file + " is no cell that can be put beside itself: " + fault);

    const Copied copies(cell, of_cell, place, request);
    PackedParticles all = copies.particles(host);
    const CellMeasures got = copies.measure(host);
    if (got.particles == 0) throw UserError("no particle has its centre in what is cut out: `cut` is too small");
    for (int k = 0; k < request.dimension; ++k)
      if (request.periodic[std::size_t(k)]) all.period[k] = place.size[k];
    all.outline = place.cut ? place.cut->outline() : SpecimenShape::Outline::box;
    all.axis = place.cut                ? place.cut->axis()
               : request.dimension == 2 ? Container::rectangle(place.size.x(), place.size.y()).axis()
                                        : Container::box(place.size.x(), place.size.y(), place.size.z()).axis();
    if (place.measure) all.container_volume = *place.measure * (request.dimension == 2 ? request.thickness : 1.0);
    report(copies.cell_alone(), got, of_cell, place, request, all);
    return all;
  }

 private:
  PackedParticles read(const PackingRequest& request, Vec3& period, Host& host) const {
    PackingRequest of_cell = request;
    of_cell.share = {};  // the cell is small: each has all of it
    sphere_file::Spheres spheres = sphere_file::read(config_, of_cell);
    period = sphere_file::period_of(config_, spheres);
    if (request.dimension == 2) period.z() = 0;
    Space space = request;
    space.cell = Cell::box(period);
    sphere_file::refuse_bad(config_, spheres, space, {});
    for (const std::string& column : spheres.ignored)
      host.info("packing replicated_cell: column `" + column + "` of " + config_.file.string() +
                " is not used: it is not all numbers");
    PackedParticles cell;
    cell.position = std::move(spheres.position);
    cell.radius = std::move(spheres.radius);
    cell.columns = std::move(spheres.columns);
    return cell;
  }

  /// With all centres within one period, from the lowest on: what is there already is not moved.
  static PackedParticles folded(PackedParticles cell, const Vec3& period) {
    Vec3 low = cell.position[0];
    for (const Vec3& x : cell.position) low = low.cwiseMin(x);
    for (Vec3& x : cell.position)
      for (int k = 0; k < 3; ++k)
        if (period[k] > 0) x[k] -= period[k] * std::floor((x[k] - low[k]) / period[k]);
    return cell;
  }

  void refuse_too_many(const Placing& place, std::size_t particles, Host& host) const {
    const double in_all = place.copies_in_all() * double(particles);
    const auto& n = place.copies.count;
    const std::string what =
        printed("%ld x %ld x %ld copies of %zu particles are %.3g; a run of so many takes about %.3g GB", n[0], n[1],
                n[2], particles, in_all, 1e-9 * bytes_each * in_all);
    if (in_all > most_particles)
      throw UserError(what + printed(". More than %.0f million particles cannot be had: ", 1e-6 * most_particles) +
                      (config_.cut ? "look at the units of `cut` and `period`" : "ask for fewer copies"));
    if (in_all > 1e6) host.info("packing replicated_cell: " + what);
  }

  /// Asked for is what the cell has.
  static void report(const CellMeasures& cell, const CellMeasures& got, const Space& of_cell, const Placing& place,
                     const PackingRequest& request, PackedParticles& all) {
    all.report = {{"particles", "1", {}, got.particles}, {"cell_particles", "1", {}, cell.particles}};
    for (std::size_t k = 0; k < std::size_t(request.dimension); ++k)
      all.report.push_back({std::string("copies_") + "xyz"[k], "1", {}, double(place.copies.count[k])});
    if (place.measure) {
      double of_one = 1;
      for (int k = 0; k < request.dimension; ++k) of_one *= of_cell.cell.vectors()(k, k);
      all.report.push_back({"porosity", "1", of_one > 0 ? std::optional(1 - cell.solid / of_one) : std::nullopt,
                            1 - got.solid / *place.measure});
    }
    all.report.insert(all.report.end(),
                      {{"contacts_per_particle", "1", cell.contacts, got.contacts},
                       {"max_overlap", "1", cell.max_overlap, got.max_overlap},
                       {"radius_mean", "m", cell.radius_mean, got.radius_mean},
                       {"radius_standard_deviation", "m", cell.radius_deviation, got.radius_deviation},
                       {"radius_min", "m", cell.radius_min, got.radius_min},
                       {"radius_max", "m", cell.radius_max, got.radius_max}});
    for (int k = 0; k < request.dimension; ++k)
      if (all.period[k] > 0)
        all.report.push_back({std::string("period_") + "xyz"[k], "m",
                              place.cut ? std::optional(place.cut->size()[k]) : std::nullopt, all.period[k]});
  }

  Config config_;
};

}  // namespace breccia::replicated_cell

BRECCIA_PLUGIN(breccia::replicated_cell::ReplicatedCell, "packing", "replicated_cell")
