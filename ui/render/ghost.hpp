#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/render/figure.hpp"
#include "ui/render/predicted_motion.hpp"

namespace pliant::render {

/// Another motion over the one on show: hatched, with dashed paths.
class Ghost {
 public:
  void addTo(vtkRenderer* renderer);
  /// Of the motion on show: what predictions are drawn with.
  void setLayout(const FigureLayout& layout);
  /// What is predicted from the motion on show; point masses as `masses` has them.
  void setPrediction(PredictedMotion motion, const mechanics::Model& masses);
  /// A motion of another model with the same nodes, drawn in that model's shape.
  void setOther(PredictedMotion motion);
  void clear();
  bool isShown() const { return motion_.has_value(); }
  /// Where it comes; nothing for a prediction, which stays near what it is predicted from.
  const Points& reach() const { return reach_; }

  void setVisible(bool visible);
  void showPaths(const std::vector<int>& nodes);
  void showPose(double tau);
  void setTheme(const Palette& palette);
  void setPixelRatio(double ratio);

 private:
  const FigureLayout& layout() const { return own_ ? *own_ : layout_; }

  Figure figure_{Figure::Kind::ghost};
  LinePrimitive paths_{2.5};
  FigureLayout layout_;
  std::optional<FigureLayout> own_;  ///< of another model
  std::optional<PredictedMotion> motion_;
  Points reach_;
};

}  // namespace pliant::render
