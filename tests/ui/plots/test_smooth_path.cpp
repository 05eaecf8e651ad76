#include <QTest>
#include <cmath>
#include <numbers>

#include "ui/plots/smooth_path.hpp"

using pliant::plots::smoothPath;

namespace {

/// Unevenly placed points on half an ellipse, far wider than high.
QVector<QPointF> halfEllipse(int count) {
  QVector<QPointF> points;
  for (int i = 0; i < count; ++i) {
    const double u = static_cast<double>(i) / (count - 1);
    const double angle = std::numbers::pi * (0.7 * u + 0.3 * u * u);
    points.push_back({1000 * std::cos(angle), 0.01 * std::sin(angle)});
  }
  return points;
}

double distanceFromEllipse(const QPointF& p) { return std::abs(std::hypot(p.x() / 1000, p.y() / 0.01) - 1); }

double distanceOfChords(const QVector<QPointF>& points) {
  double largest = 0;
  for (qsizetype i = 0; i + 1 < points.size(); ++i)
    largest = std::max(largest, distanceFromEllipse((points[i] + points[i + 1]) / 2));
  return largest;
}

}  // namespace

class TestSmoothPath : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void passesThroughThePoints() {
    const auto points = halfEllipse(9);
    const auto path = smoothPath(points, 4);
    QCOMPARE(path.size(), 8 * 5 + 1);
    for (int i = 0; i < 9; ++i) QCOMPARE(path[5 * i], points[i]);
  }

  void isCloserToACurveThanChordsAre() {
    const auto points = halfEllipse(13);
    double largest = 0;
    // The first and the last gap have a neighbour on one side only.
    const auto path = smoothPath(points, 7);
    for (qsizetype i = 8; i < path.size() - 8; ++i) largest = std::max(largest, distanceFromEllipse(path[i]));
    QVERIFY2(largest < 0.1 * distanceOfChords(points), qPrintable(QString::number(largest)));
  }

  void growthChangesOnlyTheLastGap() {
    const auto points = halfEllipse(12);
    QVector<QPointF> whole = points;
    whole.push_back({-1000, 0.002});  // inside the extent: the units stay
    const auto before = smoothPath(points, 3), after = smoothPath(whole, 3);
    for (qsizetype i = 0; i < before.size() - 4; ++i) QCOMPARE(after[i], before[i]);
  }

  void equalPointsAndShortPathsAreHarmless() {
    QCOMPARE(smoothPath({}, 5).size(), 0);
    QCOMPARE(smoothPath({{1, 2}, {3, 4}}, 5).size(), 2);
    for (const QPointF& p : smoothPath({{0, 0}, {1, 1}, {1, 1}, {2, 0}, {2, 0}}, 5))
      QVERIFY(std::isfinite(p.x()) && std::isfinite(p.y()));
  }
};

QTEST_GUILESS_MAIN(TestSmoothPath)
#include "test_smooth_path.moc"
