#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <QTest>
#include <cmath>
#include <random>

#include "core/base/error.hpp"
#include "core/geometry/tet_mesh.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/solid.hpp"
#include "core/mechanics/strain.hpp"
#include "tests/core/mechanics/shell_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

constexpr SolidMaterial material{.youngModulus = 2e6, .poissonRatio = 0.3, .density = 1000};
const Eigen::Vector3d size(0.4, 0.3, 0.2);

Model solidOf(const geometry::TetMesh& mesh, const SolidMaterial& solid, std::span<const double> factors = {}) {
  Model model;
  model.restPositions = mesh.points.reshaped();
  model.energies.push_back(makeSolid(model.restPositions, mesh.tetrahedra, solid, factors));
  model.lockedCoordinates.assign(static_cast<std::size_t>(model.coordinateCount()), 0);
  return model;
}

bool isInside(const Eigen::Vector3d& point) {
  return (point.array() > 1e-9).all() && (point.array() < size.array() - 1e-9).all();
}

/// A box whose inner points are moved by up to a fifth of a cell.
geometry::TetMesh irregularBox() {
  const Eigen::Vector3d cell(0.1, 0.1, 0.05);
  geometry::TetMesh mesh = geometry::makeBlocks({{"box", Eigen::Vector3d::Zero(), size}}, cell);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(-0.2, 0.2);
  for (Eigen::Index n = 0; n < mesh.points.cols(); ++n)
    if (isInside(mesh.points.col(n)))
      for (int axis = 0; axis < 3; ++axis) mesh.points(axis, n) += step(random) * cell[axis];
  return mesh;
}

double energyDensity(const Eigen::Matrix3d& gradient) {
  const double y = material.youngModulus, nu = material.poissonRatio;
  const double lambda = y * nu / ((1 + nu) * (1 - 2 * nu)), mu = y / (2 * (1 + nu));
  const Eigen::Matrix3d strain = 0.5 * (gradient.transpose() * gradient - Eigen::Matrix3d::Identity());
  return 0.5 * lambda * strain.trace() * strain.trace() + mu * (strain * strain).trace();
}

SparseMatrix massOf(const Model& model, const geometry::TetMesh& mesh, const SolidMaterial& solid, MassMatrix kind) {
  std::vector<Eigen::Triplet<double>> entries;
  addSolidMass(model.restPositions, mesh.tetrahedra, solid, kind, entries);
  SparseMatrix mass(model.coordinateCount(), model.coordinateCount());
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

/// A cantilever of square section, twenty times as long as thick, with `cells` cells through its thickness.
struct Beam {
  static constexpr double thickness = 0.01, length = 0.2;
  geometry::TetMesh mesh;
  Model model;
  SolidMaterial solid;

  Beam(int cells, double poissonRatio) : solid{1e6, poissonRatio, 1000} {
    mesh = geometry::makeBlocks({{"beam", {0, 0, 0}, {length, thickness, thickness}}},
                                Eigen::Vector3d(thickness, thickness, thickness) / cells);
    model = solidOf(mesh, solid);
    for (const int node : mesh.groups.at("beam.x_min"))
      for (int axis = 0; axis < 3; ++axis) model.lockedCoordinates[static_cast<std::size_t>(3 * node + axis)] = 1;
    model.finish();
  }

  /// The first bending frequency over Euler and Bernoulli's, 1.8751² √(E I / (ρ A L⁴)).
  double frequencyRatio(MassMatrix kind) const {
    const auto& free = model.dofs.freeCoordinates;
    const SparseMatrix full = massOf(model, mesh, solid, kind);
    const SparseMatrix stiffness = ElasticAssembler(std::make_shared<const Model>(model)).hessian(model.restPositions);
    SparseMatrix select(static_cast<Eigen::Index>(free.size()), full.rows());
    for (std::size_t i = 0; i < free.size(); ++i) select.insert(static_cast<Eigen::Index>(i), free[i]) = 1;
    const SparseMatrix mass = select * full * SparseMatrix(select.transpose());
    const Eigen::SimplicialLDLT<SparseMatrix> factors(stiffness);
    Vector mode(stiffness.rows());
    for (Eigen::Index i = 0; i < mode.size(); ++i) mode[i] = free[static_cast<std::size_t>(i)] % 3 == 1;
    double squared = 0;
    for (int iteration = 0; iteration < 40; ++iteration) {
      mode = factors.solve(mass * mode);
      mode /= std::sqrt(mode.dot(mass * mode));
      squared = mode.dot(stiffness * mode);
    }
    const double inertia = std::pow(thickness, 4) / 12, area = thickness * thickness;
    const double expected = 1.875104068711961 * 1.875104068711961 *
                            std::sqrt(solid.youngModulus * inertia / (solid.density * area * std::pow(length, 4)));
    return std::sqrt(squared) / expected;
  }

  /// The tip's deflection under a force there over Timoshenko's, P L³ / (3 E I) + P L / (κ G A).
  double deflectionRatio() const {
    const std::vector<int>& tip = mesh.groups.at("beam.x_max");
    const double load = 1e-6;
    Vector force = Vector::Zero(model.coordinateCount());
    for (const int node : tip) force[3 * node + 1] = load / static_cast<double>(tip.size());
    Vector x = model.restPositions;
    solveStatics(model, force, x);
    double deflection = 0;
    for (const int node : tip) deflection += (x - model.restPositions)[3 * node + 1] / static_cast<double>(tip.size());
    const double nu = solid.poissonRatio, kappa = 10 * (1 + nu) / (12 + 11 * nu);  // Cowper 1966
    const double shear = kappa * solid.youngModulus / (2 * (1 + nu)) * thickness * thickness;
    const double bending = solid.youngModulus * std::pow(thickness, 4) / 12;
    return deflection / (load * (std::pow(length, 3) / (3 * bending) + length / shear));
  }
};

}  // namespace

class TestSolid : public QObject {
  Q_OBJECT

 private slots:
  void uniformStrainOnAnIrregularMesh();
  void uniaxialTension();
  void factorsScaleElements();
  void massIsVolumeTimesDensity();
  void cantileverFrequencyConverges_data();
  void cantileverFrequencyConverges();
  void cantileverDeflectionConverges();
  void principalStretchesOfKnownDeformations();
  void badInputIsRefused();
};

void TestSolid::uniformStrainOnAnIrregularMesh() {
  const geometry::TetMesh mesh = irregularBox();
  Model model = solidOf(mesh, material);
  model.finish();
  const ElasticAssembler assembler(std::make_shared<const Model>(model));
  Eigen::Matrix3d gradient;
  gradient << 1.3, 0.4, -0.1, -0.2, 0.8, 0.3, 0.5, -0.1, 1.1;
  const Vector x = (gradient * mesh.points).reshaped();
  const double expected = size.prod() * energyDensity(gradient);
  QVERIFY(std::abs(assembler.value(x) - expected) <= 1e-12 * expected);
  const Matrix forces = assembler.gradient(x).reshaped(3, model.nodeCount());
  int inner = 0;
  for (int n = 0; n < model.nodeCount(); ++n) {
    if (!isInside(mesh.points.col(n))) continue;
    ++inner;
    QVERIFY(forces.col(n).norm() <= 1e-12 * forces.norm());
  }
  QCOMPARE(inner, 3 * 2 * 3);
}

void TestSolid::uniaxialTension() {
  const double stretch = 1.25, nu = material.poissonRatio;
  const geometry::TetMesh mesh = irregularBox();
  Model model = solidOf(mesh, material);
  const auto lock = [&](const char* side, int axis) {
    for (const int node : mesh.groups.at(side)) model.lockedCoordinates[static_cast<std::size_t>(3 * node + axis)] = 1;
  };
  lock("box.x_min", 0);
  lock("box.x_max", 0);
  lock("box.y_min", 1);
  lock("box.z_min", 2);
  model.finish();
  Vector x = model.restPositions;
  for (int n = 0; n < model.nodeCount(); ++n) x[3 * n] *= stretch;
  solveStatics(model, Vector::Zero(x.size()), x);
  // S₂₂ = S₃₃ = 0, so ε₂₂ = ε₃₃ = -ν ε₁₁ and S₁₁ = Y ε₁₁; the force is λ S₁₁ times the rest area.
  const double strain = (stretch * stretch - 1) / 2, across = std::sqrt(1 - 2 * nu * strain);
  const Vector forces = ElasticAssembler(std::make_shared<const Model>(model)).gradient(x);
  double tension = 0;
  for (const int node : mesh.groups.at("box.x_max")) tension += forces[3 * node];
  const double expected = stretch * material.youngModulus * strain * size.y() * size.z();
  QVERIFY(std::abs(tension - expected) <= 1e-10 * expected);
  for (const int node : mesh.groups.at("box.z_max")) QVERIFY(std::abs(x[3 * node + 2] - across * size.z()) <= 1e-11);
}

void TestSolid::factorsScaleElements() {
  const geometry::TetMesh mesh = irregularBox();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
  gradient(0, 1) = 0.3;
  const Vector x = (gradient * mesh.points).reshaped();
  std::vector<double> factors(mesh.tetrahedra.size(), 1.0);
  double expected = size.prod() * energyDensity(gradient);
  geometry::TetMesh harder = mesh;
  harder.tetrahedra = {mesh.tetrahedra[3], mesh.tetrahedra[11]};
  expected += 1.5 * geometry::volumeOf(harder) * energyDensity(gradient);
  factors[3] = factors[11] = 2.5;
  Model model = solidOf(mesh, material, factors);
  model.finish();
  const double energy = ElasticAssembler(std::make_shared<const Model>(model)).value(x);
  QVERIFY(std::abs(energy - expected) <= 1e-12 * expected);
}

void TestSolid::massIsVolumeTimesDensity() {
  const geometry::TetMesh mesh = irregularBox();
  const Model model = solidOf(mesh, material);
  // Kinetic energy of a motion that is linear in space; the consistent mass integrates it exactly.
  const Eigen::Vector3d a(0.3, -1.2, 0.7);
  const Vector constant = Eigen::Vector3d(1, 0, 0).replicate(model.nodeCount(), 1);
  Vector linear = Vector::Zero(model.coordinateCount());
  for (int n = 0; n < model.nodeCount(); ++n) linear[3 * n + 1] = a.dot(mesh.points.col(n) - 0.5 * size);
  const double total = material.density * size.prod();
  const double second = total * a.cwiseProduct(size).squaredNorm() / 12;
  for (const MassMatrix kind : {MassMatrix::lumped, MassMatrix::consistent}) {
    const SparseMatrix mass = massOf(model, mesh, material, kind);
    QVERIFY(std::abs(constant.dot(mass * constant) - total) <= 1e-12 * total);
    const double moment = linear.dot(mass * linear);
    if (kind == MassMatrix::consistent)
      QVERIFY(std::abs(moment - second) <= 1e-12 * second);
    else
      QVERIFY(moment > second);
  }
}

void TestSolid::cantileverFrequencyConverges_data() {
  QTest::addColumn<double>("poissonRatio");
  QTest::newRow("nu = 0") << 0.0;
  QTest::newRow("nu = 0.3") << 0.3;
}

void TestSolid::cantileverFrequencyConverges() {
  QFETCH(double, poissonRatio);
  // Shear and rotary inertia lower the frequency of so slender a beam by about 0.3 %.
  std::vector<double> errors;
  for (const int cells : {1, 2, 4}) {
    errors.push_back(Beam(cells, poissonRatio).frequencyRatio(MassMatrix::consistent) - 1);
    qInfo("%d cells through the thickness: first frequency %.1f %% too high", cells, 100 * errors.back());
  }
  const double order = std::log2(errors[1] / errors[2]);
  qInfo("order of convergence %.2f", order);
  QVERIFY(errors[0] > errors[1] && errors[1] > errors[2] && errors[2] > 0);
  QVERIFY(std::abs(order - 2) <= 0.3);
}

void TestSolid::cantileverDeflectionConverges() {
  const double coarse = 1 / Beam(2, 0.3).deflectionRatio() - 1, fine = 1 / Beam(4, 0.3).deflectionRatio() - 1;
  const double order = std::log2(coarse / fine);
  qInfo("stiffness %.1f %% and %.1f %% too high, order of convergence %.2f", 100 * coarse, 100 * fine, order);
  QVERIFY(std::abs(order - 2) <= 0.3);
  QVERIFY(std::abs(1 + fine - (coarse - fine) / 3 - 1) <= 0.03);  // extrapolated to vanishing cells
}

/// Every tetrahedron is stretched along three perpendicular directions and then turned.
void TestSolid::principalStretchesOfKnownDeformations() {
  const geometry::TetMesh mesh = irregularBox();
  const Eigen::Matrix3d directions = Eigen::AngleAxisd(0.7, Eigen::Vector3d(3, -1, 2).normalized()).matrix();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  Model model = solidOf(mesh, material);
  model.parts = {{"box", 0, model.nodeCount(), {}, mesh.tetrahedra, {}, {}, {}}};
  model.finish();
  const Eigen::Vector3d shift(1, -2, 0.5);
  const auto moved = [&](const Eigen::Vector3d& stretches) -> Vector {
    const Eigen::Matrix3d gradient = turn * directions * stretches.asDiagonal() * directions.transpose();
    return ((gradient * mesh.points).colwise() + shift).reshaped();
  };
  // The closed form of the eigenvalues leaves the root of rounding where the two largest ones are equal.
  const std::vector<std::pair<Eigen::Vector3d, double>> cases{
      {{1.3, 0.9, 0.6}, 1e-12}, {{1, 1, 1}, 1e-12}, {{0.8, 0.7, 0.5}, 1e-12}, {{0.4, 1.2, 1.2}, 1e-7}};
  for (const auto& [stretches, tolerance] : cases) {
    const Vector x = moved(stretches);
    const Vector found = principalStretches(model.restPositions, x, mesh.tetrahedra);
    QCOMPARE(found.size(), static_cast<Eigen::Index>(mesh.tetrahedra.size()));
    const double expected = stretches.maxCoeff();
    QVERIFY2((found.array() - expected).abs().maxCoeff() <= tolerance,
             qPrintable(QString::number((found.array() - expected).abs().maxCoeff())));
    QVERIFY(std::abs(largestStrain(model, x).value() - (expected - 1)) <= tolerance);
  }
  const Vector flat = Vector::Zero(model.coordinateCount());
  QVERIFY(principalStretches(model.restPositions, flat, mesh.tetrahedra).isZero(0));

  // Stretched across its faces, a solid shows less on its surface than there is inside.
  model.parts[0].triangles = geometry::boundaryTriangles(mesh.tetrahedra);
  const Vector x = moved({1.3, 0.9, 0.6});
  QVERIFY(principalStretches(3, model.restPositions, x, model.parts[0].triangles).maxCoeff() < 1.3 - 1e-3);
  QVERIFY(std::abs(largestStrain(model, x).value() - 0.3) <= 1e-12);
  model.parts.clear();
  QVERIFY(!largestStrain(model, x));
}

void TestSolid::badInputIsRefused() {
  const geometry::TetMesh mesh = irregularBox();
  const Vector rest = mesh.points.reshaped();
  const auto refused = [&](const SolidMaterial& changed, const Tetrahedra& tetrahedra,
                           const std::vector<double>& factors) {
    QVERIFY_EXCEPTION_THROWN(makeSolid(rest, tetrahedra, changed, factors), base::InputError);
  };
  for (const double bad : {-1.0, 0.0, std::nan("")}) {
    refused({bad, 0.3, 1000}, mesh.tetrahedra, {});
    refused(material, {{0, 1, 2, 30}}, {bad});
  }
  for (const double bad : {-1.0, 0.5, std::nan("")}) refused({1e6, bad, 1000}, mesh.tetrahedra, {});
  refused(material, mesh.tetrahedra, {1, 1});
  refused(material, {{0, 1, 2, 100000}}, {});
  refused(material, {{0, 1, 2, 2}}, {});
}

QTEST_GUILESS_MAIN(TestSolid)
#include "test_solid.moc"
