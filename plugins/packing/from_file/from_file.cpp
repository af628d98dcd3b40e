// SPDX-License-Identifier: BSD-3-Clause
/// A packing made elsewhere: a table of spheres, or a frame of an earlier run.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "breccia/images.hpp"
#include "breccia/packing.hpp"
#include "breccia/text_file.hpp"
#include "spheres.hpp"

namespace breccia {

enum class LengthUnit { metre, centimetre, millimetre, micrometre, inch };
enum class AxisName { x, y, z };
enum class Filled { cylinder, box, sphere, disc };

class FromFile final : public Packing {
 public:
  struct Config {
    std::filesystem::path file;
    std::optional<LengthUnit> length_unit;
    std::optional<Filled> outline;
    std::optional<AxisName> axis;
    std::optional<std::vector<double>> period;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Spheres or discs read from a .csv table or a .vtp file")
        .details(
            "CSV: the first line names the columns `x`, `y`, `z` and `radius` in any order, separated by commas, "
            "semicolons or tabs; `#` starts a comment; other columns of numbers are kept for `material_of`. VTP: "
            "points in metres "
            "and a "
            "point array `radius` in metres, such as a frame of the output `vtk`. In two dimensions z is zero, and the "
            "column may be missing.");
    s.param("file", &Config::file).example("specimen.csv").doc("the .csv or .vtp file");
    s.param("length_unit", &Config::length_unit)
        .choice("m", LengthUnit::metre, "metre")
        .choice("cm", LengthUnit::centimetre, "centimetre")
        .choice("mm", LengthUnit::millimetre, "millimetre")
        .choice("um", LengthUnit::micrometre, "micrometre")
        .choice("in", LengthUnit::inch, "inch, 25.4 mm")
        .doc("of all columns of a .csv file; a .vtp file is always in metres")
        .example("mm");
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
    s.param("period", &Config::period)
        .unit("m")
        .items(2, 3)
        .at_least(0)
        .example("[50 mm, 50 mm, 100 mm]")
        .doc("with `periodic`: after which length the particles repeat themselves along x, y, z; 0 where they do not");
    s.check([](const Config& c, Issues& issues) {
      const bool csv = has_ending(c.file, ".csv"), vtp = has_ending(c.file, ".vtp");
      if (!csv && !vtp) issues.push_back({"file", c.file.string() + " is neither a .csv nor a .vtp file"});
#ifndef BRECCIA_HAS_VTK
      if (vtp)
        issues.push_back(
            {"file", "this build reads .csv files only, because it was made without VTK; convert the file"});
#endif
      if (csv && !c.outline)
        issues.push_back({"outline",
                          "a .csv file does not say what the particles fill: add `outline`, one of cylinder, box, "
                          "sphere, or in two dimensions box, disc"});
      if (csv && !c.length_unit)
        issues.push_back(
            {"length_unit", "a .csv file has no unit of its own: add `length_unit`, one of m, cm, mm, um, in"});
      if (vtp && c.length_unit && *c.length_unit != LengthUnit::metre)
        issues.push_back({"length_unit", "a .vtp file is in metres: leave `length_unit` out"});
    });
  }

  explicit FromFile(const Config& config) : config_(config) {}

  std::vector<std::filesystem::path> inputs() const override { return {config_.file}; }

  std::string why_not(const PackingRequest& request) const override {
    const bool flat = request.dimension == 2;
    if (flat && config_.outline == Filled::cylinder)
      return "in two dimensions there is no cylinder: write `outline: box` for a rectangle or `outline: disc`";
    if (!flat && config_.outline == Filled::disc)
      return "a disc has two dimensions: write `outline: cylinder` or `outline: sphere`, or add `dimension: 2` to the "
             "workflow";
    if (flat && config_.axis == AxisName::z) return "in two dimensions the axis must be x or y";
    for (std::size_t k = 0; k < 3; ++k) {
      const bool given = config_.period && k < config_.period->size() && (*config_.period)[k] > 0;
      if (request.periodic[k] == given) continue;
      return std::string("along ") + "xyz"[k] + " space " + (given ? "does not repeat" : "repeats") +
             " itself (`periodic`): " + (given ? "write 0 there in `period`" : "`period` must say after which length");
    }
    return {};
  }

  bool can_repeat() const override { return true; }

  PackedParticles generate(const PackingRequest& request, Host& host) override {
    const bool flat = request.dimension == 2;
    const AxisName axis = config_.axis.value_or(flat ? AxisName::y : AxisName::z);

    from_file::Spheres spheres = read(!flat);
    PackedParticles packed;
    if (config_.period)
      for (std::size_t k = 0; k < config_.period->size(); ++k) packed.period[int(k)] = (*config_.period)[k];
    Space space = request;
    space.cell = Cell::box(packed.period);
    check(spheres, space);
    for (const std::string& column : spheres.ignored)
      host.info("packing from_file: column `" + column + "` of " + config_.file.string() +
                " is not used: it is not all numbers");

    packed.outline = outline(spheres, flat, host);
    packed.axis = Vec3::Unit(int(axis));
    const auto& r = spheres.radius;
    packed.report = {{"particles", "1", {}, double(r.size())},
                     {"radius_min", "m", {}, *std::min_element(r.begin(), r.end())},
                     {"radius_mean", "m", {}, std::accumulate(r.begin(), r.end(), 0.0) / double(r.size())},
                     {"radius_max", "m", {}, *std::max_element(r.begin(), r.end())}};
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

  /// A frame knows what its specimen was.
  Outline outline(const from_file::Spheres& spheres, bool flat, Host& host) const {
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

  from_file::Spheres read(bool needs_z) const {
#ifdef BRECCIA_HAS_VTK
    if (has_ending(config_.file, ".vtp")) return from_file::read_vtp(config_.file);
#endif
    BRECCIA_ASSERT(config_.length_unit.has_value());
    return from_file::read_csv(config_.file, metres(*config_.length_unit), needs_z);
  }

  static double metres(LengthUnit unit) {
    switch (unit) {
      case LengthUnit::metre:
        return 1;
      case LengthUnit::centimetre:
        return 1e-2;
      case LengthUnit::millimetre:
        return 1e-3;
      case LengthUnit::micrometre:
        return 1e-6;
      case LengthUnit::inch:
        return 25.4e-3;
    }
    return 1;
  }

  static constexpr double largest = 1e30;  // [m]

  void check(const from_file::Spheres& s, const Space& space) const {
    const bool flat = space.dimension == 2;
    if (s.radius.empty()) throw UserError(config_.file.string() + " holds no particle");
    double smallest = s.radius[0];
    for (std::size_t k = 0; k < s.radius.size(); ++k) {
      const auto fail = [&](const std::string& text) { throw UserError(s.where(config_.file, k) + ": " + text); };
      if (!s.position[k].allFinite()) fail("the centre is not finite");
      if (!std::isfinite(s.radius[k])) fail("the radius is not finite");
      if (!(s.radius[k] > 0)) fail("the radius must be above 0");
      // Squares and cubes of what lies between stay numbers; nothing that is measured lies beyond.
      if (s.position[k].cwiseAbs().maxCoeff() > largest) fail("the centre is farther than 1e30 m from the origin");
      if (s.radius[k] > largest || s.radius[k] < 1 / largest) fail("the radius is not between 1e-30 m and 1e30 m");
      for (int d = 0; d < 3; ++d)
        if (space.cell.repeats(d) && 2 * s.radius[k] > space.cell.width(d))
          fail(std::string("the particle is larger than the period along ") + "xyz"[d] + ", it would touch itself");
      if (flat && s.position[k].z() != 0) fail("z must be 0 in two dimensions");
      smallest = std::min(smallest, s.radius[k]);
    }
    // Closer than this, the line of centres (the contact normal) would be rounding noise.
    const double too_close = 1e-6 * smallest;
    for_each_pair_within(space, s.position, too_close, [&](Index i, Index j) {
      if (space.branch(s.position[i], s.position[j]).norm() <= too_close)
        throw UserError(s.where(config_.file, j) + ": the same centre as " +
                        (s.line.empty() ? "point " + std::to_string(i) : "line " + std::to_string(s.line[i])));
    });
  }

  Config config_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::FromFile, "packing", "from_file")
