#include <QTest>

#include "core/harmonic/design_space.hpp"
#include "core/math/low_discrepancy.hpp"
#include "core/math/parallel.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::DesignSpace;
using harmonic::HarmonicBalanceProblem;
using harmonic::MotionOrigin;

namespace {

constexpr double alpha = 0.1, force = 0.1, omega = 1.2;

/// m x'' + α m x' + x + γ x³ = F cos ωt with the mass between 0.2 and 3.
HarmonicBalanceProblem oscillator(double mass, double cubic) {
  auto model = std::make_shared<Model>(*duffing(alpha / 2, cubic, force));
  model->pointMasses[0] = {"mass", {0}, mass, 0.2, 3};
  return {model, {3, 32}};
}

DesignSpace sample(double cubic, int count, unsigned seed = 1, base::ExecutionContext* given = nullptr) {
  harmonic::DesignSpaceOptions options;
  options.omega = omega;
  options.parameters = {0};
  options.count = count;
  options.seed = seed;
  options.motion.tolerance = 1e-11;
  base::ExecutionContext context;
  return harmonic::sampleDesignSpace(oscillator(2, cubic), options, given ? *given : context);
}

}  // namespace

class TestDesignSpace : public QObject {
  Q_OBJECT

 private slots:
  /// The first n points leave no gap much larger than 1/n (one dimension), and halves of the cube get half of them.
  void pointsAreEven() {
    const math::EvenPoints line(1, 5);
    for (const int count : {10, 100, 1000}) {
      std::vector<double> places{0, 1};
      for (int i = 0; i < count; ++i) places.push_back(line[i][0]);
      std::sort(places.begin(), places.end());
      double gap = 0;
      for (std::size_t i = 1; i < places.size(); ++i) gap = std::max(gap, places[i] - places[i - 1]);
      QVERIFY(gap < 2.0 / count);  // golden ratio: at most φ / n (three-gap theorem)
    }
    const math::EvenPoints cube(4, 2);
    Eigen::Vector4d below = Eigen::Vector4d::Zero();
    for (int i = 0; i < 400; ++i) {
      const Vector point = cube[i];
      QVERIFY(point.minCoeff() >= 0 && point.maxCoeff() < 1);
      below += (point.array() < 0.5).cast<double>().matrix();
    }
    QVERIFY((below.array() - 200).abs().maxCoeff() < 10);  // random points would be off by 10 as a rule
  }

  void motionsAreThoseOfTheDesigns() {
    const DesignSpace space = sample(0, 40);
    QVERIFY2(space.report.converged(), space.report.message.c_str());
    QCOMPARE(space.designs.size(), std::size_t(41));
    QCOMPARE(space.designs[0].values[0], 2.0);
    for (const auto& design : space.designs) {
      const double mass = design.values[0];
      QVERIFY(design.origin != MotionOrigin::none);
      const double expected = 4 * force / std::hypot(1 - mass * omega * omega, alpha * mass * omega);
      QVERIFY(std::abs(design.amplitudes[0].pathLength - expected) < 1e-7 * expected);
      QVERIFY(design.residual < 1e-10);
    }
  }

  /// A hardening oscillator has folds over the mass: beyond them motions are found anew, and all solve the equations.
  void findsMotionsBeyondFolds() {
    const DesignSpace space = sample(4, 60);
    int anew = 0;
    for (std::size_t i = 0; i < space.designs.size(); ++i) {
      const auto& design = space.designs[i];
      anew += design.origin == MotionOrigin::anew;
      if (design.origin == MotionOrigin::none) continue;
      const HarmonicBalanceProblem problem = oscillator(design.values[0], 4);
      QVERIFY(problem.residual(design.z, omega).norm() < 1e-9 * problem.forceScale(omega));
      if (design.origin == MotionOrigin::followed) QVERIFY(design.from >= 0 && design.from < static_cast<int>(i));
    }
    QVERIFY(anew > 1);  // the first one, and one beyond a fold
  }

  void doesNotDependOnTheNumberOfThreads() {
    const DesignSpace several = sample(4, 30);
    math::setThreadCount(1);
    const DesignSpace one = sample(4, 30);
    math::setThreadCount(0);
    for (std::size_t i = 0; i < one.designs.size(); ++i) {
      QVERIFY(one.designs[i].z == several.designs[i].z);
      QCOMPARE(one.designs[i].from, several.designs[i].from);
    }
    QVERIFY(sample(4, 5, 2).designs[3].values != one.designs[3].values);
  }

  void keepsWholeBatchesWhenCancelled() {
    base::ExecutionContext* running = nullptr;
    base::ExecutionContext context([&](double fraction, const std::string&) {
      if (fraction > 0.3) running->requestCancel();
    });
    running = &context;
    const DesignSpace space = sample(0, 40, 1, &context);
    QVERIFY(space.report.termination == base::TerminationType::cancelled);
    QVERIFY(space.designs.size() >= 9 && space.designs.size() < 41);
  }

  /// Against the definition.
  void theFrontIsWhatNothingBeats() {
    const math::EvenPoints even(2, 3);
    Matrix points(200, 2);
    for (int i = 0; i < 200; ++i) points.row(i) = (20 * even[i].transpose()).array().round();  // with ties
    const std::vector<int> front = harmonic::paretoFront(points);
    for (int i = 0; i < 200; ++i) {
      bool beaten = false;
      for (int j = 0; j < 200; ++j)
        beaten |= (points.row(j).array() >= points.row(i).array()).all() && points.row(j) != points.row(i);
      const bool equalOnFront =
          std::any_of(front.begin(), front.end(), [&](int k) { return points.row(k) == points.row(i); });
      QCOMPARE(equalOnFront, !beaten);
    }
    for (std::size_t k = 1; k < front.size(); ++k) QVERIFY(points(front[k], 0) > points(front[k - 1], 0));
  }
};

QTEST_GUILESS_MAIN(TestDesignSpace)
#include "test_design_space.moc"
