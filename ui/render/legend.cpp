#include "ui/render/legend.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/render/round_numbers.hpp"
#include "ui/render/vtk_text.hpp"

namespace pliant::render {
namespace {

constexpr double stripWidth = 14, margin = 16, labelWidth = 52, tickLength = 4;

/// "%" from a hundredth on, else a power of a thousand.
struct Factor {
  double factor;
  std::string unit;
};

Factor strainFactor(double largest) {
  if (largest >= 1e-2 || largest <= 0) return {1e2, "%"};
  static constexpr std::array<const char*, 4> powers{"10⁻³", "10⁻⁶", "10⁻⁹", "10⁻¹²"};
  const int power = std::clamp(static_cast<int>(std::ceil(-std::log10(largest) / 3.0 - 1e-9)), 1, 4);
  return {std::pow(10.0, 3 * power), powers[power - 1]};
}

/// A power of a thousand before `unit`, if numbers would be long without.
Factor plainFactor(double largest, const std::string& unit) {
  if (!(largest > 0) || (largest >= 1e-2 && largest < 1e4)) return {1, unit};
  static constexpr std::array<const char*, 9> powers{"10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "", "10³", "10⁶", "10⁹", "10¹²"};
  const int power = std::clamp(static_cast<int>(std::floor(std::log10(largest) / 3.0)), -4, 4);
  const std::string prefix = powers[static_cast<std::size_t>(power + 4)];
  return {std::pow(10.0, -3 * power), unit.empty() || prefix.empty() ? prefix + unit : prefix + " " + unit};
}

}  // namespace

Legend::Legend() {
  stripMapper_->SetInputData(strip_);
  stripMapper_->SetScalarModeToUseCellData();
  stripMapper_->UseLookupTableScalarRangeOn();
  stripActor_->SetMapper(stripMapper_);
  frameMapper_->SetInputData(frame_);
  frameActor_->SetMapper(frameMapper_);
  updateTicks();
}

void Legend::addTo(vtkRenderer* renderer) {
  renderer->AddActor2D(stripActor_);
  renderer->AddActor2D(frameActor_);
  renderer->AddActor2D(title_);
  for (auto& label : labels_) renderer->AddActor2D(label);
}

void Legend::setVisible(bool visible) {
  visible_ = visible;
  stripActor_->SetVisibility(visible);
  frameActor_->SetVisibility(visible);
  title_->SetVisibility(visible);
  for (std::size_t i = 0; i < labels_.size(); ++i) labels_[i]->SetVisibility(visible && i < ticks_.size());
}

void Legend::setQuantity(const std::string& name, Scale scale, const std::string& unit) {
  name_ = name;
  scale_ = scale;
  unit_ = unit;
  updateTicks();
}

void Legend::setRange(double minimum, double maximum) {
  minimum_ = minimum;
  maximum_ = maximum;
  updateTicks();
}

void Legend::setTable(vtkLookupTable* table) { stripMapper_->SetLookupTable(table); }

void Legend::setTheme(const Palette& palette) {
  setTextStyle(title_->GetTextProperty(), 12, palette.text);
  title_->GetTextProperty()->SetJustificationToRight();
  title_->GetTextProperty()->SetVerticalJustificationToBottom();
  title_->GetTextProperty()->SetLineSpacing(1.15);
  for (auto& label : labels_) {
    setTextStyle(label->GetTextProperty(), 12, palette.text);
    label->GetTextProperty()->SetVerticalJustificationToCentered();
  }
  frameActor_->GetProperty()->SetColor(palette.text[0], palette.text[1], palette.text[2]);
}

void Legend::setPixelRatio(double ratio) {
  ratio_ = ratio;
  frameActor_->GetProperty()->SetLineWidth(static_cast<float>(ratio));
}

void Legend::updateTicks() {
  ticks_ = roundNumbers(minimum_, maximum_, 5);
  if (ticks_.size() > labels_.size()) ticks_.resize(labels_.size());
  const double largest = std::max(std::abs(minimum_), std::abs(maximum_));
  const auto [factor, unit] = scale_ == Scale::strain ? strainFactor(largest) : plainFactor(largest, unit_);
  title_->SetInput((unit.empty() ? name_ : name_ + "\n[" + unit + "]").c_str());
  const double step = ticks_.size() > 1 ? factor * (ticks_[1] - ticks_[0]) : 1.0;
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  for (std::size_t i = 0; i < ticks_.size(); ++i) {
    char text[32];
    const double value = factor * ticks_[i];
    std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value) < 1e-9 * step ? 0.0 : value);
    labels_[i]->SetInput(*text == '-' ? ("−" + std::string(text + 1)).c_str() : text);
  }
  setVisible(visible_);
}

void Legend::layOut(int windowWidth, int windowHeight) {
  const double height = std::min(0.45 * windowHeight, 240 * ratio_);
  const double left = std::round(windowWidth - (margin + labelWidth + stripWidth) * ratio_);
  const double right = std::round(left + stripWidth * ratio_);
  const double bottom = std::round(0.5 * (windowHeight - height) - 10 * ratio_), top = std::round(bottom + height);

  vtkNew<vtkPoints> corners;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkDoubleArray> values;
  // A cell a row of pixels: where edges run through a pixel's middle, rounding would choose its colour.
  const int rows = static_cast<int>(top - bottom);
  for (int i = 0; i <= rows; ++i) {
    corners->InsertNextPoint(left, bottom + i, 0);
    corners->InsertNextPoint(right, bottom + i, 0);
    if (i == rows) break;
    cells->InsertNextCell({2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2});
    values->InsertNextValue(minimum_ + (maximum_ - minimum_) * (i + 0.5) / rows);
  }
  strip_->SetPoints(corners);
  strip_->SetPolys(cells);
  strip_->GetCellData()->SetScalars(values);

  vtkNew<vtkPoints> ends;
  vtkNew<vtkCellArray> lines;
  const auto line = [&](double x0, double y0, double x1, double y1) {
    lines->InsertNextCell({ends->InsertNextPoint(x0, y0, 0), ends->InsertNextPoint(x1, y1, 0)});
  };
  for (std::size_t i = 0; i < ticks_.size(); ++i) {
    const double fraction = maximum_ > minimum_ ? (ticks_[i] - minimum_) / (maximum_ - minimum_) : 0.0;
    const double y = std::round(bottom + fraction * (top - bottom));
    line(right, y, right + tickLength * ratio_, y);
    labels_[i]->SetPosition(right + (tickLength + 4) * ratio_, y);
  }
  frame_->SetPoints(ends);
  frame_->SetLines(lines);
  title_->SetPosition(windowWidth - margin * ratio_, top + 10 * ratio_);
}

}  // namespace pliant::render
