#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "core/interlock/cell_equilibrium.hpp"
#include "core/interlock/element_families.hpp"
#include "core/math/parallel.hpp"
#include "tests/core/interlock/link_oracles.hpp"

using namespace pliant::interlock;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

namespace {

/// Points of a piece's core, dense against its radius.
Matrix3Xd pointsOf(const DilatedPiece& piece) {
  if (const auto* curve = std::get_if<ClosedCurve>(&piece.core))
    return sampled(*curve, Eigen::Matrix3d::Identity(), Vector3d::Zero(), 240);
  const SimplexSet& set = std::get<SimplexSet>(piece.core);
  std::vector<Vector3d> points;
  constexpr int n = 12;
  for (const auto& [from, to] : set.segments)
    for (int i = 0; i <= n; ++i)
      points.push_back(set.corners.col(from) + (set.corners.col(to) - set.corners.col(from)) * i / n);
  for (const auto& [a, b, c] : set.triangles)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        points.push_back((set.corners.col(a) * i + set.corners.col(b) * j + set.corners.col(c) * (n - i - j)) / n);
  Matrix3Xd result(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = points[i];
  return result;
}

double smallestDistance(const Matrix3Xd& a, const Matrix3Xd& b) {
  double smallest = 1;
  for (Eigen::Index i = 0; i < a.cols(); ++i)
    smallest = std::min(smallest, (b.colwise() - a.col(i)).colwise().squaredNorm().minCoeff());
  return std::sqrt(smallest);
}

/// By all pairs of points of all elements and images: no two overlap, and curves are linked as at rest by Gauss's
/// integral. Nothing of the library's contact code is used. Empty if all is well.
QString faultOf(const UnitCell& cell, const CellState& state) {
  const int count = static_cast<int>(cell.elements.size());
  const Eigen::Matrix2d lattice = stretchOf(state.strain) * cell.lattice;
  std::vector<std::vector<Matrix3Xd>> points;
  double reach = 0;
  for (const ElementShape& shape : cell.shapes) {
    auto& own = points.emplace_back();
    for (const DilatedPiece& piece : shape.pieces) {
      own.push_back(pointsOf(piece));
      reach = std::max(reach, own.back().colwise().norm().maxCoeff() + piece.radius);
    }
  }
  // All images that can come near: their number along each lattice vector is bounded by the distance of its lines.
  const double area = std::abs(lattice.determinant());
  const int firstCount = static_cast<int>(std::ceil(4 * reach * lattice.col(1).norm() / area)) + 1;
  const int secondCount = static_cast<int>(std::ceil(4 * reach * lattice.col(0).norm() / area)) + 1;
  for (int a = 0; a < count; ++a)
    for (int b = a; b < count; ++b)
      for (int i = -firstCount; i <= firstCount; ++i)
        for (int j = -secondCount; j <= secondCount; ++j) {
          if (a == b && (i < 0 || (i == 0 && j <= 0))) continue;
          Vector3d offset = state.positions.col(a) - state.positions.col(b);
          offset.head<2>() -= lattice * Eigen::Vector2d(i, j);
          if (offset.norm() > 2 * reach) continue;
          const ElementShape &shapeA = cell.shapes[cell.elements[a].shape],
                             &shapeB = cell.shapes[cell.elements[b].shape];
          for (std::size_t p = 0; p < shapeA.pieces.size(); ++p)
            for (std::size_t q = 0; q < shapeB.pieces.size(); ++q) {
              const auto &pieceA = shapeA.pieces[p], &pieceB = shapeB.pieces[q];
              const Matrix3Xd onA = (state.rotations[a] * points[cell.elements[a].shape][p]).colwise() + offset;
              const Matrix3Xd onB = state.rotations[b] * points[cell.elements[b].shape][q];
              const Vector3d centreA = onA.rowwise().mean(), centreB = onB.rowwise().mean();
              const double sizeA = (onA.colwise() - centreA).colwise().norm().maxCoeff();
              const double sizeB = (onB.colwise() - centreB).colwise().norm().maxCoeff();
              int expected = 0;
              for (const Link& link : cell.links) {
                const Link place = canonical({a, static_cast<int>(p), b, static_cast<int>(q), {i, j}, link.number});
                if (canonical(link) == place) expected = link.number;
              }
              const double between = (centreA - centreB).norm();
              if (between < sizeA + sizeB + pieceA.radius + pieceB.radius)
                if (const double distance = smallestDistance(onA, onB); !(distance > pieceA.radius + pieceB.radius))
                  return QString("elements %1 and %2 (%3 %4) overlap, %5").arg(a).arg(b).arg(i).arg(j).arg(distance);
              const auto* curveA = std::get_if<ClosedCurve>(&pieceA.core);
              const auto* curveB = std::get_if<ClosedCurve>(&pieceB.core);
              if (!curveA || !curveB || (between > sizeA + sizeB && expected == 0)) continue;
              const double integral =
                  gaussIntegral(curveA->rotated(state.rotations[a]), curveB->rotated(state.rotations[b]), offset, 160);
              if (std::abs(integral - expected) > 0.1)
                return QString("elements %1 and %2 (%3 %4) are linked %5 times")
                    .arg(a)
                    .arg(b)
                    .arg(i)
                    .arg(j)
                    .arg(integral);
            }
        }
  return {};
}

/// A drive far outside of what contact allows: any mix of a strain to go to, a load on the strain, and pulls on
/// elements.
StrainDrive randomDrive(std::mt19937& random, int elements) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  StrainDrive drive;
  const int kind = static_cast<int>(random() % 4);
  if (kind == 0) drive = {Eigen::Matrix3d::Identity(), Vector3d::Zero(), 1, 3 * vector(), {}};
  if (kind == 1) drive.load = vector();
  if (kind == 2) {
    drive.directions = vector().normalized();
    drive.load = (random() % 2 ? 1 : -1) * drive.directions.col(0);
  }
  if (kind == 3 || (kind == 0 && random() % 2)) {
    for (int element = 1; element < elements; ++element) drive.pulls.push_back({element, 300 * vector(), 0, {}});
    if (kind == 3) drive.load = vector();
  }
  return drive;
}

UnitCell randomCell(std::mt19937& random) {
  switch (random() % 8) {
    case 0: return fourInOne();
    case 1: return threefold();
    case 2: return torusKnot();
    case 3: return torusKnot(torusCoilDefault);
    case 4: return scaleMail();
    case 5: return squareRosette();
    case 6: return ringNet();
    default: return supercell(threefold(), 2, 1);
  }
}

}  // namespace

class TestRandomPulls : public QObject {
  Q_OBJECT

 private slots:
  /// Pulls far outside the limits never push elements into or through one another. PLIANT_RANDOM_PULLS says how many.
  void nothingPassesThrough() {
    const int pulls =
        qEnvironmentVariableIsSet("PLIANT_RANDOM_PULLS") ? qEnvironmentVariableIntValue("PLIANT_RANDOM_PULLS") : 240;
    QVERIFY(pulls > 0);
    std::vector<QString> faults(pulls);
    std::vector<int> settled(pulls), moved(pulls);
    pliant::math::parallelFor(pulls, [&](int k) {
      std::mt19937 random(1000 + k);
      const UnitCell cell = randomCell(random);
      const CellSolver solver(cell);
      const CellState start = solver.perturbed(restState(cell), 0.05, static_cast<unsigned>(k));
      const CellEquilibrium rest = solver.solve(start, randomDrive(random, static_cast<int>(cell.elements.size())));
      settled[k] = rest.converged();
      moved[k] = rest.state.strain.norm() > 0.01;
      if (rest.message.find("link") != std::string::npos) faults[k] = rest.message.c_str();
      const QString fault = faultOf(cell, rest.state);
      if (!fault.isEmpty()) faults[k] = QString("%1: %2").arg(cell.name.c_str(), fault);
    });
    for (int k = 0; k < pulls; ++k)
      QVERIFY2(faults[k].isEmpty(), qPrintable(QString("pull %1, %2").arg(k).arg(faults[k])));
    const auto share = [&](const std::vector<int>& of) { return std::accumulate(of.begin(), of.end(), 0.0) / pulls; };
    qInfo("%d pulls: %.4f settled, %.3f moved far", pulls, share(settled), share(moved));
    QVERIFY(share(settled) > 0.95);
    QVERIFY(share(moved) > 0.8);
  }
};

QTEST_GUILESS_MAIN(TestRandomPulls)
#include "test_random_pulls.moc"
