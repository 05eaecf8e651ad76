#pragma once

#include <vtkActor2D.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <array>
#include <string>
#include <vector>

#include "ui/render/theme.hpp"

namespace pliant::render {

/// The scalar bar at the right edge: a title, a strip of colours, and round numbers beside it. Measured in pixels, so
/// it keeps its size and stays sharp.
class Legend {
 public:
  static constexpr double width = 112;  ///< device-independent pixels that it takes from the right edge

  Legend();
  void addTo(vtkRenderer* renderer);
  void setVisible(bool visible);
  /// What the numbers are. A strain is shown in % or parts of it; anything else as it is, in thousands or thousandths
  /// of its unit if it is large or small. `name` stands above the strip, `unit` below it (a strain has its own).
  enum class Scale { strain, plain };
  void setQuantity(const std::string& name, Scale scale, const std::string& unit);
  void setRange(double minimum, double maximum);
  void setTable(vtkLookupTable* table);
  void setTheme(const Palette& palette);
  void setPixelRatio(double ratio);
  /// Puts everything in its place; called when the size of the window (in pixels) or anything else has changed.
  void layOut(int windowWidth, int windowHeight);

 private:
  static constexpr int maximumTicks = 8;

  void updateTicks();

  std::string name_ = "stretch λ₁ − 1";
  Scale scale_ = Scale::strain;
  std::string unit_;
  double minimum_ = 0, maximum_ = 1;
  double ratio_ = 1;
  bool visible_ = true;
  std::vector<double> ticks_;
  vtkNew<vtkPolyData> strip_;
  vtkNew<vtkPolyData> frame_;
  vtkNew<vtkPolyDataMapper2D> stripMapper_;
  vtkNew<vtkPolyDataMapper2D> frameMapper_;
  vtkNew<vtkActor2D> stripActor_;
  vtkNew<vtkActor2D> frameActor_;
  vtkNew<vtkTextActor> title_;
  std::array<vtkNew<vtkTextActor>, maximumTicks> labels_;
};

}  // namespace pliant::render
