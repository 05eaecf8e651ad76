#include "ui/jobs/curve_predictor.hpp"

#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "core/scene/model_builder.hpp"

using namespace pliant;
using jobs::CurvePredictor;
using jobs::PredictedCurve;
using scene::Scene;

namespace {

constexpr double alpha = 0.1, force = 0.1, mass = 0.9, stiffness = 2;
const std::string massPointer = "/point_masses/0/mass", stiffnessPointer = "/springs/0/coefficients/0";
constexpr int patience = 60'000;  // milliseconds

/// m x'' + α m x' + k x = F cos ωt.
const char* const text = R"({
  "schema_version": 1, "dimension": 1,
  "geometry": [{"name": "body", "type": "points", "points": [[0]]}],
  "point_masses": [{"name": "mass", "at": {"nodes": [0]}, "mass": 0.9, "minimum": 0.2, "maximum": 3}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"nodes": [0]}, "direction": [1], "coefficients": [2]}],
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1],
             "harmonics": [{"amplitude": 0.1}]}],
  "damping": {"mass_proportional": 0.1},
  "parameters": [{"name": "stiffness", "pointer": "/springs/0/coefficients/0", "minimum": 0.5, "maximum": 4}],
  "probes": [{"name": "body", "at": {"nodes": [0]}}],
  "studies": [{"name": "response", "type": "frequency_response", "from": 0.8, "to": 2.2, "harmonics": 1},
              {"name": "linear", "type": "linear_response", "from": 0.8, "to": 2.2}]
})";

double pathLengthOf(double omega, double m, double k) {
  return 4 * force / std::hypot(k - m * omega * omega, alpha * m * omega);
}
double peakFrequency(double m, double k) { return std::sqrt(k / m - alpha * alpha / 2); }

}  // namespace

/// The response curve of a linear oscillator, which is known in closed form.
class TestCurvePredictor : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    document_ = std::make_unique<document::Document>();
    quick_ = std::make_unique<jobs::JobRunner>();
    studies_ = std::make_unique<jobs::StudyRunner>(*document_, *quick_);
    session_ = std::make_unique<jobs::MotionSession>(*document_, *quick_, *studies_);
    const Scene scene = Scene::parse(text, "/nowhere", "oscillator");
    document_->adopt({scene, scene::buildModel(scene)}, QStringLiteral("oscillator"));
    predictor_ = std::make_unique<CurvePredictor>(*document_, *session_);
  }
  void cleanup() {
    predictor_.reset();
    session_.reset();
    studies_.reset();
    quick_.reset();
    document_.reset();
  }

  /// Points stay on the curve, and its peak at the top, with an error that falls with the square of the change.
  void errsBySecondOrder() {
    predict("response");
    double curveBefore = 0, peakBefore = 0;
    for (const double share : {1.0, 0.5, 0.25}) {
      const double m = mass * (1 + 0.04 * share), k = stiffness * (1 - 0.03 * share);
      session_->previewAll({{massPointer, m}, {stiffnessPointer, k}});
      const auto predicted = predictor_->predict(0);
      QVERIFY(predicted && predicted->points.size() > 20);
      QCOMPARE(predicted->branches.size(), predicted->points.size());
      const double tallest = pathLengthOf(peakFrequency(m, k), m, k);
      double worst = 0;
      for (const PredictedCurve::Place& place : predicted->points)
        worst = std::max(worst, distance(place, m, k, tallest));
      QCOMPARE(predicted->peaks.size(), std::size_t(1));
      const double peak =
          std::hypot(predicted->peaks[0].omega - peakFrequency(m, k), predicted->peaks[0].pathLength / tallest - 1);
      qInfo("curve off by %.2e, peak by %.2e", worst, peak);
      if (curveBefore > 0) {
        QVERIFY(std::abs(std::log2(curveBefore / worst) - 2) < 0.3);
        QVERIFY(std::abs(std::log2(peakBefore / peak) - 2) < 0.3);
      }
      curveBefore = worst;
      peakBefore = peak;
    }
  }

  void foretellsOnlyWhereParametersDiffer() {
    predict("response");
    QVERIFY(!predictor_->predict(0));
    session_->preview(massPointer, 1.1 * mass);
    QVERIFY(predictor_->predict(0));
    QVERIFY(!predictor_->predict(-1));
    session_->endPreview();
    QVERIFY(!predictor_->predict(0));
    QVERIFY(document_->setValue(massPointer, 1.1 * mass, "mass"));
    QVERIFY(predictor_->predict(0));  // the scene's own values count as well
    QVERIFY(document_->setValue("/damping/mass_proportional", 0.2, "damping"));
    QVERIFY(!predictor_->predict(0));  // no parameter
    document_->undoStack().undo();
    QVERIFY(predictor_->predict(0));
    predictor_->setCurve(nullptr, std::nullopt);
    QVERIFY(!predictor_->predict(0));
  }

  /// Another curve begins before the first one's sensitivities are found; only its own count.
  void theNewestCurveWins() {
    const auto first = run("response"), second = run("response");
    predictor_->setCurve(first, document_->scene());
    predictor_->setCurve(second, document_->scene());
    QTRY_VERIFY_WITH_TIMEOUT(predictor_->isComplete(), patience);
    QCOMPARE(predictor_->model(), second->problem->sharedModel());
  }

  void foretellsNoLinearResponse() {
    predictor_->setCurve(run("linear"), document_->scene());
    QVERIFY(!predictor_->model());
    session_->preview(massPointer, 1.1 * mass);
    QVERIFY(!predictor_->predict(0));
  }

 private:
  std::shared_ptr<const scene::HarmonicResult> run(const char* study) {
    base::ExecutionContext context;
    return std::dynamic_pointer_cast<const scene::HarmonicResult>(
        scene::StudyRegistry::instance().make(document_->scene(), document_->model(), study)->run(context, {}));
  }
  void predict(const char* study) {
    predictor_->setCurve(run(study), document_->scene());
    QTRY_VERIFY_WITH_TIMEOUT(predictor_->isComplete(), patience);
  }
  /// From the curve of closed form, heights counted in the tallest one.
  static double distance(const PredictedCurve::Place& place, double m, double k, double tallest) {
    double nearest = 1e300;
    for (double offset = -0.05; offset <= 0.05; offset += 1e-5)
      nearest = std::min(
          nearest, std::hypot(offset, (pathLengthOf(place.omega + offset, m, k) - place.pathLength) / tallest));
    return nearest;
  }

  std::unique_ptr<document::Document> document_;
  std::unique_ptr<jobs::JobRunner> quick_;
  std::unique_ptr<jobs::StudyRunner> studies_;
  std::unique_ptr<jobs::MotionSession> session_;
  std::unique_ptr<CurvePredictor> predictor_;
};

QTEST_GUILESS_MAIN(TestCurvePredictor)
#include "test_curve_predictor.moc"
