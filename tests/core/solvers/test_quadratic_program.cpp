#include <Eigen/Dense>
#include <QTest>
#include <random>

#include "core/solvers/quadratic_program.hpp"

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using pliant::solvers::solveQuadraticProgram;

class TestQuadraticProgram : public QObject {
  Q_OBJECT

 private slots:
  /// Against the best of all sets of constraints that could hold, each by one linear system.
  void agreesWithEnumeration() {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const auto matrix = [&](Index rows, Index columns) {
      return MatrixXd(MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); }));
    };
    for (int example = 0; example < 60; ++example) {
      const Index n = 2 + example % 3, m = 1 + example % 6;
      const MatrixXd root = matrix(n, n), H = root * root.transpose() + 0.1 * MatrixXd::Identity(n, n);
      const MatrixXd A = matrix(m, n);
      const VectorXd g = 3 * matrix(n, 1), b = matrix(m, 1).cwiseAbs();  // x = 0 is allowed
      double least = std::numeric_limits<double>::infinity();
      VectorXd best;
      for (int set = 0; set < (1 << m); ++set) {
        std::vector<Index> rows;
        for (Index i = 0; i < m; ++i)
          if (set & (1 << i)) rows.push_back(i);
        const auto count = static_cast<Index>(rows.size());
        if (count > n) continue;
        MatrixXd system = MatrixXd::Zero(n + count, n + count);
        VectorXd right(n + count);
        system.topLeftCorner(n, n) = H;
        right.head(n) = -g;
        for (Index k = 0; k < count; ++k) {
          system.block(n + k, 0, 1, n) = A.row(rows[static_cast<std::size_t>(k)]);
          system.block(0, n + k, n, 1) = A.row(rows[static_cast<std::size_t>(k)]).transpose();
          right[n + k] = b[rows[static_cast<std::size_t>(k)]];
        }
        const VectorXd x = system.fullPivLu().solve(right).head(n);
        const double value = 0.5 * x.dot(H * x) + g.dot(x);
        if ((A * x - b).maxCoeff() < 1e-9 && value < least) least = value, best = x;
      }
      const auto found = solveQuadraticProgram(H, g, A, b);
      QVERIFY(found.converged);
      QVERIFY2(
          (found.x - best).norm() < 1e-6 * (1 + best.norm()), qPrintable(QString::number((found.x - best).norm())));
      QVERIFY((H * found.x + g + A.transpose() * found.multipliers).norm() < 1e-7 * (1 + g.norm()));
      QVERIFY(found.multipliers.minCoeff() >= 0);
    }
  }

  void withoutConstraints() {
    const MatrixXd H = (MatrixXd(2, 2) << 2, 0, 0, 4).finished();
    const auto found = solveQuadraticProgram(H, Eigen::Vector2d(-2, 4), MatrixXd(0, 2), VectorXd(0));
    QVERIFY(found.converged && (found.x - Eigen::Vector2d(1, -1)).norm() < 1e-14);
  }

  void impossibleConstraintsAreSaid() {
    const MatrixXd A = (MatrixXd(2, 1) << 1, -1).finished();
    QVERIFY(!solveQuadraticProgram(MatrixXd::Identity(1, 1), VectorXd::Zero(1), A, Eigen::Vector2d(-1, -1)).converged);
  }
};

QTEST_GUILESS_MAIN(TestQuadraticProgram)
#include "test_quadratic_program.moc"
