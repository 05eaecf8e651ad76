#include "ui/render/motion_view.hpp"

#include <SMP/Common/vtkSMPToolsAPI.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkCullerCollection.h>
#include <vtkLight.h>
#include <vtkRenderWindow.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <numbers>

#include "core/mechanics/strain.hpp"
#include "ui/render/camera_control.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/figure.hpp"
#include "ui/render/gizmo.hpp"
#include "ui/render/legend.hpp"
#include "ui/render/predicted_motion.hpp"
#include "ui/render/ring.hpp"
#include "ui/render/vtk_text.hpp"

namespace pliant::render {
namespace {

constexpr int curveSamples = 256;
constexpr double dashLength = 0.012;  // of the model's extent
constexpr double captionMargin = 14;  // device-independent pixels
constexpr int fineSamples = 8;
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
  vtkNew<vtkRenderer> renderer;
  CameraControl camera{renderer};
  Gizmo gizmo;
  Legend legend;
  vtkNew<vtkTextActor> caption;
  vtkNew<vtkTextActor> notice;
  vtkNew<vtkLookupTable> table;
  Figure solved{Figure::Kind::solved};
  Figure predicted{Figure::Kind::ghost};
  LinePrimitive paths{2.5};
  LinePrimitive predictedPaths{2.5};
  DotPrimitive probeDots{8.0};
  Ring selectionRing;

  vtkRenderWindow* window = nullptr;
  unsigned long observer = 0;
  Theme theme = Theme::light;
  double ratio = 1;
  double tau = 0;
  bool fine = true;
  bool stale = false;
  bool fieldVisible = true;
  std::string captionText;

  std::shared_ptr<const mechanics::Model> model;
  FigureLayout layout;
  std::shared_ptr<const HarmonicBalanceProblem> problem;
  Vector z;
  Matrix trajectories;
  std::optional<PredictedMotion> prediction;
  std::optional<int> selected;
  double leastStretch = 0, mostStretch = 0;
  Points pose;

  Parts() {
    // What is drawn is small: waking VTK's pool of threads costs more than it saves, and the solver wants the cores.
    vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend("Sequential");
    renderer->AutomaticLightCreationOff();
    renderer->GetCullers()->RemoveAllItems();  // nothing is worth the pass over all bounds
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(-0.45, 0.65, 1.0);
    light->SetFocalPoint(0, 0, 0);
    renderer->AddLight(light);
    solved.addTo(renderer);
    for (vtkActor* actor : {paths.actor(), probeDots.actor()}) renderer->AddActor(actor);
    predicted.addTo(renderer);
    renderer->AddActor(predictedPaths.actor());
    selectionRing.addTo(renderer);
    for (LinePrimitive* lines : {&paths, &predictedPaths})
      lines->actor()->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -6);
    legend.addTo(renderer);
    legend.setTable(table);
    renderer->AddActor2D(caption);
    renderer->AddActor2D(notice);
    observer = renderer->AddObserver(vtkCommand::StartEvent, this, &Parts::layOut);
    showMotion();
    applyTheme();
  }

  ~Parts() { renderer->RemoveObserver(observer); }

  /// Puts what is measured in pixels in its place, as rendering begins.
  void layOut() {
    const int* size = renderer->GetSize();
    legend.layOut(size[0], size[1]);
    gizmo.follow(renderer->GetActiveCamera(), size[0], size[1]);
    selectionRing.setPlace(model && selected ? camera.pixelOf(pose.col(*selected)) : std::nullopt);
    const double margin = captionMargin * ratio;
    caption->SetPosition(margin, size[1] - margin);
    double height[2] = {0, 0};
    if (!captionText.empty()) caption->GetSize(renderer, height);
    notice->SetPosition(margin, size[1] - margin - (height[1] > 0 ? height[1] + 8 * ratio : 0));
  }

  void applyTheme() {
    const Palette& colors = palette(theme);
    renderer->SetBackground(colors.background.data());
    solved.setTheme(colors, stale);
    predicted.setTheme(colors, false);
    setColor(paths.actor(), stale ? faded(colors.trajectory) : colors.trajectory);
    setColor(probeDots.actor(), stale ? faded(colors.trajectory) : colors.trajectory);
    setColor(predictedPaths.actor(), colors.prediction);
    selectionRing.setColors(colors.text, colors.background);
    setViridis(table, leastStretch, mostStretch, stale);
    legend.setTheme(colors);
    gizmo.setTheme(colors);
    for (vtkTextActor* text : {caption.Get(), notice.Get()}) {
      setTextStyle(text->GetTextProperty(), 13, text == notice.Get() && prediction ? colors.prediction : colors.text);
      text->GetTextProperty()->SetVerticalJustificationToTop();
      text->GetTextProperty()->SetLineSpacing(1.2);
    }
    const std::string predictedText = prediction ? "▨ predicted" : "";
    const std::string staleText = stale && problem ? "inputs have changed since this was solved" : "";
    notice->SetInput((prediction ? predictedText : staleText).c_str());
    notice->SetVisibility(prediction || !staleText.empty());
  }

  bool showsField() const { return fieldVisible && problem && !layout.triangles.empty(); }

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
    camera.setReach(std::move(reach));
    legend.setRange(leastStretch, mostStretch);
    legend.setVisible(showsField());
    camera.setRightMargin(showsField() ? Legend::width * ratio : 0);
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

MotionView::MotionView() : parts_(std::make_unique<Parts>()) {}

MotionView::~MotionView() { attach(nullptr); }

void MotionView::attach(vtkRenderWindow* window) {
  Parts& p = *parts_;
  if (p.window == window) return;
  if (p.window) {
    p.window->RemoveRenderer(p.renderer);
    p.window->RemoveRenderer(p.gizmo.renderer());
  }
  p.window = window;
  if (!window) return;
  window->SetNumberOfLayers(2);
  window->AddRenderer(p.renderer);
  window->AddRenderer(p.gizmo.renderer());
  setPixelRatio(p.ratio);
  setFineQuality(p.fine);
}

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

void MotionView::setCaption(const std::string& text) {
  parts_->captionText = text;
  parts_->caption->SetInput(text.c_str());
  parts_->caption->SetVisibility(!text.empty());
}

void MotionView::setTheme(Theme theme) {
  parts_->theme = theme;
  parts_->applyTheme();
}

void MotionView::setFieldVisible(bool visible) {
  Parts& p = *parts_;
  p.fieldVisible = visible;
  p.legend.setVisible(p.showsField());
  p.camera.setRightMargin(p.showsField() ? Legend::width * p.ratio : 0);
  p.showPose();
}

void MotionView::setPixelRatio(double ratio) {
  Parts& p = *parts_;
  p.ratio = ratio;
  if (p.window) p.window->SetDPI(static_cast<int>(72 * ratio + 0.5));
  p.solved.setPixelRatio(ratio);
  p.predicted.setPixelRatio(ratio);
  for (LinePrimitive* lines : {&p.paths, &p.predictedPaths}) lines->setPixelRatio(ratio);
  p.probeDots.setPixelRatio(ratio);
  p.selectionRing.setPixelRatio(ratio);
  p.legend.setPixelRatio(ratio);
  p.gizmo.setPixelRatio(ratio);
  p.camera.setRightMargin(p.showsField() ? Legend::width * ratio : 0);
}

void MotionView::setFineQuality(bool fine) {
  Parts& p = *parts_;
  p.fine = fine;
  if (p.window) p.window->SetMultiSamples(fine ? fineSamples : 0);
}

void MotionView::fit() { parts_->camera.fit(); }
void MotionView::setAxisView(AxisView view) { parts_->camera.setAxisView(view); }
void MotionView::orbit(double dx, double dy) { parts_->camera.orbit(dx, dy); }
void MotionView::pan(double dx, double dy) { parts_->camera.pan(dx, dy); }
void MotionView::zoom(double factor, double x, double y) { parts_->camera.zoom(factor, x, y); }

std::optional<int> MotionView::pickNode(double x, double y, double radius) const {
  const Parts& p = *parts_;
  if (!p.model) return std::nullopt;
  return p.camera.nearestPoint(p.pose.leftCols(p.layout.rest.cols()), x, y, radius);
}

}  // namespace pliant::render
