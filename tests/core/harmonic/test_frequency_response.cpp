#include <QTest>

#include "core/base/error.hpp"
#include "core/harmonic/frequency_response.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using base::TerminationType;
using harmonic::FrequencyResponse;
using harmonic::HarmonicBalanceProblem;
using harmonic::PointKind;
using harmonic::ResponsePoint;

namespace {

/// A foil that is far stiffer in its plane than against bending, on a shaken foot, about its first resonance.
std::shared_ptr<const Model> foil() {
  StripOptions options;
  options.youngModulus = 3e9;
  options.thickness = 2e-4;
  const geometry::SurfaceMesh mesh = stripMesh(options);
  auto model = strip(options, mesh);
  model->massDamping = 2;
  model->stiffnessDamping = 5e-5;
  model->drives = {mechanics::makeTranslation(clampedNodes(mesh, 0.02), vector3(0, 0, 1), sine(1e-3))};
  model->probes = {{"tip", static_cast<int>(mesh.points.cols()) - 1}};
  model->finish();
  return model;
}

harmonic::FrequencyResponseOptions range(double from, double to) {
  harmonic::FrequencyResponseOptions options;
  options.from = from;
  options.to = to;
  return options;
}

FrequencyResponse trace(std::shared_ptr<const Model> model, int harmonics, int samples,
                        const harmonic::FrequencyResponseOptions& options) {
  HarmonicBalanceProblem problem(std::move(model), {harmonics, samples});
  base::ExecutionContext context;
  return harmonic::traceFrequencyResponse(problem, options, context);
}

}  // namespace

class TestFrequencyResponse : public QObject {
  Q_OBJECT

 private slots:
  void linearOscillatorHasTheClosedFormPeak();
  void peaksWithoutProbes();
  void stiffFoil();
  void cancellationKeepsTheHalf();
  void progressRises();
  void pointLimit();
  void badRanges();
  void failedStartIsReported();
};

void TestFrequencyResponse::linearOscillatorHasTheClosedFormPeak() {
  // |x| = P / √((1-ω²)² + (2ζω)²) is largest at ω² = 1 - 2ζ².
  const double zeta = 0.1;
  const FrequencyResponse response = trace(duffing(zeta, 0, 0.1), 1, 8, range(0.2, 2));
  QVERIFY(response.report.converged());
  int peaks = 0;
  for (const ResponsePoint& point : response.points) {
    QVERIFY(point.kind != PointKind::fold);
    const double w = point.omega;
    const double expected = 0.1 / std::hypot(1 - w * w, 2 * zeta * w);
    QVERIFY(std::abs(point.amplitudes[0].maximumDisplacement - expected) < 1e-8);
    QVERIFY(std::abs(point.amplitudes[0].pathLength - 4 * expected) < 1e-7);
    if (point.kind != PointKind::peak) continue;
    ++peaks;
    const double resonance = std::sqrt(1 - 2 * zeta * zeta);
    QVERIFY(std::abs(point.omega - resonance) < 1e-6 * resonance);
  }
  QCOMPARE(peaks, 1);
}

void TestFrequencyResponse::peaksWithoutProbes() {
  auto model = std::make_shared<Model>(*duffing(0.1, 0, 0.1));
  model->probes.clear();
  const FrequencyResponse response = trace(model, 1, 8, range(2, 0.2));
  const auto peak = std::find_if(response.points.begin(), response.points.end(),
                                 [](const ResponsePoint& point) { return point.kind == PointKind::peak; });
  QVERIFY(peak != response.points.end());
  QCOMPARE(peak->probe, -1);
  QVERIFY(std::abs(peak->omega - std::sqrt(0.98)) < 1e-6);
  QVERIFY(peak->amplitudes.empty());
}

void TestFrequencyResponse::stiffFoil() {
  const auto model = foil();
  const FrequencyResponse up = trace(model, 3, 24, range(25, 60));
  const FrequencyResponse down = trace(model, 3, 24, range(60, 25));
  std::vector<double> peaks[2];
  const FrequencyResponse* responses[] = {&up, &down};
  for (int i : {0, 1}) {
    QVERIFY2(responses[i]->report.converged(), responses[i]->report.message.c_str());
    QVERIFY(responses[i]->points.size() < 150);
    for (const ResponsePoint& point : responses[i]->points)
      if (point.kind == PointKind::peak) peaks[i].push_back(point.omega);
  }
  QCOMPARE(up.points.back().omega, 60.0);
  QCOMPARE(down.points.back().omega, 25.0);
  QVERIFY(!peaks[0].empty());
  QCOMPARE(peaks[0].size(), peaks[1].size());
  for (std::size_t i = 0; i < peaks[0].size(); ++i)
    QVERIFY(std::abs(peaks[0][i] - peaks[1][peaks[1].size() - 1 - i]) < 2e-6 * peaks[0][i]);
  // Every point is a motion that Newton's method, started there, leaves where it is.
  HarmonicBalanceProblem problem(model, {3, 24});
  base::ExecutionContext context;
  for (std::size_t i = 0; i < up.points.size(); i += 9) {
    const auto motion = harmonic::solvePeriodicMotion(problem, up.points[i].omega, {}, context, up.points[i].z);
    QVERIFY(motion.report.converged());
    QVERIFY((motion.z - up.points[i].z).norm() < 1e-6 * problem.oscillation(motion.z).norm());
  }
}

void TestFrequencyResponse::cancellationKeepsTheHalf() {
  HarmonicBalanceProblem problem(foil(), {3, 24});
  base::ExecutionContext context;
  int received = 0;
  const FrequencyResponse response =
      harmonic::traceFrequencyResponse(problem, range(25, 60), context, [&](const ResponsePoint&) {
        if (++received == 12) context.requestCancel();
      });
  QVERIFY(response.report.termination == base::TerminationType::cancelled);
  QCOMPARE(response.points.size(), 12u);
  QVERIFY(response.points.back().omega > 25);
  QVERIFY(!response.report.message.empty());
}

void TestFrequencyResponse::progressRises() {
  std::vector<double> fractions;
  base::ExecutionContext context([&](double fraction, const std::string& message) {
    fractions.push_back(fraction);
    if (!message.empty() && message.find("rad/s") == std::string::npos)
      QTest::qFail("a message names the frequency", __FILE__, __LINE__);
  });
  HarmonicBalanceProblem problem(duffing(0.02, 0.5, 0.1), {5, 32});
  QVERIFY(harmonic::traceFrequencyResponse(problem, range(0.5, 2), context).report.converged());
  QVERIFY(fractions.size() > 10);
  QVERIFY(std::is_sorted(fractions.begin(), fractions.end()));
  QCOMPARE(fractions.back(), 1.0);
}

void TestFrequencyResponse::pointLimit() {
  harmonic::FrequencyResponseOptions options = range(0.5, 2);
  options.maximumPoints = 7;
  const FrequencyResponse response = trace(duffing(0.02, 0.5, 0.1), 5, 32, options);
  QVERIFY(response.report.termination == base::TerminationType::iterationLimit);
  QVERIFY(response.points.size() >= 7 && response.points.size() <= 10);
}

void TestFrequencyResponse::badRanges() {
  const double nan = std::nan("");
  for (const auto& [from, to] : std::vector<std::pair<double, double>>{{1, 1}, {0, 2}, {-1, 2}, {1, nan}, {nan, 1}})
    QVERIFY_EXCEPTION_THROWN(trace(duffing(0.1, 0, 0.1), 1, 8, range(from, to)), base::InputError);
}

void TestFrequencyResponse::failedStartIsReported() {
  auto model = std::make_shared<Model>(*duffing(0.1, 0, 0.1));
  model->energies.clear();
  model->finish();
  const FrequencyResponse response = trace(model, 1, 8, range(0.5, 2));
  QVERIFY(response.report.termination == base::TerminationType::failed);
  QVERIFY(response.points.empty());
  QVERIFY(response.report.message.find("Nothing holds node 0 along x") != std::string::npos);
}

QTEST_GUILESS_MAIN(TestFrequencyResponse)
#include "test_frequency_response.moc"
