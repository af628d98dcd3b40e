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
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkSVGExporter.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "breccia/error.hpp"

namespace breccia::pictures {
namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void include(const std::vector<double>& v) {
    for (const double x : v)
      if (std::isfinite(x)) { low = std::min(low, x); high = std::max(high, x); }
  }
  /// Ends at round numbers; begins at zero when it begins near it.
  Ticks round_up(int count) {
    if (!(low <= high)) { low = 0; high = 1; }
    if (low > 0 && low < 0.3 * high) low = 0;
    if (!(high > low)) high = low + 1;
    const double step = nice_ticks(low, high, count).step;
    low = step * std::floor(low / step + 1e-9);
    high = step * std::ceil(high / step - 1e-9);
    return ticks_at(low, high, step);
  }
};

/// Pens, ticks and type of one axis. `u` is a hundredth of the picture's height in drawn pixels.
void set_up(vtkAxis* axis, const Range& range, const Ticks& ticks, const Rgb& writing, double u, bool grid) {
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(range.low, range.high);
  vtkNew<vtkDoubleArray> at;
  vtkNew<vtkStringArray> labels;
  for (std::size_t k = 0; k < ticks.at.size(); ++k) {
    at->InsertNextValue(ticks.at[k]);
    labels->InsertNextValue(ticks.label[k]);
  }
  axis->SetCustomTickPositions(at, labels);
  axis->SetTitleVisible(false);  // see AxisTitles
  set_type(axis->GetLabelProperties(), int(std::lround(3.0 * u)), writing);
  axis->GetPen()->SetWidth(float(0.22 * u));
  axis->GetPen()->SetColor(writing[0], writing[1], writing[2]);
  axis->SetTickLength(float(1.0 * u));
  axis->SetLabelOffset(float(1.9 * u));
  axis->SetGridVisible(grid);
  axis->GetGridPen()->SetWidth(float(0.12 * u));
  axis->GetGridPen()->SetColor(228, 228, 228);
}

/// The titles of the axes. vtkAxis keeps a fixed number of pixels between labels and title: too few for large type.
class AxisTitles final : public vtkContextItem {
 public:
  vtkTypeMacro(AxisTitles, vtkContextItem);
  static AxisTitles* New();
  const Chart* chart = nullptr;
  Rgb colour = ink;
  double width = 0, unit = 1;  // of the picture, and a hundredth of its height [drawn pixels]
  Eigen::Vector2d middle{0, 0};  // of the axes [drawn pixels]

  bool Paint(vtkContext2D* painter) override {
    const auto write = [&](double x, double y, double turn, const std::string& text) {
      vtkNew<vtkTextProperty> p;
      set_type(p, int(std::lround(3.4 * unit)), colour);
      p->SetJustificationToCentered();
      p->SetVerticalJustificationToCentered();
      p->SetOrientation(turn);
      painter->ApplyTextProp(p);
      painter->DrawString(float(x), float(y), text.c_str());
    };
    write(middle.x(), 4 * unit, 0, chart->x_title);
    write(4 * unit, middle.y(), 90, chart->left_title);
    if (!chart->right_title.empty()) write(width - 4 * unit, middle.y(), 90, chart->right_title);
    return true;
  }
};
vtkStandardNewMacro(AxisTitles);

/// Room for the longest label; digits of DejaVu Sans are 0.64 of the type size wide [drawn pixels].
double label_width(const Ticks& ticks, double u) {
  std::size_t longest = 0;
  for (const std::string& l : ticks.label)  // the minus sign has three bytes
    longest =
        std::max(longest, std::size_t(std::count_if(l.begin(), l.end(), [](char c) { return (c & 0xC0) != 0x80; })));
  return 0.64 * 3.0 * u * double(longest);
}

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
  plot->SetWidth(float((line.dashed ? 0.4 : 0.55) * u));
  if (line.dashed) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  if (line.points) {
    auto* points = vtkPlotPoints::SafeDownCast(plot);
    points->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    points->SetMarkerSize(float(2.2 * u));
  }
  if (line.right_axis) chart->SetPlotCorner(plot, 1);
}

void write_svg(vtkRenderWindow* window, const std::filesystem::path& file, const std::string& what) {
  vtkNew<vtkSVGExporter> exporter;
  exporter->SetRenderWindow(window);
  exporter->SetFileName(unfinished(file).c_str());
  exporter->SetTitle(what.c_str());
  exporter->SetDescription("");
  exporter->TextAsPathOn();  // no font is needed where it is read
  exporter->Write();
  // The exporter does not tell whether the disk took it all: a whole file ends with its closing tag.
  std::ifstream in(unfinished(file), std::ios::binary);
  std::string end(32, ' ');
  in.seekg(-std::streamoff(end.size()), std::ios::end);
  in.read(end.data(), std::streamsize(end.size()));
  if (!in || end.find("</svg>") == std::string::npos)
    cannot_write(file, "the disk is full or the folder cannot be written");
  in.close();
  give_final_name(file);
}

}  // namespace

void draw_chart(const Chart& chart, const Sheet& sheet, const std::filesystem::path& png,
                const std::filesystem::path& svg) {
  std::size_t drawn = 0;
  Range x, left, right;
  for (const ChartLine& line : chart.lines) {
    x.include(line.x);
    (line.right_axis ? right : left).include(line.y);
    drawn = std::max(drawn, std::size_t(table_of(line)->GetNumberOfRows()));
  }
  if (drawn < 2) throw UserError("fewer than two points to draw");
  const Ticks x_ticks = x.round_up(6), left_ticks = left.round_up(6);
  if (chart.right_from_zero_to_full) { right.low = 0; right.high = std::max(right.high, 1.0); }
  const Ticks right_ticks = right.round_up(6);

  // A chart is wider than high: `size` is its width.
  Canvas canvas(sheet.size, sheet.size * 3 / 4, sheet.background);
  const double u = canvas.height() * Canvas::oversampling / 100.0;
  const Rgb writing = writing_on(sheet.background);
  vtkNew<vtkChartXY> plot;
  plot->SetAutoSize(false);
  plot->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  const double width = canvas.width() * Canvas::oversampling, height = canvas.height() * Canvas::oversampling;
  const double left_room = 10 * u + label_width(left_ticks, u), bottom_room = 14 * u;
  const double right_room = chart.right_title.empty() ? 5 * u : 10 * u + label_width(right_ticks, u);
  plot->SetSize(vtkRectf(float(left_room), float(bottom_room), float(width - left_room - right_room),
                         float(height - bottom_room - 4 * u)));
  plot->GetBackgroundBrush()->SetColorF(sheet.background.x(), sheet.background.y(), sheet.background.z(), 1);
  for (const ChartLine& line : chart.lines) add_line(plot, line, u);
  set_up(plot->GetAxis(vtkAxis::BOTTOM), x, x_ticks, writing, u, true);
  set_up(plot->GetAxis(vtkAxis::LEFT), left, left_ticks, writing, u, true);
  if (!chart.right_title.empty()) {
    plot->GetAxis(vtkAxis::RIGHT)->SetVisible(true);
    set_up(plot->GetAxis(vtkAxis::RIGHT), right, right_ticks, writing, u, false);
  }
  plot->SetShowLegend(true);
  vtkChartLegend* legend = plot->GetLegend();
  legend->SetHorizontalAlignment(vtkChartLegend::LEFT);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  legend->SetPadding(int(1.2 * u));
  legend->SetSymbolWidth(int(5 * u));
  legend->SetDragEnabled(false);
  set_type(legend->GetLabelProperties(), int(std::lround(2.8 * u)), writing);
  legend->GetLabelProperties()->SetJustificationToLeft();
  legend->GetPen()->SetLineType(vtkPen::NO_PEN);
  legend->GetBrush()->SetOpacity(0);

  auto titles = vtkSmartPointer<AxisTitles>::New();
  titles->chart = &chart;
  titles->colour = writing;
  titles->width = width;
  titles->unit = u;
  titles->middle = {0.5 * (left_room + width - right_room), 0.5 * (bottom_room + height - 4 * u)};
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(plot);
  actor->GetScene()->AddItem(titles);
  canvas.renderer()->AddActor(actor);
  canvas.save(png);
  write_svg(canvas.window(), svg, chart.left_title + " against " + chart.x_title);
}

}  // namespace breccia::pictures
