#include "ui/shell/target_link.hpp"

#include <Eigen/SVD>
#include <QFileDialog>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/harmonic/closed_spline.hpp"
#include "core/harmonic/design_objective.hpp"
#include "ui/panels/target_bar.hpp"
#include "ui/panels/value_text.hpp"
#include "ui/plots/plot_style.hpp"
#include "ui/render/node_paths.hpp"
#include "ui/shell/target_entry.hpp"

namespace pliant::shell {

using document::Json;
using render::Points;
using viewport::TargetTool;

namespace {

constexpr int pointsPerPiece = 24;  ///< of a curve that is drawn
constexpr int firstPoints = 8;      ///< of a new target
constexpr int mostFirstPoints = 12;
constexpr int motionPlaces = 64;   ///< of a target that is taken from a motion
constexpr double straight = 0.05;  ///< a path this thin for its length has no plane of its own

Points padded(const mechanics::Matrix& places) {
  Points points = Points::Zero(3, places.cols());
  points.topRows(places.rows()) = places;
  return points;
}

/// Every (count / n)th place of a closed path.
Points thinned(const Points& path, int n) {
  Points points(3, n);
  for (int i = 0; i < n; ++i) points.col(i) = path.col(i * path.cols() / n);
  return points;
}

double extentOf(const Points& points) { return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm(); }

/// The trigonometric polynomial through places at even times.
Points interpolated(const Points& places, int harmonics, int count) {
  const mechanics::Matrix coefficients =
      harmonic::pathCoefficients(places, std::min<int>(harmonics, static_cast<int>(places.cols() - 1) / 2));
  const int size = static_cast<int>(coefficients.rows());
  const math::HarmonicBasis basis(size / 2, std::max(count, size));
  Points curve(3, count);
  for (int i = 0; i < count; ++i)
    curve.col(i) = (basis.valuesAt(2 * std::numbers::pi * i / count).transpose() * coefficients).transpose();
  return curve;
}

QString sizeText(const Points& curve) {
  const Eigen::Vector3d size = curve.rowwise().maxCoeff() - curve.rowwise().minCoeff();
  QStringList list;
  for (int axis = 0; axis < 3; ++axis)
    if (size[axis] > 1e-6 * size.maxCoeff()) list += plots::formatLength(size[axis]);
  return list.join(QStringLiteral(" × "));
}

}  // namespace

TargetLink::TargetLink(document::Document& document, jobs::MotionSession& session, viewport::Viewport& viewport,
                       panels::TargetBar& bar, QObject* parent)
    : QObject(parent),
      document_(document),
      session_(session),
      viewport_(viewport),
      bar_(bar),
      tool_(viewport.motionView()) {
  tool_.onChanged = [this] { showTargets(); };
  tool_.onCommitted = [this](TargetTool::Edit edit) { commit(edit); };
  tool_.onEnded = [this] { setDrawing(false); };
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    endDrawing();
    refresh();
  });
  connect(&document_, &document::Document::sceneEdited, this, &TargetLink::refresh);
  connect(&session_, &jobs::MotionSession::shownChanged, this, &TargetLink::refresh);
  connect(&bar_, &panels::TargetBar::drawToggled, this, &TargetLink::setDrawing);
  connect(&bar_, &panels::TargetBar::probeChosen, this, [this](const std::string& probe) {
    endDrawing();
    if (const int node = nodeOf(probe); node >= 0) session_.selectNode(node);
    showTargets();
    showState();
  });
  connect(&bar_, &panels::TargetBar::tableRequested, this, &TargetLink::chooseTable);
  connect(&bar_, &panels::TargetBar::motionRequested, this, &TargetLink::takeMotion);
  refresh();
}

void TargetLink::refresh() {
  const auto model = document_.model();
  bar_.setProbes(model ? model->probes : std::vector<mechanics::Probe>());
  bar_.setMotionAvailable(session_.shown().has_value());
  targets_ = model ? scene::targetPaths(document_.scene(), *model) : std::vector<scene::TargetPath>();
  if (drawing_ && !tool_.isDragging()) {
    if (const auto* target = targetOf(*drawing_))
      loadTool(*target);
    else
      endDrawing();
  }
  showTargets();
  showState();
}

int TargetLink::nodeOf(const std::string& probe) const {
  if (const auto model = document_.model())
    for (const mechanics::Probe& each : model->probes)
      if (each.name == probe) return each.node;
  return -1;
}

const scene::TargetPath* TargetLink::targetOf(const std::string& probe) const {
  const auto found = std::find_if(targets_.begin(), targets_.end(), [&](const auto& t) { return t.probe == probe; });
  return found == targets_.end() ? nullptr : &*found;
}

Points TargetLink::presentPath(int node) const {
  const auto& shown = session_.shown();
  if (shown)
    return render::nodePaths(*shown->problem, shown->problem->nodeTrajectory(shown->motion.z, node), {0}).front();
  const mechanics::Model& model = *document_.model();
  return padded(model.restPositions.segment(node * model.dimension, model.dimension));
}

Eigen::Vector3d TargetLink::planeNormal(int node) const {
  if (document_.model()->dimension < 3) return Eigen::Vector3d::UnitZ();
  const render::CameraPose pose = viewport_.motionView().cameraPose();
  const Eigen::Vector3d toCamera = (pose.position - pose.focus).normalized();
  Points path = presentPath(node);
  path.colwise() -= path.rowwise().mean().eval();
  const Eigen::JacobiSVD<Eigen::Matrix3Xd> svd(path, Eigen::ComputeFullU);
  const Eigen::Vector3d sizes = svd.singularValues();
  if (path.cols() < 3 || !(sizes[0] > 0)) return toCamera;
  if (sizes[1] > straight * sizes[0]) return svd.matrixU().col(2);
  // To and fro on a line: of the planes through it the one that is seen best.
  const Eigen::Vector3d line = svd.matrixU().col(0), normal = toCamera - toCamera.dot(line) * line;
  return normal.norm() > 1e-3 ? normal.normalized() : Eigen::Vector3d(svd.matrixU().col(1));
}

Eigen::Vector3d TargetLink::offsetOf(const scene::TargetPath& target, const Points& curve) const {
  // Where its place does not count, the target is compared with the path when both have one middle, and so it is seen.
  if (target.matchPlace) return Eigen::Vector3d::Zero();
  return presentPath(target.node).rowwise().mean() - curve.rowwise().mean();
}

render::TargetCurve TargetLink::curveOf(const scene::TargetPath& target) const {
  render::TargetCurve curve;
  const bool drawn = drawing_ == target.probe;
  if (drawn) {
    curve.handles = tool_.points();
    curve.active = tool_.active();
    curve.curve = harmonic::closedSpline(curve.handles, pointsPerPiece);
  } else {
    const Points places = padded(target.places);
    curve.curve = target.controlPoints.cols() > 0
                      ? places
                      : interpolated(places, static_cast<int>(places.cols()) / 2, std::max(256, int(places.cols())));
    curve.curve.colwise() += offsetOf(target, curve.curve);
  }
  QString label = tr("target of %1").arg(QString::fromStdString(target.probe));
  if (drawn && curve.active >= 0) {
    QStringList place;
    for (int axis = 0; axis < document_.model()->dimension; ++axis)
      place += plots::formatLength(curve.handles(axis, curve.active));
    label += QStringLiteral(": (%1)").arg(place.join(QStringLiteral(", ")));
  } else {
    label += QStringLiteral(": ") + sizeText(curve.curve);
  }
  curve.label = label.toStdString();
  return curve;
}

void TargetLink::showTargets() {
  std::vector<render::TargetCurve> curves;
  for (const scene::TargetPath& target : targets_) {
    curves.push_back(curveOf(target));
    if (drawing_ == target.probe) tool_.setCurve(curves.back().curve);
  }
  viewport_.motionView().setTargets(std::move(curves));
  viewport_.redrawMotion();
}

void TargetLink::showState() {
  const scene::TargetPath* target = targetOf(bar_.probe());
  if (!target) {
    bar_.setState(tr("no target yet"));
    return;
  }
  QString text = target->controlPoints.cols() > 0 ? tr("%1 points").arg(target->controlPoints.cols())
                                                  : tr("%1 places").arg(target->places.cols());
  if (const auto& shown = session_.shown();
      shown && !shown->problem->basis().hasTwoFrequencies() && extentOf(padded(target->places)) > 0) {
    harmonic::PathGoal goal;
    goal.paths = {{target->node, harmonic::pathCoefficients(target->places, shown->problem->basis().harmonics())}};
    goal.matchPlace = target->matchPlace;
    const auto distance = harmonic::pathDistance(*shown->problem, shown->motion.z, goal);
    text += tr(", the motion is off by %1 (%2 % of its size)")
                .arg(plots::formatLength(distance.rootMeanSquare))
                .arg(100 * distance.relative, 0, 'g', 3);
  }
  bar_.setState(text);
}

void TargetLink::setDrawing(bool on) {
  if (on == isDrawing()) return;
  if (on)
    beginDrawing();
  else
    endDrawing();
  showTargets();
}

void TargetLink::beginDrawing() {
  const std::string probe = bar_.probe();
  const int node = nodeOf(probe);
  if (node < 0) return bar_.setDrawing(false);
  if (!targetOf(probe)) {
    // From how it moves now, else from a circle around it.
    Points path = presentPath(node);
    if (path.cols() > 1 && extentOf(path) > 0) {
      path = thinned(path, firstPoints);
    } else {
      const Points rest = padded(
          document_.model()->restPositions.reshaped(document_.model()->dimension, document_.model()->nodeCount()));
      const Eigen::Vector3d normal = planeNormal(node), across = normal.unitOrthogonal();
      const Eigen::Vector3d middle = path.col(0);
      path.resize(3, firstPoints);
      for (int i = 0; i < firstPoints; ++i)
        path.col(i) = middle + 0.05 * extentOf(rest) *
                                   (Eigen::AngleAxisd(2 * std::numbers::pi * i / firstPoints, normal) * across);
    }
    if (!put("spline", path, tr("New target of %1").arg(QString::fromStdString(probe))) || !targetOf(probe))
      return bar_.setDrawing(false);
  }
  drawing_ = probe;
  const scene::TargetPath& target = *targetOf(probe);
  drawnOffset_ = offsetOf(target, padded(target.places));
  loadTool(target);
  viewport_.setTool(&tool_);
  bar_.setDrawing(true);
}

void TargetLink::endDrawing() {
  drawing_.reset();
  if (viewport_.tool() == &tool_) viewport_.setTool(nullptr);
  bar_.setDrawing(false);
}

void TargetLink::loadTool(const scene::TargetPath& target) {
  Points points = padded(target.controlPoints);
  if (points.cols() == 0) {
    const int count = std::clamp<int>(2 * target.harmonics + 2, firstPoints, mostFirstPoints);
    points = interpolated(padded(target.places), target.harmonics, count);
  }
  points.colwise() += drawnOffset_;
  tool_.set(std::move(points), planeNormal(target.node));
}

void TargetLink::commit(TargetTool::Edit edit) {
  const QString probe = QString::fromStdString(*drawing_);
  const QString text = edit == TargetTool::Edit::added     ? tr("Add a point to the target of %1")
                       : edit == TargetTool::Edit::removed ? tr("Remove a point from the target of %1")
                                                           : tr("Move a point of the target of %1");
  drawnOffset_.setZero();  // from now on the scene has it where it is seen
  bar_.setProbe(*drawing_);
  put("spline", tool_.points(), text.arg(probe));
}

bool TargetLink::put(const char* form, const Points& places, const QString& text) {
  const int dimension = document_.model()->dimension;
  Json list = Json::array();
  for (const auto& place : places.colwise()) {
    Json point = Json::array();
    for (int axis = 0; axis < dimension; ++axis)
      point.push_back(panels::rounded(place[axis], base::dimensions::length).text);
    list.push_back(point);
  }
  const std::string probe = bar_.probe();
  const scene::TargetPath* present = targetOf(probe);
  const TargetEntry entry =
      targetEntry(document_.scene(), present ? present->pointer : std::string(), Json{{"probe", probe}, {form, list}},
                  session_.shown() ? session_.shown()->motion.omega : 0);
  if (!entry.note.isEmpty()) document_.raise(base::Severity::information, entry.note);
  return document_.setValue(entry.pointer, entry.value, text);
}

void TargetLink::chooseTable() {
  const QString file = QFileDialog::getOpenFileName(nullptr, tr("Target path"), QString(), tr("Tables (*.csv)"));
  if (!file.isEmpty()) takeTable(file);
}

void TargetLink::takeTable(const QString& file) {
  if (!document_.model()) return;
  try {
    const mechanics::Matrix places = scene::placesOfTable(file.toStdString(), document_.model()->dimension);
    put("points", padded(places), tr("Target of %1 from a table").arg(QString::fromStdString(bar_.probe())));
  } catch (const base::InputError& error) {
    document_.raise(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

void TargetLink::takeMotion(const std::string& probe) {
  const int node = nodeOf(probe);
  if (node < 0 || !session_.shown()) return;
  put("points", thinned(presentPath(node), motionPlaces),
      tr("Target of %1 from the motion of %2")
          .arg(QString::fromStdString(bar_.probe()), QString::fromStdString(probe)));
}

}  // namespace pliant::shell
