// SPDX-License-Identifier: BSD-3-Clause
/// Equal spheres in a box, on a cubic grid, each moved at random within its cell.
/// Sources: name the paper of the method here; README.md says more.
#include <cmath>
#include <numbers>
#include <random>

#include "breccia/packing.hpp"

class NewPluginName final : public breccia::Packing {
 public:
  /// What the workflow says, in SI units and within its range when it comes here.
  struct Config {
    breccia::Vec3 size;
    double spacing, jitter;
  };

  /// One declaration for each parameter: messages, `breccia describe` and the editor's help are made from it.
  static void describe(breccia::Schema<Config>& s) {
    s.summary("Equal spheres on a cubic grid, each moved at random within its cell")
        .source("say where the method comes from")
        .details(
            "The box has x and y centred and z from 0. Spheres touch neither each other nor the box, see README.md.");
    s.param("size", &Config::size).unit("m").above(0).example("[8 mm, 8 mm, 16 mm]").doc("edges of the box");
    s.param("spacing", &Config::spacing).unit("m").above(0).example("2 mm").doc("edge of the cubic cells");
    s.param("jitter", &Config::jitter)
        .at_least(0)
        .below(1)
        .fallback(0.2)
        .doc("farthest way of a centre along each direction, over half the spacing; the radius shrinks by as much");
    // Rules between parameters, with the place that the message points at.
    s.check([](const Config& c, breccia::Issues& issues) {
      if (cells(c).minCoeff() < 1) issues.push_back({"spacing", "not one cell of this size fits into the box"});
    });
  }

  explicit NewPluginName(const Config& config) : config_(config) {}

  /// What can be told without making it: `breccia validate` says it, too.
  std::string why_not(const breccia::PackingRequest& request) const override {
    return request.dimension == 2 ? "it makes spheres: leave `dimension: 2` out" : "";
  }

  /// The same request must give the same bits, for any number of threads: random numbers come from `request.seed`
  /// alone. What takes long asks `host.cancelled()` now and then, and tells `host.progress(...)`.
  breccia::PackedParticles generate(const breccia::PackingRequest& request, breccia::Host&) override {
    const breccia::Vec3 n = cells(config_), corner(-0.5 * config_.size.x(), -0.5 * config_.size.y(), 0);
    if (n.prod() > 50e6) throw breccia::UserError("this grid has more than 50 million spheres: use a larger spacing");
    const double way = 0.5 * config_.jitter * config_.spacing, radius = 0.5 * config_.spacing - way;
    std::mt19937_64 random(request.seed);
    const auto moved = [&] { return way * (0x1p-52 * double(random() >> 11) - 1); };  // from -way to way

    breccia::PackedParticles packed;
    for (double k = 0; k < n.z(); ++k)
      for (double j = 0; j < n.y(); ++j)
        for (double i = 0; i < n.x(); ++i) {
          const double x = moved(), y = moved(), z = moved();  // in this order
          packed.position.push_back(corner + config_.spacing * breccia::Vec3(i + 0.5, j + 0.5, k + 0.5) +
                                    breccia::Vec3(x, y, z));
          packed.radius.push_back(radius);
        }
    packed.outline = breccia::SpecimenShape::Outline::box;
    packed.container_volume = config_.size.prod();
    // What was got, beside what was asked for (`asked` is empty here), as the run's summary shows it.
    const double solid = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    packed.report = {{"particles", "1", std::nullopt, n.prod()},
                     {"radius", "m", std::nullopt, radius},
                     {"porosity", "1", std::nullopt, 1 - solid * n.prod() / config_.size.prod()}};
    return packed;
  }
  // A packing that can fill a space that repeats itself (`periodic: [x, y, z]`) overrides `can_repeat` and says in
  // `packed.period` after which lengths; one that reads files names them in `inputs`.

 private:
  /// How many cells the box holds along each edge; to rounding, so that 8 mm hold four of 2 mm.
  static breccia::Vec3 cells(const Config& c) { return (c.size / c.spacing * (1 + 1e-9)).array().floor(); }

  Config config_;
};

BRECCIA_PLUGIN(NewPluginName, "packing", "new_plugin_name")
