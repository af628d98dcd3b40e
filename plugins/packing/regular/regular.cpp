// SPDX-License-Identifier: BSD-3-Clause
/// Lattices of equal spheres or discs.
#include <cmath>
#include <numbers>

#include "breccia/packing.hpp"
#include "breccia/packing_tools/container.hpp"
#include "breccia/plugin.hpp"

namespace breccia {
namespace {

enum class Lattice { simple_cubic, body_centred_cubic, face_centred_cubic, hexagonal_close_packed, square, hexagonal };

/// An orthogonal cell, its sites in shares of the cell; lengths in distances of nearest neighbours.
struct UnitCell {
  Vec3 size;
  std::vector<Vec3> sites;
};

UnitCell cell_of(Lattice lattice) {
  const double root2 = std::numbers::sqrt2, root3 = std::numbers::sqrt3;
  switch (lattice) {
    case Lattice::simple_cubic:
      return {Vec3(1, 1, 1), {Vec3(0, 0, 0)}};
    case Lattice::body_centred_cubic:
      return {Vec3::Constant(2 / root3), {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5)}};
    case Lattice::face_centred_cubic:
      return {Vec3::Constant(root2), {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5), Vec3(0, 0.5, 0.5)}};
    case Lattice::hexagonal_close_packed:
      return {Vec3(1, root3, std::sqrt(8.0 / 3)),
              {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0, 1.0 / 3, 0.5), Vec3(0.5, 5.0 / 6, 0.5)}};
    case Lattice::square:
      return {Vec3(1, 1, 0), {Vec3(0, 0, 0)}};
    default:
      return {Vec3(1, root3, 0), {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0)}};
  }
}

bool is_flat(Lattice lattice) { return lattice == Lattice::square || lattice == Lattice::hexagonal; }

}  // namespace

class Regular final : public Packing {
 public:
  struct Config {
    Lattice lattice;
    ContainerConfig container;
    double radius;
    double gap;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Regular lattice of equal spheres or discs")
        .source(
            "textbook; a simple cubic lattice with the bonds of Rojek et al. (2012) has Young's modulus E_c exactly")
        .details(
            "Lattice sites are kept where a whole sphere is inside the container. In a box the lattice begins at the "
            "lower corner with spheres that touch the walls; in a cylinder a site of the lowest layer is on the axis; "
            "in "
            "a sphere or disc one is at the centre. Where space repeats itself (`periodic`) there are no walls, and "
            "the "
            "box is made as long as the nearest whole number of lattice cells. Cell edges are along x, y, z; the c "
            "axis of the hexagonal close "
            "packing is z.");
    s.param("lattice", &Config::lattice)
        .choice("sc", Lattice::simple_cubic, "simple cubic, 6 neighbours")
        .choice("bcc", Lattice::body_centred_cubic, "body-centred cubic, 8 neighbours")
        .choice("fcc", Lattice::face_centred_cubic, "face-centred cubic, 12 neighbours")
        .choice("hcp", Lattice::hexagonal_close_packed, "hexagonal close packing, 12 neighbours")
        .choice("square", Lattice::square, "two dimensions, 4 neighbours")
        .choice("hexagonal", Lattice::hexagonal, "two dimensions, 6 neighbours")
        .doc("arrangement of the centres");
    s.param("container", &Config::container).doc("the space to be filled");
    s.param("radius", &Config::radius).unit("m").above(0).example("1 mm").doc("of every particle");
    s.param("gap", &Config::gap)
        .above(-0.5)
        .at_most(1)
        .fallback(0.0)
        .doc("between nearest neighbours, over the sum of their radii; below zero they overlap");
    s.check([](const Config& c, Issues& issues) {
      try {
        if (c.radius > c.container.make().largest_radius())
          issues.push_back({"radius", "not one particle of this radius fits into the container"});
      } catch (const UserError& e) { issues.push_back({"container", e.what()}); }
    });
  }

  explicit Regular(const Config& config) : config_(config) {}

  std::string why_not(const PackingRequest& request) const override {
    if (is_flat(config_.lattice) == (request.dimension == 2)) return why_not_in(config_.container, request);
    return request.dimension == 2 ? "in two dimensions the lattice is square or hexagonal"
                                  : "in three dimensions the lattice is sc, bcc, fcc or hcp";
  }

  bool can_repeat() const override { return true; }
  bool makes_shares() const override { return true; }

  PackedParticles generate(const PackingRequest& request, Host&) override {
    const Container asked = config_.container.make(request.dimension),
                    container = request.repeats() ? asked.opened(request.periodic) : asked;
    const UnitCell cell = cell_of(config_.lattice);
    const double spacing = 2 * config_.radius * (1 + config_.gap), r = config_.radius;
    const Vec3 first = origin(container, r), edge = spacing * cell.size;
    const double sites =
        container.measure() / (request.dimension == 2 ? edge.x() * edge.y() : edge.prod()) * double(cell.sites.size());
    if (sites > 400e6) throw UserError("this lattice has more than 400 million particles: use a larger radius");
    PackedParticles packed;
    // From the first site the container reaches no farther than its own size either way.
    long low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    for (int k = 0; k < request.dimension; ++k) {
      high[k] = long(container.size()[k] / edge[k]) + 1;
      low[k] = -high[k];
      if (!request.periodic[std::size_t(k)]) continue;
      low[k] = 0;
      high[k] = std::max(1L, std::lround(container.size()[k] / edge[k])) - 1;
      packed.period[k] = double(high[k] + 1) * edge[k];
    }
    long count[3];
    for (int k = 0; k < 3; ++k) count[k] = high[k] - low[k] + 1;
    for (const std::size_t row : request.share_of(std::size_t(count[2] * count[1]))) {
      const long b = low[1] + long(row) % count[1], c = low[2] + long(row) / count[1];
      for (long a = low[0]; a <= high[0]; ++a)
        for (const Vec3& site : cell.sites) {
          const Vec3 x = first + edge.cwiseProduct(Vec3(double(a), double(b), double(c)) + site);
          if (fits(container, x, r)) packed.position.push_back(x);
        }
    }
    packed.radius.assign(packed.position.size(), r);
    packed.outline = container.outline();
    packed.axis = container.axis();
    double measure = container.measure();
    for (int k = 0; k < request.dimension; ++k)
      if (packed.period[k] > 0) measure *= packed.period[k] / container.size()[k];
    packed.container_volume = measure * (request.dimension == 2 ? request.thickness : 1.0);
    ExactSumOf<double> particles;
    particles.add(double(packed.radius.size()));
    const double all = request.share.sum(particles), each = Space{request.dimension}.solid_volume(r);
    packed.report = {{"particles", "1", std::nullopt, all}, {"porosity", "1", std::nullopt, 1 - each * all / measure}};
    for (int k = 0; k < request.dimension; ++k)
      if (packed.period[k] > 0)
        packed.report.push_back({std::string("period_") + "xyz"[k], "m", container.size()[k], packed.period[k]});
    return packed;
  }

 private:
  static Vec3 origin(const Container& c, double r) {
    const bool flat = c.dimension() == 2;
    switch (c.shape()) {
      case Container::Shape::cylinder:
        return {0, 0, r};
      case Container::Shape::sphere:
        return flat ? Vec3(0, 0.5 * c.size().y(), 0) : Vec3(0, 0, 0.5 * c.size().z());
      default:
        return flat ? Vec3(-0.5 * c.size().x() + r, r, 0) : Vec3(-0.5 * c.size().x() + r, -0.5 * c.size().y() + r, r);
    }
  }
  /// To rounding: a box of exactly ten diameters holds ten spheres.
  static bool fits(const Container& c, const Vec3& x, double r) {
    Container::Walls walls;
    const std::size_t n = c.walls(x, walls);
    for (std::size_t w = 0; w < n; ++w)
      if (walls[w].distance < r * (1 - 1e-9)) return false;
    return true;
  }

  Config config_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Regular, "packing", "regular")
