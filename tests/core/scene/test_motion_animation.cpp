#include <QTest>
#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/motion_animation.hpp"

using namespace pliant;

/// Motions as meshes that move.
class TestMotionAnimation : public QObject {
  Q_OBJECT

  const std::filesystem::path scenes_ = PLIANT_SOURCE_DIR "/scenes/harmonic";

 private slots:
  /// A node that swings as r (sin τ, cos 2τ) is there in every frame, and the last frame is the first.
  void aPeriodEndsAsItBegins() {
    const auto model = scene::buildModel(scene::Scene::load(scenes_ / "membrane_strip.json"));
    const harmonic::HarmonicBalanceProblem problem(model, math::HarmonicBasis(2, 8));
    mechanics::Vector z = mechanics::Vector::Zero(problem.size());
    const int node = model->dofs.freeCoordinates.front() / model->dimension;
    QCOMPARE(model->dofs.freeCoordinates[1], model->dofs.freeCoordinates[0] + 1);
    const double x = model->restPositions[2 * node], y = model->restPositions[2 * node + 1], r = 0.01;
    z[0] = x, z[1] = r;      // x + r sin τ
    z[5] = y, z[5 + 4] = r;  // y + r cos 2τ
    const geometry::MeshAnimation animation = scene::periodAnimation(problem, z, 12, 3);
    QCOMPARE(animation.frames.size(), 13u);
    QCOMPARE(animation.times.front(), 0.0);
    QCOMPARE(animation.times.back(), 3.0);
    QVERIFY(animation.frames.front() == animation.frames.back());
    for (int i = 0; i < 12; ++i) {
      const double tau = 2 * std::numbers::pi * i / 12;
      const Eigen::Vector3d expected(x + r * std::sin(tau), y + r * std::cos(2 * tau), 0);
      QVERIFY((animation.frames[static_cast<std::size_t>(i)].col(node) - expected).norm() < 1e-12);
    }
  }

  void whatHasNoTrianglesIsSaid() {
    const auto model = scene::buildModel(scene::Scene::load(scenes_ / "duffing.json"));
    const harmonic::HarmonicBalanceProblem problem(model, math::HarmonicBasis(1, 8));
    const mechanics::Vector z = mechanics::Vector::Zero(problem.size());
    QVERIFY_EXCEPTION_THROWN(scene::periodAnimation(problem, z, 12, 3), base::InputError);
    QVERIFY_EXCEPTION_THROWN(scene::periodAnimation(problem, z, 0, 3), base::InputError);
  }
};

QTEST_GUILESS_MAIN(TestMotionAnimation)
#include "test_motion_animation.moc"
