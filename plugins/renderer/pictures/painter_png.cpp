// SPDX-License-Identifier: BSD-3-Clause
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include <cmath>

#include "canvas.hpp"
#include "painter.hpp"

namespace breccia::pictures {
namespace {

constexpr double scale = Canvas::oversampling;

/// The drawn parts of a dashed line.
std::vector<std::vector<Point>> pieces(const std::vector<Point>& points, const std::vector<double>& dashes) {
  if (dashes.empty()) return {points};
  std::vector<std::vector<Point>> all{{points.front()}};
  std::size_t k = 0;        // even: a line, odd: a gap
  double left = dashes[0];  // of the present one
  for (std::size_t p = 1; p < points.size(); ++p) {
    Point from = points[p - 1];
    for (double length = (points[p] - from).norm(); length > left; length -= left, left = dashes[k]) {
      from += left / length * (points[p] - from);
      if (k % 2 == 0) all.back().push_back(from);
      else all.push_back({from});
      k = (k + 1) % dashes.size();
    }
    left -= (points[p] - from).norm();
    if (k % 2 == 0) all.back().push_back(points[p]);
  }
  return all;
}

class ContextPainter final : public Painter {
 public:
  explicit ContextPainter(vtkContext2D* context) : context_(context) {}

  void polyline(const std::vector<Point>& points, const Stroke& stroke) override {
    vtkPen* pen = context_->GetPen();
    pen->SetLineType(vtkPen::SOLID_LINE);
    pen->SetColor(stroke.colour[0], stroke.colour[1], stroke.colour[2], 255);
    pen->SetWidth(float(stroke.width * scale));
    for (const auto& piece : pieces(points, stroke.dashes)) {
      std::vector<float> flat = flattened(piece);
      if (piece.size() > 1) context_->DrawPoly(flat.data(), int(piece.size()));
    }
  }
  void polygon(const std::vector<Point>& corners, const Rgb& fill) override {
    prepare(fill);
    std::vector<float> flat = flattened(corners);
    context_->DrawPolygon(flat.data(), int(corners.size()));
  }
  void disc(const Point& centre, double radius, const Rgb& fill) override {
    prepare(fill);
    const float r = float(radius * scale);
    context_->DrawEllipse(float(centre.x() * scale), float(centre.y() * scale), r, r);
  }
  void text(const Point& at, double size, Anchor anchor, const std::string& what, const Rgb& colour,
            bool upright) override {
    vtkNew<vtkTextProperty> type;
    set_type(type, int(std::lround(size * scale)), colour);
    constexpr int sides[] = {VTK_TEXT_LEFT, VTK_TEXT_CENTERED, VTK_TEXT_RIGHT};
    type->SetJustification(sides[int(anchor)]);
    type->SetVerticalJustificationToCentered();
    type->SetOrientation(upright ? 90 : 0);
    context_->ApplyTextProp(type);
    context_->DrawString(float(at.x() * scale), float(at.y() * scale), what.c_str());
  }

 private:
  void prepare(const Rgb& fill) {
    context_->GetPen()->SetLineType(vtkPen::NO_PEN);
    context_->GetBrush()->SetColor(fill[0], fill[1], fill[2], 255);
  }
  static std::vector<float> flattened(const std::vector<Point>& points) {
    std::vector<float> flat;
    for (const Point& p : points) {
      flat.push_back(float(p.x() * scale));
      flat.push_back(float(p.y() * scale));
    }
    return flat;
  }
  vtkContext2D* context_;
};

class Drawing final : public vtkContextItem {
 public:
  vtkTypeMacro(Drawing, vtkContextItem);
  static Drawing* New();
  const Draw* draw = nullptr;
  bool Paint(vtkContext2D* context) override {
    ContextPainter painter(context);
    (*draw)(painter);
    return true;
  }
};
vtkStandardNewMacro(Drawing);

}  // namespace

void write_png(const Page& page, const Draw& draw, const std::filesystem::path& file) {
  Canvas canvas(page.width, page.height, page.background);
  auto drawing = vtkSmartPointer<Drawing>::New();
  drawing->draw = &draw;
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(drawing);
  canvas.renderer()->AddActor(actor);
  canvas.save(file);
}

}  // namespace breccia::pictures
