// SPDX-License-Identifier: BSD-3-Clause
#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "breccia/atomic_file.hpp"
#include "breccia/utf8.hpp"
#include "painter.hpp"

namespace breccia::pictures {
namespace {

template <class T, void (*release)(T*)>
struct Releaser {
  void operator()(T* p) const { release(p); }
};
using Surface = std::unique_ptr<cairo_surface_t, Releaser<cairo_surface_t, cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Releaser<cairo_t, cairo_destroy>>;
using Font = std::unique_ptr<cairo_font_face_t, Releaser<cairo_font_face_t, cairo_font_face_destroy>>;

/// The font's own file: what else is installed, and how, does not change the pictures.
class Type {
 public:
  Type() {
    const std::string file = font_file();
    if (!file.empty() && FT_Init_FreeType(&library_) == 0 && FT_New_Face(library_, file.c_str(), 0, &face_) == 0)
      font_.reset(cairo_ft_font_face_create_for_ft_face(face_, 0));
    else font_.reset(cairo_toy_font_face_create("sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL));
  }
  Type(const Type&) = delete;
  Type& operator=(const Type&) = delete;
  cairo_font_face_t* font() const { return font_.get(); }

 private:
  // Cairo keeps fonts for later sheets: the one that is opened stays open until the program ends.
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
  Font font_;
};

class CairoPainter final : public Painter {
 public:
  CairoPainter(cairo_t* to, double height) : to_(to), height_(height) {
    static const Type* const type = new Type;
    cairo_set_font_face(to_, type->font());
    const std::unique_ptr<cairo_font_options_t, Releaser<cairo_font_options_t, cairo_font_options_destroy>> options(
        cairo_font_options_create());
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(to_, options.get());
    cairo_set_line_join(to_, CAIRO_LINE_JOIN_ROUND);
  }

  void polyline(const std::vector<Point>& points, const Stroke& stroke) override {
    ink(stroke.colour);
    cairo_set_line_width(to_, stroke.width);
    cairo_set_dash(to_, stroke.dashes.data(), int(stroke.dashes.size()), 0);
    path(points);
    cairo_stroke(to_);
  }
  void polygon(const std::vector<Point>& corners, const Rgb& fill) override {
    ink(fill);
    path(corners);
    cairo_fill(to_);
  }
  void disc(const Point& centre, double radius, const Rgb& fill) override {
    ink(fill);
    cairo_new_path(to_);
    cairo_arc(to_, centre.x(), height_ - centre.y(), radius, 0, 2 * std::numbers::pi);
    cairo_fill(to_);
  }
  void text(const Point& at, double size, Anchor anchor, const std::string& what, const Rgb& colour,
            bool upright) override {
    const std::string valid = valid_utf8(what);  // one wrong byte would end all drawing
    ink(colour);
    cairo_set_font_size(to_, size);
    cairo_text_extents_t extents;
    cairo_text_extents(to_, valid.c_str(), &extents);
    constexpr double shares[] = {0, 0.5, 1};
    cairo_save(to_);
    cairo_translate(to_, at.x(), height_ - at.y());
    if (upright) cairo_rotate(to_, -0.5 * std::numbers::pi);
    cairo_move_to(to_, -shares[int(anchor)] * extents.x_advance, middle_of_type * size);
    cairo_show_text(to_, valid.c_str());
    cairo_restore(to_);
  }

 private:
  void ink(const Rgb& c) { cairo_set_source_rgb(to_, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0); }
  void path(const std::vector<Point>& points) {
    cairo_new_path(to_);
    for (const Point& p : points) cairo_line_to(to_, p.x(), height_ - p.y());
  }
  cairo_t* to_;
  double height_;
};

void put(const Image& scene, cairo_surface_t* sheet) {
  BRECCIA_ASSERT(scene.width == cairo_image_surface_get_width(sheet) &&
                 scene.height == cairo_image_surface_get_height(sheet));
  cairo_surface_flush(sheet);
  unsigned char* const data = cairo_image_surface_get_data(sheet);
  const unsigned char* from = scene.rgb.data();
  for (int y = 0; y < scene.height; ++y) {
    auto* to = reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t(y) * cairo_image_surface_get_stride(sheet));
    for (int x = 0; x < scene.width; ++x, from += 3)
      to[x] = std::uint32_t(from[0]) << 16 | std::uint32_t(from[1]) << 8 | std::uint32_t(from[2]);
  }
  cairo_surface_mark_dirty(sheet);
}

void expect_success(cairo_status_t status, const std::filesystem::path& file) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw UserError("renderer pictures: cannot draw " + file.string() + ": " + cairo_status_to_string(status));
}

/// The sheet with all that is drawn on it; `file` is for messages.
Surface painted(const Page& page, const Draw& draw, const std::filesystem::path& file) {
  Surface sheet(cairo_image_surface_create(CAIRO_FORMAT_RGB24, page.width, page.height));
  expect_success(cairo_surface_status(sheet.get()), file);
  const Context context(cairo_create(sheet.get()));
  if (page.scene) {
    put(*page.scene, sheet.get());
  } else {
    cairo_set_source_rgb(context.get(), page.background.x(), page.background.y(), page.background.z());
    cairo_paint(context.get());
  }
  CairoPainter painter(context.get(), page.height);
  draw(painter);
  expect_success(cairo_status(context.get()), file);
  return sheet;
}

cairo_status_t append(void* to, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void write_png(const Page& page, const Draw& draw, const std::filesystem::path& file) {
  const Surface sheet = painted(page, draw, file);
  std::string png;
  expect_success(cairo_surface_write_to_png_stream(sheet.get(), append, &png), file);
  write_file(file, png);
}

Image flat(const Page& page, const Draw& draw) {
  const Surface sheet = painted(page, draw, "a picture");
  cairo_surface_flush(sheet.get());
  Image image{page.width, page.height, {}};
  image.rgb.reserve(3 * std::size_t(page.width) * std::size_t(page.height));
  const unsigned char* const data = cairo_image_surface_get_data(sheet.get());
  for (int y = 0; y < page.height; ++y) {
    const auto* from =
        reinterpret_cast<const std::uint32_t*>(data + std::ptrdiff_t(y) * cairo_image_surface_get_stride(sheet.get()));
    for (int x = 0; x < page.width; ++x)
      for (const int shift : {16, 8, 0}) image.rgb.push_back(static_cast<unsigned char>(from[x] >> shift & 255));
  }
  return image;
}

void write_pdf(const Page& page, const Draw& draw, const std::filesystem::path& file) {
  constexpr double text_width = 170 / 25.4 * 72;  // of an A4 page [points]
  const double scale = text_width / page.width;
  std::string pdf;
  const Surface sheet(cairo_pdf_surface_create_for_stream(append, &pdf, scale * page.width, scale * page.height));
  expect_success(cairo_surface_status(sheet.get()), file);
  cairo_pdf_surface_set_metadata(sheet.get(), CAIRO_PDF_METADATA_TITLE, valid_utf8(page.title).c_str());
  // The same files give the same bytes, whenever they are drawn.
  cairo_pdf_surface_set_metadata(sheet.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  {
    const Context context(cairo_create(sheet.get()));
    cairo_scale(context.get(), scale, scale);
    cairo_set_source_rgb(context.get(), page.background.x(), page.background.y(), page.background.z());
    cairo_paint(context.get());
    CairoPainter painter(context.get(), page.height);
    draw(painter);
    expect_success(cairo_status(context.get()), file);
  }
  cairo_surface_finish(sheet.get());
  expect_success(cairo_surface_status(sheet.get()), file);
  write_file(file, pdf);
}

void write_chart_files(const Page& page, const Draw& draw, const std::filesystem::path& stem,
                       std::vector<std::filesystem::path>& made) {
  made.push_back(stem.string() + ".png");
  write_png(page, draw, made.back());
  made.push_back(stem.string() + ".svg");
  write_svg(page, draw, made.back());
  made.push_back(stem.string() + ".pdf");
  write_pdf(page, draw, made.back());
}

}  // namespace breccia::pictures
