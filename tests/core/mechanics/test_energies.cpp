#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <QTest>
#include <random>

#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/registry.hpp"

using namespace pliant;
using mechanics::Matrix;
using mechanics::Vector;

namespace {

/// The derivatives are compared at shapes this far from rest, relative to the size of the example.
constexpr double deformation = 0.15;

double sizeOf(const mechanics::Model& model) { return model.restPositions.cwiseAbs().maxCoeff(); }

Vector randomShape(const mechanics::Model& model, std::mt19937& random) {
  const double size = sizeOf(model);
  std::uniform_real_distribution<double> step(-deformation * size, deformation * size);
  return model.restPositions + Vector::NullaryExpr(model.coordinateCount(), [&] { return step(random); });
}

/// Central differences of order 6 of a function of one variable, so that truncation lies far below rounding.
template <class Function>
auto derivative(const Function& f, double step) -> decltype(f(step)) {
  return ((45.0 * (f(step) - f(-step)) - 9.0 * (f(2 * step) - f(-2 * step)) + (f(3 * step) - f(-3 * step))) /
          (60.0 * step));
}

}  // namespace

/// Every registered kind of energy, at random large deformations.
class TestEnergies : public QObject {
  Q_OBJECT

 private slots:
  void gradientIsDerivativeOfValue_data() { kinds(); }
  void gradientIsDerivativeOfValue();
  void hessianIsDerivativeOfGradient_data() { kinds(); }
  void hessianIsDerivativeOfGradient();
  void convexHessianLeavesOutWhatIsIndefinite_data() { kinds(); }
  void convexHessianLeavesOutWhatIsIndefinite();
  void packetsAgreeWithScalars_data() { kinds(); }
  void packetsAgreeWithScalars();
  void rigidMotionsChangeNothing_data() { kinds(); }
  void rigidMotionsChangeNothing();

 private:
  static void kinds() {
    QTest::addColumn<int>("kind");
    for (std::size_t i = 0; i < mechanics::energyKinds().size(); ++i)
      QTest::newRow(mechanics::energyKinds()[i].name.c_str()) << static_cast<int>(i);
  }

  /// Calls check(model, random) for some random examples of this row's kind.
  template <class Check>
  static void forExamples(const Check& check) {
    QFETCH(int, kind);
    std::mt19937 random(12345 + kind);
    for (int example = 0; example < 5; ++example)
      check(std::make_shared<const mechanics::Model>(mechanics::energyKinds()[kind].example(random)), random);
  }
};

void TestEnergies::gradientIsDerivativeOfValue() {
  forExamples([](std::shared_ptr<const mechanics::Model> model, std::mt19937& random) {
    const mechanics::ElasticAssembler assembler(model);
    const Vector x = randomShape(*model, random);
    const Vector gradient = assembler.gradient(x);
    const double size = sizeOf(*model);
    for (int i = 0; i < x.size(); ++i) {
      const auto along = [&](double s) { return assembler.value(x + s * Vector::Unit(x.size(), i)); };
      QVERIFY(std::abs(derivative(along, 5e-4 * size) - gradient[i]) <= 1e-8 * gradient.norm());
    }
  });
}

void TestEnergies::hessianIsDerivativeOfGradient() {
  forExamples([](std::shared_ptr<const mechanics::Model> model, std::mt19937& random) {
    const mechanics::ElasticAssembler assembler(model);
    const Vector x = randomShape(*model, random);
    const Matrix hessian = assembler.hessian(x);
    QVERIFY(hessian == hessian.transpose());
    const double size = sizeOf(*model);
    for (int i = 0; i < x.size(); ++i) {
      const auto along = [&](double s) -> Vector { return assembler.gradient(x + s * Vector::Unit(x.size(), i)); };
      QVERIFY((derivative(along, 5e-4 * size) - hessian.col(i)).norm() <= 1e-8 * hessian.norm());
    }
  });
}

void TestEnergies::convexHessianLeavesOutWhatIsIndefinite() {
  forExamples([](std::shared_ptr<const mechanics::Model> model, std::mt19937& random) {
    const std::string_view name = model->energies.front()->name();
    const bool membrane = name == "membrane", hinge = name == "hinge_bending", limit = name.ends_with("_limit");
    const mechanics::ElasticAssembler assembler(model);
    const auto both = [&](const Vector& x) {
      std::array<Matrix, 2> hessians;
      for (const auto kind : {mechanics::HessianKind::exact, mechanics::HessianKind::convex}) {
        Vector entries;
        assembler.hessianEntries(x, entries, kind);
        Matrix& full = hessians[kind == mechanics::HessianKind::exact ? 0 : 1];
        full.setZero(model->dofs.freeCount(), model->dofs.freeCount());
        for (int s = 0; s < assembler.entryCount(); ++s)
          full(assembler.rows()[s], assembler.columns()[s]) = full(assembler.columns()[s], assembler.rows()[s]) =
              entries[s];
      }
      return hessians;
    };
    const auto smallestEigenvalue = [](const Matrix& matrix) {
      return Eigen::SelfAdjointEigenSolver<Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[0];
    };
    const auto [exact, convex] = both(randomShape(*model, random));
    if (!membrane && !hinge && !limit) {
      QVERIFY(convex == exact);
      return;
    }
    QVERIFY(smallestEigenvalue(convex) >= -1e-13 * convex.norm());
    if (membrane || name == "stretch_limit") QVERIFY(smallestEigenvalue(convex - exact) >= -1e-13 * convex.norm());
    if (limit) return;
    // Of what is stretched in all directions, and of hinges at rest, nothing is left out.
    const auto [exactHere, convexHere] = both((membrane ? 1.1 : 1.0) * model->restPositions);
    QVERIFY((convexHere - exactHere).norm() <= 1e-12 * exactHere.norm());
    // Of what is pressed together in all directions, the stresses are.
    if (membrane) QVERIFY(smallestEigenvalue(both(0.9 * model->restPositions)[0]) < 0);
  });
}

void TestEnergies::packetsAgreeWithScalars() {
  forExamples([](std::shared_ptr<const mechanics::Model> model, std::mt19937& random) {
    const mechanics::ElasticAssembler assembler(model);
    constexpr int rows = 16;
    Matrix x(rows, model->coordinateCount()), gradient, hessian, gradientAlone;
    for (int row = 0; row < rows; ++row) x.row(row) = randomShape(*model, random);
    assembler.evaluate(x, gradient, &hessian);
    assembler.evaluate(x, gradientAlone, nullptr);
    QVERIFY((gradient - gradientAlone).norm() <= 1e-14 * gradient.norm());
    for (int row = 0; row < rows; ++row) {
      const Vector expected = assembler.gradient(x.row(row));
      QVERIFY((gradient.row(row).transpose() - expected).norm() <= 1e-13 * expected.norm());
      const Matrix full = assembler.hessian(x.row(row));
      for (int s = 0; s < assembler.entryCount(); ++s)
        QVERIFY(std::abs(hessian(row, s) - full(assembler.rows()[s], assembler.columns()[s])) <= 1e-13 * full.norm());
    }
  });
}

void TestEnergies::rigidMotionsChangeNothing() {
  QFETCH(int, kind);
  const std::string& name = mechanics::energyKinds()[kind].name;
  if (name.starts_with("anchored") || name.starts_with("grounded")) return;  // tied to a place
  if (name.starts_with("rod")) return;  // turning it changes its twists as well: see TestRod
  forExamples([](std::shared_ptr<const mechanics::Model> model, std::mt19937& random) {
    const mechanics::ElasticAssembler assembler(model);
    const int dimension = model->dimension;
    const Vector x = randomShape(*model, random);
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if (dimension == 2) turn = Eigen::AngleAxisd(1.234, Eigen::Vector3d::UnitZ());
    if (dimension == 3) turn = Eigen::AngleAxisd(1.234, Eigen::Vector3d(1, -2, 0.5).normalized());
    const Matrix rotation = turn.topLeftCorner(dimension, dimension);
    const Vector shift = Vector::LinSpaced(dimension, 0.7, -0.4);
    const int nodeCoordinates = dimension * model->nodeCount();  // scalar coordinates stay
    const auto ofNodes = [&](const Vector& all) -> Matrix {
      return all.head(nodeCoordinates).reshaped(dimension, model->nodeCount());
    };
    const Matrix points = ofNodes(x);
    Vector moved = x;
    moved.head(nodeCoordinates) = Matrix((rotation * points).colwise() + shift).reshaped();
    const Matrix forces = ofNodes(assembler.gradient(x));
    const Matrix movedForces = ofNodes(assembler.gradient(moved));

    const double energy = assembler.value(x);
    QVERIFY(energy != 0);
    QVERIFY(std::abs(assembler.value(moved) - energy) <= 1e-12 * std::abs(energy));
    QVERIFY((movedForces - rotation * forces).norm() <= 1e-12 * forces.norm());
    QVERIFY(forces.rowwise().sum().norm() <= 1e-13 * forces.norm());
    const Matrix moments = points * forces.transpose();  // torque: its antisymmetric part
    QVERIFY((moments - moments.transpose()).norm() <= 1e-13 * points.norm() * forces.norm());
  });
}

QTEST_GUILESS_MAIN(TestEnergies)
#include "test_energies.moc"
