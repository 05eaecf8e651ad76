#include "ui/render/predicted_motion.hpp"

#include <QTest>

#include "tests/ui/render/pixels.hpp"
#include "tests/ui/render/swinging_fork.hpp"
#include "ui/render/motion_view.hpp"
#include "ui/render/offscreen_target.hpp"

namespace pliant::render {

namespace {

/// The fork with its base driven by `amplitude` [m] along z, in place of 4 mm.
std::shared_ptr<const mechanics::Model> drivenBy(const SwingingFork& fork, double amplitude) {
  mechanics::Model changed = *fork.model;
  changed.drives = {
      mechanics::makeTranslation(changed.drivenNodes(), mechanics::Vector::Unit(3, 2), {.terms = {{1, amplitude, 0}}})};
  changed.finish();
  return std::make_shared<const mechanics::Model>(std::move(changed));
}

}  // namespace

class TestPredictedMotion : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void drivenNodesFollowTheChangedDrive_data() {
    QTest::addColumn<int>("drivePeriods");
    QTest::newRow("once a period") << 1;
    QTest::newRow("twice a period") << 2;
  }

  void drivenNodesFollowTheChangedDrive() {
    QFETCH(int, drivePeriods);
    const SwingingFork fork;
    const auto problem =
        std::make_shared<const harmonic::HarmonicBalanceProblem>(fork.problem->withDrivePeriods(drivePeriods));
    const mechanics::Vector z = fork.problem->stretched(fork.motion(0.03), drivePeriods);
    const PredictedMotion solved{problem, z, nullptr}, changed{problem, z, drivenBy(fork, 0.009)};
    const std::vector<int> base = fork.model->drivenNodes();
    QVERIFY(!base.empty());
    const mechanics::Matrix paths = changed.trajectories();
    for (Eigen::Index i = 0; i < paths.rows(); ++i) {
      const double tau = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(paths.rows());
      const mechanics::Vector x = changed.configurationAt(tau);
      for (const int node : base) {
        const Eigen::Vector3d rest = fork.model->restPositions.segment<3>(3 * node);
        const Eigen::Vector3d expected = rest + Eigen::Vector3d(0, 0, 0.009 * std::cos(drivePeriods * tau));
        QVERIFY((x.segment<3>(3 * node) - expected).norm() <= 1e-15);
      }
      const auto& free = fork.model->dofs.freeCoordinates;
      QVERIFY(x(free) == solved.configurationAt(tau)(free));
      QVERIFY((paths.row(i).transpose() - x).cwiseAbs().maxCoeff() <= 1e-14);
    }
    QVERIFY(solved.trajectories() == problem->trajectories(z));
  }

  /// Where the drive is zero nothing changes; elsewhere the ghost's base moves on.
  void theGhostIsDrawnWithTheChangedDrive() {
    const SwingingFork fork;
    const auto changed = drivenBy(fork, 0.02);
    OffscreenTarget target(makeMesaContext());
    target.setSize(480, 320);
    MotionView view;
    view.attach(target.window());
    view.setModel(fork.model);
    view.setMotion(fork.problem, fork.motion(0.03));
    view.setAxisView(AxisView::front);
    const auto draw = [&](double tau, const std::shared_ptr<const mechanics::Model>& model) {
      Image image;
      view.setTau(tau);
      view.setPrediction(fork.motion(0.03), model);
      target.render(image);
      return image.pixels;
    };
    QVERIFY(draw(std::numbers::pi / 2, changed) == draw(std::numbers::pi / 2, nullptr));
    QVERIFY(draw(0, changed) != draw(0, nullptr));
    QVERIFY(draw(0, drivenBy(fork, 0.004)) == draw(0, nullptr));
    // The motion is played on with the prediction that stands.
    view.setPrediction(fork.motion(0.03), changed);
    view.setTau(0);
    Image played;
    target.render(played);
    QVERIFY(played.pixels == draw(0, changed));
  }
};

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestPredictedMotion)
#include "test_predicted_motion.moc"
