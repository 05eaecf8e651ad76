#include "ui/jobs/motion_session.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/harmonic/amplitude.hpp"
#include "core/mechanics/drive_frequency.hpp"
#include "core/mechanics/joint_parameter.hpp"
#include "ui/jobs/comparable_scenes.hpp"
#include "ui/jobs/node_correspondence.hpp"

namespace pliant::jobs {

using document::StudyStatus;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;
using harmonic::ResponseSensitivity;
using harmonic::Vector;

namespace {

const QString motionTopic = QStringLiteral("motion");
const QString sensitivityTopic = QStringLiteral("sensitivity");

std::shared_ptr<const scene::HarmonicResult> harmonicResult(const document::StudyState* study) {
  return study ? std::dynamic_pointer_cast<const scene::HarmonicResult>(study->result) : nullptr;
}

/// Whether the nodes of a motion are those of the document's model: at the same places, or at others that parameters
/// alone have moved.
bool fits(const ShownMotion& shown, const document::Document& document) {
  const mechanics::Model &solved = shown.problem->model(), &present = *document.model();
  if (sameNodes(solved, present)) return true;
  if (solved.dimension != present.dimension || solved.restPositions.size() != present.restPositions.size())
    return false;
  return areComparable(shown.scene, document.scene(), solved);
}

/// Whether a parameter at this pointer is one of the shown motion's own.
bool hasParameterAt(const ShownMotion& shown, const std::string& pointer) {
  const auto& parameters = shown.problem->model().parameters;
  return std::any_of(
      parameters.begin(), parameters.end(), [&](const auto& parameter) { return parameter->pointer() == pointer; });
}

/// The frequency that the document asks for, if the shown motion has it among its parameters.
std::optional<double> wantedFrequency(const ShownMotion& shown, const document::Document& document) {
  for (const auto& parameter : shown.problem->model().parameters)
    if (mechanics::isDriveFrequency(*parameter))
      if (const auto json = document.valueAt(parameter->pointer()); json.is_number()) return json.get<double>();
  return std::nullopt;
}

}  // namespace

double amplitudeOf(const HarmonicBalanceProblem& problem, const Vector& z, int node, AmplitudeMeasure measure) {
  const harmonic::Amplitude amplitude = harmonic::amplitude(problem, z, node);
  return measure == AmplitudeMeasure::pathLength ? amplitude.pathLength : amplitude.maximumDisplacement;
}

MotionSession::MotionSession(document::Document& document, JobRunner& quick, StudyRunner& studies, QObject* parent)
    : QObject(parent), document_(document), quick_(quick), studies_(studies) {
  connect(&document_, &document::Document::sceneReplaced, this, &MotionSession::reset);
  connect(&document_, &document::Document::sceneEdited, this, [this] {
    // In this order nobody ever asks a motion for a node that it does not have.
    putAsideIfUnfit();
    refreshNode();
    takeBackIfFit();
    refreshStaleness();
  });
  connect(&document_, &document::Document::studyChanged, this, &MotionSession::follow);
  connect(&studies_, &StudyRunner::runningChanged, this, [this] { Q_EMIT busyChanged(isBusy()); });
  connect(&quick_, &JobRunner::finished, this,
          [this](JobRunner::Id, const QString& topic, JobOutcome outcome, const QString& sentence) {
            if (topic != motionTopic && topic != sensitivityTopic) return;
            if (outcome == JobOutcome::failed) document_.raise(base::Severity::warning, sentence);
            Q_EMIT busyChanged(isBusy());
          });
}

void MotionSession::reset() {
  // What they would deliver is about the scene that was open before.
  quick_.abandonTopic(motionTopic);
  quick_.abandonTopic(sensitivityTopic);
  shown_.reset();
  aside_.reset();
  stale_ = false;
  comparable_ = false;
  preview_.clear();
  prediction_.reset();
  effects_.clear();
  followed_.reset();
  follow_ = false;
  nodesOf_ = document_.model();
  node_ = nodesOf_->probes.empty() ? 0 : nodesOf_->probes.front().node;
  Q_EMIT nodeChanged(node_);
  Q_EMIT shownChanged();
  Q_EMIT predictionChanged();
  Q_EMIT effectsChanged();
}

bool MotionSession::isBusy() const { return studies_.isRunning() || quick_.isActive(motionTopic); }

void MotionSession::run(const std::vector<std::string>& names) {
  follow_ = true;
  followed_.reset();
  studies_.run(names);
}

void MotionSession::runAll() {
  follow_ = true;
  followed_.reset();
  studies_.runAll();
}

void MotionSession::cancel() {
  studies_.cancel();
  quick_.cancelTopic(motionTopic);
}

void MotionSession::follow(const std::string& name) {
  if (!follow_) return;
  const document::StudyState* study = document_.study(name);
  const auto result = harmonicResult(study);
  if (!result || result == followed_ || result->points.empty()) return;
  if (!result->isCurve) {
    followed_ = result;
    showPoint(name, 0);
    follow_ = true;
    return;
  }
  // A curve alone: its first motion at once, its highest peak when it is done.
  const bool shownOfCurve = shown_ && shown_->study == name;
  const bool ended = study->status != StudyStatus::running && study->status != StudyStatus::waiting;
  if (!followed_) {
    followed_ = result;
    showPoint(name, 0);
    follow_ = true;
  } else if (ended && shownOfCurve && shown_->point == 0) {
    followed_ = result;
    int best = -1;
    for (int i = 0; i < static_cast<int>(result->points.size()); ++i) {
      const auto& point = result->points[i];
      if (point.kind != harmonic::PointKind::peak) continue;
      if (best < 0 ||
          amplitudeOf(*result->problemOf(point), point.z, node_, measure_) >
              amplitudeOf(*result->problemOf(result->points[best]), result->points[best].z, node_, measure_))
        best = i;
    }
    if (best >= 0) showPoint(name, best);
  }
}

void MotionSession::showPoint(const std::string& name, int point) {
  const document::StudyState* study = document_.study(name);
  const auto result = harmonicResult(study);
  if (!result || point < 0 || point >= static_cast<int>(result->points.size())) return;
  follow_ = false;
  const harmonic::ResponsePoint& found = result->points[point];
  PeriodicMotion motion;
  motion.omega = found.omega;
  motion.z = found.z;
  motion.report.termination = base::TerminationType::converged;
  motion.report.iterations.push_back({found.newtonIterations, found.residual, 0, found.correction});
  show({result->problemOf(found), std::move(motion), *study->solvedScene,
        result->isCurve ? nullptr : result->sensitivity, name, point, !result->isLinear && !result->isBackbone});
}

void MotionSession::show(ShownMotion shown) {
  shown_ = std::move(shown);
  aside_.reset();
  if (!fits(*shown_, document_)) {
    putAsideIfUnfit();
    document_.raise(base::Severity::information,
                    tr("This motion belongs to another mesh than the scene has by now: run its study again."));
    return;
  }
  Q_EMIT shownChanged();
  refreshStaleness();
  if (shown_->sensitivity) {
    quick_.cancelTopic(sensitivityTopic);
    refreshEffects();
  } else {
    effects_.clear();
    Q_EMIT effectsChanged();
    computeSensitivity();
  }
}

void MotionSession::putAsideIfUnfit() {
  if (!shown_ || fits(*shown_, document_)) return;
  aside_ = std::move(shown_);
  shown_.reset();
  prediction_.reset();
  effects_.clear();
  Q_EMIT shownChanged();
  Q_EMIT effectsChanged();
}

void MotionSession::takeBackIfFit() {
  if (!shown_ && aside_ && fits(*aside_, document_)) show(*std::exchange(aside_, std::nullopt));
}

void MotionSession::refreshNode() {
  const auto model = document_.model();
  const auto before = std::exchange(nodesOf_, model);
  int node = correspondingNode(*before, node_, *model);
  if (node < 0) node = model->probes.empty() ? 0 : model->probes.front().node;
  if (node == node_) return;
  node_ = node;
  Q_EMIT nodeChanged(node_);
  refreshEffects();
}

void MotionSession::computeSensitivity() {
  if (shown_->problem->model().parameters.empty() || !shown_->solvesDrivenModel) return;
  Job job;
  job.topic = sensitivityTopic;
  job.work = [this, problem = shown_->problem, motion = shown_->motion](
                 base::ExecutionContext& context, const Publish&) -> Delivery {
    if (context.cancelRequested()) return {};
    const HarmonicBalanceProblem own(*problem);
    const auto sensitivity = std::make_shared<const ResponseSensitivity>(own, motion);
    return [this, problem, sensitivity] {
      if (!shown_ || shown_->problem != problem) return;
      shown_->sensitivity = sensitivity;
      refreshPrediction();
      refreshEffects();
    };
  };
  quick_.submit(std::move(job));
}

void MotionSession::solveAt(double omega, const std::string& name, int nearestPoint) {
  const document::StudyState* study = document_.study(name);
  const auto result = harmonicResult(study);
  if (!result || nearestPoint < 0 || nearestPoint >= static_cast<int>(result->points.size())) return;
  follow_ = false;
  Job job;
  job.topic = motionTopic;
  job.title = tr("Motion at %1 rad/s").arg(omega, 0, 'g', 4);
  job.work = [this, omega, result, scene = *study->solvedScene, near = result->points[nearestPoint]](
                 base::ExecutionContext& context, const Publish&) -> Delivery {
    const auto shared = result->problemOf(near);
    HarmonicBalanceProblem problem(*shared);
    PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, {}, context, near.z);
    if (!motion.report.converged()) {
      return [this, message = QString::fromStdString(motion.report.message)] {
        document_.raise(base::Severity::warning, message);
      };
    }
    return [this, shared, scene, motion] { show({shared, motion, scene, nullptr, {}, -1}); };
  };
  quick_.submit(std::move(job));
  Q_EMIT busyChanged(true);
}

void MotionSession::update() {
  if (document_.isEmpty()) return;
  if (!shown_) {
    runAll();
    return;
  }
  const auto model = mechanics::withoutDriveFrequencies(
      document_.model(), [this](const std::string& pointer) { return hasParameterAt(*shown_, pointer); });
  const double wanted = wantedFrequency(*shown_, document_).value_or(shown_->motion.omega);
  follow_ = false;
  endPreview();
  const double predicted = predictedAmplitude().value_or(std::numeric_limits<double>::quiet_NaN());
  Job job;
  job.topic = motionTopic;
  job.title = tr("Update of the motion at %1 rad/s").arg(wanted, 0, 'g', 4);
  job.work = [this, model, scene = document_.scene(), basis = shown_->problem->basis(),
              drivePeriods = shown_->problem->drivePeriods(), omega = wanted,
              start = prediction_.value_or(shown_->motion.z),
              predicted](base::ExecutionContext& context, const Publish&) -> Delivery {
    HarmonicBalanceProblem problem(model, basis, drivePeriods);
    const Vector from = start.size() == problem.size() ? start : Vector();
    PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, {}, context, from);
    if (!motion.report.converged()) {
      return [this, message = QString::fromStdString(motion.report.message)] {
        document_.raise(base::Severity::warning, message);
      };
    }
    const auto shared = std::make_shared<const HarmonicBalanceProblem>(std::move(problem));
    return [this, shared, motion, scene, predicted] {
      show({shared, motion, scene, nullptr, {}, -1});
      if (shown_) Q_EMIT updated(predicted, shownAmplitude());
    };
  };
  quick_.submit(std::move(job));
  Q_EMIT busyChanged(true);
  studies_.cancel();
  studies_.runOutdated();
}

void MotionSession::refreshStaleness() {
  const bool wasComparable = std::exchange(comparable_, true);
  stale_ = shown_ && !document::sameModel(shown_->scene, document_.scene());
  if (shown_ && wantedFrequency(*shown_, document_) != mechanics::driveFrequency(shown_->problem->model()))
    stale_ = true;
  if (stale_) comparable_ = areComparable(shown_->scene, document_.scene(), shown_->problem->model());
  refreshPrediction();
  if (comparable_ != wasComparable) refreshEffects();
}

std::optional<Vector> MotionSession::changeFrom(const mechanics::Model& solved) const {
  Vector change(static_cast<Eigen::Index>(solved.parameters.size()));
  for (Eigen::Index p = 0; p < change.size(); ++p) {
    const mechanics::DesignParameter& parameter = *solved.parameters[static_cast<std::size_t>(p)];
    const std::string pointer = parameter.pointer();
    const double before = parameter.value(solved);
    double value = before;
    if (const auto previewed = preview_.find(pointer); previewed != preview_.end()) {
      value = previewed->second;
    } else if (const auto json = document_.valueAt(pointer); json.is_number()) {
      value = json.get<double>();
    }
    change[p] = value - before;
  }
  if (change.isZero(0)) return std::nullopt;
  return change;
}

void MotionSession::refreshPrediction() {
  prediction_.reset();
  if (shown_ && comparable_ && shown_->sensitivity && shown_->sensitivity->regular())
    if (const auto change = changeFrom(shown_->problem->model())) prediction_ = shown_->sensitivity->predict(*change);
  Q_EMIT predictionChanged();
}

void MotionSession::refreshEffects() {
  effects_.clear();
  if (shown_ && comparable_ && shown_->sensitivity && shown_->sensitivity->regular()) {
    // The slope of the very amplitude that the prediction reports, along the predicted motion.
    const auto& parameters = shown_->problem->model().parameters;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      const auto column = shown_->sensitivity->derivative().col(static_cast<Eigen::Index>(p));
      const double size = column.norm();
      const double step = size > 0 ? 1e-5 * std::max(shown_->motion.z.norm(), 1e-12) / size : 0;
      double slope = 0;
      if (step > 0)
        slope = (amplitudeOf(*shown_->problem, shown_->motion.z + step * column, node_, measure_) -
                 amplitudeOf(*shown_->problem, shown_->motion.z - step * column, node_, measure_)) /
                (2 * step);
      effects_.push_back({parameters[p]->pointer(), slope});
    }
  }
  Q_EMIT effectsChanged();
}

std::shared_ptr<const mechanics::Model> MotionSession::previewedModel() const {
  const auto model = document_.model();
  std::vector<std::shared_ptr<const mechanics::DesignParameter>> moved;
  std::vector<double> values;
  for (const auto& parameter : model->parameters)
    if (const auto previewed = preview_.find(parameter->pointer()); previewed != preview_.end()) {
      moved.push_back(parameter);
      values.push_back(previewed->second);
    }
  if (moved.empty()) return model;
  return std::make_shared<mechanics::Model>(mechanics::withParameterValues(
      *model, moved, Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()))));
}

QString MotionSession::predictionObstacle() const {
  if (!shown_) return tr("Run a study to see what the parameters do.");
  if (!shown_->solvesDrivenModel)
    return tr("This is a motion of the linear or the free model; choose one of the driven model to predict from.");
  if (!comparable_) return tr("More than parameters has changed; update to predict again.");
  if (shown_->sensitivity && !shown_->sensitivity->regular())
    return tr("At a fold the motion has no derivative; choose another point of the curve.");
  return {};
}

double MotionSession::shownAmplitude() const {
  return shown_ ? amplitudeOf(*shown_->problem, shown_->motion.z, node_, measure_) : 0.0;
}

std::optional<double> MotionSession::predictedAmplitude() const {
  if (!prediction_) return std::nullopt;
  return amplitudeOf(*shown_->problem, *prediction_, node_, measure_);
}

void MotionSession::previewAll(std::map<std::string, double> values) {
  preview_ = std::move(values);
  refreshPrediction();
}

void MotionSession::endPreview() {
  if (preview_.empty()) return;
  preview_.clear();
  refreshPrediction();
}

void MotionSession::selectNode(int node) {
  if (document_.isEmpty() || node < 0 || node >= document_.model()->nodeCount() || node == node_) return;
  node_ = node;
  Q_EMIT nodeChanged(node_);
  Q_EMIT predictionChanged();
  refreshEffects();
}

void MotionSession::setMeasure(AmplitudeMeasure measure) {
  if (measure_ == measure) return;
  measure_ = measure;
  Q_EMIT measureChanged();
  Q_EMIT predictionChanged();
  refreshEffects();
}

}  // namespace pliant::jobs
