#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <QTest>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "core/math/block_pattern.hpp"
#include "core/math/parallel.hpp"
#include "core/math/sparse_factorization.hpp"
#include "core/math/supernodal_factorization.hpp"
#include "tests/core/math/block_matrices.hpp"

using namespace pliant::tests;
using pliant::math::BlockPattern;
using pliant::math::SparseFactorization;
using pliant::math::SparseMatrix;
using pliant::math::SupernodalFactorization;

namespace {

struct Solution {
  Eigen::MatrixXd x;
  Eigen::MatrixXd transposed;
};

bool sameBytes(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

/// Makes `matrix` singular by changing one diagonal entry.
void makeSingular(SparseMatrix& matrix, int at) {
  Eigen::SparseLU<SparseMatrix> lu(matrix);
  const Eigen::VectorXd column = lu.solve(Eigen::VectorXd::Unit(matrix.rows(), at).eval());
  matrix.coeffRef(at, at) -= 1 / column[at];
}

}  // namespace

/// SparseFactorization and the factorisation by supernodes behind it, on matrices made of dense blocks.
class BlockFactorizationTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { pliant::math::setThreadCount(0); }

  void agreesWithAnotherLu_data() {
    QTest::addColumn<SparseMatrix>("matrix");
    const auto add = [](const char* name, const HarmonicMatrixSpec& spec) {
      const SparseMatrix matrix = harmonicMatrix(spec);
      QTest::addRow("%s", name) << matrix;
      QTest::addRow("%s, random", name) << randomValues(matrix, 5);
    };
    add("one node", {1, 1, 1});
    add("two nodes", {1, 2, 2});
    add("static", {6, 7, 0});
    add("strip", {3, 16, 2});
    add("bordered strip", {3, 16, 2, true});
    add("grid", {7, 8, 3});
    add("bordered grid", {7, 8, 3, true, 3});
    add("bordered node", {1, 1, 4, true, 3});
  }
  void agreesWithAnotherLu() {
    QFETCH(SparseMatrix, matrix);
    const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 2, 2);
    QVERIFY(SupernodalFactorization::suits(BlockPattern(matrix)));
    SparseFactorization factorization;
    QVERIFY(factorization.factorize(matrix));
    Eigen::SparseLU<SparseMatrix> reference(matrix);
    const Eigen::MatrixXd x = factorization.solve(b);
    QVERIFY(factorization.backwardError(x, b) < 1e-15);
    QVERIFY(relativeDifference(x, reference.solve(b)) < 1e-8);
    const Eigen::MatrixXd transposed = factorization.solveTransposed(b);
    const SparseMatrix transpose = matrix.transpose();
    QVERIFY(relativeDifference(transpose * transposed, b) < 1e-10);
    QVERIFY(relativeDifference(transposed, Eigen::SparseLU<SparseMatrix>(transpose).solve(b)) < 1e-8);
    QCOMPARE(static_cast<double>(factorization.determinantSign()), reference.signDeterminant());
  }

  void factorsAloneAreAccurate() {
    const SparseMatrix matrix = harmonicMatrix({8, 9, 2, true});
    SupernodalFactorization blocks(matrix, BlockPattern(matrix));
    QVERIFY(blocks.factorize(matrix.valuePtr()) > 1e-9);
    const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 35, 4);  // more than one chunk of right-hand sides
    Eigen::MatrixXd x;
    blocks.solve(false, b, x);
    QVERIFY(relativeDifference(matrix * x, b) < 1e-9);
    blocks.solve(true, b, x);
    QVERIFY(relativeDifference(matrix.transpose() * x, b) < 1e-9);
    QVERIFY(blocks.factorEntries() > static_cast<double>(matrix.nonZeros()));
    QVERIFY(blocks.flops() < 2.0 / 3 * std::pow(static_cast<double>(matrix.rows()), 3));
  }

  void refactorizesNewValues() {
    const SparseMatrix pattern = harmonicMatrix({4, 5, 2});
    SparseFactorization factorization;
    for (unsigned seed = 1; seed < 4; ++seed) {
      const SparseMatrix matrix = randomValues(pattern, seed);
      QVERIFY(factorization.factorize(matrix));
      const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 1, seed);
      QVERIFY(relativeDifference(matrix * factorization.solve(b), b) < 1e-11);
    }
    const SparseMatrix other = harmonicMatrix({5, 4, 2, true});
    QVERIFY(factorization.factorize(other));
    const Eigen::MatrixXd b = randomMatrix(other.rows(), 1, 9);
    QVERIFY(relativeDifference(other * factorization.solve(b), b) < 1e-11);
  }

  void atAFoldOnlyTheBorderedMatrixIsRegular() {
    SparseMatrix bordered = harmonicMatrix({4, 9, 2, true});
    const Eigen::Index unknowns = bordered.rows() - 1;
    SparseMatrix matrix = bordered.topLeftCorner(unknowns, unknowns);
    SparseFactorization factorization;
    QVERIFY(factorization.factorize(matrix));
    makeSingular(matrix, 40);
    QVERIFY(!factorization.factorize(matrix));
    QCOMPARE(factorization.determinantSign(), 0);
    bordered.coeffRef(40, 40) = matrix.coeff(40, 40);
    QVERIFY(factorization.factorize(bordered));
    SupernodalFactorization blocks(bordered, BlockPattern(bordered));
    QVERIFY2(
        blocks.factorize(bordered.valuePtr()) > 1e-9, "no pivot should be small with the border in the last block");
    const Eigen::MatrixXd b = randomMatrix(bordered.rows(), 1, 3);
    const Eigen::MatrixXd x = factorization.solve(b);
    QVERIFY(factorization.backwardError(x, b) < 1e-15);
    QVERIFY(relativeDifference(bordered * x, b) < 1e-10);
  }

  void theDeterminantChangesSignThroughAFold() {
    SparseMatrix matrix = harmonicMatrix({4, 9, 2});
    makeSingular(matrix, 40);
    const double critical = matrix.coeff(40, 40);
    SparseFactorization factorization;
    matrix.coeffRef(40, 40) = critical + 1e-6;
    QVERIFY(factorization.factorize(matrix));
    const int above = factorization.determinantSign();
    matrix.coeffRef(40, 40) = critical - 1e-6;
    QVERIFY(factorization.factorize(matrix));
    QCOMPARE(factorization.determinantSign(), -above);
  }

  void nearlySingularMatricesAreSolvedWithASmallBackwardError() {
    SparseMatrix matrix = harmonicMatrix({4, 9, 2});
    makeSingular(matrix, 40);
    matrix.coeffRef(40, 40) *= 1 + 1e-9;
    SparseFactorization factorization;
    QVERIFY(factorization.factorize(matrix));
    const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 1, 3);
    QVERIFY(factorization.backwardError(factorization.solve(b), b) < 1e-15);
  }

  void singularPivotBlocksAreNoObstacle_data() {
    QTest::addColumn<double>("diagonal");
    QTest::newRow("zero") << 0.0;
    QTest::newRow("tiny") << 1e-13;
    QTest::newRow("small") << 1e-7;
  }
  void singularPivotBlocksAreNoObstacle() {
    // Only even and odd columns of nodes are coupled (a regular matrix), so neither can be eliminated by itself.
    QFETCH(double, diagonal);
    const int columns = 20;
    SparseMatrix matrix = randomValues(harmonicMatrix({3, columns, 3}), 3);
    const auto meshColumn = [&](Eigen::Index unknown) { return unknown / (3 * 7) % columns; };
    for (int j = 0; j < matrix.cols(); ++j) {
      for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
        if ((meshColumn(it.row()) + meshColumn(j)) % 2 == 0) it.valueRef() *= diagonal;
      }
    }
    SupernodalFactorization blocks(matrix, BlockPattern(matrix));
    const double pivotRatio = blocks.factorize(matrix.valuePtr());
    QVERIFY2(!(pivotRatio > 0) || blocks.largestMultiplier() > 0.01 / diagonal, "the matrix is no test of anything");
    SparseFactorization factorization;
    QVERIFY(factorization.factorize(matrix));
    const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 1, 3);
    QVERIFY(factorization.backwardError(factorization.solve(b), b) < 1e-15);
    const Eigen::MatrixXd x = factorization.solveTransposed(b);
    QVERIFY((matrix.transpose() * x - b).norm() < 1e-14 * (matrix.norm() * x.norm() + b.norm()));
    QCOMPARE(
        static_cast<double>(factorization.determinantSign()), Eigen::SparseLU<SparseMatrix>(matrix).signDeterminant());
  }

  void largeDenseMatrices() {
    const SparseMatrix matrix = randomMatrix(450, 450, 4).sparseView();
    SparseFactorization factorization;
    QVERIFY(factorization.factorize(matrix));
    const Eigen::MatrixXd b = randomMatrix(450, 2, 5);
    const Eigen::PartialPivLU<Eigen::MatrixXd> reference{Eigen::MatrixXd(matrix)};
    QVERIFY(relativeDifference(factorization.solve(b), reference.solve(b)) < 1e-9);
    QCOMPARE(factorization.determinantSign(), reference.determinant() > 0 ? 1 : -1);
  }

  void nonFiniteValuesAreReported() {
    SparseMatrix matrix = harmonicMatrix({3, 5, 1, true});
    SparseFactorization factorization;
    for (const Eigen::Index entry : {Eigen::Index{0}, matrix.nonZeros() / 2, matrix.nonZeros() - 1}) {
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const double good = std::exchange(matrix.valuePtr()[entry], bad);
        QVERIFY(!factorization.factorize(matrix));
        matrix.valuePtr()[entry] = good;
        QVERIFY(factorization.factorize(matrix));
      }
    }
  }

  void unsymmetricPatterns() {
    // Blocks in one triangle only, and a node without a diagonal block.
    std::vector<Eigen::Triplet<double>> entries;
    const Eigen::MatrixXd values = randomMatrix(40, 40, 6);
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j) {
        const int row = i / 8;
        const int column = j / 8;
        const bool present = row == 2 ? column == 3 : row == 3 ? column != 3 : row >= column;
        if (present) entries.emplace_back(i, j, values(i, j));
      }
    }
    SparseMatrix matrix(40, 40);
    matrix.setFromTriplets(entries.begin(), entries.end());
    SparseFactorization factorization;
    QVERIFY(factorization.factorize(matrix));
    const Eigen::MatrixXd b = randomMatrix(40, 1, 7);
    QVERIFY(relativeDifference(factorization.solve(b), Eigen::MatrixXd(matrix).lu().solve(b)) < 1e-9);
  }

  void resultsDoNotDependOnThreads() {
    const SparseMatrix matrix = harmonicMatrix({8, 9, 4, true});
    const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 18, 4);
    const auto solveWith = [&](int threads) {
      pliant::math::setThreadCount(threads);
      SparseFactorization factorization;
      factorization.factorize(matrix);
      return Solution{factorization.solve(b), factorization.solveTransposed(b)};
    };
    const Solution one = solveWith(1);
    for (const int threads : {2, 3, 2}) {
      const Solution several = solveWith(threads);
      QVERIFY(sameBytes(one.x, several.x));
      QVERIFY(sameBytes(one.transposed, several.transposed));
    }
  }

  void severalThreadsAtOnce() {
    pliant::math::setThreadCount(3);
    const SparseMatrix matrix = harmonicMatrix({5, 6, 3, true});
    const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 2, 4);
    SparseFactorization shared;
    QVERIFY(shared.factorize(matrix));
    const Eigen::MatrixXd expected = shared.solve(b);
    std::atomic<int> failures{0};
    std::vector<std::thread> threads;
    for (int thread = 0; thread < 4; ++thread) {
      threads.emplace_back([&] {
        SparseFactorization own;
        if (!own.factorize(matrix) || !sameBytes(own.solve(b), expected)) ++failures;
        if (!sameBytes(shared.solve(b), expected)) ++failures;
      });
    }
    for (auto& thread : threads) thread.join();
    QCOMPARE(failures.load(), 0);
  }
};

QTEST_GUILESS_MAIN(BlockFactorizationTest)
#include "test_block_factorization.moc"
