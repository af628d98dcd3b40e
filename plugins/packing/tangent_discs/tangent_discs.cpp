// SPDX-License-Identifier: BSD-3-Clause
/// Packing of discs that touch their neighbours exactly.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "advancing_front.hpp"
#include "breccia/cell_grid.hpp"
#include "breccia/packing.hpp"
#include "breccia/plugin.hpp"

namespace breccia::tangent_discs {

namespace {

constexpr double smallest_share = 1e-4;  // of the container: for smaller radii rounding spoils the touching
constexpr double nearly = 1e-3;          // gap over r_i + r_j up to which the discs of Ouyang et al. (2017) are bonded

struct Quality {
  double max_overlap = 0, max_gap = 0;  // over r_i + r_j, of the pairs made to touch
  std::size_t nearly_touching = 0;      // other pairs
};

Quality measure(const AdvancingFront& front, const PackedParticles& p, double max) {
  Quality q;
  const auto gap = [&](Index i, Index j) {
    return (p.position[i] - p.position[j]).norm() / (p.radius[i] + p.radius[j]) - 1;
  };
  for (const Touch& t : front.touches()) {
    q.max_overlap = std::max(q.max_overlap, -gap(t.i, t.j));
    q.max_gap = std::max(q.max_gap, gap(t.i, t.j));
  }
  std::size_t within = 0;
  CellGrid(p.position, 2 * max * (1 + nearly)).for_each_pair([&](Index i, Index j) { within += gap(i, j) <= nearly; });
  q.nearly_touching = within - front.touches().size();
  return q;
}

}  // namespace

class TangentDiscs final : public Packing {
 public:
  struct Config {
    ContainerConfig container;
    double radius_min, radius_max;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Dense packing of discs that touch two or three neighbours exactly, by a geometric advancing front")
        .source("specimens of Ouyang et al. (2017), Appl. Sci. 7, 686, section 2.4; the method here is Breccia's own")
        .details(
            "Two dimensions only. Discs are placed one after the other and never moved. In the pocket between two "
            "discs (or "
            "walls) a disc grows until it meets a third: if its radius is then between radius_min and radius_max it "
            "touches "
            "three, if the pocket is too narrow it stays void, and if it is wider than radius_max a disc with a random "
            "radius, uniform between the two, touches two. The walls are lined first and the front moves inward until "
            "no disc of "
            "radius_min fits anywhere. Mean radius, porosity (about 14 % for a ratio of 3) and coordination number "
            "(about 5) follow.");
    s.param("container", &Config::container).doc("a box (a rectangle here) or a sphere (a disc here)");
    s.param("radius_min", &Config::radius_min).unit("m").above(0).example("0.3 mm").doc("of the discs");
    s.param("radius_max", &Config::radius_max).unit("m").above(0).example("0.9 mm").doc("of the discs");
    s.check([](const Config& c, Issues& issues) {
      if (c.radius_max < c.radius_min) issues.push_back({"radius_max", "is below radius_min"});
      try {
        const Container container = c.container.make(2);
        if (c.radius_max > container.largest_radius())
          issues.push_back({"radius_max", "the largest disc does not fit into the container"});
        if (c.radius_min < smallest_share * container.size().maxCoeff())
          issues.push_back({"radius_min", "is less than 1/10000 of the container: use larger radii"});
      } catch (const UserError& e) { issues.push_back({"container", e.what()}); }
    });
  }

  explicit TangentDiscs(const Config& config) : config_(config) {}

  std::string why_not(const PackingRequest& request) const override {
    return request.dimension == 2 ? "" : "it makes discs: it needs `dimension: 2`";
  }

  PackedParticles generate(const PackingRequest& request, Host& host) override {
    const Container container = config_.container.make(2);
    AdvancingFront front(container, config_.radius_min, config_.radius_max, request.seed, host);
    front.run();
    PackedParticles packed;
    for (const Disc& d : front.discs()) {
      packed.position.emplace_back(d.x.x(), d.x.y(), 0);
      packed.radius.push_back(d.r);
    }
    packed.outline = container.outline();
    packed.axis = container.axis();
    packed.container_volume = container.measure() * request.thickness;
    report(front, container, packed);
    char line[200];
    std::snprintf(line, sizeof line, "packed %zu discs: porosity %.4f, %.3f tangent neighbours each",
                  packed.radius.size(), packed.report[1].got, packed.report[2].got);
    host.info(line);
    return packed;
  }

 private:
  void report(const AdvancingFront& front, const Container& container, PackedParticles& packed) const {
    const double n = double(packed.radius.size());
    double sum = 0, squares = 0;
    for (const double r : packed.radius) {
      sum += r;
      squares += r * r;
    }
    const auto [low, high] = std::minmax_element(packed.radius.begin(), packed.radius.end());
    const Quality q = measure(front, packed, config_.radius_max);
    packed.report = {
        {"particles", "1", std::nullopt, n},
        {"porosity", "1", std::nullopt, 1 - std::numbers::pi * squares / container.measure()},
        {"coordination_number", "1", std::nullopt, 2 * double(front.touches().size()) / n},
        {"radius_mean", "m", std::nullopt, sum / n},
        {"radius_min", "m", config_.radius_min, *low},
        {"radius_max", "m", config_.radius_max, *high},
        {"tangent_pairs", "1", std::nullopt, double(front.touches().size())},
        {"max_overlap", "1", 0.0, q.max_overlap},
        {"max_gap", "1", 0.0, q.max_gap},
        {"nearly_tangent_pairs", "1", std::nullopt, double(q.nearly_touching)},
        {"tangencies_with_walls", "1", std::nullopt, double(front.touches_at_walls())},
    };
  }

  Config config_;
};

}  // namespace breccia::tangent_discs

BRECCIA_PLUGIN(breccia::tangent_discs::TangentDiscs, "packing", "tangent_discs")
