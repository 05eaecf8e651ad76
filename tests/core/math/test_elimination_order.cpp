#include <QTest>
#include <algorithm>
#include <atomic>
#include <numeric>
#include <vector>

#include "core/math/elimination_order.hpp"
#include "core/math/parallel.hpp"
#include "core/math/residual.hpp"
#include "core/math/supernode_tree.hpp"
#include "core/math/tree_traversal.hpp"
#include "tests/core/math/block_matrices.hpp"

using namespace pliant::math;
using namespace pliant::tests;

/// What is done once per pattern: blocks, order, tree; and products with the blocks.
class EliminationOrderTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { setThreadCount(0); }

  void nodesAreFoundAsVertices() {
    const BlockPattern pattern(harmonicMatrix({4, 5, 2, true}));
    QCOMPARE(pattern.vertexCount(), 4 * 5 + 1);
    for (int v = 0; v < 20; ++v) QCOMPARE(pattern.width(v), 3 * 5);
    QCOMPARE(pattern.width(20), 1);
    QCOMPARE(pattern.degree(20), 20);
    for (int v = 0; v < 20; ++v) {
      for (int k = pattern.starts[v]; k < pattern.starts[v + 1]; ++k) {
        const int u = pattern.neighbors[k];
        QVERIFY(u != v);
        QVERIFY(std::binary_search(
            pattern.neighbors.begin() + pattern.starts[u], pattern.neighbors.begin() + pattern.starts[u + 1], v));
      }
    }
  }

  void ordersArePermutationsWithTheBorderLast() {
    const BlockPattern pattern(harmonicMatrix({6, 7, 1, true}));
    const auto orders = eliminationOrders(pattern);
    QVERIFY(orders.size() > 1);
    for (std::vector<int> order : orders) {
      QCOMPARE(order.back(), 42);
      std::sort(order.begin(), order.end());
      std::vector<int> all(43);
      std::iota(all.begin(), all.end(), 0);
      QVERIFY(order == all);
    }
    setThreadCount(1);
    QVERIFY(eliminationOrders(pattern) == orders);
  }

  void ordersSaveWork() {
    const BlockPattern pattern(harmonicMatrix({9, 10, 1}));
    std::vector<int> natural(pattern.vertexCount());
    std::iota(natural.begin(), natural.end(), 0);
    double best = SupernodeTree(pattern, natural).flops;
    for (const auto& order : eliminationOrders(pattern)) best = std::min(best, SupernodeTree(pattern, order).flops);
    QVERIFY(best < 0.7 * SupernodeTree(pattern, natural).flops);
  }

  void supernodesCoverTheMatrix() {
    const BlockPattern pattern(harmonicMatrix({6, 7, 3, true}));
    const SupernodeTree tree(pattern, eliminationOrders(pattern).front());
    int pivots = 0;
    for (std::size_t s = 0; s < tree.supernodes.size(); ++s) {
      const auto& node = tree.supernodes[s];
      QCOMPARE(node.firstPivot, pivots);
      pivots += node.pivots;
      QCOMPARE(node.parent < 0, node.rows == 0);
      QVERIFY(node.parent < 0 || node.parent > static_cast<int>(s));
    }
    QCOMPARE(pivots, pattern.firstColumn.back());
    QVERIFY2(tree.supernodes.back().pivots > 1, "the border must share its pivots with others");
  }

  void treesAreTraversedInOrder() {
    std::vector<int> parent(300);
    for (int node = 0; node < 300; ++node) parent[node] = node % 60 == 59 ? -1 : node + 1 + node * 7 % (59 - node % 60);
    const TreeTraversal traversal(parent);
    for (const int threads : {1, 3}) {
      setThreadCount(threads);
      std::vector<std::atomic<int>> visits(300);
      std::atomic<int> faults{0};
      std::atomic<int> slotCount{0};
      traversal.childrenFirst([&](int count) { slotCount = count; },
                              [&](int node) {
                                if (TreeTraversal::slot() < 0 || TreeTraversal::slot() >= slotCount) ++faults;
                                for (int child = 0; child < 300; ++child) {
                                  if (parent[child] == node && visits[child] != 1) ++faults;
                                }
                                ++visits[node];
                              });
      traversal.parentsFirst([&](int node) {
        if (parent[node] >= 0 && visits[parent[node]] != 2) ++faults;
        ++visits[node];
      });
      QCOMPARE(faults.load(), 0);
      QVERIFY(std::all_of(visits.begin(), visits.end(), [](const auto& count) { return count == 2; }));
    }
  }

  void residualsAreThoseOfTheMatrix() {
    for (const HarmonicMatrixSpec& spec : {HarmonicMatrixSpec{2, 2, 1, true}, HarmonicMatrixSpec{4, 5, 2, true}}) {
      const Eigen::SparseMatrix<double> matrix = harmonicMatrix(spec);
      const Eigen::MatrixXd x = randomMatrix(matrix.rows(), 3, 1);
      const Eigen::MatrixXd b = randomMatrix(matrix.rows(), 3, 2);
      const BlockPattern pattern(matrix);
      const Eigen::MatrixXd direct = b - matrix * x;
      const Eigen::MatrixXd transposed = b - matrix.transpose() * x;
      QVERIFY(relativeDifference(residual(matrix, pattern, false, x, b), direct) < 1e-13);
      QVERIFY(relativeDifference(residual(matrix, pattern, true, x, b), transposed) < 1e-13);
    }
  }
};

QTEST_GUILESS_MAIN(EliminationOrderTest)
#include "test_elimination_order.moc"
