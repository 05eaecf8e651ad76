#include "core/cloth/projection_program.hpp"

#include <QTest>

#include "tests/core/solvers/sheet_examples.hpp"

using namespace pliant;
using cloth::ProjectionProgram;

namespace {

struct Evaluations {
  Eigen::VectorXd gradient, values;
  Eigen::MatrixXd jacobian, hessian;  ///< dense; the Hessian of factor f + Σ λ g
};

/// The problem's functions through Ipopt's interface, its sparse entries summed up.
class Wrapped {
 public:
  explicit Wrapped(ProjectionProgram& program) : program_(program) {
    Ipopt::TNLP::IndexStyleEnum style;
    program.get_nlp_info(variables, rows, jacobianEntries_, hessianEntries_, style);
  }

  double value(const Eigen::VectorXd& x) const {
    double result = 0;
    program_.eval_f(variables, x.data(), true, result);
    return result;
  }

  Evaluations at(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& lambda) const {
    Evaluations result{Eigen::VectorXd(variables), Eigen::VectorXd(rows), Eigen::MatrixXd::Zero(rows, variables),
                       Eigen::MatrixXd::Zero(variables, variables)};
    program_.eval_grad_f(variables, x.data(), true, result.gradient.data());
    program_.eval_g(variables, x.data(), true, rows, result.values.data());
    std::vector<Ipopt::Index> i(jacobianEntries_), j(jacobianEntries_);
    std::vector<double> entries(jacobianEntries_);
    program_.eval_jac_g(variables, nullptr, true, rows, jacobianEntries_, i.data(), j.data(), nullptr);
    program_.eval_jac_g(variables, x.data(), true, rows, jacobianEntries_, nullptr, nullptr, entries.data());
    for (int k = 0; k < jacobianEntries_; ++k) result.jacobian(i[k], j[k]) += entries[k];
    i.resize(hessianEntries_);
    j.resize(hessianEntries_);
    entries.resize(hessianEntries_);
    program_.eval_h(
        variables, nullptr, true, factor, rows, nullptr, true, hessianEntries_, i.data(), j.data(), nullptr);
    program_.eval_h(variables, x.data(), true, factor, rows, lambda.data(), true, hessianEntries_, nullptr, nullptr,
                    entries.data());
    for (int k = 0; k < hessianEntries_; ++k) {
      if (j[k] > i[k]) throw std::logic_error("an entry above the diagonal");
      result.hessian(i[k], j[k]) += entries[k];
      if (i[k] != j[k]) result.hessian(j[k], i[k]) += entries[k];
    }
    return result;
  }

  Ipopt::Index variables = 0, rows = 0;

 private:
  ProjectionProgram& program_;
  Ipopt::Index jacobianEntries_ = 0, hessianEntries_ = 0;
};

}  // namespace

class TestProjectionProgram : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void derivativesAreThoseOfTheFunctions_data() {
    QTest::addColumn<int>("kind");
    for (int kind = 0; kind < 3; ++kind) QTest::addRow("%d", kind) << kind;
  }

  /// Kinds: 0 two ellipses, 1 directions, 2 both.
  void derivativesAreThoseOfTheFunctions() {
    QFETCH(int, kind);
    tests::Sheet sheet = tests::makeSheet(2);
    solvers::MetricBounds bounds = tests::directionBounds(1.1, 3);
    if (kind != 1) bounds.ellipses = {Eigen::Matrix2d{{1.3, 0.2}, {0.2, 1.1}}, 1.21 * Eigen::Matrix2d::Identity()};
    if (kind == 0) bounds.directions.clear();
    sheet.constraints.bounds = {bounds};
    sheet.constraints.fixed[4] = sheet.constraints.fixed[8] = 1;
    base::ExecutionContext context;
    const Eigen::Matrix3Xd candidate = tests::disturbed(sheet.rest, 0.3, 2);
    const Ipopt::SmartPtr<ProjectionProgram> program =
        new ProjectionProgram(sheet.constraints, candidate, sheet.rest, context);
    const Wrapped wrapped(*program);
    QCOMPARE(wrapped.variables, 21);
    QCOMPARE(wrapped.rows, 8 * (kind == 0 ? 4 : kind == 1 ? 3 : 7));

    std::mt19937 random(4);
    std::uniform_real_distribution<double> number(-1, 1);
    Eigen::VectorXd x(wrapped.variables), lambda(wrapped.rows);
    for (double& entry : x) entry = number(random);
    for (double& entry : lambda) entry = number(random);
    const double factor = 0.7;
    const Evaluations at = wrapped.at(x, factor, lambda);
    // All are polynomials of degree 4 at most: central differences of size h are off by h² / 6 times their third
    // derivative, of the size of the entries times the gradients of the elements (2 to 3 per m) squared, and by the
    // rounding of their values, 1e-16 / h of them.
    const double h = 1e-5, tolerance = 1e-8;
    Eigen::VectorXd gradient(x.size());
    Eigen::MatrixXd jacobian(wrapped.rows, x.size()), hessian(x.size(), x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), i);
      const Evaluations after = wrapped.at(x + step, factor, lambda), before = wrapped.at(x - step, factor, lambda);
      gradient[i] = (wrapped.value(x + step) - wrapped.value(x - step)) / (2 * h);
      jacobian.col(i) = (after.values - before.values) / (2 * h);
      hessian.col(i) =
          (factor * (after.gradient - before.gradient) + (after.jacobian - before.jacobian).transpose() * lambda) /
          (2 * h);
    }
    QVERIFY((gradient - at.gradient).norm() <= tolerance * at.gradient.norm());
    QVERIFY((jacobian - at.jacobian).norm() <= tolerance * at.jacobian.norm());
    QVERIFY((hessian - at.hessian).norm() <= tolerance * at.hessian.norm());
  }
};

QTEST_GUILESS_MAIN(TestProjectionProgram)
#include "test_projection_program.moc"
