#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "tests/core/mechanics/shell_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

constexpr double length = 0.4, width = 0.3;
constexpr ShellMaterial material{.youngModulus = 1e6, .poissonRatio = 0.3, .density = 1200, .thickness = 2e-3};

SparseMatrix massOf(const Model& model, const Triangles& triangles, MassMatrix kind) {
  std::vector<Eigen::Triplet<double>> entries;
  addShellMass(model.dimension, model.restPositions, triangles, material, kind, entries);
  SparseMatrix mass(model.coordinateCount(), model.coordinateCount());
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

}  // namespace

class TestShellMass : public QObject {
  Q_OBJECT

 private slots:
  void rigidTranslation_data();
  void rigidTranslation();
  void linearVelocityField();
  void lumpedIsDiagonal();
  void badInputIsRefused();
};

void TestShellMass::rigidTranslation_data() {
  QTest::addColumn<int>("dimension");
  QTest::addColumn<bool>("lumped");
  for (const int dimension : {2, 3})
    for (const bool lumped : {false, true}) QTest::addRow("%dD, lumped: %d", dimension, lumped) << dimension << lumped;
}

void TestShellMass::rigidTranslation() {
  QFETCH(int, dimension);
  QFETCH(bool, lumped);
  const geometry::SurfaceMesh mesh = irregularGrid(length, width, 5, 4);
  const Model model = modelOf(mesh, dimension);
  const SparseMatrix mass = massOf(model, mesh.triangles, lumped ? MassMatrix::lumped : MassMatrix::consistent);
  const double total = material.density * material.thickness * length * width;
  const Vector velocity = Vector::LinSpaced(dimension, 1, 3);
  const Vector all = velocity.replicate(model.nodeCount(), 1);
  QVERIFY(std::abs(all.dot(mass * all) - total * velocity.squaredNorm()) <= 1e-13 * total * velocity.squaredNorm());
  // The first moment: gravity turns the plate about its middle.
  const Vector weight = mass * all;
  double moment = 0;
  for (int n = 0; n < model.nodeCount(); ++n) moment += mesh.points(0, n) * weight[n * dimension];
  QVERIFY(std::abs(moment - total * velocity[0] * length / 2) <= 1e-13 * total);
}

void TestShellMass::linearVelocityField() {
  const geometry::SurfaceMesh mesh = irregularGrid(length, width, 5, 4);
  const Model model = modelOf(mesh, 3);
  const SparseMatrix mass = massOf(model, mesh.triangles, MassMatrix::consistent);
  // v = (0, 0, 2 + 3x + 5y): ∫ v² over the rectangle, term by term.
  Vector velocity = Vector::Zero(model.coordinateCount());
  for (int n = 0; n < model.nodeCount(); ++n) velocity[3 * n + 2] = 2 + 3 * mesh.points(0, n) + 5 * mesh.points(1, n);
  const double area = length * width;
  const double squared = area * (4 + 12 * length / 2 + 9 * length * length / 3 + 25 * width * width / 12);
  const double expected = 0.5 * material.density * material.thickness * squared;
  QVERIFY(std::abs(0.5 * velocity.dot(mass * velocity) - expected) <= 1e-13 * expected);
}

void TestShellMass::lumpedIsDiagonal() {
  const geometry::SurfaceMesh mesh = irregularGrid(length, width, 5, 4);
  const SparseMatrix mass = massOf(modelOf(mesh, 3), mesh.triangles, MassMatrix::lumped);
  QCOMPARE(mass.nonZeros(), mass.rows());
  for (Eigen::Index i = 0; i < mass.rows(); ++i) QVERIFY(mass.coeff(i, i) > 0);
}

void TestShellMass::badInputIsRefused() {
  const geometry::SurfaceMesh mesh = geometry::makeGrid(1, 1, 1, 1);
  const Vector rest = modelOf(mesh, 3).restPositions;
  std::vector<Eigen::Triplet<double>> entries;
  for (const double bad : {-1.0, 0.0, std::nan("")}) {
    ShellMaterial changed = material;
    changed.density = bad;
    QVERIFY_EXCEPTION_THROWN(
        addShellMass(3, rest, mesh.triangles, changed, MassMatrix::lumped, entries), base::InputError);
  }
  QVERIFY_EXCEPTION_THROWN(
      addShellMass(3, rest, {{0, 1, 77}}, material, MassMatrix::lumped, entries), base::InputError);
}

QTEST_GUILESS_MAIN(TestShellMass)
#include "test_shell_mass.moc"
