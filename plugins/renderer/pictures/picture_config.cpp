// SPDX-License-Identifier: BSD-3-Clause
#include "picture_config.hpp"

#include <Eigen/Geometry>

namespace breccia::pictures {
namespace {

constexpr const char* motif_names[] = {
    "specimen",      "cutaway",    "cracks",  "cracks_time", "displacement", "displacement_across",
    "stress_strain", "load_curve", "strains", "tables",      "histogram"};

void describe_motif(Schema<PictureConfig>& s) {
  s.param("show", &PictureConfig::show)
      .choice("specimen", Motif::specimen, "the particles, coloured by `field`")
      .choice("cutaway", Motif::cutaway, "the same with a part cut away (`cut`)")
      .choice("cracks", Motif::cracks, "broken bonds as discs, coloured by tension and shear")
      .choice("cracks_time", Motif::cracks_time, "broken bonds as discs, coloured by when they broke")
      .choice("displacement", Motif::displacement, "the particles, coloured by the magnitude of their displacement")
      .choice("displacement_across", Motif::displacement_across,
              "the particles, coloured by their displacement across the crack of a splitting or tension test, or "
              "across a beam")
      .choice("stress_strain", Motif::stress_strain,
              "axial stress and damage against axial strain, .png, .svg and .pdf")
      .choice("load_curve", Motif::load_curve, "load and damage against displacement, .png, .svg and .pdf")
      .choice("strains", Motif::strains, "lateral and volumetric strain against axial strain, .png, .svg and .pdf")
      .choice("tables", Motif::tables,
              "histograms, roses and profiles of the run's tables, if any: <table>.png, .svg and .pdf each")
      .choice("histogram", Motif::histogram, "how the values of `field` are distributed, .png, .svg and .pdf")
      .doc("what the picture shows");
  s.param("name", &PictureConfig::name)
      .example("inside")
      .doc("file name without its ending; if absent the value of `show`, of a histogram with the field's name");
  s.param("title", &PictureConfig::title).example("Specimen A, 20 MPa").doc("a line above the picture");
}

void describe_colours(Schema<PictureConfig>& s) {
  s.param("field", &PictureConfig::field)
      .example("velocity_z")
      .doc(
          "particle field of the colours; of a vector or tensor its magnitude, or what `component` says, or the name "
          "ends with (`velocity_z`, `stress_zz`); if absent `damage`, or else, and while nothing is damaged, the "
          "displacement. Of a histogram it may be a bond field");
  s.param("component", &PictureConfig::component)
      .choice("x", FieldPart::x, "of a vector")
      .choice("y", FieldPart::y, "of a vector")
      .choice("z", FieldPart::z, "of a vector")
      .choice("xx", FieldPart::xx, "of a tensor")
      .choice("yy", FieldPart::yy, "of a tensor")
      .choice("zz", FieldPart::zz, "of a tensor")
      .choice("xy", FieldPart::xy, "of a tensor")
      .choice("yz", FieldPart::yz, "of a tensor")
      .choice("xz", FieldPart::xz, "of a tensor")
      .choice("yx", FieldPart::yx, "of a tensor; of a symmetric one the same as xy")
      .choice("zy", FieldPart::zy, "of a tensor; of a symmetric one the same as yz")
      .choice("zx", FieldPart::zx, "of a tensor; of a symmetric one the same as xz")
      .choice("magnitude", FieldPart::magnitude, "root of the sum of the squares of all components")
      .choice("mean", FieldPart::mean, "of a tensor: third of its trace, in two dimensions half")
      .choice("von_mises", FieldPart::von_mises,
              "of a tensor: sqrt(3/2 s:s) of its deviator s, in two dimensions the difference of the principal values")
      .doc("which number of a vector or tensor `field` is shown; `magnitude` if absent");
  s.param("colour_map", &PictureConfig::colour_map)
      .choice("automatic", ColourMap::automatic, "by the kind of field")
      .choice("viridis", ColourMap::viridis, "dark blue to yellow")
      .choice("cividis", ColourMap::cividis, "blue to yellow, the same to all eyes")
      .choice("inferno", ColourMap::inferno, "black to yellow")
      .choice("orange_red", ColourMap::orange_red, "pale stone to dark red")
      .choice("blue_red", ColourMap::blue_red, "diverging")
      .choice("grey", ColourMap::grey, "light to dark grey")
      .fallback("automatic")
      .doc("colours of the values");
  s.param("low", &PictureConfig::low).doc("value at the lower end of the colour bar, in the SI unit of the field");
  s.param("high", &PictureConfig::high).doc("value at the upper end of the colour bar, in the SI unit of the field");
  s.param("bins", &PictureConfig::bins)
      .at_least(2)
      .at_most(500)
      .doc("intervals of a histogram; if absent as many as suit the number of values");
}

void describe_view(Schema<PictureConfig>& s) {
  s.param("camera", &PictureConfig::camera).doc("from where the specimen is seen");
  s.param("slice", &PictureConfig::slice)
      .doc("only what lies in a plane, or in a slab about it, seen along its normal unless `camera` says otherwise");
  s.param("clip", &PictureConfig::clip).doc("takes away all on that side of a plane to which its normal points");
  s.param("cut", &PictureConfig::cut)
      .choice("automatic", Cut::automatic, "half of what is seen from the face, else a quarter")
      .choice("quarter", Cut::quarter, "a quarter")
      .choice("half", Cut::half, "the front half")
      .doc("what a cutaway takes away; `automatic` if absent");
  s.param("opacity", &PictureConfig::opacity)
      .at_least(0)
      .at_most(1)
      .doc("of the particles: 1 if absent, in `cracks` 0; below 1 the cracks behind them are seen");
  s.param("since", &PictureConfig::since)
      .unit("s")
      .at_least(0)
      .example("2 ms")
      .doc("only cracks that came at this time or later");
  s.param("size_by", &PictureConfig::size_by)
      .example("energy")
      .doc(
          "what the areas of cracks are in proportion to: `area`, the smaller particle's section; `energy`, what the "
          "bond released as it broke; or any bond field. The largest disc is as large as by `area`; `area` if absent");
  s.param("platens", &PictureConfig::platens)
      .doc("draws the platens; if absent where discs, tension and bending are seen from the face");
  s.param("axes", &PictureConfig::axes).doc("shows the directions x, y, z; true if absent");
  s.param("time", &PictureConfig::time).doc("shows the time of the frame; true if absent");
}

void describe_frames(Schema<PictureConfig>& s) {
  s.param("frame", &PictureConfig::frame).at_least(0).doc("which frame, counted from 0; the last if absent");
  s.param("movie", &PictureConfig::movie)
      .choice("mp4", MovieFormat::mp4, "H.264, plays everywhere")
      .choice("webm", MovieFormat::webm, "VP9, for web pages")
      .choice("gif", MovieFormat::gif, "for slides and mails; 256 colours")
      .doc("all frames as a movie, in this format, instead of one picture; needs the program ffmpeg");
  s.param("frames_per_second", &PictureConfig::frames_per_second)
      .at_least(0.5)
      .at_most(60)
      .doc("how fast a movie goes; 10 if absent");
}

bool is_zero(const std::optional<Vec3>& v) { return v && !(v->norm() > 0); }

}  // namespace

void PictureConfig::describe(Schema<PictureConfig>& s) {
  describe_motif(s);
  describe_colours(s);
  describe_view(s);
  describe_frames(s);
}

std::string PictureConfig::shown_field() const {
  static constexpr const char* parts[] = {"x",  "y",  "z",  "xx", "yy",        "zz",   "xy",       "yz",
                                          "xz", "yx", "zy", "zx", "magnitude", "mean", "von_mises"};
  const std::string whole = field.value_or(show == Motif::displacement ? "displacement" : "");
  return component ? whole + "_" + parts[int(*component)] : whole;
}

std::string PictureConfig::file_name() const {
  if (name) return *name;
  const std::string usual = motif_names[int(show)];
  return show == Motif::histogram && field ? usual + "_" + shown_field() : usual;
}

void PictureConfig::check(const std::string& path, Issues& issues) const {
  const std::string of = "`" + std::string(motif_names[int(show)]) + "`";
  const auto refuse = [&](bool given, bool fits, const char* key, const char* goes_with) {
    if (given && !fits)
      issues.push_back({path + "." + key, "this goes with " + std::string(goes_with) + ", not with " + of +
                                              ": leave it out, or choose another `show`"});
  };
  const bool cracks = show == Motif::cracks || show == Motif::cracks_time, scene = is_scene();
  const char* const scenes = "pictures of particles and cracks";
  const bool coloured = (scene && !cracks) || show == Motif::histogram;
  refuse(field.has_value(), coloured, "field", "pictures of particles and histograms");
  refuse(component.has_value(), coloured, "component", "pictures of particles and histograms");
  if (component && coloured && !field && show != Motif::displacement && show != Motif::histogram)
    issues.push_back(
        {path + ".component", "a component of what? Add a `field`, for example `field: stress`, or leave this out"});
  refuse(low || high, scene && show != Motif::cracks, low ? "low" : "high", "pictures that have a colour bar");
  refuse(frame.has_value(), scene || show == Motif::histogram, "frame", "pictures of one instant");
  refuse(bins.has_value(), show == Motif::histogram, "bins", "histograms");
  refuse(camera.has_value(), scene, "camera", scenes);
  refuse(slice.has_value(), scene, "slice", scenes);
  refuse(clip.has_value(), scene, "clip", scenes);
  refuse(opacity.has_value(), scene, "opacity", scenes);
  refuse(platens.has_value(), scene, "platens", scenes);
  refuse(axes.has_value(), scene, "axes", scenes);
  refuse(time.has_value(), scene, "time", scenes);
  refuse(movie.has_value(), scene, "movie", scenes);
  refuse(title.has_value(), show != Motif::tables, "title", "single pictures");
  const bool see_cracks = cracks || (scene && opacity.value_or(1) < 1);
  refuse(since.has_value(), see_cracks, "since", "cracks, or particles with an `opacity` below 1");
  refuse(size_by.has_value(), see_cracks, "size_by", "cracks, or particles with an `opacity` below 1");
  if (show == Motif::histogram && !field)
    issues.push_back({path, "a histogram needs a `field`, for example `field: radius`"});
  if (frames_per_second && !movie)
    issues.push_back({path + ".frames_per_second", "there is no `movie`: add `movie: mp4`, or leave this out"});
  if (movie && frame) issues.push_back({path + ".frame", "a movie shows all frames: leave out `frame`, or `movie`"});
  if (low && high && !(*low < *high)) issues.push_back({path + ".low", "must be below `high`"});
  const auto point = [&](const std::optional<Vec3>& v, const char* key) {
    if (is_zero(v)) issues.push_back({path + "." + key, "three zeros are no direction: for example [0, 1, 0]"});
  };
  if (camera) {
    point(camera->direction, "camera.direction");
    point(camera->up, "camera.up");
    if (camera->direction && camera->up && !is_zero(camera->direction) && !is_zero(camera->up) &&
        camera->direction->normalized().cross(camera->up->normalized()).norm() < 1e-6)
      issues.push_back({path + ".camera.up", "is along `direction`: choose one across it"});
  }
  if (slice) point(slice->normal, "slice.normal");
  if (clip) point(clip->normal, "clip.normal");
}

SceneWish PictureConfig::wish() const {
  SceneWish w;
  w.cracks = show == Motif::cracks || show == Motif::cracks_time;
  w.crack_colour = show == Motif::cracks_time ? CrackColour::time : CrackColour::mode;
  w.field = shown_field();
  w.across = show == Motif::displacement_across && !field;
  w.colours = {colour_map, low, high};
  if (show == Motif::cutaway) w.cut = cut.value_or(Cut::automatic);
  w.options = *this;
  return w;
}

}  // namespace breccia::pictures
