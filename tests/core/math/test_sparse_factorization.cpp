#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <QTest>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/math/parallel.hpp"
#include "core/math/sparse_factorization.hpp"
#include "tests/core/math/block_matrices.hpp"

using pliant::math::SparseFactorization;
using pliant::math::SparseMatrix;
using pliant::tests::randomMatrix;
using pliant::tests::relativeDifference;

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseMatrix assemble(int size, const Triplets& entries) {
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// A structurally symmetric random matrix with a five-point stencil on a square grid; values are not symmetric.
SparseMatrix randomGrid(int side, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Triplets entries;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const int at = i * side + j;
      entries.emplace_back(at, at, 2 + uniform(generator));
      const auto couple = [&](int other) {
        entries.emplace_back(at, other, uniform(generator));
        entries.emplace_back(other, at, uniform(generator));
      };
      if (i + 1 < side) couple(at + side);
      if (j + 1 < side) couple(at + 1);
    }
  }
  return assemble(side * side, entries);
}

}  // namespace

class SparseFactorizationTest : public QObject {
  Q_OBJECT

 private slots:
  void agreesWithAnotherLu() {
    const SparseMatrix matrix = randomGrid(30, 1);
    const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 3, 2);
    SparseFactorization factorization;
    QVERIFY(factorization.factorize(matrix));
    Eigen::SparseLU<SparseMatrix> reference(matrix);
    const Eigen::MatrixXd x = factorization.solve(b);
    QVERIFY(relativeDifference(x, reference.solve(b)) < 1e-10);
    QVERIFY(factorization.backwardError(x, b) < 1e-15);
    QVERIFY(factorization.backwardError(1.001 * x, b) > 1e-6);
    QVERIFY(relativeDifference(factorization.solveRoughly(b), x) < 1e-8);
    const Eigen::MatrixXd transposed = factorization.solveTransposed(b);
    QVERIFY(relativeDifference(matrix.transpose() * transposed, b) < 1e-12);
    QCOMPARE(static_cast<double>(factorization.determinantSign()), reference.signDeterminant());
    QVERIFY(factorization.factorEntries() >= static_cast<double>(matrix.rows()));
    QVERIFY(factorization.flops() > 0);
  }

  void refactorizesNewValuesAndNewPatterns() {
    SparseFactorization factorization;
    const Eigen::MatrixXd b = randomMatrix(400, 1, 3);
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const SparseMatrix matrix = randomGrid(20, seed);
      QVERIFY(factorization.factorize(matrix));
      QVERIFY(relativeDifference(matrix * factorization.solve(b), b) < 1e-12);
    }
    SparseMatrix coupled = randomGrid(20, 4);
    coupled.coeffRef(0, 399) = 0.5;  // leaves the matrix uncompressed
    QVERIFY(factorization.factorize(coupled));
    QVERIFY(relativeDifference(coupled * factorization.solve(b), b) < 1e-12);
    const SparseMatrix smaller = randomGrid(3, 5);
    QVERIFY(factorization.factorize(smaller));
    QVERIFY(relativeDifference(smaller * factorization.solve(b.topRows(9)), b.topRows(9)) < 1e-12);
  }

  void aMovedFactorizationStillSolves() {
    const SparseMatrix matrix = randomGrid(5, 1);
    SparseFactorization first;
    QVERIFY(first.factorize(matrix));
    const SparseFactorization second = std::move(first);
    const Eigen::MatrixXd b = randomMatrix(25, 1, 1);
    QVERIFY(relativeDifference(matrix * second.solve(b), b) < 1e-12);
  }

  void tinyMatrices() {
    SparseFactorization factorization;
    QVERIFY(factorization.factorize(assemble(1, {{0, 0, -4.0}})));
    QCOMPARE(factorization.solve(Eigen::MatrixXd::Constant(1, 1, 2.0))(0, 0), -0.5);
    QCOMPARE(factorization.determinantSign(), -1);
    QVERIFY(factorization.factorize(assemble(2, {{0, 1, 1.0}, {1, 0, 1.0}})));
    QCOMPARE(factorization.determinantSign(), -1);
    QVERIFY(factorization.factorize(assemble(3, {{0, 1, 1.0}, {1, 2, 1.0}, {2, 0, 1.0}})));
    QCOMPARE(factorization.determinantSign(), 1);
    QVERIFY_THROWS_EXCEPTION(std::invalid_argument, factorization.factorize(SparseMatrix(2, 3)));
  }

  void singularMatricesAreReported_data() {
    QTest::addColumn<SparseMatrix>("matrix");
    QTest::newRow("zero") << assemble(1, {{0, 0, 0.0}});
    QTest::newRow("no entries") << SparseMatrix(4, 4);
    QTest::newRow("empty column") << assemble(3, {{0, 0, 1.0}, {1, 1, 1.0}, {2, 1, 1.0}});
    QTest::newRow("rank 2 of 3") << SparseMatrix(Eigen::MatrixXd{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}.sparseView());
    const Eigen::MatrixXd factor = randomMatrix(60, 59, 9);
    QTest::newRow("rank 59 of 60") << SparseMatrix((factor * randomMatrix(59, 60, 8)).sparseView());
    SparseMatrix laplacian = randomGrid(15, 3);  // every row sums to zero
    const Eigen::VectorXd sums = laplacian * Eigen::VectorXd::Ones(225);
    for (int i = 0; i < 225; ++i) laplacian.coeffRef(i, i) -= sums[i];
    QTest::newRow("constant null vector") << laplacian;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    QTest::newRow("not a number") << assemble(2, {{0, 0, 1.0}, {1, 1, nan}});
    QTest::newRow("infinite") << assemble(2, {{0, 0, 1.0}, {1, 1, std::numeric_limits<double>::infinity()}});
  }
  void singularMatricesAreReported() {
    QFETCH(SparseMatrix, matrix);
    SparseFactorization factorization;
    QVERIFY(!factorization.factorize(matrix));
    QCOMPARE(factorization.determinantSign(), 0);
    SparseMatrix identity(matrix.rows(), matrix.cols());
    identity.setIdentity();
    QVERIFY(factorization.factorize(identity));  // and the object can be used again
  }

  void unitsAreNotSingularity() {
    const SparseMatrix grid = randomGrid(20, 6);
    Eigen::VectorXd units(400);
    for (int i = 0; i < 400; ++i) units[i] = std::pow(10.0, -10 + i % 21);
    SparseFactorization factorization;
    const SparseMatrix equations = units.asDiagonal() * grid;
    QVERIFY(factorization.factorize(equations));
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(400);
    QVERIFY((factorization.solve(equations * ones) - ones).cwiseAbs().maxCoeff() < 1e-9);
    const SparseMatrix unknowns = grid * units.asDiagonal();
    QVERIFY(factorization.factorize(unknowns));
    const Eigen::MatrixXd x = factorization.solve(grid * ones);
    QVERIFY((units.asDiagonal() * x - ones).cwiseAbs().maxCoeff() < 1e-9);
  }

  void determinantSignChangesThroughASingularity() {
    const SparseMatrix matrix = randomGrid(8, 2);
    SparseFactorization factorization;
    std::set<int> seen;
    for (const double shift : {-5.0, -3.0, -2.5, -1.7, -1.0, 0.0, 1.0}) {
      SparseMatrix shifted = matrix;
      for (int i = 0; i < shifted.rows(); ++i) shifted.coeffRef(i, i) += shift;
      QVERIFY(factorization.factorize(shifted));
      const double determinant = Eigen::MatrixXd(shifted).determinant();
      QCOMPARE(factorization.determinantSign(), determinant > 0 ? 1 : -1);
      seen.insert(factorization.determinantSign());
    }
    QCOMPARE(seen.size(), std::size_t{2});
  }

  void resultsDoNotDependOnThreads() {
    const SparseMatrix matrix = randomGrid(40, 3);
    const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 5, 4);
    const auto solveWith = [&](int threads) {
      pliant::math::setThreadCount(threads);
      SparseFactorization factorization;
      factorization.factorize(matrix);
      const Eigen::MatrixXd x = factorization.solve(b);
      pliant::math::setThreadCount(0);
      return x;
    };
    const Eigen::MatrixXd one = solveWith(1);
    const Eigen::MatrixXd two = solveWith(2);
    QVERIFY(std::memcmp(one.data(), two.data(), sizeof(double) * static_cast<std::size_t>(one.size())) == 0);
  }

  void severalThreadsAtOnce() {
    std::atomic<int> failures{0};
    std::vector<std::thread> threads;
    for (unsigned thread = 0; thread < 4; ++thread) {
      threads.emplace_back([&, thread] {
        SparseFactorization factorization;
        for (unsigned repeat = 0; repeat < 5; ++repeat) {
          const SparseMatrix matrix = randomGrid(20, 10 * thread + repeat);
          const Eigen::MatrixXd b = randomMatrix(400, 2, repeat);
          if (!factorization.factorize(matrix) || relativeDifference(matrix * factorization.solve(b), b) > 1e-12) {
            ++failures;
          }
        }
      });
    }
    for (auto& thread : threads) thread.join();
    QCOMPARE(failures.load(), 0);
  }
};

QTEST_GUILESS_MAIN(SparseFactorizationTest)
#include "test_sparse_factorization.moc"
