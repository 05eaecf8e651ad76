#include <QTest>
#include <cmath>
#include <limits>
#include <random>

#include "core/math/packet.hpp"

using pliant::math::Packet;

namespace {

Packet toPacket(const double* values) {
  Packet packet;
  pliant::math::load(values, packet);
  return packet;
}

/// Distance in units of the last place of `expected`.
double ulps(double value, double expected) {
  const double unit = std::nextafter(std::abs(expected), std::numeric_limits<double>::infinity()) - std::abs(expected);
  return std::abs(value - expected) / unit;
}

}  // namespace

/// A packet against the same operations on its eight doubles.
class TestPacket : public QObject {
  Q_OBJECT

 private slots:
  void arithmeticIsThatOfDoubles();
  void anglesAgreeWithTheLibrary();
  void anglesOnTheAxes();
  void sineAndCosineAgreeWithTheLibrary();
};

void TestPacket::arithmeticIsThatOfDoubles() {
  const double a[] = {1, -2, 3.5, 0.1, 1e300, -1e-300, 7, 0}, b[] = {3, 0.7, -5, 0.3, 2, 11, 1e10, -1};
  const Packet p = toPacket(a), q = toPacket(b);
  Packet sum = p, product = p;
  sum += q;
  product *= q;
  for (int i = 0; i < Packet::width; ++i) {
    QCOMPARE((p + q)[i], a[i] + b[i]);
    QCOMPARE((p - q)[i], a[i] - b[i]);
    QCOMPARE((p * q)[i], a[i] * b[i]);
    QCOMPARE((p / q)[i], a[i] / b[i]);
    QCOMPARE((-p)[i], -a[i]);
    QCOMPARE((2.0 * q)[i], 2.0 * b[i]);
    QCOMPARE(sum[i], a[i] + b[i]);
    QCOMPARE(product[i], a[i] * b[i]);
    QCOMPARE(sqrt(p * p)[i], std::sqrt(a[i] * a[i]));
  }
  double memory[] = {1, 2, 3, 4, 5, 6, 7, 8};
  pliant::math::addTo(memory, q);
  for (int i = 0; i < Packet::width; ++i) QCOMPARE(memory[i], i + 1 + b[i]);
}

void TestPacket::anglesAgreeWithTheLibrary() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> direction(-M_PI, M_PI), exponent(-12, 12);
  for (int trial = 0; trial < 20000; ++trial) {
    double x[Packet::width], y[Packet::width];
    for (int i = 0; i < Packet::width; ++i) {
      const double angle = direction(random), size = std::pow(10, exponent(random));
      x[i] = size * std::cos(angle);
      y[i] = size * std::sin(angle) * (trial % 2 ? 1 : std::pow(10, exponent(random)));
    }
    const Packet angles = atan2(toPacket(y), toPacket(x));
    for (int i = 0; i < Packet::width; ++i) QVERIFY(ulps(angles[i], std::atan2(y[i], x[i])) <= 2);
  }
}

void TestPacket::anglesOnTheAxes() {
  const double x[] = {1, 0, -1, 0, 0, 1, -1, 1e-320}, y[] = {0, 1, 0, -1, 0, 1, -1, 0};
  const Packet angles = atan2(toPacket(y), toPacket(x));
  for (int i = 0; i < Packet::width; ++i) QCOMPARE(angles[i], std::atan2(y[i], x[i]));
}

void TestPacket::sineAndCosineAgreeWithTheLibrary() {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> sign(-1, 1), exponent(-9, 5);
  std::uniform_int_distribution<int> quarter(-40, 40);
  for (int trial = 0; trial < 20000; ++trial) {
    double angle[Packet::width];
    for (double& a : angle) a = trial % 2 ? sign(random) * std::pow(10, exponent(random)) : quarter(random) * M_PI_4;
    Packet sine, cosine;
    sineAndCosine(toPacket(angle), sine, cosine);
    for (int i = 0; i < Packet::width; ++i) {
      QVERIFY(std::abs(sine[i] - std::sin(angle[i])) <= 4e-16);
      QVERIFY(std::abs(cosine[i] - std::cos(angle[i])) <= 4e-16);
      if (std::abs(angle[i]) < 1e-3) QVERIFY(ulps(sine[i], std::sin(angle[i])) <= 2);  // small ones keep their digits
    }
  }
}

QTEST_GUILESS_MAIN(TestPacket)
#include "test_packet.moc"
