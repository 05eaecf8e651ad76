#include <QTest>

#include "core/mechanics/mechanism.hpp"
#include "ui/render/figure.hpp"

using namespace pliant;

class TestFigure : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// A spring to a fixed place is drawn from its node, wherever that is, to the place.
  void springEndsAtItsAnchor() {
    mechanics::Model model = twoMasses(2);
    model.parts[0].springs = {{mechanics::attachedToNode(2, 1), mechanics::fixedPlace(Eigen::Vector2d(3, 4))}};
    model.finish();
    const render::FigureLayout layout(model);
    QCOMPARE(layout.springs.size(), 1u);
    const render::Points pose = layout.pose(Eigen::Vector4d(0, 0, 1, 0.5));
    const Eigen::Vector3d from(1, 0.5, 0), to(3, 4, 0);
    QVERIFY(pose.col(layout.springs[0][0]) == from);
    QVERIFY(pose.col(layout.springs[0][1]) == to);
    QVERIFY(layout.size >= 5);  // what is to be seen reaches to the anchor
    QCOMPARE(layout.fixedPoints, std::vector<int>{layout.springs[0][1]});
  }

  /// Its coil is one line from end to end that stays beside the axis, in the plane in 2 dimensions.
  void coilJoinsTheEnds_data() {
    QTest::addColumn<int>("dimension");
    QTest::newRow("zigzag") << 2;
    QTest::newRow("helix") << 3;
  }
  void coilJoinsTheEnds() {
    QFETCH(int, dimension);
    mechanics::Model model = twoMasses(dimension);
    model.parts[0].springs = {{mechanics::attachedToNode(dimension, 0), mechanics::attachedToNode(dimension, 1)}};
    model.finish();
    const render::FigureLayout layout(model);
    const render::Points pose = layout.pose(model.restPositions);
    QCOMPARE(pose.col(layout.coils.front()[0]), Eigen::Vector3d(0, 0, 0));
    QCOMPARE(pose.col(layout.coils.back()[1]), Eigen::Vector3d(1, 0, 0));
    double widest = 0, deepest = 0;
    for (std::size_t i = 0; i < layout.coils.size(); ++i) {
      if (i > 0) QCOMPARE(layout.coils[i][0], layout.coils[i - 1][1]);
      const Eigen::Vector3d point = pose.col(layout.coils[i][1]);
      widest = std::max(widest, point.tail<2>().norm());
      deepest = std::max(deepest, std::abs(point.z()));
    }
    QVERIFY(widest > 0.005 && widest < 0.05);
    QCOMPARE(deepest > 1e-6, dimension == 3);
  }

 private:
  /// At distance 1 along x.
  static mechanics::Model twoMasses(int dimension) {
    mechanics::Model model;
    model.dimension = dimension;
    model.restPositions = Eigen::VectorXd::Unit(2 * dimension, dimension);
    model.gravity = Eigen::VectorXd::Zero(dimension);
    model.pointMasses = {{"mass", {0, 1}, 1, 0, 1}};
    model.parts.resize(1);
    return model;
  }
};

QTEST_GUILESS_MAIN(TestFigure)
#include "test_figure.moc"
