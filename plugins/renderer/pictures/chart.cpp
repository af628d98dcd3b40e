// SPDX-License-Identifier: BSD-3-Clause
#include "chart.hpp"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <cmath>

#include "canvas.hpp"

namespace breccia::pictures {
namespace {

using L = ChartLayout;

/// Pens, ticks and type of one axis. `u` is the layout's unit in drawn pixels.
void set_up(vtkAxis* axis, const ChartAxis& as, const Rgb& writing, double u, bool grid) {
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(as.low, as.high);
  vtkNew<vtkDoubleArray> at;
  vtkNew<vtkStringArray> labels;
  for (std::size_t k = 0; k < as.ticks.at.size(); ++k) {
    at->InsertNextValue(as.ticks.at[k]);
    labels->InsertNextValue(as.ticks.label[k]);
  }
  axis->SetCustomTickPositions(at, labels);
  axis->SetTitleVisible(false);  // see AxisTitles
  set_type(axis->GetLabelProperties(), int(std::lround(L::label_size * u)), writing);
  axis->GetPen()->SetWidth(float(L::axis_line * u));
  axis->GetPen()->SetColor(writing[0], writing[1], writing[2]);
  axis->SetTickLength(float(L::tick * u));
  axis->SetLabelOffset(float(1.9 * u));
  axis->SetGridVisible(grid);
  axis->GetGridPen()->SetWidth(float(L::grid_line * u));
  axis->GetGridPen()->SetColor(L::grid[0], L::grid[1], L::grid[2]);
}

/// The titles of the axes. vtkAxis keeps a fixed number of pixels between labels and title: too few for large type.
class AxisTitles final : public vtkContextItem {
 public:
  vtkTypeMacro(AxisTitles, vtkContextItem);
  static AxisTitles* New();
  const Chart* chart = nullptr;
  const ChartLayout* layout = nullptr;

  bool Paint(vtkContext2D* painter) override {
    constexpr double scale = Canvas::oversampling;
    const auto write = [&](double x, double y, double turn, const std::string& text) {
      vtkNew<vtkTextProperty> p;
      set_type(p, int(std::lround(L::title_size * layout->unit * scale)), layout->writing);
      p->SetJustificationToCentered();
      p->SetVerticalJustificationToCentered();
      p->SetOrientation(turn);
      painter->ApplyTextProp(p);
      painter->DrawString(float(x * scale), float(y * scale), text.c_str());
    };
    const double x = 0.5 * (layout->left + layout->right), y = 0.5 * (layout->bottom + layout->top);
    const double offset = L::title_offset * layout->unit;
    write(x, offset, 0, chart->x_title);
    write(offset, y, 90, chart->left_title);
    if (!chart->right_title.empty()) write(layout->width - offset, y, 90, chart->right_title);
    return true;
  }
};
vtkStandardNewMacro(AxisTitles);

vtkSmartPointer<vtkTable> table_of(const ChartLine& line) {
  vtkNew<vtkDoubleArray> x, y;
  x->SetName("x");
  y->SetName(line.label.c_str());
  for (std::size_t k = 0; k < line.x.size(); ++k) {
    if (!std::isfinite(line.x[k]) || !std::isfinite(line.y[k])) continue;
    x->InsertNextValue(line.x[k]);
    y->InsertNextValue(line.y[k]);
  }
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(x);
  table->AddColumn(y);
  return table;
}

void add_line(vtkChartXY* chart, const ChartLine& line, double u) {
  vtkPlot* plot = chart->AddPlot(line.points ? vtkChart::POINTS : vtkChart::LINE);
  const auto table = table_of(line);
  plot->SetInputData(table, 0, 1);
  plot->SetLabel("  " + line.label);  // the legend sets text close to its symbol
  plot->SetColor(line.colour[0], line.colour[1], line.colour[2], 255);
  plot->SetWidth(float((line.dashed ? L::dashed_line : L::line) * u));
  if (line.dashed) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  if (line.points) {
    auto* points = vtkPlotPoints::SafeDownCast(plot);
    points->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    points->SetMarkerSize(float(L::marker * u));
  }
  if (line.right_axis) chart->SetPlotCorner(plot, 1);
}

}  // namespace

void write_png(const Chart& chart, const ChartLayout& layout, const Sheet& sheet, const std::filesystem::path& file) {
  Canvas canvas(int(layout.width), int(layout.height), sheet.background);
  constexpr double scale = Canvas::oversampling;
  const double u = layout.unit * scale;
  vtkNew<vtkChartXY> plot;
  plot->SetAutoSize(false);
  plot->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  plot->SetSize(vtkRectf(float(layout.left * scale), float(layout.bottom * scale),
                         float((layout.right - layout.left) * scale), float((layout.top - layout.bottom) * scale)));
  plot->GetBackgroundBrush()->SetColorF(sheet.background.x(), sheet.background.y(), sheet.background.z(), 1);
  for (const ChartLine& line : chart.lines) add_line(plot, line, u);
  set_up(plot->GetAxis(vtkAxis::BOTTOM), layout.x_axis, layout.writing, u, true);
  set_up(plot->GetAxis(vtkAxis::LEFT), layout.left_axis, layout.writing, u, true);
  if (!chart.right_title.empty()) {
    plot->GetAxis(vtkAxis::RIGHT)->SetVisible(true);
    set_up(plot->GetAxis(vtkAxis::RIGHT), layout.right_axis, layout.writing, u, false);
  }
  plot->SetShowLegend(true);
  vtkChartLegend* legend = plot->GetLegend();
  legend->SetHorizontalAlignment(vtkChartLegend::LEFT);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  legend->SetPadding(int(1.2 * u));
  legend->SetSymbolWidth(int(5 * u));
  legend->SetDragEnabled(false);
  set_type(legend->GetLabelProperties(), int(std::lround(L::legend_size * u)), layout.writing);
  legend->GetLabelProperties()->SetJustificationToLeft();
  legend->GetPen()->SetLineType(vtkPen::NO_PEN);
  legend->GetBrush()->SetOpacity(0);

  auto titles = vtkSmartPointer<AxisTitles>::New();
  titles->chart = &chart;
  titles->layout = &layout;
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(plot);
  actor->GetScene()->AddItem(titles);
  canvas.renderer()->AddActor(actor);
  canvas.save(file);
}

}  // namespace breccia::pictures
