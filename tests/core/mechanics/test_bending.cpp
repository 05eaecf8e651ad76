#include <Eigen/Geometry>
#include <QTest>
#include <cmath>

#include "tests/core/mechanics/shell_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

constexpr double pi = M_PI;

double rigidity(const ShellMaterial& material) {
  return material.youngModulus * std::pow(material.thickness, 3) /
         (12 * (1 - material.poissonRatio * material.poissonRatio));
}

/// Rolls the plane z = 0 onto a cylinder of the radius, along the direction at `angle` from x.
Vector rolled(const Eigen::Matrix3Xd& points, double radius, double angle) {
  Eigen::Matrix3Xd result(3, points.cols());
  const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0), axis(-along.y(), along.x(), 0);
  for (Eigen::Index n = 0; n < points.cols(); ++n) {
    const double turn = along.dot(points.col(n)) / radius;
    result.col(n) = axis.dot(points.col(n)) * axis + radius * std::sin(turn) * along;
    result(2, n) = radius * (1 - std::cos(turn));
  }
  return result.reshaped();
}

double bendingEnergy(const geometry::SurfaceMesh& mesh, const ShellMaterial& material, const Vector& x) {
  Model model = modelOf(mesh, 3);
  model.energies.push_back(makeHingeBending(model.restPositions, mesh.triangles, material));
  model.finish();
  return ElasticAssembler(std::make_shared<const Model>(model)).value(x);
}

/// Rows of equilateral triangles with the edge length `side`: `columns` triangles with an edge along x in each row,
/// every second row shifted by half an edge.
geometry::SurfaceMesh equilateralMesh(double side, int columns, int rows) {
  geometry::SurfaceMesh mesh;
  mesh.points.setZero(3, (columns + 1) * (rows + 1));
  const auto node = [&](int i, int j) { return j * (columns + 1) + i; };
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      mesh.points.col(node(i, j)) << side * (i + 0.5 * (j % 2)), side * std::sqrt(0.75) * j, 0;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (j % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  return mesh;
}

double area(const geometry::SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.points.col(b) - mesh.points.col(a)).cross(mesh.points.col(c) - mesh.points.col(a)).norm();
  return sum;
}

/// A narrow cantilever of equilateral triangles. Such a mesh bends like a plate with the rigidity D and ν = -1/3 (Seung
/// & Nelson 1988), so a narrow strip of it like a beam with Y I = (1 - ν²) D w = 8/9 D w.
struct Cantilever {
  static constexpr double width = 0.005;
  static constexpr ShellMaterial material{
      .youngModulus = 2e9, .poissonRatio = 0.36, .density = 1200, .thickness = 5e-4};

  double side, length;
  geometry::SurfaceMesh mesh;
  Model model;

  explicit Cantilever(int rows) : side(width / (rows * std::sqrt(0.75))) {
    const int columns = static_cast<int>(std::lround(20 * width / side));
    length = columns * side;
    mesh = equilateralMesh(side, columns, rows);
    model = modelOf(mesh, 3);
    model.energies.push_back(makeMembrane(3, model.restPositions, mesh.triangles, material));
    model.energies.push_back(makeHingeBending(model.restPositions, mesh.triangles, material));
    model.lockedCoordinates.assign(model.coordinateCount(), 0);
    for (int n = 0; n < model.nodeCount(); ++n)
      if (mesh.points(0, n) < 1.25 * side)
        for (int axis = 0; axis < 3; ++axis) model.lockedCoordinates[3 * n + axis] = 1;
    std::vector<Eigen::Triplet<double>> entries;
    addShellMass(3, model.restPositions, mesh.triangles, material, MassMatrix::consistent, entries);
    SparseMatrix mass(model.coordinateCount(), model.coordinateCount());
    mass.setFromTriplets(entries.begin(), entries.end());
    model.elementMass = std::make_shared<const SparseMatrix>(mass);
    model.finish();
  }

  static double beamRigidity() { return 8.0 / 9 * rigidity(material) * width; }

  SparseMatrix stiffness() const {
    return ElasticAssembler(std::make_shared<const Model>(model)).hessian(model.restPositions);
  }

  /// Deflection under a force at the tip, divided by that of an Euler-Bernoulli beam, P L³ / (3 Y I).
  double relativeDeflection() const {
    std::vector<int> tip;
    for (int n = 0; n < model.nodeCount(); ++n)
      if (std::abs(mesh.points(0, n) - length) < 0.1 * side) tip.push_back(3 * n + 2);
    const double force = 1e-6;
    Vector load = Vector::Zero(model.coordinateCount());
    for (const int coordinate : tip) load[coordinate] = force / static_cast<double>(tip.size());
    const Eigen::SimplicialLDLT<SparseMatrix> factors(stiffness());
    const Vector free = load(model.dofs.freeCoordinates), solution = factors.solve(free);
    const double deflection = free.dot(solution) / force;
    return deflection / (force * std::pow(length, 3) / (3 * beamRigidity()));
  }

  /// First angular frequency divided by that of an Euler-Bernoulli beam, 1.8751041² √(Y I / (ρ h w)) / L².
  double relativeFrequency() const {
    const auto& free = model.dofs.freeCoordinates;
    SparseMatrix select(model.coordinateCount(), static_cast<Eigen::Index>(free.size()));
    for (std::size_t i = 0; i < free.size(); ++i) select.insert(free[i], static_cast<Eigen::Index>(i)) = 1;
    const SparseMatrix k = stiffness(), m = select.transpose() * model.massMatrix() * select;
    const Eigen::SimplicialLDLT<SparseMatrix> factors(k);
    Vector mode = Vector::Zero(k.rows());
    for (std::size_t i = 0; i < free.size(); ++i) mode[static_cast<Eigen::Index>(i)] = free[i] % 3 == 2;
    for (int iteration = 0; iteration < 20; ++iteration) {  // inverse iteration
      const Vector next = factors.solve((m * mode).eval());
      mode = next / std::sqrt(next.dot(m * next));
    }
    const double root = 1.8751040687119611;
    const double massPerLength = material.density * material.thickness * width;
    return std::sqrt(mode.dot(k * mode)) /
           (root * root * std::sqrt(beamRigidity() / massPerLength) / (length * length));
  }
};

}  // namespace

class TestBending : public QObject {
  Q_OBJECT

 private slots:
  void gridRolledAlongItsEdges();
  void equilateralMeshRolledInAnyDirection_data();
  void equilateralMeshRolledInAnyDirection();
  void uniformCurvatureIsInBalance();
  void curvedRestShapeIsUnstressed();
  void cantileverDeflection();
  void cantileverFrequency();
  void noInnerEdgeNoEnergy();
};

void TestBending::gridRolledAlongItsEdges() {
  constexpr ShellMaterial material{.youngModulus = 3e9, .poissonRatio = 0.36, .density = 1000, .thickness = 5e-4};
  const double length = 0.2, width = 0.05, radius = 0.1;
  const double exact = 0.5 * rigidity(material) / (radius * radius) * length * width;
  const auto energy = [&](int cells) {
    const geometry::SurfaceMesh mesh = geometry::makeGrid(length, width, cells, 3);
    return bendingEnergy(mesh, material, rolled(mesh.points, radius, 0));
  };
  // The two outermost half cells have no hinge: an error of first order that extrapolation takes away.
  QVERIFY(std::abs(energy(20) - exact) <= 0.06 * exact);
  QVERIFY(std::abs(2 * energy(40) - energy(20) - exact) <= 1e-9 * exact);
}

void TestBending::equilateralMeshRolledInAnyDirection_data() {
  QTest::addColumn<double>("angle");
  for (const double angle : {0.0, 10.0, 25.0, 30.0, 47.0, 90.0}) QTest::addRow("%g degrees", angle) << angle * pi / 180;
}

void TestBending::equilateralMeshRolledInAnyDirection() {
  QFETCH(double, angle);
  constexpr ShellMaterial material{.youngModulus = 3e9, .poissonRatio = 0.36, .density = 1000, .thickness = 5e-4};
  const double radius = 0.15;
  const auto relativeEnergy = [&](int cells) {
    const geometry::SurfaceMesh mesh = equilateralMesh(0.1 / cells, cells, cells);
    return bendingEnergy(mesh, material, rolled(mesh.points, radius, angle)) /
           (0.5 * rigidity(material) / (radius * radius) * area(mesh));
  };
  // Boundary edges have no hinge: an error of first order that extrapolation takes away.
  const double e10 = relativeEnergy(10), e20 = relativeEnergy(20), e40 = relativeEnergy(40);
  const double coarse = 2 * e20 - e10 - 1, fine = 2 * e40 - e20 - 1;
  QVERIFY(std::abs(fine) <= 2e-3);
  QVERIFY(std::abs(fine) <= 0.3 * std::abs(coarse) + 1e-9);  // second order
}

void TestBending::uniformCurvatureIsInBalance() {
  // Small constant curvatures κ₁, κ₂, κ₁₂ of an equilateral lattice: inner nodes feel no force, and the energy an area
  // is that of a plate with ν = -1/3, D/2 ((κ₁ + κ₂)² - 2 (1 - ν) (κ₁ κ₂ - κ₁₂²)).
  const double side = 0.01, nu = -1.0 / 3;
  const auto bend = [&](int cells, const Eigen::Vector3d& k, Vector& force) {
    const geometry::SurfaceMesh mesh = equilateralMesh(side, cells, cells);
    Model model = modelOf(mesh, 3);
    model.energies.push_back(makeHingeBending(model.restPositions, mesh.triangles, Cantilever::material));
    model.finish();
    Vector u = Vector::Zero(model.coordinateCount());
    for (int n = 0; n < model.nodeCount(); ++n) {
      const double x = mesh.points(0, n), y = mesh.points(1, n);
      u[3 * n + 2] = 0.5 * (k[0] * x * x + k[1] * y * y) + k[2] * x * y;
    }
    force = ElasticAssembler(std::make_shared<const Model>(model)).hessian(model.restPositions) * u;
    return 0.5 * u.dot(force);
  };
  for (const Eigen::Vector3d& k : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1),
                                   Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(0.3, -0.8, 0.5)}) {
    Vector force;
    const double energy4 = bend(4, k, force), energy6 = bend(6, k, force), energy8 = bend(8, k, force);
    for (int j = 2; j <= 6; ++j)
      for (int i = 2; i <= 6; ++i) QVERIFY(std::abs(force[3 * (j * 9 + i) + 2]) <= 1e-12 * force.norm());
    // Energy of n x n cells: quadratic in n, of which second differences keep the part that grows with the area.
    const double perCell = (energy8 - 2 * energy6 + energy4) / 8;
    const double density =
        0.5 * rigidity(Cantilever::material) * (std::pow(k[0] + k[1], 2) - 2 * (1 - nu) * (k[0] * k[1] - k[2] * k[2]));
    QVERIFY(std::abs(perCell - density * side * side * std::sqrt(0.75)) <= 1e-11 * energy8);
  }
}

void TestBending::curvedRestShapeIsUnstressed() {
  geometry::SurfaceMesh mesh = irregularGrid(0.2, 0.1, 8, 5);
  const Eigen::Matrix3Xd flat = mesh.points;
  mesh.points = rolled(flat, 0.05, 0.3).reshaped(3, flat.cols());
  const double bentTwice = bendingEnergy(mesh, Cantilever::material, rolled(flat, 0.025, 0.3));
  QVERIFY(bendingEnergy(mesh, Cantilever::material, mesh.points.reshaped()) <= 1e-25 * bentTwice);
  QVERIFY(bendingEnergy(mesh, Cantilever::material, flat.reshaped()) > 0.1 * bentTwice);
}

// First order in the mesh, as the place of the clamp and the missing hinges on the sides are uncertain by a cell. What
// extrapolation leaves is the plate's own: the clamp keeps the cross-section from curling over about half a width,
// where the rigidity is D rather than 8/9 D, which takes 3 (w/2)/L (1 - 8/9) = 0.8 % from the deflection.
void TestBending::cantileverDeflection() {
  const double coarse = Cantilever(4).relativeDeflection(), fine = Cantilever(8).relativeDeflection();
  QVERIFY(std::abs(fine - 1) < std::abs(coarse - 1));
  QVERIFY(std::abs(2 * fine - coarse - 0.992) <= 0.005);
}

void TestBending::cantileverFrequency() {
  const double coarse = Cantilever(4).relativeFrequency(), fine = Cantilever(8).relativeFrequency();
  QVERIFY(std::abs(fine - 1) < std::abs(coarse - 1));
  QVERIFY(std::abs(2 * fine - coarse - 1.004) <= 0.005);
}

void TestBending::noInnerEdgeNoEnergy() {
  const Vector rest = (Vector(9) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished();
  QVERIFY(!makeHingeBending(rest, {{0, 1, 2}}, Cantilever::material));
}

QTEST_GUILESS_MAIN(TestBending)
#include "test_bending.moc"
