#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <set>

#include "core/interlock/cell_symmetry.hpp"
#include "core/interlock/deformation_test.hpp"
#include "core/interlock/element_families.hpp"

using namespace pliant::interlock;
using Eigen::Vector3d;

namespace {

const std::vector<UnitCell>& cells() {
  static const std::vector<UnitCell> all{
      fourInOne(), threefold(), squareRosette(), torusKnot(), scaleMail(), ringNet(), supercell(fourInOne(), 2, 1)};
  return all;
}

/// Linear parts of all symmetries, rounded.
std::set<std::array<long, 9>> linearParts(const std::vector<CellSymmetry>& symmetries) {
  std::set<std::array<long, 9>> parts;
  for (const CellSymmetry& symmetry : symmetries) {
    std::array<long, 9> part;
    for (int i = 0; i < 9; ++i) part[i] = std::lround(symmetry.linear.data()[i] * 1e6);
    parts.insert(part);
  }
  return parts;
}

}  // namespace

class TestCellSymmetry : public QObject {
  Q_OBJECT

 private slots:
  void cells_data() {
    QTest::addColumn<int>("index");
    for (std::size_t i = 0; i < cells().size(); ++i)
      QTest::newRow(qPrintable(QString("%1 %2").arg(i).arg(cells()[i].name.c_str()))) << static_cast<int>(i);
  }

  /// They form a group: with two symmetries there is the one after the other.
  void groups_data() { cells_data(); }
  void groups() {
    QFETCH(int, index);
    const auto symmetries = symmetriesOf(cells()[index]);
    QVERIFY(!symmetries.empty() && symmetries.front().linear.isIdentity());
    const auto parts = linearParts(symmetries);
    QCOMPARE(parts.size(), symmetries.size());
    for (const CellSymmetry& first : symmetries)
      for (const CellSymmetry& second : symmetries) {
        CellSymmetry product = first;
        product.linear = first.linear * second.linear;
        for (int i = 0; i < 9; ++i)  // minus zero
          if (std::abs(product.linear.data()[i]) < 1e-9) product.linear.data()[i] = 0;
        QVERIFY(parts.contains(*linearParts({product}).begin()));
      }
  }

  /// A deformed state that is mapped is one of the same material: proper rotations, the same gap and the same limit in
  /// the mapped direction. The solver knows nothing of symmetries.
  void mappedStates_data() { cells_data(); }
  void mappedStates() {
    QFETCH(int, index);
    const UnitCell& cell = cells()[index];
    const CellSolver solver(cell);
    CellState state = solver.perturbed(restState(cell), 0.1, 7);
    state.strain = Vector3d(1e-3, 5e-4, -7e-4);
    const double reach = 2 * cell.smallestRadius();
    const double gap = solver.contact().smallestGap(state, reach);
    QVERIFY(gap > 0 && gap < reach);
    const Vector3d direction = Vector3d(1, 0.3, -0.2).normalized();
    const CellEquilibrium limit = solver.solve(state, rayDrive(direction));
    QVERIFY(limit.converged() && limit.kind == RestKind::locked);
    const double farthest = direction.dot(limit.state.strain);
    for (const CellSymmetry& symmetry : symmetriesOf(cell)) {
      const CellState image = symmetry.mapped(cell, state);
      for (const Eigen::Matrix3d& rotation : image.rotations) {
        QVERIFY((rotation * rotation.transpose()).isIdentity(1e-9));
        QVERIFY(rotation.determinant() > 0);
      }
      QVERIFY(std::abs(solver.contact().smallestGap(image, reach) - gap) < 1e-6 * reach);
      const Vector3d other = symmetry.strainMap() * direction;
      const CellEquilibrium same = solver.solve(image, rayDrive(other));
      QVERIFY(same.converged());
      QVERIFY2(std::abs(other.dot(same.state.strain) - farthest) < 1e-4,
               qPrintable(QString("%1 %2").arg(other.dot(same.state.strain)).arg(farthest)));
    }
  }

  /// What is known of the shipped materials: rotations of the plane about z without turning it over.
  void knownGroups() {
    const auto rotations = [](const UnitCell& cell) {
      int count = 0;
      for (const CellSymmetry& symmetry : symmetriesOf(cell))
        count += symmetry.linear(2, 2) > 0 && symmetry.linear.determinant() > 0;
      return count;
    };
    QCOMPARE(rotations(torusKnot()), 4);
    QCOMPARE(rotations(threefold()) % 3, 0);
    QCOMPARE(rotations(squareRosette()) % 4, 0);
    QCOMPARE(rotations(scaleMail()) % 3, 0);
    QVERIFY(rotations(fourInOne()) >= 2);
  }

  /// A ring that is moved or made thicker breaks symmetries.
  void brokenSymmetries() {
    UnitCell cell = ringNet();
    const std::size_t all = symmetriesOf(cell).size();
    QVERIFY(all >= 4);
    cell.elements.back().position += Vector3d(1e-4, 2e-4, 3e-4);
    QVERIFY(symmetriesOf(cell).size() < all);
    cell = torusKnot();
    cell.elements.front().rotation = Eigen::AngleAxisd(0.1, Vector3d(1, 2, 0.5).normalized()).toRotationMatrix();
    QVERIFY(symmetriesOf(cell).size() <= 2);
  }

  /// Each orbit has as many directions as there are different strain maps, but for those on axes and planes.
  void orbitsCoverTheSphere_data() { cells_data(); }
  void orbitsCoverTheSphere() {
    QFETCH(int, index);
    const auto symmetries = symmetriesOf(cells()[index]);
    const SphereMesh mesh = symmetricIcosphere(3, symmetries);
    const DirectionOrbits orbits = orbitsOf(mesh, symmetries);
    std::set<std::array<long, 9>> maps;
    for (const CellSymmetry& symmetry : symmetries) {
      CellSymmetry map = symmetry;
      map.linear = symmetry.strainMap();
      for (int i = 0; i < 9; ++i)
        if (std::abs(map.linear.data()[i]) < 1e-9) map.linear.data()[i] = 0;
      maps.merge(linearParts({map}));
    }
    int representatives = 0;
    for (int i = 0; i < 642; ++i) {
      representatives += orbits.representative[i] == i;
      const Vector3d image = symmetries[orbits.symmetry[i]].strainMap() * mesh.directions[orbits.representative[i]];
      QVERIFY((image - mesh.directions[i]).norm() < 1e-7);
    }
    QCOMPARE(representatives, orbits.count);
    QVERIFY2(orbits.count < 1.35 * 642 / maps.size() + 1,
             qPrintable(QString("%1 orbits, %2 maps").arg(orbits.count).arg(maps.size())));
  }
};

QTEST_GUILESS_MAIN(TestCellSymmetry)
#include "test_cell_symmetry.moc"
