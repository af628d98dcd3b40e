// SPDX-License-Identifier: BSD-3-Clause
#include "source.hpp"

#include <algorithm>
#include <cmath>

#include "breccia/images.hpp"
#include "breccia/text_file.hpp"

namespace breccia::sphere_file {
namespace {

constexpr double largest = 1e30;  // [m]

double metres(LengthUnit unit) {
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

}  // namespace

void check(const Source& source, Issues& issues) {
  const bool csv = has_ending(source.file, ".csv"), vtp = is_vtk(source.file);
  if (!csv && !vtp) issues.push_back({"file", source.file.string() + " is neither a .csv nor a .vtp or .pvtp file"});
#ifndef BRECCIA_HAS_VTK
  if (vtp)
    issues.push_back({"file", "this build reads .csv files only, because it was made without VTK; convert the file"});
#endif
  if (csv && !source.length_unit)
    issues.push_back(
        {"length_unit", "a .csv file has no unit of its own: add `length_unit`, one of m, cm, mm, um, in"});
  if (vtp && source.length_unit && *source.length_unit != LengthUnit::metre)
    issues.push_back({"length_unit", "a .vtp file is in metres: leave `length_unit` out"});
}

bool has_shares(const Source& source) {
  return has_ending(source.file, ".csv") && std::filesystem::is_regular_file(source.file);
}

Spheres read(const Source& source, const PackingRequest& request) {
#ifdef BRECCIA_HAS_VTK
  if (is_vtk(source.file)) return read_vtp(source.file);
#endif
  BRECCIA_ASSERT(source.length_unit.has_value());
  return read_csv(source.file, metres(*source.length_unit), request.dimension == 3, request);
}

std::vector<std::filesystem::path> inputs(const Source& source) {
  std::vector<std::filesystem::path> files{source.file};
#ifdef BRECCIA_HAS_VTK
  if (has_ending(source.file, ".pvtp"))
    for (const std::filesystem::path& piece : pieces_of(source.file)) files.push_back(piece);
#endif
  return files;
}

Vec3 period_of(const Source& source, const Spheres& spheres) {
  Vec3 period = Vec3::Zero();
  if (source.period) {
    for (std::size_t k = 0; k < source.period->size(); ++k) period[int(k)] = (*source.period)[k];
    return period;
  }
  period = spheres.cell.diagonal();
  const Mat3 askew = spheres.cell - Mat3(period.asDiagonal());
  if (!spheres.cell.allFinite() || (period.array() < 0).any() || (period.array() > largest).any())
    throw UserError(source.file.string() + ": its `cell_vectors` are no lengths: give `period`");
  if (!askew.isZero(0))
    throw UserError(
        source.file.string() +
        " is a frame of a cell that has been sheared; only a box can be taken from it: use an earlier frame");
  return period;
}

void refuse_bad(const Source& source, const Spheres& s, const Space& space, const SeenInPart& share) {
  const bool flat = space.dimension == 2;
  if (share.max(double(s.radius.size())) == 0) throw UserError(source.file.string() + " holds no particle");
  double smallest = largest;
  for (std::size_t k = 0; k < s.radius.size(); ++k) {
    const auto fail = [&](const std::string& text) { throw UserError(s.where(source.file, k) + ": " + text); };
    if (!s.position[k].allFinite()) fail("the centre is not finite");
    if (!std::isfinite(s.radius[k])) fail("the radius is not finite");
    if (!(s.radius[k] > 0)) fail("the radius must be above 0");
    // Squares and cubes of what lies between stay numbers; nothing that is measured lies beyond.
    if (s.position[k].cwiseAbs().maxCoeff() > largest) fail("the centre is farther than 1e30 m from the origin");
    if (s.radius[k] > largest || s.radius[k] < 1 / largest) fail("the radius is not between 1e-30 m and 1e30 m");
    constexpr double rounding = 1e-9;  // in a lattice a sphere may just touch itself
    for (int d = 0; d < 3; ++d)
      if (space.cell.repeats(d) && 2 * s.radius[k] > (1 + rounding) * space.cell.width(d))
        fail(std::string("the particle is larger than the period along ") + "xyz"[d] + ", it would touch itself");
    if (flat && s.position[k].z() != 0) fail("z must be 0 in two dimensions");
    smallest = std::min(smallest, s.radius[k]);
  }
  smallest = -share.max(-smallest);
  // Closer than this, the line of centres (the contact normal) would be rounding noise.
  const double too_close = 1e-6 * smallest;
  for_each_pair_within(space, s.position, too_close, [&](Index i, Index j) {
    if (space.branch(s.position[i], s.position[j]).norm() <= too_close)
      throw UserError(s.where(source.file, j) + ": the same centre as " +
                      (s.line.empty() ? "point " + std::to_string(i) : "line " + std::to_string(s.line[i])));
  });
}

}  // namespace breccia::sphere_file
