#include <QTest>
#include <cmath>
#include <random>

#include "core/base/error.hpp"
#include "tests/core/mechanics/strain_set_examples.hpp"

using namespace pliant;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using mechanics::AdmissibleStrainSet;
using mechanics::StrainFunction;
using mechanics::strainSet;

namespace {

const Vector3d halfAxes(0.3, 0.1, 0.2);

/// The gauge of an ellipsoid in closed form.
double ellipsoidGauge(const Vector3d& offset) { return offset.cwiseQuotient(halfAxes).norm(); }

double ellipsoidRadius(const Vector3d& direction) { return 1 / ellipsoidGauge(direction); }

Vector3d randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3d::NullaryExpr([&] { return normal(random); }).normalized();
}

}  // namespace

class TestAdmissibleStrainSet : public QObject {
  Q_OBJECT

 private slots:
  void gaugeIsExactOnTheSamples();
  void gaugeConvergesToTheEllipsoids();
  void derivativesOfTheGauge();
  void gaugeIsHomogeneous();
  void distanceIsRelativeToTheBox();
  void hiddenBoundaryIsRefused();
};

void TestAdmissibleStrainSet::gaugeIsExactOnTheSamples() {
  const Vector3d middle(-0.05, 0.01, 0.02);
  const auto set = strainSet(ellipsoidRadius, middle);
  for (Eigen::Index i = 0; i < set->boundary().points.cols(); ++i)
    QVERIFY(std::abs(set->gauge(set->boundary().points.col(i)).value - 1) < 1e-12);
}

/// Between the samples, against the closed form; what gaugeError says is about flat triangles, which are inside.
void TestAdmissibleStrainSet::gaugeConvergesToTheEllipsoids() {
  std::mt19937 random(1);
  std::vector<double> largest;
  for (const int subdivisions : {2, 3, 4}) {
    const auto set = strainSet(ellipsoidRadius, Vector3d::Zero(), subdivisions);
    double error = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3d direction = randomDirection(random);
      error = std::max(error, std::abs(set->gauge(direction).value / ellipsoidGauge(direction) - 1));
    }
    largest.push_back(error);
  }
  qInfo("66, 258 and 1026 directions: largest errors %.1e, %.1e, %.1e", largest[0], largest[1], largest[2]);
  QVERIFY(largest[1] < 0.25 * largest[0]);
  QVERIFY(largest[2] < 0.25 * largest[1]);
  QVERIFY(largest[2] < 1e-3);
}

void TestAdmissibleStrainSet::derivativesOfTheGauge() {
  const Vector3d middle(-0.05, 0.01, 0.02);
  const auto set = strainSet(ellipsoidRadius, middle);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> length(0.02, 0.3);
  for (int i = 0; i < 200; ++i) {
    const Vector3d strain = middle + length(random) * randomDirection(random);
    const StrainFunction at = set->gauge(strain);
    const double h = 1e-5;
    Vector3d gradient;
    Matrix3d hessian;
    for (int k = 0; k < 3; ++k) {
      const auto along = [&](double step) { return set->gauge(strain + step * Vector3d::Unit(k)); };
      gradient[k] = (8 * (along(h).value - along(-h).value) - (along(2 * h).value - along(-2 * h).value)) / (12 * h);
      hessian.col(k) =
          (8 * (along(h).gradient - along(-h).gradient) - (along(2 * h).gradient - along(-2 * h).gradient)) / (12 * h);
    }
    QVERIFY((gradient - at.gradient).norm() < 1e-8 * at.gradient.norm());
    QVERIFY((hessian - at.hessian).norm() < 1e-7 * at.hessian.norm());
    QVERIFY((at.hessian - at.hessian.transpose()).norm() < 1e-12 * at.hessian.norm());
  }
}

void TestAdmissibleStrainSet::gaugeIsHomogeneous() {
  const Vector3d middle(-0.05, 0.01, 0.02);
  const auto set = strainSet(ellipsoidRadius, middle);
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Vector3d offset = 0.1 * randomDirection(random);
    const StrainFunction near = set->gauge(middle + offset), far = set->gauge(middle + 3 * offset);
    QVERIFY(std::abs(far.value - 3 * near.value) < 1e-12);
    QVERIFY(std::abs(near.gradient.dot(offset) - near.value) < 1e-12);
    QVERIFY((near.hessian * offset).norm() < 1e-10);
  }
  QCOMPARE(set->gauge(middle).value, 0.0);
  QVERIFY(set->gauge(middle).hessian.allFinite());
}

/// An octahedron with corners at 0.3: its faces are 0.3/√3 from the middle, its box has a diagonal of 0.6 √3.
void TestAdmissibleStrainSet::distanceIsRelativeToTheBox() {
  const auto set = strainSet([](const Vector3d&) { return 0.3; }, Vector3d::Zero(), 0);
  QVERIFY(std::abs(set->size() - 0.6 * std::sqrt(3.0)) < 1e-15);
  QVERIFY(std::abs(set->distance(Vector3d::Zero()).value + 0.3 / std::sqrt(3.0) / set->size()) < 1e-15);
  QVERIFY(std::abs(set->distance({0.5, 0, 0}).value - 0.2 / set->size()) < 1e-15);
}

void TestAdmissibleStrainSet::hiddenBoundaryIsRefused() {
  const auto set = strainSet(ellipsoidRadius);
  QVERIFY_THROWS_EXCEPTION(base::InputError, AdmissibleStrainSet(set->boundary(), Vector3d(1, 0, 0)));
}

QTEST_APPLESS_MAIN(TestAdmissibleStrainSet)
#include "test_admissible_strain_set.moc"
