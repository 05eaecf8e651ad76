#include <Eigen/LU>
#include <QTest>
#include <cstring>
#include <vector>

#include "core/math/dense_kernels.hpp"
#include "core/math/parallel.hpp"
#include "tests/core/math/block_matrices.hpp"

using namespace pliant::math;
using pliant::tests::randomMatrix;
using pliant::tests::relativeDifference;

class DenseKernelsTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { useOneBlasThread(); }
  void cleanup() { setThreadCount(0); }

  void luReproducesTheMatrix_data() {
    QTest::addColumn<int>("size");
    for (const int size : {1, 2, 51, 96, 192, 193, 288, 300, 385, 577}) QTest::addRow("%d", size) << size;
  }
  void luReproducesTheMatrix() {
    QFETCH(int, size);
    const int stride = size + 5;  // the matrix is part of a larger panel
    const Eigen::MatrixXd panel = randomMatrix(stride, size, 3);
    Eigen::MatrixXd lu = panel;
    std::vector<int> swaps(size);
    factorizeDense(size, lu.data(), stride, swaps.data());
    QVERIFY(lu.bottomRows(5) == panel.bottomRows(5));
    const Eigen::MatrixXd square = lu.topRows(size);
    Eigen::MatrixXd product =
        square.triangularView<Eigen::UnitLower>() * Eigen::MatrixXd(square.triangularView<Eigen::Upper>());
    QVERIFY(square.triangularView<Eigen::StrictlyLower>().toDenseMatrix().cwiseAbs().maxCoeff() <= 1);
    exchangeRowsBack(size, swaps.data(), size, product.data(), size);
    QVERIFY(relativeDifference(product, panel.topRows(size)) < 1e-13);

    Eigen::MatrixXd again = panel;
    setThreadCount(1);
    factorizeDense(size, again.data(), stride, swaps.data());
    QVERIFY(std::memcmp(again.data(), lu.data(), sizeof(double) * static_cast<std::size_t>(lu.size())) == 0);
  }

  void trianglesAreSolved() {
    const int size = 40;
    Eigen::MatrixXd lu = randomMatrix(size, size, 4) / size;
    lu.diagonal().setConstant(2);
    const Eigen::MatrixXd upper = lu.triangularView<Eigen::Upper>();
    const Eigen::MatrixXd lower = lu.triangularView<Eigen::UnitLower>();
    for (const int columns : {1, 7}) {
      const Eigen::MatrixXd b = randomMatrix(size, columns, 5);
      for (const bool transposed : {false, true}) {
        for (const Triangle triangle : {Triangle::unitLower, Triangle::upper}) {
          const Eigen::MatrixXd& t = triangle == Triangle::upper ? upper : lower;
          Eigen::MatrixXd x = b;
          solveTriangle(triangle, transposed, size, lu.data(), size, columns, x.data(), size);
          const Eigen::MatrixXd product = transposed ? (t.transpose() * x).eval() : (t * x).eval();
          QVERIFY(relativeDifference(product, b) < 1e-13);
        }
      }
    }
    const Eigen::MatrixXd b = randomMatrix(9, size, 6);
    Eigen::MatrixXd x = b;
    solveUpperFromRight(9, size, lu.data(), size, x.data(), 9);
    QVERIFY(relativeDifference(x * upper, b) < 1e-13);
  }

  void productsAreSubtracted() {
    const Eigen::MatrixXd a = randomMatrix(12, 8, 7);
    for (const int count : {1, 3}) {
      const Eigen::MatrixXd x = randomMatrix(8, count, 8);
      const Eigen::MatrixXd y = randomMatrix(12, count, 9);
      Eigen::MatrixXd difference = y;
      subtractProduct(false, 12, 8, a.data(), 12, count, x.data(), 8, difference.data(), 12);
      QVERIFY(relativeDifference(difference, y - a * x) < 1e-14);
      difference = x;
      subtractProduct(true, 12, 8, a.data(), 12, count, y.data(), 12, difference.data(), 8);
      QVERIFY(relativeDifference(difference, x - a.transpose() * y) < 1e-14);
    }
  }

  void exchangesAreUndone() {
    const std::vector<int> swaps{3, 1, 4, 4, 4};
    const Eigen::MatrixXd x = randomMatrix(5, 19, 1);
    Eigen::MatrixXd y = x;
    exchangeRows(5, swaps.data(), 19, y.data(), 5);
    QVERIFY(y.row(0) == x.row(3));
    QVERIFY(y.row(2) == x.row(4));
    exchangeRowsBack(5, swaps.data(), 19, y.data(), 5);
    QVERIFY(y == x);
  }
};

QTEST_GUILESS_MAIN(DenseKernelsTest)
#include "test_dense_kernels.moc"
