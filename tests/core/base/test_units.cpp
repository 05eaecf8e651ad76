#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

using namespace pliant::base;
namespace dim = pliant::base::dimensions;

class TestUnits : public QObject {
  Q_OBJECT

 private slots:
  void readsUnits_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<int>("mass");
    QTest::addColumn<int>("length");
    QTest::addColumn<int>("time");
    QTest::addColumn<int>("angle");
    QTest::addColumn<double>("value");
    const double pi = std::numbers::pi;
    const auto row = [](const char* text, Dimension d, double value) {
      QTest::newRow(text) << QString::fromUtf8(text) << d.mass << d.length << d.time << d.angle << value;
    };
    row("70.2 N/m", dim::stiffness, 70.2);
    row("3.3 GPa", dim::pressure, 3.3e9);
    row("3.3GPa", dim::pressure, 3.3e9);
    row("0.5 N/m^3", {1, -2, -2, 0}, 0.5);
    row("2 mN/mm", dim::stiffness, 2);
    row("2.7 g/cm^3", dim::density, 2700);
    row("2.7 g/cm³", dim::density, 2700);
    row("1380 kg/m^3", dim::density, 1380);
    row("12.4 g", dim::mass, 0.0124);
    row("0.3 t", dim::mass, 300);
    row("25 µm", dim::length, 25e-6);
    row("25 um", dim::length, 25e-6);
    row("146 mm", dim::length, 0.146);
    row("1e1 cm", dim::length, 0.1);
    row("5 ms", dim::time, 0.005);
    row("2 min", dim::time, 120);
    row("40 deg", dim::angle, 40 * pi / 180);
    row("90°", dim::angle, pi / 2);
    row("2.5 Hz", dim::angularFrequency, 5 * pi);
    row("2.5 kHz", dim::angularFrequency, 5000 * pi);
    row("60 rpm", dim::angularFrequency, 2 * pi);
    row("11 rad/s", dim::angularFrequency, 11);
    row("0.5 1/s", dim::rate, 0.5);
    row("0.5 Hz", dim::rate, 0.5);
    row("-9.81 m/s^2", dim::acceleration, -9.81);
    row("3 m s^-2", dim::acceleration, 3);
    row("1 kg*m/s^2", dim::force, 1);
    row("2 kg·m/s²", dim::force, 2);
    row("6 N s/m", {1, 0, -1, 0}, 6);
    row("8 J/m^2", dim::stiffness, 8);
    row("12", dim::length, 12);
    row("  +1.5e-3  ", dim::mass, 1.5e-3);
    row(".5", dim::none, 0.5);
    row("36 %", dim::none, 0.36);
  }
  void readsUnits() {
    QFETCH(QString, text);
    QFETCH(int, mass);
    QFETCH(int, length);
    QFETCH(int, time);
    QFETCH(int, angle);
    QFETCH(double, value);
    const double read = parseQuantity(text.toStdString(), {mass, length, time, angle});
    QVERIFY2(std::abs(read - value) <= 2e-16 * std::abs(value), qPrintable(QString::number(read, 'g', 17)));
  }

  void readsDecimalPrefixesWithoutRounding() {
    QCOMPARE(parseQuantity("12.4 g", dim::mass), 0.0124);
    QCOMPARE(parseQuantity("0.1 mm", dim::length), 1e-4);
    QCOMPARE(parseQuantity("1.7e-3 GPa", dim::pressure), 1.7e6);
  }

  void refusesWhatIsNoQuantity_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("says");
    for (const char* text : {"", " ", "nan", "inf", "-inf", "mm", "1,5 mm", "abc", "--3", "0x10 mm", "- 3 m", "+-3 m"})
      QTest::addRow("<%s>", text) << text << "";
    QTest::newRow("mass") << "3 kg"
                          << "wrong unit; expected a value in m";
    QTest::newRow("frequency") << "3 Hz"
                               << "wrong unit";
    QTest::newRow("unknown") << "3 furlong"
                             << "\"furlong\" is not known";
    QTest::newRow("incomplete") << "3 m/"
                                << "incomplete";
    QTest::newRow("double slash") << "3 m//s"
                                  << "incomplete";
    QTest::newRow("exponent") << "3 m^x"
                              << "exponent";
    QTest::newRow("huge exponent") << "3 m^99999999999"
                                   << "exponent";
    QTest::newRow("overflow") << "1e999 m"
                              << "too large";
    QTest::newRow("overflow by prefix") << "1e308 km"
                                        << "too large";
    QTest::newRow("prefix alone") << "3 k"
                                  << "not known";
    QTest::newRow("two prefixes") << "3 mmm"
                                  << "not known";
  }
  void refusesWhatIsNoQuantity() {
    QFETCH(QString, text);
    QFETCH(QString, says);
    try {
      const double value = parseQuantity(text.toStdString(), dim::length);
      QFAIL(qPrintable(QString("accepted as %1").arg(value)));
    } catch (const InputError& error) {
      const QString problem = QString::fromStdString(error.problem());
      QVERIFY(error.location().empty());
      QVERIFY2(problem.endsWith('.') && problem.count('\n') == 0, qPrintable(problem));
      QVERIFY2(problem.contains(says), qPrintable(problem));
    }
  }

  void anAngularFrequencyNeedsHzOrRadians() {
    QVERIFY_EXCEPTION_THROWN(parseQuantity("11 1/s", dim::angularFrequency), InputError);
    QVERIFY_EXCEPTION_THROWN(parseQuantity("11 rad/s", dim::rate), InputError);
  }

  void formats_data() {
    QTest::addColumn<double>("value");
    QTest::addColumn<int>("which");
    QTest::addColumn<QString>("text");
    QTest::newRow("g") << 0.0124 << 0 << "12.40 g";
    QTest::newRow("kg") << 1.5 << 0 << "1.500 kg";
    QTest::newRow("mg") << 2.5e-6 << 0 << "2.500 mg";
    QTest::newRow("tonnes") << 12345.6 << 0 << "12350 kg";
    QTest::newRow("mm") << 0.0124 << 1 << "12.40 mm";
    QTest::newRow("µm") << 1.25e-4 << 1 << "125.0 µm";
    QTest::newRow("rounds up") << 0.99996 << 1 << "1.000 m";
    QTest::newRow("negative") << -0.5 << 1 << "-500.0 mm";
    QTest::newRow("zero") << 0.0 << 1 << "0 m";
    QTest::newRow("GPa") << 3.3e9 << 2 << "3.300 GPa";
    QTest::newRow("rad/s") << 11.0 << 3 << "11.00 rad/s";
    QTest::newRow("deg") << std::numbers::pi / 4 << 4 << "45.00 deg";
    QTest::newRow("number") << 0.36 << 5 << "0.3600";
    QTest::newRow("small number") << 5e-5 << 5 << "5.000e-05";
    QTest::newRow("kN/m") << 70200.0 << 6 << "70.20 kN/m";
    QTest::newRow("density") << 1380.0 << 7 << "1380 kg/m^3";
  }
  void formats() {
    QFETCH(double, value);
    QFETCH(int, which);
    QFETCH(QString, text);
    const Dimension all[] = {dim::mass,  dim::length, dim::pressure,  dim::angularFrequency,
                             dim::angle, dim::none,   dim::stiffness, dim::density};
    QCOMPARE(QString::fromStdString(formatQuantity(value, all[which])), text);
  }

  void siUnits() {
    QCOMPARE(siUnit(dim::none), std::string());
    QCOMPARE(siUnit(dim::stiffness), std::string("N/m"));
    QCOMPARE(siUnit({1, -2, -2, 0}), std::string("N/m^3"));
    QCOMPARE(siUnit(dim::pressure), std::string("Pa"));
    QCOMPARE(siUnit(dim::density), std::string("kg/m^3"));
    QCOMPARE(siUnit(dim::angularFrequency), std::string("rad/s"));
    QCOMPARE(siUnit(dim::rate), std::string("1/s"));
    QCOMPARE(siUnit(dim::acceleration), std::string("m/s^2"));
  }

  void everyDimensionAndValueIsReadBack() {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> exponent(-3, 3);
    std::uniform_real_distribution<double> mantissa(-10, 10);
    std::uniform_int_distribution<int> decimals(-14, 14);
    for (int i = 0; i < 3000; ++i) {
      const Dimension d{exponent(random), exponent(random), exponent(random), exponent(random)};
      const double value = mantissa(random) * std::pow(10, decimals(random));
      const std::string exact = formatQuantityExactly(value, d);
      QVERIFY2(parseQuantity(exact, d) == value, exact.c_str());
      const std::string shown = formatQuantity(value, d);
      const double relative = std::abs(parseQuantity(shown, d) / value - 1);
      QVERIFY2(relative <= 0.5e-3 * (1 + 1e-9), shown.c_str());
    }
  }

  void formatsWhatIsNotFinite() {
    QCOMPARE(formatQuantity(std::numeric_limits<double>::quiet_NaN(), dim::length), std::string("nan m"));
    QCOMPARE(formatQuantity(-std::numeric_limits<double>::infinity(), dim::none), std::string("-inf"));
  }
};

QTEST_GUILESS_MAIN(TestUnits)
#include "test_units.moc"
