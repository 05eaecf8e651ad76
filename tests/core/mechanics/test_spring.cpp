#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/spring.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

ElasticAssembler assemblerOf(const std::shared_ptr<const Energy>& energy, int nodes, int dimension) {
  Model model;
  model.dimension = dimension;
  model.restPositions = Vector::Zero(nodes * dimension);
  model.energies.push_back(energy);
  model.finish();
  return ElasticAssembler(std::make_shared<const Model>(model));
}

Vector vector(std::initializer_list<double> values) {
  Vector result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.data());
  return result;
}

}  // namespace

class TestSpring : public QObject {
  Q_OBJECT

 private slots:
  void duffingForce();
  void groundedSpringPullsAlongItsDirection();
  void springForceIsThePolynomial();
  void anchoredSpringPullsToItsPlace();
  void zeroLengthIsSafe_data();
  void zeroLengthIsSafe();
  void badInputIsRefused();
};

void TestSpring::duffingForce() {
  const double gamma = 0.5;
  const ElasticAssembler assembler =
      assemblerOf(makeGroundedSpring(2, 0, vector({3, 4}), vector({1, 0}), {{1, 0, gamma}}), 1, 2);
  for (const double e : {-1.7, -0.2, 0.0, 0.3, 2.0}) {
    const Vector x = vector({3 + e, 7});
    const double force = e + gamma * e * e * e, energy = e * e / 2 + gamma * e * e * e * e / 4;
    QVERIFY(std::abs(assembler.gradient(x)[0] - force) <= 1e-14);
    QCOMPARE(assembler.gradient(x)[1], 0.0);
    QVERIFY(std::abs(assembler.value(x) - energy) <= 1e-14);
    QVERIFY(std::abs(assembler.hessian(x).coeff(0, 0) - (1 + 3 * gamma * e * e)) <= 1e-14);
  }
}

void TestSpring::groundedSpringPullsAlongItsDirection() {
  const Vector direction = vector({0.6, 0, 0.8});
  const ElasticAssembler assembler =
      assemblerOf(makeGroundedSpring(3, 0, vector({1, 1, 1}), direction, {{10, 4}}), 1, 3);
  const Vector x = vector({1.5, 9, 0.75});  // e = 0.3 - 0.2
  QVERIFY((assembler.gradient(x) - (10 * 0.1 + 4 * 0.01) * direction).norm() <= 1e-14);
}

void TestSpring::springForceIsThePolynomial() {
  const ElasticAssembler assembler = assemblerOf(makeSpring(3, 0, 1, 4, {{7, -2, 3}}), 2, 3);
  const Vector x = vector({1, 1, 1, 4, 1, 5});  // distance 5 along (0.6, 0, 0.8), e = 1
  const Vector gradient = assembler.gradient(x);
  QVERIFY((gradient.tail(3) - 8 * vector({0.6, 0, 0.8})).norm() <= 1e-13);
  QVERIFY((gradient.head(3) + gradient.tail(3)).norm() <= 1e-15);
  QVERIFY(std::abs(assembler.value(x) - (3.5 - 2.0 / 3 + 0.75)) <= 1e-14);
}

void TestSpring::anchoredSpringPullsToItsPlace() {
  const ElasticAssembler assembler = assemblerOf(makeAnchoredSpring(2, 0, vector({1, 2}), 3, {{5}}), 1, 2);
  const Vector gradient = assembler.gradient(vector({1, 6}));
  QVERIFY((gradient - vector({0, 5})).norm() <= 1e-14);
}

void TestSpring::zeroLengthIsSafe_data() {
  QTest::addColumn<double>("restLength");
  QTest::newRow("of rest length 0") << 0.0;
  QTest::newRow("of some rest length") << 0.5;
}

void TestSpring::zeroLengthIsSafe() {
  QFETCH(double, restLength);
  for (const int dimension : {2, 3}) {
    const ElasticAssembler assembler = assemblerOf(makeSpring(dimension, 0, 1, restLength, {{7, 1, 3}}), 2, dimension);
    const Vector x = Vector::Constant(2 * dimension, 0.25);
    const Matrix rows = x.transpose().replicate(8, 1);
    Matrix gradient, hessian;
    assembler.evaluate(rows, gradient, &hessian);
    QVERIFY(std::isfinite(assembler.value(x)));
    QVERIFY(assembler.gradient(x).isZero(0) && gradient.isZero(0));
    const Matrix stiffness = assembler.hessian(x);
    QVERIFY(stiffness.allFinite() && hessian.allFinite());
    // With rest length 0 the energy is smooth there: ½ 7 |r|² to second order.
    const Matrix block = stiffness.topLeftCorner(dimension, dimension);
    const double expected = restLength == 0 ? 7 : 0;
    QVERIFY((block - expected * Matrix::Identity(dimension, dimension)).norm() <= 1e-14);
  }
}

void TestSpring::badInputIsRefused() {
  const double nan = std::nan("");
  const SpringLaw law{{1}};
  QVERIFY_EXCEPTION_THROWN(makeSpring(4, 0, 1, 1, law), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeSpring(3, 0, 0, 1, law), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeSpring(3, 0, 1, -1, law), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeSpring(3, 0, 1, nan, law), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeSpring(3, 0, 1, 1, {}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeSpring(3, 0, 1, 1, {{nan}}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeAnchoredSpring(3, 0, vector({0, 0}), 1, law), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeAnchoredSpring(3, 0, vector({0, 0, nan}), 1, law), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeGroundedSpring(2, 0, vector({0, 0}), vector({2, 0}), law), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeGroundedSpring(2, 0, vector({0, 0}), vector({nan, 0}), law), base::InputError);
}

QTEST_GUILESS_MAIN(TestSpring)
#include "test_spring.moc"
