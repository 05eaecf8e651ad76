#include <QtTest>

#include "core/mechanics/spring.hpp"
#include "ui/render/figure.hpp"

using namespace pliant;

class TestFigure : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// A spring to a fixed place is drawn from its node, wherever that is, to the place.
  void tetherEndsAtItsAnchor() {
    mechanics::Model model;
    model.dimension = 2;
    model.restPositions = Eigen::Vector4d(0, 0, 1, 0);
    model.gravity = Eigen::Vector2d::Zero();
    model.pointMasses = {{"mass", {0, 1}, 1, 0, 1}};
    model.parts.resize(1);
    model.parts[0].tethers = {{1, Eigen::Vector2d(3, 4)}};
    model.finish();
    const render::FigureLayout layout(model);
    QCOMPARE(layout.springs.size(), 1u);
    const render::Points pose = layout.pose(Eigen::Vector4d(0, 0, 1, 0.5));
    QCOMPARE(pose.cols(), 3);
    QVERIFY(pose.col(layout.springs[0][0]) == Eigen::Vector3d(1, 0.5, 0));
    QVERIFY(pose.col(layout.springs[0][1]) == Eigen::Vector3d(3, 4, 0));
    QVERIFY(layout.size >= 5);  // what is to be seen reaches to the anchor
  }
};

QTEST_GUILESS_MAIN(TestFigure)
#include "test_figure.moc"
