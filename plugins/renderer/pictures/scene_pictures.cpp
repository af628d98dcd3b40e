// SPDX-License-Identifier: BSD-3-Clause
#include "scene_pictures.hpp"

#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "breccia/error.hpp"
#include "cutting.hpp"
#include "painter.hpp"
#include "scene.hpp"

namespace breccia::pictures {
namespace {

constexpr double most_covered = 0.3;  // of the view: cracks that cover more hide each other
constexpr Rgb mode_colour[3] = {blue, vermillion, green}, held_colour{70, 70, 74}, plain_colour{205, 205, 200};

std::string length_text(double metres) {
  const ShownUnit unit = shown_unit("m", metres);
  return significant(metres * unit.factor, 3) + " " + unit.unit;
}

/// Of bonds alone: where their particles are, as far as they frame the picture.
Spheres ends_of(vtkPolyData* bonds) {
  Spheres ends;
  ends.position.resize(std::size_t(bonds->GetNumberOfPoints()));
  ends.radius.assign(ends.position.size(), 0);
  ends.number.assign(ends.position.size(), 0);
  for (std::size_t p = 0; p < ends.position.size(); ++p) bonds->GetPoint(vtkIdType(p), ends.position[p].data());
  return ends;
}

/// Draws one picture; what it needs in turn.
class Drawing {
 public:
  Drawing(const SceneFrame& frame, const SceneWish& wish, const Sheet& sheet, SceneFixed& fixed)
      : frame_(frame), wish_(wish), sheet_(sheet), options_(wish.options), setup_(frame.setup) {
    if (!wish.cracks && !frame.particles) throw UserError("there are no frames of particles");
    if (wish.cracks && !frame.bonds) throw UserError("there are no frames of bonds");
    if (setup_.dimension == 2 && (wish.cut != Cut::none || options_.slice))
      throw UserError("a specimen in two dimensions has no inside to show");
    opacity_ = options_.opacity.value_or(wish.cracks ? 0.0 : 1.0);
    if (wish.cracks && opacity_ > 0 && !frame.particles)
      throw UserError("there are no frames of particles to be seen through");
    if (frame.bonds && (wish.cracks || opacity_ < 1))
      cracks_ =
          broken_bonds(frame.bonds, options_.size_by.value_or(""), options_.since.value_or(-1), fixed.crack_scale);
    all_cracks_ = cracks_.size();
    if (!cracks_.empty() && fixed.crack_scale) say_size(*fixed.crack_scale);
    look(fixed);
    if (opacity_ > 0) take_spheres(fixed);
    take_cracks();
  }

  ScenePicture draw() {
    const bool titled = options_.title.has_value();
    const Viewpoint::Paper paper = view_->paper(sheet_.size, titled);
    const Projection projection = view_->aim(paper, titled);
    Scene scene;
    scene.occlusion = setup_.dimension == 3;
    scene.opacity = opacity_;
    const double thin = 0.14 * paper.unit / projection.pixels_per_metre;
    if (setup_.specimen && wish_.cracks)
      add_outline(scene, *setup_.specimen, setup_.dimension, projection, thin, at_start());
    if (cutting_->is_section()) add_section(scene, spheres_, colour_, cutting_->point(), cutting_->normal());
    else add_spheres(scene, spheres_, colour_);
    add_cracks(scene, cracks_, crack_colour_, setup_.dimension, projection, 3 * thin);
    if (platens_) add_slabs(scene, slabs_of(setup_));
    write_over(paper, projection);
    return {cast(scene, projection, paper.width, paper.height, sheet_.background, sheet_.threads), std::move(overlay_)};
  }

 private:
  void look(SceneFixed& fixed) {
    if (!fixed.slab) fixed.slab = wish_.cracks && !options_.slice ? uncrowded_slab() : 1.0;
    const bool crowded = *fixed.slab < 1;
    const bool face = setup_.best_from_the_face || options_.slice || crowded;
    CameraConfig camera = options_.camera.value_or(CameraConfig{{}, {}, {}, 1});
    if (options_.slice && options_.slice->normal && !camera.view && !camera.direction)
      camera.direction = options_.slice->normal;
    const Direction direction = direction_of(camera, setup_, face);
    const bool from_the_face = direction.toward.dot(setup_.face) > 0.999 || setup_.dimension == 2;
    platens_ = options_.platens.value_or(setup_.best_from_the_face && from_the_face);
    if (!fixed.view) fixed.view.emplace(framed(), setup_, direction, camera.zoom, platens_);
    view_ = &*fixed.view;
    const auto [middle, extent] = box();
    cutting_.emplace(wish_, setup_, view_->direction(), middle, extent.dot(view_->direction().toward.cwiseAbs()));
    if (crowded) cutting_->take_middle_slab(*fixed.slab);
  }

  /// What the frame is to hold, as far as it is near the specimen.
  Spheres framed() const {
    Spheres all = wish_.cracks ? ends_of(frame_.bonds) : spheres_of(frame_.particles);
    if (all.position.empty()) throw UserError("there are no particles to draw");
    if (!wish_.cracks) return all;
    const auto add = [&](const Vec3& at, double radius) {
      all.position.push_back(at);
      all.radius.push_back(radius);
    };
    for (const BrokenBond& c : cracks_) add(c.position, c.radius);  // they stick out between the outermost
    if (!setup_.specimen) return all;
    const Spheres start = at_start();  // and the shadow that is the outline of an irregular specimen
    const double gap = shadow_gap(start);
    for (std::size_t p = 0; p < start.size(); ++p) add(start.position[p], start.radius[p] + gap);
    return all;
  }

  /// Middle and size of the specimen, or of what there is [m].
  std::pair<Vec3, Vec3> box() const {
    if (const auto& s = setup_.specimen) return {s->base + 0.5 * s->height * s->axis, s->extent};
    const Spheres all = wish_.cracks ? ends_of(frame_.bonds) : spheres_of(frame_.particles);
    Vec3 low = all.position.at(0), high = low;
    for (const Vec3& x : all.position) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    return {0.5 * (low + high), high - low};
  }

  /// As thick a slab, seen from the face, as keeps most of the view free [share of the specimen].
  double uncrowded_slab() const {
    if (setup_.dimension == 2 || !setup_.specimen) return 1;
    double covered = 0;
    for (const BrokenBond& c : cracks_)
      covered += std::numbers::pi * c.radius * c.radius * std::abs(c.normal.dot(setup_.face));
    const Vec3 right = setup_.up.cross(setup_.face);
    const double all =
        setup_.specimen->extent.dot(right.cwiseAbs()) * setup_.specimen->extent.dot(setup_.up.cwiseAbs());
    return covered <= most_covered * all ? 1.0 : std::max(0.02, most_covered * all / covered);
  }

  void take_spheres(SceneFixed& fixed) {
    spheres_ = spheres_of(frame_.particles);
    if (spheres_.radius.empty()) throw UserError("there are no particles to draw");
    spheres_.keep([&](const Vec3& x, double radius) { return view_->frames(x, radius); });
    if (wish_.cracks) {
      spheres_.keep([&](const Vec3& x, double radius) { return cutting_->shows_sphere(x, radius); });
      colour_.assign(spheres_.size(), plain_colour);
      return;
    }
    Values values = colour_values(frame_, wish_);
    const std::vector<double> all = std::move(values.value);
    const auto of_shown = [&] {
      values.value.clear();
      for (const std::size_t p : spheres_.number) values.value.push_back(all[p]);
    };
    of_shown();
    const FrameFacts facts = facts_of(frame_.particles);
    const bool names = values.name == "material" && !facts.materials.empty();
    if (!names && !fixed.scale) fixed.scale = scale_of(values, wish_.colours);  // of the inside as of the outside
    spheres_.keep([&](const Vec3& x, double radius) { return cutting_->shows_sphere(x, radius); });
    of_shown();
    ColourTable colours;
    if (names) colour_by_name(overlay_, facts.materials, values.value, colours);
    else colours = (overlay_.bar = bar_of(values, values.name, *fixed.scale))->colours;
    for (const double v : values.value) colour_.push_back(colours.at(v));
    mark_held();
  }

  /// In a test by dead loads the supports are seen by their colour.
  void mark_held() {
    bool any = false;
    if (!setup_.held.empty())
      for (std::size_t p = 0; p < spheres_.size(); ++p)
        if (setup_.held[spheres_.number[p]]) {
          colour_[p] = held_colour;
          any = true;
        }
    if (any) overlay_.legend.push_back({held_colour, "held"});
  }

  void take_cracks() {
    std::erase_if(cracks_, [&](const BrokenBond& c) { return !cutting_->shows_crack(c.position); });
    std::size_t count[3] = {0, 0, 0};
    for (const BrokenBond& c : cracks_) ++count[c.mode];
    const std::size_t some = cracks_.size();
    // Those that are counted, but magnified out of the picture or broken far off, would lie over the writing.
    std::erase_if(cracks_, [&](const BrokenBond& c) { return !view_->frames(c.position, 0); });
    for (const BrokenBond& c : cracks_) crack_colour_.push_back(mode_colour[c.mode]);
    const bool shown = wish_.cracks || some > 0;
    if (wish_.cracks && wish_.crack_colour == CrackColour::time && !cracks_.empty()) {
      colour_by_time();
    } else if (shown) {
      const char* names[] = {"tension", "shear", "combined"};
      for (std::size_t m = 0; m < 3; ++m)
        if (m < 2 || count[m] > 0)
          overlay_.legend.push_back({mode_colour[m], std::string(names[m]) + ": " + std::to_string(count[m])});
    }
    if (!shown || cutting_->crack_slab() <= 0) return;
    overlay_.captions.push_back(std::to_string(some) + " of " + std::to_string(all_cracks_) + " cracks, in a slab of " +
                                length_text(cutting_->crack_slab()));
  }

  void say_size(const CrackScale& scale) {
    const ShownUnit unit = shown_unit(scale.unit, scale.value);
    overlay_.captions.push_back("largest disc: " + title(scale.name, "") + " " +
                                significant(scale.value * unit.factor, 3) + (unit.unit.empty() ? "" : " " + unit.unit));
  }

  void colour_by_time() {
    Values times{{}, "break_time", "s"};
    for (const BrokenBond& c : cracks_) times.value.push_back(c.time);
    const auto [first, last] = std::minmax_element(times.value.begin(), times.value.end());
    const ColourMap map = wish_.colours.map == ColourMap::automatic ? ColourMap::viridis : wish_.colours.map;
    const double low = wish_.colours.low.value_or(*first), high = wish_.colours.high.value_or(*last);
    overlay_.bar = bar_of(times, "time of breakage", {map, low, high > low ? high : low + 1e-9});
    for (std::size_t k = 0; k < cracks_.size(); ++k) crack_colour_[k] = overlay_.bar->colours.at(times.value[k]);
  }

  /// As loading began.
  Spheres at_start() const {
    if (!frame_.particles || setup_.specimen->outline != SpecimenShape::Outline::irregular) return {};
    Spheres s = spheres_of(frame_.particles);
    vtkDataArray* moved = frame_.particles->GetPointData()->GetArray("displacement");
    for (std::size_t p = 0; moved && moved->GetNumberOfComponents() == 3 && p < s.size(); ++p) {
      Vec3 d;
      moved->GetTuple(vtkIdType(p), d.data());
      s.position[p] -= d;
    }
    return s;
  }

  void write_over(const Viewpoint::Paper& paper, const Projection& projection) {
    overlay_.width = paper.width;
    overlay_.height = paper.height;
    overlay_.unit = paper.unit;
    overlay_.colour = writing_on(sheet_.background);
    overlay_.title = options_.title.value_or("");
    view_->annotate(overlay_, options_.axes.value_or(true));
    const FrameFacts facts = facts_of(frame_.particles && !wish_.cracks ? frame_.particles : frame_.bonds);
    if (facts.time && options_.time.value_or(true)) {
      const ShownUnit unit = shown_unit("s", *facts.time);
      overlay_.captions.insert(overlay_.captions.begin(),
                               "t = " + significant(*facts.time * unit.factor, 4) + " " + unit.unit);
    }
    if (!setup_.specimen) return;
    for (const DeadLoad& load : setup_.loads) {
      if (!view_->frames(load.tip, 0)) continue;  // what it acts on has left the picture
      const Vec3 from = load.tip - arrow_share * setup_.size() * load.direction;
      overlay_.arrows.emplace_back(projection.seen(from).head<2>(), projection.seen(load.tip).head<2>());
    }
  }

  const SceneFrame& frame_;
  const SceneWish& wish_;
  const Sheet& sheet_;
  const SceneOptions& options_;
  const TestSetup& setup_;
  double opacity_;
  bool platens_ = false;
  Viewpoint* view_ = nullptr;
  std::optional<Cutting> cutting_;
  Spheres spheres_;
  std::vector<Rgb> colour_, crack_colour_;
  std::vector<BrokenBond> cracks_;
  std::size_t all_cracks_ = 0;
  Overlay overlay_;
};

}  // namespace

void fix_scene(const SceneFrame& frame, const SceneWish& wish, const Sheet& sheet, SceneFixed& fixed) {
  Drawing(frame, wish, sheet, fixed);
}

void widen_scale(const SceneFrame& frame, const SceneWish& wish, SceneFixed& fixed) {
  Values seen = colour_values(frame, wish);
  const Spheres spheres = spheres_of(frame.particles);
  const std::vector<double> all = std::move(seen.value);
  seen.value = {fixed.scale->low, fixed.scale->high};
  for (std::size_t p = 0; p < all.size(); ++p)
    if (fixed.view->frames(spheres.position[p], spheres.radius[p])) seen.value.push_back(all[p]);
  fixed.scale = scale_of(seen, wish.colours);
}

ScenePicture draw_scene(const SceneFrame& frame, const SceneWish& wish, const Sheet& sheet, SceneFixed& fixed) {
  return Drawing(frame, wish, sheet, fixed).draw();
}

void write_scene(const ScenePicture& picture, const Sheet& sheet, const std::filesystem::path& file) {
  write_png(
      {picture.image.width, picture.image.height, sheet.background, {}, &picture.image},
      [&](Painter& painter) { picture.overlay.paint(painter); }, file);
}

Image flat_scene(const ScenePicture& picture, const Sheet& sheet) {
  return flat({picture.image.width, picture.image.height, sheet.background, {}, &picture.image},
              [&](Painter& painter) { picture.overlay.paint(painter); });
}

}  // namespace breccia::pictures
