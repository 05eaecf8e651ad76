#include <Eigen/Geometry>
#include <QTest>
#include <cmath>

#include "core/geometry/tet_mesh.hpp"
#include "core/mechanics/element_stress.hpp"
#include "core/mechanics/stiffness_factor.hpp"
#include "tests/core/mechanics/shell_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

constexpr double young = 2e6, poisson = 0.3, thickness = 2e-3;

ShellMaterial material(double nu = poisson) {
  return {.youngModulus = young, .poissonRatio = nu, .density = 1000, .thickness = thickness};
}

Model sheet(const geometry::SurfaceMesh& mesh, int dimension, double nu, bool bends) {
  Model model = modelOf(mesh, dimension);
  model.energies.push_back(makeMembrane(dimension, model.restPositions, mesh.triangles, material(nu)));
  if (bends) model.energies.push_back(makeHingeBending(model.restPositions, mesh.triangles, material(nu)));
  model.lockedCoordinates.assign(static_cast<std::size_t>(model.coordinateCount()), 0);
  model.finish();
  return model;
}

geometry::TetMesh block() { return geometry::makeBlocks({{"", {0, 0, 0}, {0.2, 0.1, 0.1}}}, {0.1, 0.1, 0.1}); }

Model solid(const geometry::TetMesh& mesh, double nu = poisson) {
  Model model;
  model.restPositions = mesh.points.reshaped();
  model.energies.push_back(makeSolid(model.restPositions, mesh.tetrahedra, {young, nu, 1000}));
  model.finish();
  return model;
}

/// Every node taken along by a matrix.
Vector deformed(const Model& model, const Eigen::Matrix3d& by) {
  const int dimension = model.dimension;
  return (by.topLeftCorner(dimension, dimension) *
          model.restPositions.reshaped(dimension, model.restPositions.size() / dimension))
      .reshaped();
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& by) {
  return Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix() * by;
}

bool all(const Vector& values, double expected, double tolerance) {
  return values.size() > 0 && (values.array() - expected).abs().maxCoeff() <= tolerance;
}

/// The largest relative difference of a gradient from differences of order 4.
double gradientError(const ElementStress& stress, const Vector& x, const Vector& weights, double step) {
  Vector gradient = Vector::Zero(x.size()), differences(x.size());
  stress.addGradient(x, weights, gradient);
  const auto at = [&](Eigen::Index i, double change) {
    Vector moved = x;
    moved[i] += change;
    return weights.dot(stress.values(moved));
  };
  for (Eigen::Index i = 0; i < x.size(); ++i)
    differences[i] = (8 * (at(i, step) - at(i, -step)) - (at(i, 2 * step) - at(i, -2 * step))) / (12 * step);
  return (gradient - differences).cwiseAbs().maxCoeff() / differences.cwiseAbs().maxCoeff();
}

Vector randomVector(Eigen::Index size, unsigned seed, double scale) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-scale, scale);
  return Vector::NullaryExpr(size, [&] { return entry(random); });
}

constexpr double length = 0.4, width = 0.05;
constexpr double perMoment = 6 / (width * thickness * thickness);  // y / I

/// A strip that is held by its first two rows of nodes, at its equilibrium under a force upwards on its end and a
/// couple on its last two rows.
struct Cantilever {
  geometry::SurfaceMesh mesh;
  double cell;
  Model model;
  Vector x;

  Cantilever(int lengthCells, int widthCells, double nu, double force, double couple)
      : mesh(geometry::makeStrip(length, width, lengthCells, widthCells)),
        cell(length / lengthCells),
        model(sheet(mesh, 3, nu, true)),
        x(model.restPositions) {
    Vector load = Vector::Zero(model.coordinateCount());
    const double count = widthCells + 1;
    for (int node = 0; node < model.nodeCount(); ++node) {
      const double along = mesh.points(0, node);
      if (along < 1.01 * cell)
        for (int axis = 0; axis < 3; ++axis) model.lockedCoordinates[static_cast<std::size_t>(3 * node + axis)] = 1;
      if (along > length - 0.01 * cell)
        load[3 * node + 2] += (force + couple / cell) / count;
      else if (along > length - 1.01 * cell)
        load[3 * node + 2] -= couple / cell / count;
    }
    model.finish();
    solveStatics(model, load, x);
  }

  /// At the places of triangles that are neither held nor in the last row of cells.
  Vector between(ElementMeasure measure) const {
    const ElementStress stress(model, mesh.triangles, {}, measure);
    const Vector values = stress.values(x);
    std::vector<Eigen::Index> places;
    for (Eigen::Index place = 0; place < values.size(); ++place) {
      double middle = 0;
      for (const int node :
           mesh.triangles[static_cast<std::size_t>(stress.elements()[static_cast<std::size_t>(place)].element)])
        middle += mesh.points(0, node) / 3;
      if (middle > cell && middle < length - cell) places.push_back(place);
    }
    return values(places);
  }
};

}  // namespace

class TestElementStress : public QObject {
  Q_OBJECT

 private slots:
  void pullsAlongOneAxis_data();
  void pullsAlongOneAxis();
  void pressureAloneIsNoMisesStress();
  void shears();
  void cantileverHasMomentOverInertia_data();
  void cantileverHasMomentOverInertia();
  void coupleStressesAllAlike();
  void couplesStrainTheSurfaces();
  void gradientAgreesWithDifferences_data();
  void gradientAgreesWithDifferences();
  void followsFactors();
  void tellsChosenElementsAlone();
};

void TestElementStress::pullsAlongOneAxis_data() {
  QTest::addColumn<double>("strain");
  QTest::newRow("small") << 1e-7;
  QTest::newRow("large") << 0.3;
}

/// Free to the sides: S = Y ε along the axis, σ = S λ / λ₁² with λ² = 1 + 2 ε and λ₁² = 1 - 2 ν ε, which is Y ε where
/// strains are small; in the plane, in space, and in a solid, however it is turned.
void TestElementStress::pullsAlongOneAxis() {
  QFETCH(double, strain);
  const double along = std::sqrt(1 + 2 * strain), across = std::sqrt(1 - 2 * poisson * strain);
  const double expected = young * strain * along / (across * across);
  const Eigen::Matrix3d pull = Eigen::Vector3d(along, across, across).asDiagonal();
  const double tolerance = 1e-9 * expected + 1e-15 * young;
  const auto plane = irregularGrid(1, 0.5, 3, 2);
  for (const int dimension : {2, 3}) {
    const Model model = sheet(plane, dimension, poisson, dimension == 3);
    const ElementStress stress(model, plane.triangles, {}, ElementMeasure::vonMises);
    QVERIFY(all(stress.values(deformed(model, dimension == 3 ? turned(pull) : pull)), expected, tolerance));
  }
  const auto mesh = block();
  const Model model = solid(mesh);
  QVERIFY(all(ElementStress(model, {}, mesh.tetrahedra, ElementMeasure::vonMises).values(deformed(model, turned(pull))),
              expected, tolerance));
  QVERIFY(all(ElementStress(model, {}, mesh.tetrahedra, ElementMeasure::principalStrain).values(deformed(model, pull)),
              along - 1, 1e-14));
}

void TestElementStress::pressureAloneIsNoMisesStress() {
  const auto mesh = block();
  const Model model = solid(mesh);
  const ElementStress stress(model, {}, mesh.tetrahedra, ElementMeasure::vonMises);
  for (const double scale : {0.8, 1.0, 1.2})
    QVERIFY(all(stress.values(deformed(model, turned(scale * Eigen::Matrix3d::Identity()))), 0, 1e-7 * young));
}

/// √3 G γ, to first order in the shear γ.
void TestElementStress::shears() {
  const double angle = 1e-6, expected = std::sqrt(3.0) * young / (2 * (1 + poisson)) * angle;
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  shear(0, 1) = angle;
  const auto plane = irregularGrid(1, 0.5, 3, 2);
  const Model flat = sheet(plane, 3, poisson, false);
  QVERIFY(all(ElementStress(flat, plane.triangles, {}, ElementMeasure::vonMises).values(deformed(flat, shear)),
              expected, 1e-5 * expected));
  const auto mesh = block();
  const Model model = solid(mesh);
  QVERIFY(all(ElementStress(model, {}, mesh.tetrahedra, ElementMeasure::vonMises).values(deformed(model, shear)),
              expected, 1e-5 * expected));
}

void TestElementStress::cantileverHasMomentOverInertia_data() {
  QTest::addColumn<int>("lengthCells");
  QTest::addColumn<int>("widthCells");
  QTest::newRow("square cells") << 8 << 1;
  QTest::newRow("long cells") << 4 << 1;
  QTest::newRow("short cells") << 12 << 1;
  QTest::newRow("several across") << 16 << 2;
}

/// σ = M y / I, M = F (l - x) at the hinges, of a plate that is pushed up at its end.
void TestElementStress::cantileverHasMomentOverInertia() {
  QFETCH(int, lengthCells);
  QFETCH(int, widthCells);
  const double force = 1e-8;
  const Cantilever plate(lengthCells, widthCells, 0, force, 0);
  const ElementStress stress(plate.model, plate.mesh.triangles, {}, ElementMeasure::vonMises);
  const Vector values = stress.values(plate.x);
  QCOMPARE(values.size(), static_cast<Eigen::Index>(2 * (lengthCells - 1) * widthCells * 2 + 2 * widthCells));
  const double largest = values.maxCoeff(), arm = length - plate.cell, bending = force * arm * perMoment;
  if (widthCells > 1) {
    QVERIFY2(largest > bending && largest < 1.2 * bending, qPrintable(QString::number(largest / bending)));
    return;
  }
  // The force acts a quarter of the width beside the middle of the hinge's neighbour: M and a torque.
  const double twist = force * width / 4 * perMoment, expected = std::sqrt(bending * bending + 3 * twist * twist);
  QVERIFY2(std::abs(largest / expected - 1) < 1e-5, qPrintable(QString::number(largest / expected, 'g', 10)));
}

/// By a couple at the last two rows: M is the same everywhere before them, and so is its stress, in every triangle.
void TestElementStress::coupleStressesAllAlike() {
  const double moment = 1e-9;
  for (const int lengthCells : {4, 8, 12}) {
    const Cantilever plate(lengthCells, 1, 0, 0, moment);
    const Vector values = plate.between(ElementMeasure::vonMises);
    QCOMPARE(values.size(), static_cast<Eigen::Index>(4 * (lengthCells - 2)));
    QVERIFY(all(values, moment * perMoment, 1e-5 * moment * perMoment));
  }
}

/// A free narrow strip bends as a beam: its surfaces are strained by M y / (Y I) along it, or ν of that across where it
/// is pressed, whatever the stiffness of the hinges.
void TestElementStress::couplesStrainTheSurfaces() {
  const double moment = 1e-7, strain = moment * perMoment / young;
  const Vector values = Cantilever(8, 1, poisson, 0, moment).between(ElementMeasure::principalStrain);
  for (Eigen::Index place = 0; place < values.size(); place += 2) {
    QVERIFY(std::abs(values.segment(place, 2).maxCoeff() / strain - 1) < 1e-3);
    QVERIFY(std::abs(values.segment(place, 2).minCoeff() / (poisson * strain) - 1) < 1e-3);
  }
}

void TestElementStress::gradientAgreesWithDifferences_data() {
  QTest::addColumn<int>("measure");
  QTest::newRow("stress") << static_cast<int>(ElementMeasure::vonMises);
  QTest::newRow("strain") << static_cast<int>(ElementMeasure::principalStrain);
}

void TestElementStress::gradientAgreesWithDifferences() {
  QFETCH(int, measure);
  const auto kind = static_cast<ElementMeasure>(measure);
  const auto mesh = irregularGrid(1, 0.5, 3, 2);
  for (const int dimension : {2, 3}) {
    const Model model = sheet(mesh, dimension, poisson, dimension == 3);
    const ElementStress stress(model, mesh.triangles, {}, kind);
    QCOMPARE(stress.count(), static_cast<int>(mesh.triangles.size()) * (dimension - 1));
    const Vector x = model.restPositions + randomVector(model.coordinateCount(), 5, 0.05);
    const double error = gradientError(stress, x, randomVector(stress.count(), 6, 1), 1e-4);
    QVERIFY2(error < 1e-7, qPrintable(QString::number(error)));
  }
  const auto blocks = block();
  const Model model = solid(blocks);
  const ElementStress stress(model, {}, blocks.tetrahedra, kind);
  const Vector x = model.restPositions + randomVector(model.coordinateCount(), 7, 0.01);
  const double error = gradientError(stress, x, randomVector(stress.count(), 8, 1), 1e-5);
  QVERIFY2(error < 1e-7, qPrintable(QString::number(error)));
}

/// Of a membrane in a sheet that bends as well, and of a solid: what the value gains with one element's stiffness.
void TestElementStress::followsFactors() {
  const auto mesh = irregularGrid(1, 0.5, 3, 2);
  const auto blocks = block();
  for (const ElementMeasure measure : {ElementMeasure::vonMises, ElementMeasure::principalStrain})
    for (const bool ofSolid : {false, true}) {
      Model model = ofSolid ? solid(blocks) : sheet(mesh, 3, poisson, true);
      const StiffnessFactorOptions options{"factor", "/factors", {}, 0.1, 10};
      const auto factors = makeStiffnessFactors(model, 0, options);
      const auto stressOf = [&](const Model& of) {
        return ElementStress(of, mesh.triangles, ofSolid ? blocks.tetrahedra : Tetrahedra{}, measure);
      };
      const Model softer = factors[3]->withValue(model, 0.4);
      const Vector x = model.restPositions + randomVector(model.coordinateCount(), 5, 0.01);
      const ElementStress stress = stressOf(softer);
      const Vector weights = randomVector(stress.count(), 6, 1), shares = stress.byStiffness(x, weights);
      double derivative = 0;
      for (Eigen::Index place = 0; place < shares.size(); ++place)
        if (stress.elements()[static_cast<std::size_t>(place)] == *factoredElement(*factors[3]))
          derivative += shares[place] / 0.4;
      const auto at = [&](double factor) {
        return weights.dot(stressOf(factors[3]->withValue(model, factor)).values(x));
      };
      const double step = 1e-3;
      const double difference =
          (8 * (at(0.4 + step) - at(0.4 - step)) - (at(0.4 + 2 * step) - at(0.4 - 2 * step))) / (12 * step);
      const double rounding = measure == ElementMeasure::vonMises ? 1e-6 : 1e-10;
      QVERIFY2(std::abs(derivative - difference) < 1e-7 * std::abs(difference) + rounding,
               qPrintable(QString("%1, differences %2").arg(derivative).arg(difference)));
      if (!ofSolid || measure == ElementMeasure::vonMises) QVERIFY(std::abs(difference) > 1e3 * rounding);
    }
}

void TestElementStress::tellsChosenElementsAlone() {
  const auto mesh = irregularGrid(1, 0.5, 3, 2);
  const Model model = sheet(mesh, 3, poisson, true);
  const auto [a, b, c] = mesh.triangles[4];
  const Vector x = model.restPositions + randomVector(model.coordinateCount(), 5, 0.05);
  const ElementStress one(model, {{c, a, b}}, {}, ElementMeasure::vonMises);
  QCOMPARE(one.count(), 2);
  QCOMPARE(one.elements()[1].element, 4);
  const Vector all = ElementStress(model, mesh.triangles, {}, ElementMeasure::vonMises).values(x);
  QCOMPARE(one.values(x)[0], all[8]);
  QCOMPARE(one.values(x)[1], all[9]);
  QVERIFY(std::abs(all[8] - all[9]) > 1e-6 * all[8]);
}

QTEST_GUILESS_MAIN(TestElementStress)
#include "test_element_stress.moc"
