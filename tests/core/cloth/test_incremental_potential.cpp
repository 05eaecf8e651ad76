#include <QTest>

#include "tests/core/cloth/cloth_examples.hpp"

using namespace pliant;
using cloth::IncrementalPotential;
using mechanics::Vector;

namespace {

/// A sheet with everything that the potential can contain.
cloth::ClothProblem fullProblem() {
  cloth::ClothProblem problem = test::withModel(test::sheetProblem(4), [](mechanics::Model& model) {
    model.gravity = Eigen::Vector3d(0, -1, -9.81);
    model.massDamping = 0.7;
    model.stiffnessDamping = 0.02;
    for (int i = 0; i < 3; ++i) model.lockedCoordinates[i] = 1;
  });
  problem.wind.emplace();
  problem.wind->velocity = {1, -2, 3};
  return problem;
}

cloth::StepTerms termsAt(const IncrementalPotential& potential, const Eigen::Matrix3Xd& positions) {
  cloth::StepTerms terms;
  terms.rate = 50;
  terms.base = positions.reshaped();
  terms.target = terms.base + test::scattered(positions.cols(), 0.02, 7).reshaped();
  terms.history = potential.elasticForce(terms.base);
  return terms;
}

}  // namespace

class TestIncrementalPotential : public QObject {
  Q_OBJECT

 private slots:
  void theGradientIsThatOfTheValue() {
    const auto problem = std::make_shared<const cloth::ClothProblem>(fullProblem());
    IncrementalPotential potential(problem);
    const Eigen::Matrix3Xd start = problem->model->restPositions.reshaped(3, problem->sheet.nodeCount) +
                                   test::scattered(problem->sheet.nodeCount, 0.03);
    potential.setTerms(termsAt(potential, start));
    potential.beginWind(start, 0.3);
    const Vector x = start.reshaped() + test::scattered(start.cols(), 0.01, 9).reshaped();
    const Vector gradient = potential.gradient(x);
    QVERIFY(gradient.head<3>().isZero(0));
    constexpr double step = 1e-6;
    double largest = 0;
    for (Eigen::Index i = 3; i < x.size(); ++i) {
      Vector ahead = x, behind = x;
      ahead[i] += step;
      behind[i] -= step;
      const double difference = (potential.value(ahead) - potential.value(behind)) / (2 * step);
      largest = std::max(largest, std::abs(difference - gradient[i]));
    }
    QVERIFY2(largest < 1e-7 * gradient.lpNorm<Eigen::Infinity>(), qPrintable(QString::number(largest)));
  }

  /// The last corrections square only if the Hessian is the gradient's derivative.
  void newtonConvergesQuadratically() {
    const auto problem = std::make_shared<const cloth::ClothProblem>(fullProblem());
    IncrementalPotential potential(problem);
    const Eigen::Matrix3Xd start = problem->model->restPositions.reshaped(3, problem->sheet.nodeCount) +
                                   test::scattered(problem->sheet.nodeCount, 0.003);
    potential.setTerms(termsAt(potential, start));
    potential.beginWind(start, 0.3);
    Vector x = start.reshaped();
    base::ExecutionContext context;
    const base::SolverReport report = potential.minimize(x, {1e-12, 50}, context);
    QVERIFY2(report.converged(), report.message.c_str());
    QVERIFY((x.head<3>().array() == start.col(0).array()).all());
    const auto& steps = report.iterations;
    QVERIFY(steps.size() >= 4);
    for (std::size_t i = steps.size() - 2; i + 1 < steps.size(); ++i)
      QVERIFY2(steps[i + 1].correction < 30 * std::pow(steps[i].correction, 2) + 1e-13,
               qPrintable(QString("%1 after %2").arg(steps[i + 1].correction).arg(steps[i].correction)));
  }

  /// Pushed together, a sheet's stiffness is indefinite; the minimum is found all the same.
  void anIndefiniteHessianIsNoObstacle() {
    const auto problem = std::make_shared<const cloth::ClothProblem>(test::sheetProblem(6));
    IncrementalPotential potential(problem);
    Eigen::Matrix3Xd start = problem->model->restPositions.reshaped(3, problem->sheet.nodeCount);
    start.row(0) *= 0.4;
    start.row(1) *= 0.4;
    start += test::scattered(start.cols(), 1e-4);
    cloth::StepTerms terms;
    terms.rate = 1;
    terms.base = terms.target = start.reshaped();
    terms.history = potential.elasticForce(terms.base);
    potential.setTerms(terms);
    Vector x = terms.base;
    const double before = potential.value(x);
    base::ExecutionContext context;
    const base::SolverReport report = potential.minimize(x, {1e-9, 200}, context);
    QVERIFY2(report.converged(), report.message.c_str());
    QVERIFY(potential.value(x) < 0.1 * before);
    QVERIFY(report.residual() <= 1e-9);
  }
};

QTEST_GUILESS_MAIN(TestIncrementalPotential)
#include "test_incremental_potential.moc"
