#include <Eigen/SparseCholesky>
#include <QTest>
#include <limits>
#include <random>
#include <set>

#include "core/math/block_cholesky.hpp"
#include "core/math/parallel.hpp"

using pliant::math::BlockCholesky;
using Pairs = std::vector<std::array<int, 2>>;

namespace {

/// A grid of triangles, n x n vertices, some of them left alone.
Pairs gridPairs(int n) {
  Pairs pairs;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int v = i * n + j;
      if (i + 1 < n) pairs.push_back({v, v + n});
      if (j + 1 < n) pairs.push_back({v + 1, v});
      if (i + 1 < n && j + 1 < n) pairs.push_back({v, v + n + 1});
    }
  return pairs;
}

Pairs randomPairs(int count, int edges, unsigned seed) {
  std::mt19937 generator(seed);
  Pairs pairs;
  for (int e = 0; e < edges; ++e)
    pairs.push_back({static_cast<int>(generator() % count), static_cast<int>(generator() % count)});
  return pairs;
}

/// Σ over pairs of a random positive definite 6 x 6 matrix, and `shift` on the diagonal: as sparse matrix and in place.
Eigen::SparseMatrix<double> fill(BlockCholesky& cholesky, int count, const Pairs& pairs, double shift, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Eigen::Triplet<double>> entries;
  cholesky.clear();
  const auto add = [&](int a, int b, const Eigen::Matrix3d& block) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        entries.emplace_back(3 * a + i, 3 * b + j, block(i, j));
        if (a != b) entries.emplace_back(3 * b + j, 3 * a + i, block(i, j));
      }
    const auto place = cholesky.place(a, b);
    const Eigen::Matrix3d stored = place.transposed ? Eigen::Matrix3d(block.transpose()) : block;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) cholesky.values()[place.offset + Eigen::Index{j} * place.stride + i] += stored(i, j);
  };
  for (int v = 0; v < count; ++v) add(v, v, shift * Eigen::Matrix3d::Identity());
  for (const auto& [a, b] : pairs) {
    if (a == b) continue;
    const Eigen::Matrix<double, 6, 6> factor =
        Eigen::Matrix<double, 6, 6>::NullaryExpr([&] { return uniform(generator); });
    const Eigen::Matrix<double, 6, 6> block = factor * factor.transpose();
    add(a, a, block.topLeftCorner<3, 3>());
    add(b, b, block.bottomRightCorner<3, 3>());
    add(a, b, block.topRightCorner<3, 3>());
  }
  Eigen::SparseMatrix<double> matrix(3 * count, 3 * count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

class TestBlockCholesky : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void solves_data() {
    QTest::addColumn<int>("count");
    QTest::addColumn<Pairs>("pairs");
    QTest::newRow("one vertex") << 1 << Pairs{};
    QTest::newRow("no pairs") << 5 << Pairs{};
    QTest::newRow("two vertices, given twice") << 2 << Pairs{{0, 1}, {1, 0}};
    for (const int n : {2, 3, 7, 30, 45}) QTest::addRow("grid %d", n) << n * n << gridPairs(n);
    for (const int seed : {1, 2, 3}) QTest::addRow("random %d", seed) << 80 << randomPairs(80, 120, seed);
    QTest::newRow("full") << 40 << randomPairs(40, 5000, 4);
    QTest::newRow("several parts") << 300 << randomPairs(300, 150, 5);
  }

  void solves() {
    QFETCH(int, count);
    QFETCH(Pairs, pairs);
    BlockCholesky cholesky(count, pairs);
    for (const unsigned seed : {1u, 2u}) {  // twice: memory is used again
      const Eigen::SparseMatrix<double> matrix = fill(cholesky, count, pairs, 0.1, seed);
      const Eigen::VectorXd expected = Eigen::VectorXd::LinSpaced(3 * count, -1, 2);
      QVERIFY(cholesky.factorize());
      Eigen::VectorXd x = matrix * expected;
      cholesky.solve(x);
      const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> oracle(matrix);
      const Eigen::VectorXd theirs = oracle.solve(matrix * expected);
      // Both lose digits to the condition of the matrix; ours no more than ten times theirs.
      QVERIFY((x - expected).norm() <= 10 * (theirs - expected).norm() + 1e-13 * expected.norm());
      QVERIFY((matrix * x - matrix * expected).norm() <= 1e-13 * (matrix.norm() * x.norm()));
    }
  }

  void tellsWhatIsNotPositiveDefinite() {
    const Pairs pairs = gridPairs(12);
    BlockCholesky cholesky(144, pairs);
    fill(cholesky, 144, pairs, -20, 1);
    QVERIFY(!cholesky.factorize());
    fill(cholesky, 144, pairs, 0.1, 1);
    QVERIFY(cholesky.factorize());
    fill(cholesky, 144, pairs, 0.1, 1);
    cholesky.values()[cholesky.place(70, 71).offset] = std::numeric_limits<double>::quiet_NaN();
    QVERIFY(!cholesky.factorize());
    fill(cholesky, 144, {}, 0, 1);
    QVERIFY(!cholesky.factorize());
  }

  void doesNotDependOnTheThreads() {
    const int n = 60;
    const Pairs pairs = gridPairs(n);
    std::vector<Eigen::VectorXd> solutions;
    for (const int threads : {1, 2, 4}) {
      pliant::math::setThreadCount(threads);
      BlockCholesky cholesky(n * n, pairs);
      fill(cholesky, n * n, pairs, 0.1, 1);
      QVERIFY(cholesky.factorize());
      solutions.push_back(Eigen::VectorXd::LinSpaced(3 * n * n, 0, 1));
      cholesky.solve(solutions.back());
    }
    pliant::math::setThreadCount(0);
    QVERIFY(solutions[0] == solutions[1]);
    QVERIFY(solutions[0] == solutions[2]);
  }
};

QTEST_GUILESS_MAIN(TestBlockCholesky)
#include "test_block_cholesky.moc"
