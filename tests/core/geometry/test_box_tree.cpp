#include <QTest>
#include <algorithm>
#include <limits>
#include <random>

#include "core/geometry/box_tree.hpp"
#include "core/math/parallel.hpp"

using namespace pliant;
using geometry::BoxTree;

namespace {

std::vector<BoxTree::Box> randomBoxes(int count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1), extent(0, size);
  std::vector<BoxTree::Box> boxes;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d low = Eigen::Vector3d::NullaryExpr([&] { return coordinate(random); });
    const Eigen::Vector3d sizes = Eigen::Vector3d::NullaryExpr([&] { return extent(random); });
    boxes.emplace_back(low, low + sizes);
  }
  return boxes;
}

bool overlapOnAllAxes(const BoxTree::Box& a, const BoxTree::Box& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(a.min()[axis] <= b.max()[axis] && b.min()[axis] <= a.max()[axis])) return false;
  return true;
}

BoxTree::Pairs bruteForce(const std::vector<BoxTree::Box>& a, const std::vector<BoxTree::Box>& b) {
  BoxTree::Pairs pairs;
  for (int i = 0; i < static_cast<int>(a.size()); ++i)
    for (int j = 0; j < static_cast<int>(b.size()); ++j)
      if (overlapOnAllAxes(a[i], b[j])) pairs.push_back({i, j});
  return pairs;
}

BoxTree::Pairs upper(const BoxTree::Pairs& pairs) {
  BoxTree::Pairs kept;
  for (const auto& pair : pairs)
    if (pair[0] < pair[1]) kept.push_back(pair);
  return kept;
}

BoxTree::Pairs sorted(BoxTree::Pairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool all(int, int) { return true; }

}  // namespace

class TestBoxTree : public QObject {
  Q_OBJECT

 private slots:
  void pairsAreThoseOfBruteForce_data();
  void pairsAreThoseOfBruteForce();
  void filterIsAsked();
  void sameForAnyNumberOfThreads();
  void boxesAtOnePlace();
  void touchingEmptyAndInvalidBoxes();
  void rebuilding();
};

void TestBoxTree::pairsAreThoseOfBruteForce_data() {
  QTest::addColumn<int>("count");
  QTest::addColumn<double>("size");
  for (const int count : {0, 1, 2, 7, 8, 9, 16, 17, 63, 64, 65, 129, 700, 1500})
    for (const double size : {0.02, 0.3}) QTest::addRow("%d boxes up to %g", count, size) << count << size;
}

void TestBoxTree::pairsAreThoseOfBruteForce() {
  QFETCH(int, count);
  QFETCH(double, size);
  const auto boxes = randomBoxes(count, size, 1), others = randomBoxes(count / 2 + 3, size, 2);
  const BoxTree tree(boxes), otherTree(others);
  QCOMPARE(tree.size(), count);
  QVERIFY(sorted(tree.ownPairs(all)) == upper(bruteForce(boxes, boxes)));
  QVERIFY(sorted(tree.pairsWith(otherTree, all)) == bruteForce(boxes, others));
  QVERIFY(sorted(otherTree.pairsWith(tree, all)) == bruteForce(others, boxes));
  QVERIFY(sorted(tree.pairsWith(tree, all)) == bruteForce(boxes, boxes));
}

void TestBoxTree::filterIsAsked() {
  const auto boxes = randomBoxes(500, 0.3, 3);
  auto expected = upper(bruteForce(boxes, boxes));
  std::erase_if(expected, [](const auto& pair) { return (pair[0] + pair[1]) % 3 != 0; });
  QVERIFY(!expected.empty());
  QVERIFY(sorted(BoxTree(boxes).ownPairs([](int i, int j) { return i < j && (i + j) % 3 == 0; })) == expected);
}

void TestBoxTree::sameForAnyNumberOfThreads() {
  const BoxTree tree(randomBoxes(5000, 0.1, 4));
  math::setThreadCount(1);
  const auto alone = tree.ownPairs(all);
  math::setThreadCount(4);
  const auto together = tree.ownPairs(all);
  math::setThreadCount(0);
  QVERIFY(alone.size() > 1000);
  QVERIFY(alone == together);  // in the same order
}

void TestBoxTree::boxesAtOnePlace() {
  const std::vector<BoxTree::Box> boxes(100, BoxTree::Box(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 3)));
  QCOMPARE(BoxTree(boxes).ownPairs(all).size(), std::size_t(100 * 99 / 2));
}

void TestBoxTree::touchingEmptyAndInvalidBoxes() {
  const Eigen::Vector3d one = Eigen::Vector3d::Ones();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<BoxTree::Box> boxes = {
      {-one, one}, {one, 2 * one}, BoxTree::Box(), {nan * one, nan * one}, {-one, Eigen::Vector3d(1, nan, 1)}};
  QVERIFY((BoxTree(boxes).ownPairs(all) == BoxTree::Pairs{{0, 1}}));
}

void TestBoxTree::rebuilding() {
  BoxTree tree(randomBoxes(1000, 0.3, 5));
  for (const int count : {10, 2000, 0, 1, 300}) {
    const auto boxes = randomBoxes(count, 0.3, 6);
    tree.build(boxes);
    QVERIFY(sorted(tree.ownPairs(all)) == upper(bruteForce(boxes, boxes)));
  }
}

QTEST_GUILESS_MAIN(TestBoxTree)
#include "test_box_tree.moc"
