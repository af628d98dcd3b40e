// SPDX-License-Identifier: BSD-3-Clause
#include "overlay.hpp"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include <cmath>

namespace breccia::pictures {

vtkStandardNewMacro(Overlay);

void Overlay::set_text(vtkContext2D* painter, double size, int horizontal, int vertical, double turn, bool bold) const {
  vtkNew<vtkTextProperty> p;
  set_type(p, int(std::lround(size * unit() * scale)), colour, bold);
  p->SetJustification(horizontal);
  p->SetVerticalJustification(vertical);
  p->SetOrientation(turn);
  painter->ApplyTextProp(p);
}

void Overlay::line(vtkContext2D* painter, double x1, double y1, double x2, double y2, double thickness) const {
  painter->GetPen()->SetColor(colour[0], colour[1], colour[2]);
  painter->GetPen()->SetOpacity(255);
  painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
  painter->GetPen()->SetWidth(float(thickness * unit() * scale));
  painter->DrawLine(float(x1 * scale), float(y1 * scale), float(x2 * scale), float(y2 * scale));
}

void Overlay::text(vtkContext2D* painter, double x, double y, const std::string& what) const {
  painter->DrawString(float(x * scale), float(y * scale), what.c_str());
}

bool Overlay::Paint(vtkContext2D* painter) {
  if (bar) paint_bar(painter);
  if (!legend.empty()) paint_legend(painter);
  if (scale_bar > 0) paint_scale(painter);
  if (!directions.empty()) paint_directions(painter);
  if (!caption.empty()) {
    set_text(painter, 1.9, VTK_TEXT_RIGHT, VTK_TEXT_BOTTOM);
    text(painter, width - 3 * unit(), 2.6 * unit(), caption);
  }
  return true;
}

void Overlay::paint_bar(vtkContext2D* painter) const {
  const double u = unit(), x = width - (100 * share_of_bar - 7) * u, w = 2.4 * u, y = 25 * u, h = 50 * u;
  painter->GetPen()->SetLineType(vtkPen::NO_PEN);
  const int steps = int(bar->colours->GetNumberOfTableValues());
  for (int k = 0; k < steps; ++k) {
    double c[4];
    bar->colours->GetTableValue(k, c);
    painter->GetBrush()->SetColorF(c[0], c[1], c[2], 1);
    // Each step overlaps the next, which is drawn over it: no seams.
    const double low = y + h * k / steps, high = y + h * std::min(k + 2, steps) / steps;
    painter->DrawRect(float(x * scale), float(low * scale), float(w * scale), float((high - low) * scale));
  }
  line(painter, x, y, x + w, y, 0.12);
  line(painter, x, y + h, x + w, y + h, 0.12);
  line(painter, x, y, x, y + h, 0.12);
  line(painter, x + w, y, x + w, y + h, 0.12);
  set_text(painter, 1.9, VTK_TEXT_LEFT, VTK_TEXT_CENTERED);
  for (std::size_t k = 0; k < bar->ticks.at.size(); ++k) {
    const double at = y + h * (bar->ticks.at[k] - bar->low) / (bar->high - bar->low);
    line(painter, x + w, at, x + w + 0.7 * u, at, 0.14);
    text(painter, x + w + 1.2 * u, at, bar->ticks.label[k]);
  }
  set_text(painter, 2.1, VTK_TEXT_CENTERED, VTK_TEXT_BOTTOM, 90);
  text(painter, x - 1.4 * u, y + h / 2, bar->title);
}

void Overlay::paint_legend(vtkContext2D* painter) const {
  const double u = unit(), x = width - (100 * share_of_bar - 1) * u, side = 2 * u;
  double y = height - 8 * u;
  for (const LegendEntry& e : legend) {
    painter->GetPen()->SetLineType(vtkPen::NO_PEN);
    painter->GetBrush()->SetColor(e.colour[0], e.colour[1], e.colour[2], 255);
    painter->DrawEllipse(float((x + side / 2) * scale), float((y + side / 2) * scale), float(side / 2 * scale),
                         float(side / 2 * scale));
    set_text(painter, 1.9, VTK_TEXT_LEFT, VTK_TEXT_CENTERED);
    text(painter, x + 1.5 * side, y + side / 2, e.text);
    y -= 3.4 * u;
  }
}

void Overlay::paint_scale(vtkContext2D* painter) const {
  const double u = unit(), x = 12 * u, y = 3.4 * u;
  line(painter, x, y, x + scale_bar, y, 0.3);
  line(painter, x, y - 0.6 * u, x, y + 0.6 * u, 0.2);
  line(painter, x + scale_bar, y - 0.6 * u, x + scale_bar, y + 0.6 * u, 0.2);
  set_text(painter, 1.9, VTK_TEXT_CENTERED, VTK_TEXT_BOTTOM);
  text(painter, x + scale_bar / 2, y + 0.9 * u, scale_text);
}

void Overlay::paint_directions(vtkContext2D* painter) const {
  const double u = unit(), x = 5 * u, y = 4.5 * u, length = 3.4 * u;
  set_text(painter, 1.7, VTK_TEXT_CENTERED, VTK_TEXT_CENTERED);
  for (const auto& [d, name] : directions) {
    if (d.norm() < 0.15) continue;  // points at the reader
    line(painter, x, y, x + length * d.x(), y + length * d.y(), 0.2);
    const Eigen::Vector2d at = length * d + 1.2 * u * d.normalized();
    text(painter, x + at.x(), y + at.y(), name);
  }
}

}  // namespace breccia::pictures
