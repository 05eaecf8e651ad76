#include <QTest>

#include "core/harmonic/curve_sensitivity.hpp"
#include "core/harmonic/frequency_response.hpp"
#include "core/mechanics/family_parameter.hpp"
#include "core/mechanics/joint_parameter.hpp"
#include "core/mechanics/registry.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::FrequencyResponse;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeakSensitivity;
using harmonic::PointKind;
using harmonic::ResponsePoint;

namespace {

struct Example {
  std::string name;
  std::shared_ptr<const Model> model;
  math::HarmonicBasis basis;
  double from, to;
  double step;  ///< of a parameter, relative to its value
};

/// A hardening oscillator whose damping, cubic stiffness and force may change, besides its mass.
std::shared_ptr<const Model> variableDuffing() {
  const auto make = [](const std::vector<double>& values) { return Model(*duffing(values[0], values[1], values[2])); };
  const auto family = std::make_shared<const mechanics::ModelFamily>(make);
  auto model = std::make_shared<Model>(make({0.02, 0.5, 0.1}));
  model->familyValues = {0.02, 0.5, 0.1};
  const std::vector<mechanics::FamilyParameter> entries = {{"damping", "/damping", base::dimensions::none, 0.001, 1},
                                                           {"cubic", "/cubic", base::dimensions::none, 0, 10},
                                                           {"force", "/force", base::dimensions::none, 0.01, 1}};
  for (int i = 0; i < 3; ++i)
    model->parameters.push_back(mechanics::makeFamilyParameter(i, entries[static_cast<std::size_t>(i)], family));
  return model;
}

/// A foil on a turning foot with masses, near its first resonance.
std::shared_ptr<const Model> weightedFoil() {
  StripOptions options;
  options.youngModulus = 3e9;
  options.thickness = 2e-4;
  const geometry::SurfaceMesh mesh = stripMesh(options);
  auto model = strip(options, mesh);
  const int last = static_cast<int>(mesh.points.cols()) - 1;
  addPointMass(*model, "tip", {last}, 1e-4);
  addPointMass(*model, "middle", {last / 2, last / 2 + 1}, 1e-4);
  model->massDamping = 2;
  model->stiffnessDamping = 5e-5;
  model->drives = {mechanics::makeTranslation(clampedNodes(mesh, 0.02), vector3(0, 0, 1), sine(1e-3))};
  model->probes = {{"tip", last}};
  model->finish();
  return model;
}

std::shared_ptr<const Model> withoutProbes(const std::shared_ptr<const Model>& model) {
  auto changed = std::make_shared<Model>(*model);
  changed->probes.clear();
  return changed;
}

std::vector<Example> examples() {
  std::vector<Example> list = {{"duffing, past a fold", variableDuffing(), {7, 32}, 1, 2, 5e-3},
                               {"duffing without probes", withoutProbes(duffing(0.02, 0.5, 0.1)), {7, 32}, 1, 2, 5e-3},
                               {"foil", weightedFoil(), {3, 16}, 15, 60, 1e-2}};
  for (const mechanics::ParameterKind& kind : mechanics::parameterKinds()) {
    std::mt19937 random(3);
    list.push_back({kind.name, std::make_shared<const Model>(kind.drivenExample(random)), {5, 32}, 1, 6, 4e-3});
  }
  return list;
}

FrequencyResponse trace(const Example& example, std::shared_ptr<const Model> model, double maximumStep = 0) {
  HarmonicBalanceProblem problem(std::move(model), example.basis);
  base::ExecutionContext context;
  harmonic::FrequencyResponseOptions options;
  options.from = example.from;
  options.to = example.to;
  options.stability = false;
  options.locationTolerance = 1e-9;
  options.newton.tolerance = 1e-12;
  options.newton.stepTolerance = 1e-12;
  options.maximumStep = maximumStep;
  options.maximumPoints = 20'000;
  FrequencyResponse response = harmonic::traceFrequencyResponse(problem, options, context);
  if (!response.report.converged()) QTest::qFail(response.report.message.c_str(), __FILE__, __LINE__);
  return response;
}

std::shared_ptr<const Model> changed(const Model& model, std::size_t parameter, double change) {
  const auto& p = *model.parameters[parameter];
  return std::make_shared<const Model>(p.withValue(model, p.value(model) + change));
}

/// The peaks of one probe, by place on the curve.
std::vector<ResponsePoint> peaksOf(const FrequencyResponse& response, int probe) {
  std::vector<ResponsePoint> peaks;
  for (const ResponsePoint& point : response.points)
    if (point.kind == PointKind::peak && point.probe == probe) peaks.push_back(point);
  return peaks;
}

double amplitudeOf(const HarmonicBalanceProblem& problem, const ResponsePoint& peak) {
  return peak.probe < 0 ? problem.oscillation(peak.z).norm()
                        : peak.amplitudes[static_cast<std::size_t>(peak.probe)].pathLength;
}

std::vector<int> allOf(const Model& model) {
  std::vector<int> all;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) all.push_back(static_cast<int>(i));
  return all;
}

}  // namespace

class TestCurveSensitivity : public QObject {
  Q_OBJECT

 private slots:
  void peaksMoveAsOnWholeCurves_data();
  void peaksMoveAsOnWholeCurves();
  void linearOscillatorHasClosedForms();
  void theHardeningPeakIsPastWhereAFixedFrequencyWouldDo();
  void foretoldCurvesErrBySecondOrder();
  void otherPointsAreNoPeaks();
};

void TestCurveSensitivity::peaksMoveAsOnWholeCurves_data() {
  QTest::addColumn<int>("index");
  const auto list = examples();
  for (std::size_t i = 0; i < list.size(); ++i) QTest::newRow(list[i].name.c_str()) << static_cast<int>(i);
}

/// Against differences of order 4 between the peaks of whole curves.
void TestCurveSensitivity::peaksMoveAsOnWholeCurves() {
  QFETCH(int, index);
  const Example example = examples()[static_cast<std::size_t>(index)];
  const Model& model = *example.model;
  const HarmonicBalanceProblem problem(example.model, example.basis);
  const int probe = model.probes.empty() ? -1 : 0;
  const std::vector<ResponsePoint> peaks = peaksOf(trace(example, example.model), probe);
  QVERIFY(!peaks.empty());
  std::vector<std::optional<PeakSensitivity>> found;
  for (const ResponsePoint& peak : peaks) {
    found.push_back(harmonic::peakSensitivity(problem, peak, allOf(model)));
    QVERIFY(found.back().has_value());
    QVERIFY(std::abs(found.back()->omega - peak.omega) < 1e-7 * peak.omega);
    QVERIFY(found.back()->residual <= 2 * std::max(peak.residual, 1e-12));
  }
  for (std::size_t p = 0; p < model.parameters.size(); ++p) {
    const double value = model.parameters[p]->value(model), step = example.step * value;
    std::vector<std::vector<ResponsePoint>> moved;
    for (const double multiple : {-2, -1, 1, 2}) {
      moved.push_back(peaksOf(trace(example, changed(model, p, multiple * step)), probe));
      QCOMPARE(moved.back().size(), peaks.size());
    }
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      const auto difference = [&](const std::function<double(const ResponsePoint&)>& of) {
        return (8 * (of(moved[2][i]) - of(moved[1][i])) - (of(moved[3][i]) - of(moved[0][i]))) / (12 * step);
      };
      const double omega = difference([](const ResponsePoint& peak) { return peak.omega; });
      const double amplitude = difference([&](const ResponsePoint& peak) { return amplitudeOf(problem, peak); });
      const auto at = static_cast<Eigen::Index>(p);
      // Changes relative to the peak's own frequency and amplitude, for a change of the parameter by itself.
      const double omegaError = std::abs(found[i]->omegaDerivative[at] - omega) * value / found[i]->omega;
      const double amplitudeError =
          std::abs(found[i]->amplitudeDerivative[at] - amplitude) * value / found[i]->amplitude;
      qInfo("peak %zu at %.4g by %s: dω/dp %.6g, off by %.1e; dA/dp %.6g, off by %.1e", i, found[i]->omega,
            model.parameters[p]->name().c_str(), omega, omegaError, amplitude, amplitudeError);
      QVERIFY(omegaError < 1e-6 && amplitudeError < 1e-6);
    }
  }
}

/// |x| = P / √((k - mω²)² + (cω)²) with k = m = 1 is largest at ω² = 1 - c²/2.
void TestCurveSensitivity::linearOscillatorHasClosedForms() {
  constexpr double zeta = 0.1, force = 0.1;
  const Example example{"linear", duffing(zeta, 0, force), {1, 8}, 0.5, 2, 0};
  const HarmonicBalanceProblem problem(example.model, example.basis);
  const auto peaks = peaksOf(trace(example, example.model), 0);
  QCOMPARE(peaks.size(), std::size_t(1));
  const auto found = harmonic::peakSensitivity(problem, peaks[0], {0});
  QVERIFY(found.has_value());
  // Damping is 2 ζ m: ω*² = 1/m - 2 ζ², A* = 4 P / (2 ζ m √(1/m - ζ²)).
  const double omega = std::sqrt(1 - 2 * zeta * zeta);
  QVERIFY(std::abs(found->omega - omega) < 1e-10);
  QVERIFY(std::abs(found->omegaDerivative[0] + 0.5 / omega) < 1e-8);
  const double amplitude = 4 * force / (2 * zeta * std::sqrt(1 - zeta * zeta));
  QVERIFY(std::abs(found->amplitude - amplitude) < 1e-9);
  QVERIFY(std::abs(found->amplitudeDerivative[0] - amplitude * (-1 + 0.5 / (1 - zeta * zeta))) < 1e-8);
}

/// What the motion's own sensitivity says of the amplitude at a peak's frequency is no answer near a fold.
void TestCurveSensitivity::theHardeningPeakIsPastWhereAFixedFrequencyWouldDo() {
  const Example example = examples()[0];
  const FrequencyResponse response = trace(example, example.model);
  const auto peak = peaksOf(response, 0).at(0);
  const auto fold = std::find_if(response.points.begin(), response.points.end(),
                                 [](const ResponsePoint& point) { return point.kind == PointKind::fold; });
  QVERIFY(fold != response.points.end());
  QVERIFY(std::abs(fold->omega - peak.omega) < 1e-3 * peak.omega);
  // Of the force: A* grows about as it does; at the fixed frequency next to the fold it changes many times as fast.
  const auto found = harmonic::peakSensitivity(HarmonicBalanceProblem(example.model, example.basis), peak, {3});
  QVERIFY(found.has_value());
  const double relative = found->amplitudeDerivative[0] * 0.1 / found->amplitude;
  QVERIFY(relative > 0.5 && relative < 1.1);
  QVERIFY(found->omegaDerivative[0] > 0);
}

/// Distance of foretold points from the polygon of another curve, relative to frequencies and the largest amplitude.
void TestCurveSensitivity::foretoldCurvesErrBySecondOrder() {
  const Example example = examples()[0];
  const Model& model = *example.model;
  const HarmonicBalanceProblem problem(example.model, example.basis);
  const FrequencyResponse response = trace(example, example.model);
  const std::vector<int> parameters = allOf(model);
  std::vector<harmonic::PointSensitivity> sensitivities;
  for (const ResponsePoint& point : response.points) {
    sensitivities.push_back(harmonic::pointSensitivity(problem, point, parameters));
    QCOMPARE(sensitivities.back().omega.size(), Eigen::Index(4));  // at folds as well
  }
  const double tallest = peaksOf(response, 0).at(0).amplitudes[0].pathLength;
  const Vector direction = Eigen::Vector4d(0.03, 0.001, 0.05, 0.006);  // mass, damping, cubic, force
  double before = 0;
  for (const double share : {1.0, 0.5, 0.25}) {
    Vector values(4);
    for (Eigen::Index i = 0; i < 4; ++i) values[i] = model.parameters[static_cast<std::size_t>(i)]->value(model);
    const FrequencyResponse exact = trace(example,
                                          std::make_shared<const Model>(mechanics::withParameterValues(
                                              model, model.parameters, values + share * direction)),
                                          1e-2);
    double worst = 0;
    for (std::size_t i = 0; i < response.points.size(); ++i) {
      const auto point = harmonic::predictPoint(response.points[i], sensitivities[i], share * direction);
      if (point.omega < example.from || point.omega > example.to) continue;
      const Eigen::Vector2d at(point.omega, point.pathLengths[0] / tallest);
      double nearest = 1e300;
      for (std::size_t j = 1; j < exact.points.size(); ++j) {
        const auto place = [&](std::size_t k) {
          return Eigen::Vector2d(exact.points[k].omega, exact.points[k].amplitudes[0].pathLength / tallest);
        };
        const Eigen::Vector2d edge = place(j) - place(j - 1), offset = at - place(j - 1);
        const double along = std::clamp(offset.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (offset - along * edge).norm());
      }
      worst = std::max(worst, nearest);
    }
    qInfo("foretold curve off by %.3e, slope %.3f", worst, std::log2(before / worst));
    if (before > 0) QVERIFY(std::abs(std::log2(before / worst) - 2) < 0.3);
    before = worst;
  }
  const auto unmoved = harmonic::predictPoint(response.points[3], sensitivities[3], Vector::Zero(4));
  QCOMPARE(unmoved.omega, response.points[3].omega);
  QCOMPARE(unmoved.pathLengths.at(0), response.points[3].amplitudes[0].pathLength);
}

void TestCurveSensitivity::otherPointsAreNoPeaks() {
  const Example example = examples()[0];
  const HarmonicBalanceProblem problem(example.model, example.basis);
  ResponsePoint start = trace(example, example.model).points.front();
  start.probe = 0;
  QVERIFY(!harmonic::peakSensitivity(problem, start, {0}).has_value());
}

QTEST_GUILESS_MAIN(TestCurveSensitivity)
#include "test_curve_sensitivity.moc"
