#include <QTest>
#include <random>

#include "core/solvers/cone_certificate.hpp"
#include "core/solvers/cone_history.hpp"
#include "tests/core/solvers/sheet_examples.hpp"

using namespace pliant::solvers;
using pliant::base::ExecutionContext;
using pliant::tests::directionBounds;
using pliant::tests::disturbed;
using pliant::tests::isotropicBound;
using pliant::tests::makeSheet;
using pliant::tests::Sheet;

namespace {

/// Springs with random directions between neighbours and next but one: a dense matrix and its lower triangle.
struct Springs {
  Eigen::MatrixXd dense;
  ConeStiffness pattern;
  Eigen::VectorXd entries;
};

Springs springs(int side, double stiffness) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Springs result;
  const int nodes = side * side;
  result.dense.setZero(3 * nodes, 3 * nodes);
  Eigen::MatrixXi coupled = Eigen::MatrixXi::Identity(nodes, nodes);
  const auto connect = [&](int a, int b) {
    const Eigen::Vector3d n(uniform(generator), uniform(generator), uniform(generator));
    const Eigen::Matrix3d block = stiffness * n * n.transpose();
    result.dense.block<3, 3>(3 * a, 3 * a) += block;
    result.dense.block<3, 3>(3 * b, 3 * b) += block;
    result.dense.block<3, 3>(3 * a, 3 * b) -= block;
    result.dense.block<3, 3>(3 * b, 3 * a) -= block;
    coupled(a, b) = coupled(b, a) = 1;
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j + 2 < side; ++j) {
      connect(i * side + j, i * side + j + 1);
      connect(i * side + j, i * side + j + 2);
      connect(j * side + i, (j + 2) * side + i);
    }
  std::vector<double> entries;
  for (int column = 0; column < 3 * nodes; ++column)
    for (int row = column; row < 3 * nodes; ++row)
      if (coupled(row / 3, column / 3)) {
        result.pattern.rows.push_back(row);
        result.pattern.columns.push_back(column);
        entries.push_back(result.dense(row, column));
      }
  result.entries = Eigen::Map<Eigen::VectorXd>(entries.data(), static_cast<Eigen::Index>(entries.size()));
  return result;
}

}  // namespace

class TestConeObjective : public QObject {
  Q_OBJECT

 private slots:
  void stiffnessCountsInTheOptimum_data() {
    QTest::addColumn<double>("stiffness");
    QTest::addColumn<double>("inertia");
    QTest::addColumn<bool>("sampled");
    QTest::newRow("soft") << 1e-3 << 0.0 << false;
    QTest::newRow("stiff") << 1.0 << 0.0 << false;
    QTest::newRow("stiff, more inertia") << 1.0 << 4.0 << false;
    QTest::newRow("directions") << 0.1 << 0.0 << true;
  }
  /// The conditions of an optimum in the norm of H, with H as a dense matrix.
  void stiffnessCountsInTheOptimum() {
    QFETCH(double, stiffness);
    QFETCH(double, inertia);
    QFETCH(bool, sampled);
    Sheet sheet = makeSheet(5);
    sheet.constraints.bounds = {sampled ? directionBounds(1.02, 6) : isotropicBound(1.02)};
    sheet.constraints.fixed[0] = sheet.constraints.fixed[5] = 1;
    Eigen::Matrix3Xd candidate = disturbed(sheet.rest, 0.2, 3);
    for (const int node : {0, 5}) candidate.col(node) = sheet.rest.col(node);
    const Springs k = springs(6, stiffness);
    Eigen::MatrixXd h = k.dense;
    for (int i = 0; i < h.rows(); ++i) h(i, i) += (1 + inertia) * sheet.constraints.masses[i / 3];
    ConeProgram program(sheet.constraints, k.pattern);
    QVERIFY(program.setStiffness(k.entries, inertia));
    ExecutionContext context;
    const ConeSolution solution = program.solve(candidate, sheet.rest, {}, context);
    QVERIFY2(solution.report.converged(), solution.report.message.c_str());
    QVERIFY(solution.violation <= 1e-9);

    const Eigen::VectorXd offset = (solution.positions - candidate).reshaped();
    const Eigen::VectorXd gradient = h * offset;
    QVERIFY(std::abs(solution.objective - 0.5 * offset.dot(gradient)) < 1e-12 * solution.objective);
    QVERIFY(solution.relativeGap() <= 1e-8);
    Eigen::VectorXd residual = gradient + Eigen::VectorXd(limitForces(sheet.constraints, solution).reshaped());
    for (const int node : {0, 5}) residual.segment<3>(3 * node).setZero();
    QVERIFY2(residual.lpNorm<Eigen::Infinity>() <= 1e-7 * gradient.lpNorm<Eigen::Infinity>(),
             qPrintable(QString::number(residual.norm() / gradient.norm())));
    // Nothing that keeps the limits is nearer: points between here and states that do.
    for (unsigned seed = 1; seed < 6; ++seed) {
      Eigen::Matrix3Xd inside = sheet.rest;
      for (int node = 0; node < inside.cols(); ++node)
        if (!sheet.constraints.fixed[node]) inside.col(node) += 0.002 * disturbed(sheet.rest, 0.2, seed).col(node);
      const Eigen::VectorXd towards = (inside - solution.positions).reshaped();
      QVERIFY(gradient.dot(towards) > -1e-7 * gradient.norm() * towards.norm());
    }
  }

  void refusesAnIndefiniteStiffness() {
    Sheet sheet = makeSheet(5);
    sheet.constraints.bounds = {isotropicBound(1.02)};
    const Springs k = springs(6, -1);
    ConeProgram program(sheet.constraints, k.pattern);
    QVERIFY(!program.setStiffness(k.entries, 0));
  }

  /// Of the last problems that which is posed again is recognised, its multipliers prove its whole objective, and
  /// multiples of them are found.
  void rememberedMultipliersFit() {
    Sheet sheet = makeSheet(6);
    sheet.constraints.bounds = {isotropicBound(1.02)};
    std::vector<int> vertices(49);
    for (int node = 0; node < 49; ++node) vertices[node] = node;
    std::vector<std::array<int, 2>> pairs;
    for (const ConeElement& element : sheet.constraints.elements)
      for (int a = 0; a < 3; ++a) pairs.push_back({element.nodes[a], element.nodes[(a + 1) % 3]});
    const pliant::math::BlockCholesky cholesky(49, pairs);
    ConeElements elements(sheet.constraints, vertices, cholesky);
    const ConeObjective objective(sheet.constraints, vertices, {}, pairs);
    ConeHistory history;
    std::vector<ConeSolution> solutions;
    for (unsigned seed = 1; seed <= 3; ++seed) {
      ConeProgram program(sheet.constraints);
      ExecutionContext context;
      solutions.push_back(program.solve(disturbed(sheet.rest, 0.1 * seed, seed), sheet.rest, {}, context));
      // Elements are in groups of eight, in their order: all have the same limit.
      ConeElements::Multipliers multipliers;
      const Eigen::Matrix3Xd& own = solutions.back().ellipseMultipliers;
      for (Eigen::Index first = 0; first < own.cols(); first += 8) {
        double entries[3][8] = {};
        for (Eigen::Index lane = 0; lane < 8 && first + lane < own.cols(); ++lane)
          for (int i = 0; i < 3; ++i) entries[i][lane] = own(i, first + lane);
        SymmetricPacket& packet = multipliers.ellipses.emplace_back();
        pliant::math::load(entries[0], packet.a);
        pliant::math::load(entries[1], packet.b);
        pliant::math::load(entries[2], packet.c);
      }
      history.remember(std::move(multipliers), solutions.back().objective);
    }
    QCOMPARE(history.lastObjective(), solutions[2].objective);
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const ConeSolution& solution = solutions[seed - 1];
      const auto match =
          history.bestFor(elements, objective, solution.positions, disturbed(sheet.rest, 0.1 * seed, seed));
      QVERIFY(match.has_value());
      QVERIFY2(std::abs(match->factor - 1) < 1e-6, qPrintable(QString::number(match->factor)));
      QVERIFY(std::abs(match->bound - solution.objective) < 1e-6 * solution.objective);
    }
    // Nothing is proved about what keeps the limits.
    QVERIFY(!history.bestFor(elements, objective, sheet.rest, 0.9 * sheet.rest).has_value());
  }
};

QTEST_GUILESS_MAIN(TestConeObjective)
#include "test_cone_objective.moc"
