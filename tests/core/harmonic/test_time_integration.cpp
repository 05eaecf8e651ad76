#include <Eigen/SparseLU>
#include <QtTest>

#include "core/harmonic/periodic_motion.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;

namespace {

/// The trapezoidal rule on d/dt (M v + D_β ∇E(x)) = f - ∇E(x) - D_α M v, which is Newmark's method with β = 1/4 and
/// γ = 1/2 (thesis 2.A.3) where D_β = 0, and needs no derivative of the tangent damping otherwise.
class TimeIntegration {
 public:
  TimeIntegration(std::shared_ptr<const Model> model, double omega, double step)
      : model_(model), assembler_(model), mass_(model->massMatrix()), omega_(omega), step_(step) {}

  void start(const Vector& positions, const Vector& velocities) {
    time_ = 0;
    x_ = positions;
    v_ = velocities;
  }

  const Vector& positions() const { return x_; }

  void advance() {
    const auto& free = model_->dofs.freeCoordinates;
    const Model& m = *model_;
    const double next = time_ + step_;
    const Vector forceNow = unbalanced(x_, v_, time_);
    const Vector elasticNow = assembler_.gradient(x_);
    const Vector velocityNow = v_;
    Vector x1 = m.configuration((x_ + step_ * v_)(free), omega_ * next);
    const Vector base = x_;
    for (int iteration = 0; iteration < 20; ++iteration) {
      Vector v1 = prescribedVelocity(next);
      v1(free) = (2 / step_ * (x1 - base) - velocityNow)(free);
      const Vector r = (mass_ * (v1 - velocityNow) + m.stiffnessDamping * (assembler_.gradient(x1) - elasticNow) -
                        0.5 * step_ * (forceNow + unbalanced(x1, v1, next)))(free);
      const SparseMatrix k = assembler_.hessian(x1);
      const SparseMatrix jacobian = freeBlock() * (2 / step_ + m.massDamping) + k * (m.stiffnessDamping + 0.5 * step_);
      Eigen::SparseLU<SparseMatrix> lu(jacobian);
      const Vector change = lu.solve(r);
      Vector moved = x1(free) - change;
      x1 = m.configuration(moved, omega_ * next);
      v_ = v1;
      if (change.norm() < 1e-13) break;
    }
    x_ = x1;
    v_ = prescribedVelocity(next);
    v_(free) = (2 / step_ * (x1 - base) - velocityNow)(free);
    time_ = next;
  }

 private:
  Vector unbalanced(const Vector& x, const Vector& v, double t) const {
    return model_->externalForce(omega_ * t) - assembler_.gradient(x) - model_->massDamping * (mass_ * v);
  }
  Vector prescribedVelocity(double t) const {
    const Vector any = Vector::Zero(model_->dofs.freeCount());
    const double h = 1e-3;
    const auto at = [&](double steps) { return model_->configuration(any, omega_ * t + steps * h); };
    return omega_ * (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
  }
  SparseMatrix freeBlock() const {
    const auto& free = model_->dofs.freeCoordinates;
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t f = 0; f < free.size(); ++f)
      for (SparseMatrix::InnerIterator it(mass_, free[f]); it; ++it)
        if (model_->dofs.freeIndex[it.row()] >= 0)
          entries.emplace_back(model_->dofs.freeIndex[it.row()], static_cast<int>(f), it.value());
    SparseMatrix block(static_cast<Eigen::Index>(free.size()), static_cast<Eigen::Index>(free.size()));
    block.setFromTriplets(entries.begin(), entries.end());
    return block;
  }

  std::shared_ptr<const Model> model_;
  mechanics::ElasticAssembler assembler_;
  SparseMatrix mass_;
  double omega_;
  double step_;
  double time_ = 0;
  Vector x_;
  Vector v_;
};

std::shared_ptr<const Model> turnedStrip(mechanics::MassMatrix mass) {
  StripOptions options{4, 1, 1e7, 1e-3, mass, 0, true};
  const geometry::SurfaceMesh mesh = stripMesh(options);
  auto model = strip(options, mesh);
  model->massDamping = 4;
  model->stiffnessDamping = 2e-3;
  model->gravity = vector3(0, 0, -9.81);
  model->drives = {
      mechanics::makeRotation(clampedNodes(mesh, 0.026), vector3(0, 0, 0), Eigen::Vector3d::UnitY(), sine(0.35))};
  const int last = static_cast<int>(mesh.points.cols()) - 1;
  addPointMass(*model, "tip", {last}, 1e-4);
  model->probes = {{"tip", last}};
  model->finish();
  return model;
}

}  // namespace

/// Harmonic balance against time integration of the same model.
class TestTimeIntegration : public QObject {
  Q_OBJECT

 private slots:
  void steadyMotionsAgree_data();
  void steadyMotionsAgree();
};

void TestTimeIntegration::steadyMotionsAgree_data() {
  QTest::addColumn<int>("mass");
  QTest::newRow("lumped") << static_cast<int>(mechanics::MassMatrix::lumped);
  QTest::newRow("consistent") << static_cast<int>(mechanics::MassMatrix::consistent);
}

void TestTimeIntegration::steadyMotionsAgree() {
  QFETCH(int, mass);
  const auto model = turnedStrip(static_cast<mechanics::MassMatrix>(mass));
  const double omega = 14;
  const double period = 2 * std::numbers::pi / omega;
  HarmonicBalanceProblem problem(model, {14, 96});
  base::ExecutionContext context;
  const PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, {}, context);
  QVERIFY2(motion.report.converged(), motion.report.message.c_str());
  const int node = model->probes[0].node;
  const Matrix path = problem.nodeTrajectory(motion.z, node);
  double swing = 0;
  for (Eigen::Index i = 0; i < path.rows(); ++i) swing = std::max(swing, (path.row(i) - path.row(0)).norm());

  // From rest until the transient has died away; the error of the rule is of second order in the step.
  std::vector<double> errors;
  for (const int steps : {128, 256}) {
    TimeIntegration integration(model, omega, period / steps);
    const Vector atRest = problem.configurationAt(problem.restCoefficients(), 0);
    const Vector soon = problem.configurationAt(problem.restCoefficients(), 1e-4);
    integration.start(atRest, omega * (soon - atRest) / 1e-4);
    for (int i = 0; i < 14 * steps; ++i) integration.advance();
    double error = 0;
    for (int i = 0; i < steps; ++i) {
      const Vector expected = problem.configurationAt(motion.z, 2 * std::numbers::pi * i / steps);
      error = std::max(error, (integration.positions() - expected).segment(3 * node, 3).norm());
      integration.advance();
    }
    errors.push_back(error / swing);
  }
  QVERIFY2(errors[0] < 1e-2, qPrintable(QString::number(errors[0])));
  const double order = std::log2(errors[0] / errors[1]);
  QVERIFY2(order > 1.8 && order < 2.2, qPrintable(QString("%1 %2").arg(errors[0]).arg(errors[1])));
}

QTEST_GUILESS_MAIN(TestTimeIntegration)
#include "test_time_integration.moc"
