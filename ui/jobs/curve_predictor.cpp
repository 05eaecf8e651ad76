#include "ui/jobs/curve_predictor.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/stopwatch.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/sensitivity_tables.hpp"
#include "ui/jobs/comparable_scenes.hpp"

namespace pliant::jobs {

namespace {

const QString curveTopic = QStringLiteral("predicted curve");
constexpr double secondsBetweenLooks = 0.4;

/// In which order points are looked at: every eighth one with the ends, then the peaks, then finer and finer, so that
/// the whole curve is seen soon.
std::vector<std::size_t> coarseToFine(const scene::ResponsePoints& points) {
  const std::size_t count = points.size();
  const auto rankOf = [&](std::size_t i) {
    if (i % 8 == 0 || i + 1 == count) return 0;
    if (points[i].kind != harmonic::PointKind::regular) return 1;
    return i % 4 == 0 ? 2 : i % 2 == 0 ? 3 : 4;
  };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rankOf(a) < rankOf(b); });
  return order;
}

/// The sensitivity of peak number `peak` if the study has found it already.
std::optional<harmonic::PeakSensitivity> knownPeak(const scene::HarmonicResult& curve, std::size_t peak) {
  if (!curve.peakSensitivities || peak >= curve.peakSensitivities->peaks.size()) return std::nullopt;
  return curve.peakSensitivities->peaks[peak];
}

}  // namespace

CurvePredictor::CurvePredictor(document::Document& document, MotionSession& session, QObject* parent)
    : QObject(parent), document_(document), session_(session) {
  connect(&document_, &document::Document::sceneEdited, this, [this] {
    compare();
    if (curve_) Q_EMIT changed();
  });
}

void CurvePredictor::setCurve(std::shared_ptr<const scene::HarmonicResult> curve,
                              const std::optional<scene::Scene>& solvedScene) {
  // A linear response and a free motion solve another equation than the one that is differentiated.
  if (curve && (!curve->isCurve || curve->isLinear || curve->isBackbone || !solvedScene ||
                curve->problem->model().parameters.empty() || curve->problem->model().probes.empty()))
    curve = nullptr;
  if (curve == curve_) return;
  runner_.abandonTopic(curveTopic);
  curve_ = std::move(curve);
  solvedScene_ = curve_ ? solvedScene : std::nullopt;
  sensitivity_.reset();
  complete_ = false;
  compare();
  if (curve_)
    compute();
  else
    Q_EMIT changed();
}

void CurvePredictor::compare() {
  comparable_ =
      curve_ && !document_.isEmpty() && areComparable(*solvedScene_, document_.scene(), curve_->problem->model());
}

void CurvePredictor::compute() {
  Job job;
  job.topic = curveTopic;
  job.work = [this, curve = curve_](base::ExecutionContext& context, const Publish& publish) -> Delivery {
    const scene::ResponsePoints& points = curve->points;
    std::vector<int> parameters(curve->problem->model().parameters.size());
    std::iota(parameters.begin(), parameters.end(), 0);
    std::vector<std::size_t> peakNumbers(points.size());
    std::size_t peakCount = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].kind == harmonic::PointKind::peak) peakNumbers[i] = peakCount++;
    CurveSensitivity found;
    found.points.resize(points.size());
    found.peaks.resize(points.size());
    const auto delivery = [&](bool complete) -> Delivery {
      return [this, curve, complete, sensitivity = std::make_shared<const CurveSensitivity>(found)] {
        if (curve_ != curve) return;
        sensitivity_ = sensitivity;
        complete_ = complete;
        Q_EMIT changed();
      };
    };
    base::Stopwatch watch;
    for (const std::size_t i : coarseToFine(points)) {
      if (context.cancelRequested()) return {};
      const harmonic::ResponsePoint& point = points[i];
      const harmonic::HarmonicBalanceProblem own(*curve->problemOf(point));
      found.points[i] = harmonic::pointSensitivity(own, point, parameters);
      if (point.kind == harmonic::PointKind::peak) {
        found.peaks[i] = knownPeak(*curve, peakNumbers[i]);
        if (!found.peaks[i]) found.peaks[i] = harmonic::peakSensitivity(own, point, parameters);
      }
      if (watch.seconds() < secondsBetweenLooks) continue;
      publish(delivery(false));
      watch = base::Stopwatch();
    }
    return delivery(true);
  };
  runner_.submit(std::move(job));
}

std::optional<PredictedCurve> CurvePredictor::predict(int probe) const {
  if (!curve_ || !comparable_ || !sensitivity_ || probe < 0) return std::nullopt;
  const auto change = session_.changeFrom(curve_->problem->model());
  if (!change) return std::nullopt;
  PredictedCurve predicted;
  for (std::size_t i = 0; i < curve_->points.size(); ++i) {
    const auto& sensitivity = sensitivity_->points[i];
    if (!sensitivity || sensitivity->omega.size() == 0) continue;  // not found yet, or two curves cross there
    const harmonic::ResponsePoint& point = curve_->points[i];
    const harmonic::PredictedPoint place = harmonic::predictPoint(point, *sensitivity, *change);
    // A way is never shorter than nothing: so far from where it was solved the curve is not known any more.
    predicted.points.push_back({place.omega, std::max(0.0, place.pathLengths.at(static_cast<std::size_t>(probe)))});
    predicted.branches.push_back(point.branch);
    if (const auto& peak = sensitivity_->peaks[i]; peak && point.probe == probe)
      predicted.peaks.push_back({peak->omega + peak->omegaDerivative.dot(*change),
                                 std::max(0.0, peak->amplitude + peak->amplitudeDerivative.dot(*change))});
  }
  if (predicted.points.empty()) return std::nullopt;
  return predicted;
}

}  // namespace pliant::jobs
