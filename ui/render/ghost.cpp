#include "ui/render/ghost.hpp"

#include "ui/render/node_paths.hpp"

namespace pliant::render {
namespace {

constexpr double ghostDash = 0.012;  // of the model's extent

}  // namespace

void Ghost::addTo(vtkRenderer* renderer) {
  figure_.addTo(renderer);
  paths_.actor()->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -6);
  renderer->AddActor(paths_.actor());
  setVisible(false);
}

void Ghost::setLayout(const FigureLayout& layout) {
  layout_ = layout;
  clear();
  figure_.setLayout(layout_);
}

void Ghost::setPrediction(PredictedMotion motion, const mechanics::Model& masses) {
  if (own_) clear();
  figure_.setMassRadii(layout_, layout_.massRadii(masses));
  motion_ = std::move(motion);
}

void Ghost::setOther(PredictedMotion motion) {
  own_ = FigureLayout(motion.problem->model());
  reach_ = reachOf(*own_, instantsOf(motion));
  own_->setReach(reach_);
  figure_.setLayout(*own_);
  figure_.setMassRadii(*own_, own_->massRadii(motion.problem->model()));
  motion_ = std::move(motion);
}

void Ghost::clear() {
  if (own_) figure_.setLayout(layout_);
  motion_.reset();
  own_.reset();
  reach_.resize(3, 0);
  setVisible(false);
}

void Ghost::setVisible(bool visible) {
  figure_.setVisible(visible);
  paths_.actor()->SetVisibility(visible);
}

void Ghost::showPaths(const std::vector<int>& nodes) {
  if (motion_)
    paths_.setClosedCurves(nodePaths(*motion_->problem, motion_->trajectories(), nodes), ghostDash * layout().size);
}

void Ghost::showPose(double tau) {
  if (motion_) figure_.setPose(layout().pose(motion_->configurationAt(tau)));
}

void Ghost::setTheme(const Palette& palette) {
  figure_.setTheme(palette, false);
  setColor(paths_.actor(), palette.prediction);
}

void Ghost::setPixelRatio(double ratio) {
  figure_.setPixelRatio(ratio);
  paths_.setPixelRatio(ratio);
}

}  // namespace pliant::render
