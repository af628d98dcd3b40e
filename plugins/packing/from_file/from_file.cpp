// SPDX-License-Identifier: BSD-3-Clause
/// A packing made elsewhere: a table of spheres, or a frame of an earlier run.
#include <algorithm>
#include <array>

#include "../../shared/sphere_file/source.hpp"
#include "breccia/text_file.hpp"

namespace breccia {

enum class AxisName { x, y, z };
enum class Filled { cylinder, box, sphere, disc };

class FromFile final : public Packing {
 public:
  struct Config : sphere_file::Source {
    std::optional<Filled> outline;
    std::optional<AxisName> axis;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Spheres or discs read from a .csv table, a .vtp file or a .pvtp file")
        .details(sphere_file::form_of_files);
    sphere_file::describe(s);
    s.param("outline", &Config::outline)
        .choice("cylinder", Filled::cylinder, "a cylinder along `axis`; in three dimensions")
        .choice("box", Filled::box, "a box with faces normal to x, y and z; a rectangle in two dimensions")
        .choice("sphere", Filled::sphere, "a sphere; a disc in two dimensions")
        .choice("disc", Filled::disc, "the same, in two dimensions only")
        .doc(
            "what the particles fill: cross-section and volume are measured accordingly. A frame of the output `vtk` "
            "says so itself")
        .example("box");
    s.param("axis", &Config::axis)
        .choice("x", AxisName::x, "along x")
        .choice("y", AxisName::y, "along y")
        .choice("z", AxisName::z, "along z")
        .doc("of the cylinder, or the long direction of the box; z unless given, y in two dimensions")
        .example("z");
    s.check([](const Config& c, Issues& issues) {
      if (has_ending(c.file, ".csv") && !c.outline)
        issues.push_back({"outline",
                          "a .csv file does not say what the particles fill: add `outline`, one of cylinder, box, "
                          "sphere, or in two dimensions box, disc"});
    });
  }

  explicit FromFile(const Config& config) : config_(config) {}

  std::vector<std::filesystem::path> inputs() const override { return sphere_file::inputs(config_); }

  std::string why_not(const PackingRequest& request) const override {
    const bool flat = request.dimension == 2;
    if (flat && config_.outline == Filled::cylinder)
      return "in two dimensions there is no cylinder: write `outline: box` for a rectangle or `outline: disc`";
    if (!flat && config_.outline == Filled::disc)
      return "a disc has two dimensions: write `outline: cylinder` or `outline: sphere`, or add `dimension: 2` to the "
             "workflow";
    if (flat && config_.axis == AxisName::z) return "in two dimensions the axis must be x or y";
    if (!config_.period && sphere_file::is_vtk(config_.file)) return {};  // the file may say it
    for (std::size_t k = 0; k < 3; ++k) {
      const bool given = config_.period && k < config_.period->size() && (*config_.period)[k] > 0;
      if (request.periodic[k] == given) continue;
      return std::string("along ") + "xyz"[k] + " space " + (given ? "does not repeat" : "repeats") +
             " itself (`periodic`): " + (given ? "write 0 there in `period`" : "`period` must say after which length");
    }
    return {};
  }

  bool can_repeat() const override { return true; }
  bool makes_shares() const override { return sphere_file::has_shares(config_); }

  PackedParticles generate(const PackingRequest& request, Host& host) override {
    const bool flat = request.dimension == 2;
    const AxisName axis = config_.axis.value_or(flat ? AxisName::y : AxisName::z);

    sphere_file::Spheres spheres = sphere_file::read(config_, request);
    PackedParticles packed;
    if (request.repeats()) packed.period = period(spheres, request);
    Space space = request;
    space.cell = Cell::box(packed.period);
    sphere_file::refuse_bad(config_, spheres, space, request.share);
    for (const std::string& column : spheres.ignored)
      host.info("packing from_file: column `" + column + "` of " + config_.file.string() +
                " is not used: it is not all numbers");

    packed.outline = outline(spheres, flat, host);
    packed.axis = Vec3::Unit(int(axis));
    ExactSumOf<double> radii, particles;
    std::array<double, 2> most{-1e300, -1e300};
    for (const double r : spheres.radius) {
      radii.add(r);
      most = {std::max(most[0], -r), std::max(most[1], r)};
    }
    particles.add(double(spheres.radius.size()));
    const auto [sum, count] = request.share.sum(radii, particles);
    request.share.max(most);
    packed.report = {{"particles", "1", {}, count},
                     {"radius_min", "m", {}, -most[0]},
                     {"radius_mean", "m", {}, sum / count},
                     {"radius_max", "m", {}, most[1]}};
    packed.columns = std::move(spheres.columns);
    packed.position = std::move(spheres.position);
    packed.radius = std::move(spheres.radius);
    return packed;
  }

 private:
  using Outline = SpecimenShape::Outline;

  static Outline outline_of(Filled filled) {
    return filled == Filled::cylinder ? Outline::cylinder : filled == Filled::box ? Outline::box : Outline::ellipsoid;
  }

  Vec3 period(const sphere_file::Spheres& spheres, const PackingRequest& request) const {
    Vec3 of = sphere_file::period_of(config_, spheres);
    for (int k = 0; k < 3; ++k) {
      if (!request.periodic[std::size_t(k)]) of[k] = 0;
      else if (!(of[k] > 0))
        throw UserError("packing from_file: " + config_.file.string() +
                        " does not say after which length it repeats itself along " + "xyz"[k] + ": add `period`");
    }
    return of;
  }

  /// A frame knows what its specimen was.
  Outline outline(const sphere_file::Spheres& spheres, bool flat, Host& host) const {
    std::optional<Filled> own;
    if (spheres.outline == "cylinder" && !flat) own = Filled::cylinder;
    if (spheres.outline == "box") own = Filled::box;
    if (spheres.outline == "ellipsoid") own = flat ? Filled::disc : Filled::sphere;
    if (!own && !config_.outline)
      throw UserError("packing from_file: " + config_.file.string() +
                      " does not say what the particles fill: add `outline`, one of " +
                      (flat ? "box, disc" : "cylinder, box, sphere"));
    if (own && config_.outline && outline_of(*own) != outline_of(*config_.outline)) {
      const std::string name = name_of(*own);
      host.warn("packing from_file: " + config_.file.string() + " is a frame of a " + name + ": `outline: " +
                name_of(*config_.outline) + "` is not used; write `outline: " + name + "`, or leave it out");
    }
    return outline_of(own ? *own : *config_.outline);
  }

  static std::string name_of(Filled filled) {
    constexpr const char* names[] = {"cylinder", "box", "sphere", "disc"};
    return names[int(filled)];
  }

  Config config_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::FromFile, "packing", "from_file")
