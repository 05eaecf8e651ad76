#include "ui/render/chart_picture.hpp"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "ui/render/offscreen_target.hpp"
#include "ui/render/vtk_text.hpp"

namespace pliant::render {
namespace {

using Mark = scene::ResultSeries::Mark;

/// Okabe and Ito's.
constexpr std::array<std::array<unsigned char, 3>, 7> groupColors{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {138, 109, 0}, {86, 180, 233}, {90, 90, 90}}};

void addSeries(vtkChartXY* chart, const scene::ResultSeries& series) {
  vtkNew<vtkTable> table;
  for (const std::vector<double>* values : {&series.x, &series.y}) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(values == &series.x ? "x" : series.name.c_str());
    for (const double value : *values) column->InsertNextValue(value);
    table->AddColumn(column);
  }
  vtkPlot* plot = chart->AddPlot(series.mark == Mark::points ? vtkChart::POINTS : vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  const auto& color = groupColors[static_cast<std::size_t>(series.group) % groupColors.size()];
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->SetWidth(2.0F);
  plot->SetLegendVisibility(!series.name.empty());
  if (series.mark == Mark::dashedLine) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  if (auto* points = vtkPlotPoints::SafeDownCast(plot); points && series.mark == Mark::points) {
    points->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    points->SetMarkerSize(8);
  }
}

void styleAxis(vtkAxis* axis, const std::string& label, const Palette& colors) {
  axis->SetTitle(label);
  setTextStyle(axis->GetTitleProperties(), 14, colors.text);
  setTextStyle(axis->GetLabelProperties(), 12, colors.text);
  const auto byte = [](double value) { return static_cast<unsigned char>(255 * value); };
  axis->GetPen()->SetColor(byte(colors.text[0]), byte(colors.text[1]), byte(colors.text[2]));
  axis->GetGridPen()->SetColor(128, 128, 128, 64);
}

/// Before there are plots: they ask their axes once how to show their values, and an axis is only logarithmic while its
/// range is positive.
void makeLogarithmic(vtkAxis* axis, const scene::ResultChart& chart, std::vector<double> scene::ResultSeries::*values) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const scene::ResultSeries& series : chart.series)
    for (const double value : series.*values) {
      if (value > 0) low = std::min(low, value);
      high = std::max(high, value);
    }
  if (!(high > 0)) return;
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetUnscaledRange(0.8 * low, 1.25 * high);
  axis->LogScaleOn();
}

/// From zero, or the lowest value if that is below, to a little beyond the highest, so that a peak's marker is not cut.
void leaveRoom(vtkAxis* axis, const scene::ResultChart& chart) {
  double low = 0, high = 0;
  for (const scene::ResultSeries& series : chart.series)
    for (const double value : series.y) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  const double room = 0.06 * (high - low);
  if (!(room > 0)) return;
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(low < 0 ? low - room : 0, high + room);
}

/// Ticks at the values themselves where they are few: 64, 128, 256 rather than round numbers.
void putTicksAtValues(vtkAxis* axis, const scene::ResultChart& chart) {
  constexpr std::size_t most = 12;
  std::set<double> values;
  for (const scene::ResultSeries& series : chart.series) values.insert(series.x.begin(), series.x.end());
  if (values.size() > most) return;
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const double value : values) {
    positions->InsertNextValue(chart.logarithmicX ? std::log10(value) : value);
    char label[32];
    std::snprintf(label, sizeof label, "%g", value);
    labels->InsertNextValue(label);
  }
  axis->SetCustomTickPositions(positions, labels);
}

}  // namespace

void drawCharts(const std::vector<scene::ResultChart>& charts, int width, int height, Theme theme,
                const std::filesystem::path& file) {
  writePng(chartImage(charts, width, height, theme), file);
}

Image chartImage(const std::vector<scene::ResultChart>& charts, int width, int height, Theme theme) {
  const Palette& colors = palette(theme);
  OffscreenTarget target;
  target.setSize(width, height);
  Image image;
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(colors.background.data());
    target.window()->AddRenderer(renderer);
    vtkNew<vtkContextActor> actor;
    renderer->AddActor(actor);
    actor->GetScene()->SetRenderer(renderer);
    const float each = static_cast<float>(width) / static_cast<float>(charts.size());
    for (std::size_t i = 0; i < charts.size(); ++i) {
      const scene::ResultChart& data = charts[i];
      vtkNew<vtkChartXY> chart;
      chart->SetAutoSize(false);
      chart->SetSize(vtkRectf(each * static_cast<float>(i), 0, each, static_cast<float>(height)));
      chart->SetTitle(data.title);
      setTextStyle(chart->GetTitleProperties(), 16, colors.text);
      styleAxis(chart->GetAxis(vtkAxis::BOTTOM), data.xLabel, colors);
      styleAxis(chart->GetAxis(vtkAxis::LEFT), data.yLabel, colors);
      if (data.logarithmicX) makeLogarithmic(chart->GetAxis(vtkAxis::BOTTOM), data, &scene::ResultSeries::x);
      putTicksAtValues(chart->GetAxis(vtkAxis::BOTTOM), data);
      if (data.logarithmicY)
        makeLogarithmic(chart->GetAxis(vtkAxis::LEFT), data, &scene::ResultSeries::y);
      else
        leaveRoom(chart->GetAxis(vtkAxis::LEFT), data);
      for (const scene::ResultSeries& series : data.series) addSeries(chart, series);
      chart->SetShowLegend(true);
      setTextStyle(chart->GetLegend()->GetLabelProperties(), 12, colors.text);
      actor->GetScene()->AddItem(chart);
    }
    target.render(image);
    target.window()->RemoveRenderer(renderer);
  }
  return image;
}

}  // namespace pliant::render
