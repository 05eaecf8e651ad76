#include <Eigen/Geometry>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/strain.hpp"
#include "tests/core/mechanics/shell_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

constexpr ShellMaterial material{.youngModulus = 2e6, .poissonRatio = 0.3, .density = 1000, .thickness = 2e-3};
constexpr double length = 0.4, width = 0.3;

/// St. Venant-Kirchhoff energy an area in plane stress, in terms of the deformation gradient's metric C = FᵀF.
double energyDensity(const Eigen::Matrix2d& metric) {
  const Eigen::Matrix2d strain = 0.5 * (metric - Eigen::Matrix2d::Identity());
  const double nu = material.poissonRatio;
  const Eigen::Matrix2d stress =
      material.youngModulus / (1 - nu * nu) * ((1 - nu) * strain + nu * strain.trace() * Eigen::Matrix2d::Identity());
  return 0.5 * material.thickness * (stress * strain).trace();
}

}  // namespace

class TestMembrane : public QObject {
  Q_OBJECT

 private slots:
  void uniformStrainOnAnIrregularMesh_data();
  void uniformStrainOnAnIrregularMesh();
  void uniaxialTension();
  void factorsScaleTriangles();
  void badInputIsRefused();
  void principalStretchesOfKnownDeformations();
};

void TestMembrane::uniformStrainOnAnIrregularMesh_data() {
  QTest::addColumn<int>("dimension");
  QTest::newRow("2D") << 2;
  QTest::newRow("3D") << 3;
}

void TestMembrane::uniformStrainOnAnIrregularMesh() {
  QFETCH(int, dimension);
  const geometry::SurfaceMesh mesh = irregularGrid(length, width, 6, 5);
  Model model = modelOf(mesh, dimension);
  model.energies.push_back(makeMembrane(dimension, model.restPositions, mesh.triangles, material));
  model.finish();
  const ElasticAssembler assembler(std::make_shared<const Model>(model));

  Eigen::Matrix<double, 3, 2> gradient;
  gradient << 1.3, 0.4, -0.2, 0.8, 0.5, -0.1;
  const Matrix f = gradient.topRows(dimension);
  const Matrix rest = model.restPositions.reshaped(dimension, model.nodeCount());
  const Vector x = (f * rest.topRows(2)).reshaped();
  const double expected = length * width * energyDensity(f.transpose() * f);
  QVERIFY(std::abs(assembler.value(x) - expected) <= 1e-12 * expected);

  const Matrix forces = assembler.gradient(x).reshaped(dimension, model.nodeCount());
  int inner = 0;
  for (int n = 0; n < model.nodeCount(); ++n) {
    const double toBoundary = std::min({rest(0, n), length - rest(0, n), width / 2 - std::abs(rest(1, n))});
    if (toBoundary < 1e-9) continue;
    ++inner;
    QVERIFY(forces.col(n).norm() <= 1e-12 * forces.norm());  // the inner nodes are in balance
  }
  QCOMPARE(inner, 20);
}

void TestMembrane::uniaxialTension() {
  const double stretch = 1.25, nu = material.poissonRatio;
  const geometry::SurfaceMesh mesh = irregularGrid(length, width, 6, 5);
  Model model = modelOf(mesh, 2);
  model.energies.push_back(makeMembrane(2, model.restPositions, mesh.triangles, material));
  model.lockedCoordinates.assign(model.coordinateCount(), 0);
  for (const char* side : {"start", "end"})
    for (const int node : mesh.groups.at(side)) model.lockedCoordinates[2 * node] = 1;
  model.lockedCoordinates[2 * mesh.groups.at("start")[0] + 1] = 1;
  model.finish();
  Vector x = model.restPositions;
  for (int n = 0; n < model.nodeCount(); ++n) x[2 * n] *= stretch;
  solveStatics(model, Vector::Zero(x.size()), x);

  // S₂₂ = 0, so ε₂₂ = -ν ε₁₁ and S₁₁ = Y ε₁₁; the force is the first Piola-Kirchhoff stress λ S₁₁ times h w.
  const double strain = (stretch * stretch - 1) / 2, across = std::sqrt(1 - 2 * nu * strain);
  const Vector forces = ElasticAssembler(std::make_shared<const Model>(model)).gradient(x);
  double tension = 0, lowest = x[1], highest = x[1];
  for (const int node : mesh.groups.at("end")) tension += forces[2 * node];
  for (int n = 0; n < model.nodeCount(); ++n) {
    lowest = std::min(lowest, x[2 * n + 1]);
    highest = std::max(highest, x[2 * n + 1]);
  }
  const double expected = stretch * material.youngModulus * strain * material.thickness * width;
  QVERIFY(std::abs(tension - expected) <= 1e-10 * expected);
  QVERIFY(std::abs(highest - lowest - across * width) <= 1e-10 * width);

  const Vector stretches = principalStretches(2, model.restPositions, x, mesh.triangles);
  QVERIFY((stretches.array() - stretch).abs().maxCoeff() <= 1e-10);
}

void TestMembrane::factorsScaleTriangles() {
  const geometry::SurfaceMesh mesh = irregularGrid(length, width, 4, 3);
  Eigen::Matrix2d gradient;
  gradient << 1.3, 0.4, -0.2, 0.8;
  const Vector x = (gradient * mesh.points.topRows(2)).reshaped();
  Model model = modelOf(mesh, 2);
  std::vector<double> stiffness(mesh.triangles.size(), 1.0), thickness = stiffness;
  stiffness[2] = 3;
  thickness[2] = 0.5;
  thickness[5] = 4;
  const TriangleFactors factors{stiffness, thickness};
  model.energies.push_back(makeMembrane(2, model.restPositions, mesh.triangles, material, factors));
  model.finish();
  const auto area = [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return 0.5 * (mesh.points.col(b) - mesh.points.col(a)).cross(mesh.points.col(c) - mesh.points.col(a)).norm();
  };
  const double weighted = length * width + 0.5 * area(2) + 3 * area(5);
  const double expected = weighted * energyDensity(gradient.transpose() * gradient);
  QVERIFY(std::abs(ElasticAssembler(std::make_shared<const Model>(model)).value(x) - expected) <= 1e-12 * expected);

  std::vector<Eigen::Triplet<double>> entries;
  addShellMass(2, model.restPositions, mesh.triangles, material, MassMatrix::lumped, entries, factors);
  double mass = 0;
  for (const auto& entry : entries) mass += entry.value() / 2;  // in both directions
  const double expectedMass = material.density * material.thickness * (length * width - 0.5 * area(2) + 3 * area(5));
  QVERIFY(std::abs(mass - expectedMass) <= 1e-12 * expectedMass);

  // Bending of an edge: D goes with the stiffness and the thickness cubed.
  const geometry::SurfaceMesh pair = geometry::makeGrid(1, 1, 1, 1);
  const Vector rest = modelOf(pair, 3).restPositions;
  Vector bent = rest;
  bent[2] += 0.1;
  const auto bendingEnergy = [&](const TriangleFactors& both) {
    Model hinge = modelOf(pair, 3);
    hinge.energies.push_back(makeHingeBending(rest, pair.triangles, material, both));
    hinge.finish();
    return ElasticAssembler(std::make_shared<const Model>(hinge)).value(bent);
  };
  const std::vector<double> uneven = {5, 1}, thick = {2, 2};
  const double plain = bendingEnergy({});
  QVERIFY(std::abs(bendingEnergy({uneven, {}}) - 3 * plain) <= 1e-12 * plain);
  QVERIFY(std::abs(bendingEnergy({{}, thick}) - 8 * plain) <= 1e-12 * plain);
}

void TestMembrane::badInputIsRefused() {
  const geometry::SurfaceMesh mesh = geometry::makeGrid(1, 1, 2, 2);
  const Vector rest = modelOf(mesh, 3).restPositions;
  const auto build = [&](ShellMaterial changed, Triangles triangles) {
    makeMembrane(3, rest, triangles, changed);
    makeHingeBending(rest, triangles, changed);
  };
  build(material, mesh.triangles);
  for (const double bad : {-1.0, 0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    ShellMaterial changed = material;
    changed.youngModulus = bad;
    QVERIFY_EXCEPTION_THROWN(build(changed, mesh.triangles), base::InputError);
    changed = material;
    changed.thickness = bad;
    QVERIFY_EXCEPTION_THROWN(build(changed, mesh.triangles), base::InputError);
  }
  for (const double bad : {-1.0, 0.51, std::nan("")}) {
    ShellMaterial changed = material;
    changed.poissonRatio = bad;
    QVERIFY_EXCEPTION_THROWN(build(changed, mesh.triangles), base::InputError);
  }
  const std::vector<double> tooFew = {1, 2}, negative(mesh.triangles.size(), -1.0);
  for (const std::vector<double>& bad : {tooFew, negative})
    QVERIFY_EXCEPTION_THROWN(makeMembrane(3, rest, mesh.triangles, material, {bad, {}}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(build(material, {{0, 1, 9}}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(build(material, {{0, 1, -1}}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(build(material, {{0, 1, 1}}), base::InputError);
}

void TestMembrane::principalStretchesOfKnownDeformations() {
  const geometry::SurfaceMesh mesh = irregularGrid(length, width, 4, 3);
  const Vector rest = modelOf(mesh, 2).restPositions;
  const Matrix f = (Matrix(2, 2) << 1.2, 0.5, -0.3, 0.7).finished();
  const double expected = Eigen::JacobiSVD<Matrix>(f).singularValues()[0];
  const Matrix flat = f * mesh.points.topRows(2);
  const Vector inPlane = principalStretches(2, rest, flat.reshaped(), mesh.triangles);
  QVERIFY((inPlane.array() / expected - 1).abs().maxCoeff() <= 1e-12);

  Matrix turned = Matrix::Zero(3, flat.cols());
  turned.topRows(2) = flat;
  turned = Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix() * turned;
  const Vector inSpace = principalStretches(3, modelOf(mesh, 3).restPositions, turned.reshaped(), mesh.triangles);
  QVERIFY((inSpace.array() / expected - 1).abs().maxCoeff() <= 1e-12);

  const Vector collapsed = principalStretches(2, rest, Vector::Zero(rest.size()), mesh.triangles);
  QVERIFY(collapsed.isZero(0));
}

QTEST_GUILESS_MAIN(TestMembrane)
#include "test_membrane.moc"
