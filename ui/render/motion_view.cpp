#include "ui/render/motion_view.hpp"

#include <algorithm>

#include "core/mechanics/strain.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/ghost.hpp"
#include "ui/render/node_paths.hpp"
#include "ui/render/ring.hpp"
#include "ui/render/stage.hpp"
#include "ui/render/target_figure.hpp"

namespace pliant::render {
namespace {

using harmonic::HarmonicBalanceProblem;
using mechanics::Matrix;
using mechanics::Vector;

}  // namespace

struct MotionView::Parts {
  Stage& stage;
  vtkNew<vtkLookupTable> table;
  Figure solved{Figure::Kind::solved};
  Ghost ghost;
  LinePrimitive paths{2.5};
  DotPrimitive probeDots{8.0};
  TargetFigure targets;
  Ring selectionRing;

  double tau = 0;
  bool stale = false;

  std::shared_ptr<const mechanics::Model> model;
  FigureLayout layout;
  std::shared_ptr<const HarmonicBalanceProblem> problem;
  Vector z;
  Matrix trajectories;
  std::string ghostLabel;
  std::optional<int> selected;
  FieldRange ownRange;
  std::optional<FieldRange> sharedRange;
  Points reach{3, 0};  ///< of the solved motion
  Points beyond{3, 0};
  Points pose;

  explicit Parts(Stage& around) : stage(around) {
    vtkRenderer* renderer = stage.renderer();
    solved.addTo(renderer);
    for (vtkActor* actor : {paths.actor(), probeDots.actor()}) renderer->AddActor(actor);
    ghost.addTo(renderer);
    targets.addTo(renderer);
    selectionRing.addTo(renderer);
    paths.actor()->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -6);
    stage.legend().setTable(table);
    stage.onLayOut = [this] {
      targets.layOut(stage.camera());
      selectionRing.setPlace(model && selected ? stage.camera().pixelOf(pose.col(*selected)) : std::nullopt);
    };
    stage.onTheme = [this] { applyTheme(); };
    stage.onPixelRatio = [this] { applyPixelRatio(); };
    stage.onField = [this] {
      showScale();
      showPose();
    };
    showMotion();
    stage.setTheme(Theme::light);
  }

  void applyTheme() {
    const Palette& colors = stage.colors();
    solved.setTheme(colors, stale);
    ghost.setTheme(colors);
    setColor(paths.actor(), stale ? faded(colors.trajectory) : colors.trajectory);
    setColor(probeDots.actor(), stale ? faded(colors.trajectory) : colors.trajectory);
    targets.setTheme(colors);
    selectionRing.setColors(colors.text, colors.background);
    setViridis(table, range().least, range().most, stale);
    if (ghost.isShown())
      stage.setNotice("▨ " + ghostLabel, colors.prediction);
    else
      stage.setNotice(stale && problem ? "inputs have changed since this was solved" : "", colors.text);
  }

  void applyPixelRatio() {
    const double ratio = stage.pixelRatio();
    solved.setPixelRatio(ratio);
    ghost.setPixelRatio(ratio);
    paths.setPixelRatio(ratio);
    probeDots.setPixelRatio(ratio);
    targets.setPixelRatio(ratio);
    selectionRing.setPixelRatio(ratio);
  }

  bool showsField() const { return stage.fieldVisible() && problem && !layout.triangles.empty(); }

  /// Largest principal stretch of each triangle, less 1.
  Vector stretch(const Vector& positions) const {
    return mechanics::principalStretches(layout.dimension, model->restPositions, positions, layout.triangles).array() -
           1.0;
  }

  const FieldRange& range() const { return sharedRange ? *sharedRange : ownRange; }

  /// Everything that depends on the solved motion but not on τ.
  void showMotion() {
    trajectories = problem ? problem->trajectories(z) : Matrix();
    reach = model ? layout.places(model->restPositions) : Points(3, 0);
    ownRange = {};
    if (problem) {
      const Matrix instants = instantsOf({problem, z, nullptr});
      reach = reachOf(layout, instants);
      for (Eigen::Index i = 0; !layout.triangles.empty() && i < instants.rows(); ++i) {
        const Vector values = stretch(instants.row(i).transpose());
        ownRange.least = i == 0 ? values.minCoeff() : std::min(ownRange.least, values.minCoeff());
        ownRange.most = i == 0 ? values.maxCoeff() : std::max(ownRange.most, values.maxCoeff());
      }
    }
    ownRange.most = std::max(ownRange.most, ownRange.least + 1e-12);
    layout.setReach(reach);
    solved.setLayout(layout);
    if (model) solved.setMassRadii(layout, layout.massRadii(*model));
    ghost.setLayout(layout);
    showReach();
    showScale();
    showPaths();
    showPose();
    applyTheme();
  }

  void showReach() {
    Points all = joined(joined(reach, ghost.reach()), joined(targets.reach(), beyond));
    if (all.cols() == 0) all = Points::Zero(3, 1);
    stage.camera().setReach(std::move(all));
  }

  void showScale() {
    stage.legend().setRange(range().least, range().most);
    stage.setLegendVisible(showsField() && !sharedRange);
  }

  std::vector<int> tracedNodes() const {
    std::vector<int> nodes = layout.probeNodes;
    if (selected) nodes.push_back(*selected);
    return nodes;
  }

  void showPaths() {
    paths.actor()->SetVisibility(problem != nullptr);
    if (problem) paths.setClosedCurves(nodePaths(*problem, trajectories, tracedNodes()), 0);
    ghost.showPaths(tracedNodes());
  }

  void showPose() {
    solved.setVisible(model != nullptr);
    probeDots.actor()->SetVisibility(problem != nullptr);
    ghost.showPose(tau);
    if (!model) return;
    const Vector positions = problem ? problem->configurationAt(z, tau) : model->restPositions;
    pose = layout.pose(positions);
    solved.setPose(pose);
    const Vector values = showsField() ? stretch(positions) : Vector();
    solved.setField(showsField() ? &values : nullptr, table);
    probeDots.setNodes(layout.probeNodes);
    probeDots.setPoints(pose);
  }

  void showGhost(const std::string& label) {
    const bool relabel = label != ghostLabel;
    ghostLabel = label;
    ghost.setVisible(true);
    ghost.showPaths(tracedNodes());
    ghost.showPose(tau);
    if (relabel) applyTheme();
  }

  void clearGhost() {
    ghostLabel.clear();
    ghost.clear();
  }
};

MotionView::MotionView() : parts_(std::make_unique<Parts>(stage())) {}

MotionView::~MotionView() { attach(nullptr); }

void MotionView::setModel(std::shared_ptr<const mechanics::Model> model) {
  Parts& p = *parts_;
  p.model = std::move(model);
  p.problem.reset();
  p.clearGhost();
  p.selected.reset();
  p.stale = false;
  p.layout = p.model ? FigureLayout(*p.model) : FigureLayout();
  p.showMotion();
}

void MotionView::setMotion(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, mechanics::Vector z) {
  Parts& p = *parts_;
  p.problem = std::move(problem);
  p.z = std::move(z);
  p.clearGhost();
  p.stale = false;
  p.showMotion();
}

void MotionView::clearMotion() {
  Parts& p = *parts_;
  p.problem.reset();
  p.clearGhost();
  p.stale = false;
  p.showMotion();
}

void MotionView::setPrediction(const mechanics::Vector& z, std::shared_ptr<const mechanics::Model> changedModel) {
  Parts& p = *parts_;
  if (!p.problem) return;
  const mechanics::Model& masses = changedModel ? *changedModel : *p.model;
  p.ghost.setPrediction({p.problem, z, changedModel}, masses);
  p.showGhost("predicted");
}

void MotionView::setGhost(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z,
                          const std::string& label) {
  Parts& p = *parts_;
  if (!p.problem) return;
  p.ghost.setOther({std::move(problem), z, nullptr});
  p.showGhost(label);
  p.showReach();
}

bool MotionView::showsGhost() const { return parts_->ghost.isShown(); }

void MotionView::clearPrediction() {
  Parts& p = *parts_;
  if (!p.ghost.isShown()) return;
  p.clearGhost();
  p.showReach();
  p.applyTheme();
}

FieldRange MotionView::fieldRange() const { return parts_->ownRange; }

void MotionView::setSharedRange(std::optional<FieldRange> range) {
  Parts& p = *parts_;
  p.sharedRange = range;
  p.showScale();
  p.showPose();
  p.applyTheme();
}

Points MotionView::reach() const { return joined(parts_->reach, parts_->ghost.reach()); }

void MotionView::setBeyond(Points beyond) {
  parts_->beyond = std::move(beyond);
  parts_->showReach();
}

vtkLookupTable* MotionView::colorTable() const { return parts_->table; }

bool MotionView::showsField() const { return parts_->showsField(); }

void MotionView::setTargets(std::vector<TargetCurve> targets) {
  parts_->targets.setTargets(std::move(targets));
  parts_->showReach();
}

const std::vector<TargetCurve>& MotionView::targets() const { return parts_->targets.targets(); }

void MotionView::setGizmoVisible(bool visible) { stage().setGizmoVisible(visible); }

vtkRenderer* MotionView::renderer() const { return parts_->stage.renderer(); }

const CameraControl& MotionView::camera() const { return stage().camera(); }

void MotionView::setStale(bool stale) {
  if (parts_->stale == stale) return;
  parts_->stale = stale;
  parts_->applyTheme();
}

void MotionView::setTau(double tau) {
  parts_->tau = tau;
  parts_->showPose();
}

int MotionView::periods() const { return parts_->problem ? parts_->problem->basis().periods() : 1; }

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
