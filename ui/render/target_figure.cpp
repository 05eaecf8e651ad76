#include "ui/render/target_figure.hpp"

#include <vtkTextProperty.h>

#include "ui/render/node_paths.hpp"
#include "ui/render/vtk_text.hpp"

namespace pliant::render {
namespace {

constexpr double dashes = 40;      // a curve
constexpr double nameOffset = 10;  // above a curve, device-independent pixels

double lengthOf(const Points& curve) {
  double length = 0;
  for (Eigen::Index i = 0; i < curve.cols(); ++i) length += (curve.col((i + 1) % curve.cols()) - curve.col(i)).norm();
  return length;
}

}  // namespace

void TargetFigure::addTo(vtkRenderer* renderer) {
  renderer_ = renderer;
  curves_.actor()->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -8);
  renderer->AddActor(curves_.actor());
  handles_.addTo(renderer);
  active_.addTo(renderer);
  setTargets({});
}

void TargetFigure::setTargets(std::vector<TargetCurve> targets) {
  targets_ = std::move(targets);
  std::vector<Points> curves;
  double dash = 0;
  for (const TargetCurve& target : targets_) {
    curves.push_back(target.curve);
    const double own = lengthOf(target.curve) / (2 * dashes);
    dash = dash > 0 ? std::min(dash, own) : own;
  }
  curves_.actor()->SetVisibility(!targets_.empty());
  curves_.setClosedCurves(curves, dash);
  refreshNames();
}

Points TargetFigure::reach() const {
  Points all(3, 0);
  for (const TargetCurve& target : targets_) all = joined(all, joined(target.curve, target.handles));
  return all;
}

void TargetFigure::refreshNames() {
  while (names_.size() > targets_.size()) {
    renderer_->RemoveActor2D(names_.back());
    names_.pop_back();
  }
  while (names_.size() < targets_.size()) {
    names_.emplace_back();
    renderer_->AddActor2D(names_.back());
    setTextStyle(names_.back()->GetTextProperty(), 12, color_);
    names_.back()->GetTextProperty()->SetJustificationToCentered();
  }
  for (std::size_t i = 0; i < targets_.size(); ++i)
    if (targets_[i].label != (names_[i]->GetInput() ? names_[i]->GetInput() : ""))
      names_[i]->SetInput(targets_[i].label.c_str());
}

void TargetFigure::setTheme(const Palette& palette) {
  color_ = palette.mass;  // blue, as in the thesis's figures
  background_ = palette.background;
  setColor(curves_.actor(), color_);
  handles_.setColors(color_, background_);
  active_.setColors(palette.prediction, background_);
  for (auto& name : names_) setTextStyle(name->GetTextProperty(), 12, color_);
}

void TargetFigure::setPixelRatio(double ratio) {
  ratio_ = ratio;
  curves_.setPixelRatio(ratio);
  handles_.setPixelRatio(ratio);
  active_.setPixelRatio(ratio);
}

void TargetFigure::layOut(const CameraControl& camera) {
  std::vector<Eigen::Vector2d> passive, active;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const TargetCurve& target = targets_[i];
    for (Eigen::Index h = 0; h < target.handles.cols(); ++h)
      if (const auto pixel = camera.pixelOf(target.handles.col(h)))
        (h == target.active ? active : passive).push_back(*pixel);
    std::optional<Eigen::Vector2d> top;
    for (const auto& point : target.curve.colwise())
      if (const auto pixel = camera.pixelOf(point); pixel && (!top || pixel->y() > top->y())) top = pixel;
    names_[i]->SetVisibility(top.has_value());
    if (top) names_[i]->SetPosition(top->x(), top->y() + nameOffset * ratio_);
  }
  for (auto& [dots, places] : {std::pair(&handles_, &passive), std::pair(&active_, &active)}) {
    Eigen::Matrix2Xd pixels(2, static_cast<Eigen::Index>(places->size()));
    for (std::size_t i = 0; i < places->size(); ++i) pixels.col(static_cast<Eigen::Index>(i)) = (*places)[i];
    dots->setVisible(!places->empty());
    dots->setPlaces(pixels);
  }
}

}  // namespace pliant::render
