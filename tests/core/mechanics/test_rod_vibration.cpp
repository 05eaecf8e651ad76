#include <Eigen/Eigenvalues>
#include <QTest>

#include "tests/core/mechanics/rod_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

constexpr double youngModulus = 69e9, shearModulus = 26e9, density = 2700, radius = 0.55e-3;

RodSegment wire() {
  RodSegment segment;
  segment.material = {.youngModulus = youngModulus, .shearModulus = shearModulus, .density = density};
  segment.section = circularSection(radius);
  return segment;
}

/// Angular frequencies at rest, ascending.
Vector frequencies(const RodModel& rod) {
  const std::vector<int>& free = rod.model.dofs.freeCoordinates;
  const Matrix mass = Matrix(rod.model.massMatrix())(free, free);
  const Matrix stiffness = rod.assembler().hessian(rod.model.restPositions);
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(stiffness, mass, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .cwiseMax(0)
      .cwiseSqrt();
}

/// Checks that the relative errors of two levels are small and fall with order 2.
void checkSecondOrder(const char* what, double coarseValue, double fineValue, double exact) {
  const double coarse = std::abs(coarseValue / exact - 1), fine = std::abs(fineValue / exact - 1);
  qInfo("%s: relative errors %.2e, %.2e", what, coarse, fine);
  QVERIFY(coarse <= 0.02);
  const double order = std::log2(coarse / fine);
  QVERIFY2(order > 1.9 && order < 2.1, what);
}

}  // namespace

/// Natural frequencies against closed forms.
class TestRodVibration : public QObject {
  Q_OBJECT

 private slots:
  void straightCantilever();
  void freeRing();
};

void TestRodVibration::straightCantilever() {
  const double length = 0.2;
  const double beam = std::sqrt(youngModulus * radius * radius / 4 / density) / (length * length);
  const double shaft = M_PI / 2 * std::sqrt(shearModulus / density) / length;
  const Vector coarse = frequencies(cantilever(length, 40, wire()));
  const Vector fine = frequencies(cantilever(length, 80, wire()));
  // Roots of cos β cosh β = -1; each frequency twice, for the two planes.
  const double roots[] = {1.8751040687, 4.6940911330, 7.8547574382};
  for (int mode = 0; mode < 3; ++mode) {
    checkSecondOrder("cantilever", coarse[2 * mode], fine[2 * mode], roots[mode] * roots[mode] * beam);
    QVERIFY(std::abs(fine[2 * mode] - fine[2 * mode + 1]) <= 1e-6 * fine[2 * mode]);
  }
  // Torsion is far above: the one frequency near it that does not come in a pair.
  for (int mode = 0; mode < fine.size(); ++mode)
    if (std::abs(fine[mode] / shaft - 1) < 1e-3) return;
  QFAIL("no torsional vibration");
}

/// Rings of a round section (Hoppe 1871, Michell 1890; Love, A Treatise on the Mathematical Theory of Elasticity,
/// §293):
///   in its plane ω² = n² (n² - 1)²/(n² + 1) EI/(ρ A R⁴), across it ω² = n² (n² - 1)²/(n² + EI/GJ) EI/(ρ A R⁴).
void TestRodVibration::freeRing() {
  const double ringRadius = 0.1;
  const double unit = youngModulus * radius * radius / 4 / density / std::pow(ringRadius, 4);
  const double ratio = youngModulus / (2 * shearModulus);  // EI/GJ
  const auto frequenciesOf = [&](int count) {
    return frequencies(ring(ringRadius, count, [](const Eigen::Vector3d&) { return wire(); }));
  };
  const Vector coarse = frequenciesOf(40), fine = frequenciesOf(80);
  QVERIFY(fine[5] <= 1e-3 * fine[6]);  // six rigid motions
  // Then pairs, across and in the plane by turns.
  for (int n = 2; n <= 3; ++n) {
    const double factor = n * n * (n * n - 1.0) * (n * n - 1.0) * unit;
    const int across = 6 + 4 * (n - 2), inPlane = across + 2;
    checkSecondOrder("ring, across its plane", coarse[across], fine[across], std::sqrt(factor / (n * n + ratio)));
    checkSecondOrder("ring, in its plane", coarse[inPlane], fine[inPlane], std::sqrt(factor / (n * n + 1)));
  }
}

QTEST_GUILESS_MAIN(TestRodVibration)
#include "test_rod_vibration.moc"
