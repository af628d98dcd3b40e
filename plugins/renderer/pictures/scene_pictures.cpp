// SPDX-License-Identifier: BSD-3-Clause
#include "scene_pictures.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

#include "breccia/error.hpp"
#include "painter.hpp"
#include "scene.hpp"

namespace breccia::pictures {
namespace {

Spheres spheres_of(vtkPolyData* particles) {
  Spheres s;
  s.radius = field_of(particles->GetPointData(), "radius").value;
  s.position.resize(s.radius.size());
  for (std::size_t p = 0; p < s.radius.size(); ++p) particles->GetPoint(vtkIdType(p), s.position[p].data());
  return s;
}

/// Bounds of the colours: all values, unless a few runaways would leave the rest in one colour.
std::pair<double, double> range_of(std::vector<double> v) {
  v.erase(std::remove_if(v.begin(), v.end(), [](double x) { return !std::isfinite(x); }), v.end());
  if (v.empty()) return {0, 1};
  std::sort(v.begin(), v.end());
  double low = v.front(), high = v.back();
  const double middle_low = v[v.size() / 200], middle_high = v[v.size() - 1 - v.size() / 200];
  if (high - low > 2 * (middle_high - middle_low) && middle_high > middle_low) {
    low = middle_low;
    high = middle_high;
  }
  if (!(high > low)) high = low + (low != 0 ? std::abs(low) : 1);
  return {low, high};
}

struct Scale {
  ColourMap map;
  double low, high;
};

Scale scale_of(const Values& v, const SpecimenPicture& picture) {
  auto [low, high] = range_of(v.value);
  const bool share =
      v.name.find("damage") != std::string::npos && (v.unit.empty() || v.unit == "1") && low >= 0 && high <= 1;
  if (share) {
    low = 0;
    high = 1;
  }
  const bool is_signed = low < 0 && high > 0 && !share;
  if (is_signed) {
    high = std::max(-low, high);
    low = -high;
  } else if (low > 0 && low < 0.3 * high) low = 0;
  ColourMap map = picture.colours;
  if (map == ColourMap::automatic)
    map = share ? ColourMap::orange_red : is_signed ? ColourMap::blue_red : ColourMap::viridis;
  low = picture.low.value_or(low);
  high = picture.high.value_or(high);
  if (!(low < high))
    throw UserError("the colour range of `" + v.name + "` is empty: " + significant(low, 6) + " to " +
                    significant(high, 6));
  return {map, low, high};
}

ColourBar bar_of(const Values& v, const std::string& name, const Scale& scale) {
  const ShownUnit unit = shown_unit(v.unit, std::max(std::abs(scale.low), std::abs(scale.high)));
  ColourBar bar;
  bar.colours = colour_table(scale.map, scale.low, scale.high);
  bar.low = scale.low * unit.factor;
  bar.high = scale.high * unit.factor;
  bar.ticks = nice_ticks(bar.low, bar.high, 6, v.whole ? 1 : 0);
  bar.title = title(name, unit.unit);
  return bar;
}

/// One colour each for values that only name something, and the legend of those that are there.
void colour_by_name(Overlay& overlay, const std::vector<std::string>& names, const std::vector<double>& value,
                    ColourTable& colours) {
  constexpr Rgb palette[] = {blue, orange, green, vermillion, sky_blue, purple, yellow};
  std::vector<std::size_t> count(names.size(), 0);
  for (const double v : value)
    if (v >= 0 && v < double(names.size())) ++count[std::size_t(v)];
  colours.low = -0.5;
  colours.high = double(names.size()) - 0.5;
  for (std::size_t s = 0; s < colours.step.size(); ++s)
    colours.step[s] = palette[s * names.size() / colours.step.size() % std::size(palette)];
  for (std::size_t m = 0; m < names.size(); ++m)
    if (count[m] > 0) overlay.legend.push_back({palette[m % std::size(palette)], names[m]});
}

std::string caption_of(const FrameFacts& facts) {
  if (!facts.time) return {};
  const ShownUnit unit = shown_unit("s", *facts.time);
  return "t = " + significant(*facts.time * unit.factor, 4) + " " + unit.unit;
}

/// Casts the scene, puts the writing over it and saves the picture.
void finish(const Scene& scene, const Viewpoint& view, const Projection& projection, int width, Overlay& overlay,
            const Sheet& sheet, const std::filesystem::path& file) {
  overlay.width = width;
  overlay.height = sheet.size;
  overlay.colour = writing_on(sheet.background);
  view.annotate(overlay);
  const Image image = cast(scene, projection, width, sheet.size, sheet.background, sheet.threads);
  write_png(
      {width, sheet.size, sheet.background, {}, &image}, [&](Painter& painter) { overlay.paint(painter); }, file);
}

/// Keeps the spheres for which `shown(centre, radius)` holds, with their values.
template <class F>
void keep(Spheres& spheres, std::vector<double>& value, F&& shown) {
  std::size_t kept = 0;
  for (std::size_t p = 0; p < value.size(); ++p) {
    if (!shown(spheres.position[p], spheres.radius[p])) continue;
    spheres.position[kept] = spheres.position[p];
    spheres.radius[kept] = spheres.radius[p];
    value[kept++] = value[p];
  }
  spheres.position.resize(kept);
  spheres.radius.resize(kept);
  value.resize(kept);
}

/// Takes away what stands in the quarter or half of the specimen that faces the reader.
void cut_open(Spheres& spheres, std::vector<double>& value, Cut cut, const Viewpoint& view, const FrameFacts& facts) {
  Vec3 centre = Vec3::Zero();
  if (facts.specimen) {
    centre = facts.specimen->base + 0.5 * facts.specimen->height * facts.specimen->axis;
  } else {
    Vec3 low = spheres.position[0], high = low;
    for (const Vec3& x : spheres.position) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    centre = 0.5 * (low + high);
  }
  Vec3 front = view.toward_reader();
  front.z() = 0;
  front.normalize();
  const Vec3 side(-front.y(), front.x(), 0);
  keep(spheres, value, [&](const Vec3& at, double) {
    const Vec3 x = at - centre;
    const double f = x.dot(front), s = x.dot(side);
    return !(cut == Cut::half ? f > 0 : f > std::abs(s));
  });
}

}  // namespace

void draw_specimen(vtkPolyData* particles, const SpecimenPicture& picture, const Sheet& sheet,
                   const std::filesystem::path& file) {
  Spheres spheres = spheres_of(particles);
  if (spheres.radius.empty()) throw UserError("there are no particles to draw");
  vtkPointData* data = particles->GetPointData();
  std::string field = picture.field;
  if (field.empty())
    field = data->HasArray("damage") ? "damage" : data->HasArray("displacement") ? "displacement" : "radius";
  Values values = field_of(data, field);
  const FrameFacts facts = facts_of(particles);
  if (picture.cut != Cut::none && facts.dimension == 2)
    throw UserError("a specimen in two dimensions has no inside to show");

  const bool names = field == "material" && !facts.materials.empty();
  const Scale scale = names ? Scale{ColourMap::automatic, 0, 1} : scale_of(values, picture);
  Viewpoint view(spheres, facts);
  keep(spheres, values.value, [&](const Vec3& x, double radius) { return view.frames(x, radius); });
  if (picture.cut != Cut::none) cut_open(spheres, values.value, picture.cut, view, facts);
  const int width = view.width_for(sheet.size);
  const Projection projection = view.aim(width, sheet.size);
  Overlay overlay;
  overlay.caption = caption_of(facts);
  ColourTable colours;
  if (names) colour_by_name(overlay, facts.materials, values.value, colours);
  else colours = (overlay.bar = bar_of(values, field, scale))->colours;
  Scene scene;
  scene.occlusion = facts.dimension == 3;
  add_spheres(scene, spheres, values.value, colours);
  finish(scene, view, projection, width, overlay, sheet, file);
}

void draw_cracks(vtkPolyData* bonds, CrackColour by, ColourMap colours, const Sheet& sheet,
                 const std::filesystem::path& file) {
  vtkCellData* data = bonds->GetCellData();
  vtkDataArray *state = data->GetArray("state"), *position = data->GetArray("break_position"),
               *normal = data->GetArray("break_normal"), *radius = data->GetArray("crack_radius"),
               *time = data->GetArray("break_time");
  if (!state || !position || !normal || !radius || !time)
    throw UserError("the bond file lacks one of state, break_time, break_position, break_normal, crack_radius");

  std::vector<Crack> cracks;
  Values times{{}, "break_time", "s"};
  std::size_t count[3] = {0, 0, 0};
  constexpr Rgb mode_colour[3] = {blue, vermillion, green};
  for (vtkIdType b = 0; b < state->GetNumberOfTuples(); ++b) {
    const auto s = BondState(int(state->GetComponent(b, 0)));
    if (!is_broken(s)) continue;
    const std::size_t mode = std::min<std::size_t>(std::size_t(s) - std::size_t(BondState::broken_tension), 2);
    Crack c;
    position->GetTuple(b, c.position.data());
    normal->GetTuple(b, c.normal.data());
    c.radius = radius->GetComponent(b, 0);
    c.colour = mode_colour[mode];
    ++count[mode];
    cracks.push_back(c);
    times.value.push_back(time->GetComponent(b, 0));
  }

  const FrameFacts facts = facts_of(bonds);
  Spheres ends;  // the particles' centres frame the picture
  ends.position.resize(std::size_t(bonds->GetNumberOfPoints()));
  ends.radius.assign(ends.position.size(), 0);
  for (std::size_t p = 0; p < ends.position.size(); ++p) bonds->GetPoint(vtkIdType(p), ends.position[p].data());
  if (ends.position.empty()) throw UserError("there are no particles to draw");
  for (const Crack& c : cracks) {  // and the cracks themselves, which stick out between the outermost
    ends.position.push_back(c.position);
    ends.radius.push_back(c.radius);
  }
  Viewpoint view(ends, facts);
  const int width = view.width_for(sheet.size);
  const Projection projection = view.aim(width, sheet.size);
  Overlay overlay;
  overlay.caption = caption_of(facts);
  if (by == CrackColour::time && !cracks.empty()) {
    SpecimenPicture all;
    all.colours = colours == ColourMap::automatic ? ColourMap::viridis : colours;
    const auto [first, last] = std::minmax_element(times.value.begin(), times.value.end());
    all.low = *first;
    all.high = *last > *first ? *last : *first + 1e-9;
    overlay.bar = bar_of(times, "time of breakage", scale_of(times, all));
    for (std::size_t k = 0; k < cracks.size(); ++k) cracks[k].colour = overlay.bar->colours.at(times.value[k]);
  } else {
    const char* names[] = {"tension", "shear", "combined"};
    for (std::size_t m = 0; m < 3; ++m)
      if (m < 2 || count[m] > 0)
        overlay.legend.push_back({mode_colour[m], std::string(names[m]) + ": " + std::to_string(count[m])});
  }
  Scene scene;
  if (facts.specimen)
    add_outline(scene, *facts.specimen, facts.dimension, projection,
                0.14 * sheet.size / 100.0 / projection.pixels_per_metre);
  add_cracks(scene, cracks, facts.dimension);
  finish(scene, view, projection, width, overlay, sheet, file);
}

}  // namespace breccia::pictures
