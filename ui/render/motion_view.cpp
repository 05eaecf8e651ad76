#include "ui/render/motion_view.hpp"

#include <algorithm>
#include <numbers>

#include "core/mechanics/strain.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/figure.hpp"
#include "ui/render/predicted_motion.hpp"
#include "ui/render/ring.hpp"
#include "ui/render/stage.hpp"

namespace pliant::render {
namespace {

constexpr int curveSamples = 256;
constexpr double dashLength = 0.012;  // of the model's extent
/// At least so many instants of a period tell how far the motion reaches and how much it stretches: a solver may take
/// so few samples that more happens between them.
constexpr int fewestInstants = 64;

using harmonic::HarmonicBalanceProblem;
using mechanics::Matrix;
using mechanics::Vector;

/// The closed paths of some nodes, one column a place.
std::vector<Points> nodePaths(const HarmonicBalanceProblem& problem, const Matrix& trajectories,
                              const std::vector<int>& nodes) {
  const math::HarmonicBasis& basis = problem.basis();
  // The samples' trigonometric interpolant, so that paths are smooth however few samples the solver takes.
  Matrix interpolation(curveSamples, basis.size());
  for (int i = 0; i < curveSamples; ++i)
    interpolation.row(i) = basis.valuesAt(2.0 * std::numbers::pi * i / curveSamples).transpose();
  const int dimension = problem.model().dimension;
  std::vector<Points> paths;
  for (const int node : nodes) {
    const Matrix samples = trajectories.middleCols(node * dimension, dimension);
    Points path = Points::Zero(3, curveSamples);
    path.topRows(dimension) = (interpolation * (basis.analysis() * samples)).transpose();
    paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace

struct MotionView::Parts {
  Stage& stage;
  vtkNew<vtkLookupTable> table;
  Figure solved{Figure::Kind::solved};
  Figure predicted{Figure::Kind::ghost};
  LinePrimitive paths{2.5};
  LinePrimitive predictedPaths{2.5};
  DotPrimitive probeDots{8.0};
  Ring selectionRing;

  double tau = 0;
  bool stale = false;

  std::shared_ptr<const mechanics::Model> model;
  FigureLayout layout;
  std::shared_ptr<const HarmonicBalanceProblem> problem;
  Vector z;
  Matrix trajectories;
  std::optional<PredictedMotion> prediction;
  std::optional<int> selected;
  double leastStretch = 0, mostStretch = 0;
  Points pose;

  explicit Parts(Stage& around) : stage(around) {
    vtkRenderer* renderer = stage.renderer();
    solved.addTo(renderer);
    for (vtkActor* actor : {paths.actor(), probeDots.actor()}) renderer->AddActor(actor);
    predicted.addTo(renderer);
    renderer->AddActor(predictedPaths.actor());
    selectionRing.addTo(renderer);
    for (LinePrimitive* lines : {&paths, &predictedPaths})
      lines->actor()->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -6);
    stage.legend().setTable(table);
    stage.onLayOut = [this] {
      selectionRing.setPlace(model && selected ? stage.camera().pixelOf(pose.col(*selected)) : std::nullopt);
    };
    stage.onTheme = [this] { applyTheme(); };
    stage.onPixelRatio = [this] { applyPixelRatio(); };
    stage.onField = [this] {
      stage.setLegendVisible(showsField());
      showPose();
    };
    showMotion();
    stage.setTheme(Theme::light);
  }

  void applyTheme() {
    const Palette& colors = stage.colors();
    solved.setTheme(colors, stale);
    predicted.setTheme(colors, false);
    setColor(paths.actor(), stale ? faded(colors.trajectory) : colors.trajectory);
    setColor(probeDots.actor(), stale ? faded(colors.trajectory) : colors.trajectory);
    setColor(predictedPaths.actor(), colors.prediction);
    selectionRing.setColors(colors.text, colors.background);
    setViridis(table, leastStretch, mostStretch, stale);
    if (prediction)
      stage.setNotice("▨ predicted", colors.prediction);
    else
      stage.setNotice(stale && problem ? "inputs have changed since this was solved" : "", colors.text);
  }

  void applyPixelRatio() {
    const double ratio = stage.pixelRatio();
    solved.setPixelRatio(ratio);
    predicted.setPixelRatio(ratio);
    for (LinePrimitive* lines : {&paths, &predictedPaths}) lines->setPixelRatio(ratio);
    probeDots.setPixelRatio(ratio);
    selectionRing.setPixelRatio(ratio);
  }

  bool showsField() const { return stage.fieldVisible() && problem && !layout.triangles.empty(); }

  /// Largest principal stretch of each triangle, less 1.
  Vector stretch(const Vector& positions) const {
    return mechanics::principalStretches(layout.dimension, model->restPositions, positions, layout.triangles).array() -
           1.0;
  }

  /// Everything that depends on the solved motion but not on τ.
  void showMotion() {
    trajectories = problem ? problem->trajectories(z) : Matrix();
    Points reach = model ? layout.places(model->restPositions) : Points(3, 0);
    leastStretch = 0;
    mostStretch = 0;
    const Eigen::Index instants = problem ? std::max<Eigen::Index>(fewestInstants, trajectories.rows()) : 0;
    if (problem) reach.resize(3, instants * reach.cols());
    for (Eigen::Index i = 0; i < instants; ++i) {
      const Vector positions =
          problem->configurationAt(z, 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(instants));
      const Points sample = layout.places(positions);
      reach.middleCols(i * sample.cols(), sample.cols()) = sample;
      if (layout.triangles.empty()) continue;
      const Vector values = stretch(positions);
      leastStretch = i == 0 ? values.minCoeff() : std::min(leastStretch, values.minCoeff());
      mostStretch = i == 0 ? values.maxCoeff() : std::max(mostStretch, values.maxCoeff());
    }
    mostStretch = std::max(mostStretch, leastStretch + 1e-12);
    layout.setReach(reach);
    for (Figure* figure : {&solved, &predicted}) {
      figure->setLayout(layout);
      if (model) figure->setMassRadii(layout, layout.massRadii(*model));
    }
    if (reach.cols() == 0) reach = Points::Zero(3, 1);
    stage.camera().setReach(std::move(reach));
    stage.legend().setRange(leastStretch, mostStretch);
    stage.setLegendVisible(showsField());
    showPaths();
    showPose();
    applyTheme();
  }

  std::vector<int> tracedNodes() const {
    std::vector<int> nodes = layout.probeNodes;
    if (selected) nodes.push_back(*selected);
    return nodes;
  }

  void showPaths() {
    paths.actor()->SetVisibility(problem != nullptr);
    if (problem) paths.setClosedCurves(nodePaths(*problem, trajectories, tracedNodes()), 0);
    showPredictedPaths();
  }

  void showPredictedPaths() {
    predictedPaths.actor()->SetVisibility(problem && prediction);
    if (problem && prediction)
      predictedPaths.setClosedCurves(
          nodePaths(*problem, prediction->trajectories(), tracedNodes()), dashLength * layout.size);
  }

  void showPose() {
    solved.setVisible(model != nullptr);
    probeDots.actor()->SetVisibility(problem != nullptr);
    showPredictedPose();
    if (!model) return;
    const Vector positions = problem ? problem->configurationAt(z, tau) : model->restPositions;
    pose = layout.pose(positions);
    solved.setPose(pose);
    const Vector values = showsField() ? stretch(positions) : Vector();
    solved.setField(showsField() ? &values : nullptr, table);
    probeDots.setNodes(layout.probeNodes);
    probeDots.setPoints(pose);
  }

  void showPredictedPose() {
    predicted.setVisible(problem && prediction);
    if (problem && prediction) predicted.setPose(layout.pose(prediction->configurationAt(tau)));
  }
};

MotionView::MotionView() : parts_(std::make_unique<Parts>(stage())) {}

MotionView::~MotionView() { attach(nullptr); }

void MotionView::setModel(std::shared_ptr<const mechanics::Model> model) {
  Parts& p = *parts_;
  p.model = std::move(model);
  p.problem.reset();
  p.prediction.reset();
  p.selected.reset();
  p.stale = false;
  p.layout = p.model ? FigureLayout(*p.model) : FigureLayout();
  p.showMotion();
}

void MotionView::setMotion(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, mechanics::Vector z) {
  Parts& p = *parts_;
  p.problem = std::move(problem);
  p.z = std::move(z);
  p.prediction.reset();
  p.stale = false;
  p.showMotion();
}

void MotionView::clearMotion() {
  Parts& p = *parts_;
  p.problem.reset();
  p.prediction.reset();
  p.stale = false;
  p.showMotion();
}

void MotionView::setPrediction(const mechanics::Vector& z, std::shared_ptr<const mechanics::Model> changedModel) {
  Parts& p = *parts_;
  if (!p.problem) return;
  const bool first = !p.prediction;
  p.predicted.setMassRadii(p.layout, p.layout.massRadii(changedModel ? *changedModel : *p.model));
  p.prediction = {p.problem, z, std::move(changedModel)};
  p.showPredictedPaths();
  p.showPredictedPose();
  if (first) p.applyTheme();
}

void MotionView::clearPrediction() {
  Parts& p = *parts_;
  if (!p.prediction) return;
  p.prediction.reset();
  p.showPredictedPaths();
  p.showPredictedPose();
  p.applyTheme();
}

void MotionView::setStale(bool stale) {
  if (parts_->stale == stale) return;
  parts_->stale = stale;
  parts_->applyTheme();
}

void MotionView::setTau(double tau) {
  parts_->tau = tau;
  parts_->showPose();
}

double MotionView::tau() const { return parts_->tau; }

void MotionView::setSelectedNode(std::optional<int> node) {
  Parts& p = *parts_;
  if (node && (!p.model || *node < 0 || *node >= p.model->nodeCount())) node.reset();
  p.selected = node;
  p.showPaths();
  p.showPose();
}

std::optional<int> MotionView::selectedNode() const { return parts_->selected; }

std::optional<int> MotionView::pickNode(double x, double y, double radius) const {
  const Parts& p = *parts_;
  if (!p.model) return std::nullopt;
  return stage().camera().nearestPoint(p.pose.leftCols(p.layout.rest.cols()), x, y, radius);
}

}  // namespace pliant::render
