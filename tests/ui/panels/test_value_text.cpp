#include <QTest>

#include "ui/panels/value_text.hpp"

using namespace pliant;
using panels::Json;

namespace {

base::ParameterSpec numberSpec(const base::Dimension& dimension) {
  base::ParameterSpec spec;
  spec.kind = base::ValueKind::number;
  spec.dimension = dimension;
  return spec;
}

}  // namespace

class TestValueText : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void namesAreReadable() { QCOMPARE(panels::humanName("young_modulus"), QString("Young modulus")); }

  void numbersAreShownAsWrittenOrWithAPrefix() {
    const auto mass = numberSpec(base::dimensions::mass);
    QCOMPARE(panels::displayText(0.0124, 0.0124, mass), QString("12.40 g"));
    QCOMPARE(panels::displayText(0.0124, "12.4 g", mass), QString("12.4 g"));
    QCOMPARE(panels::displayText(0.69813, "40 deg", numberSpec(base::dimensions::angle)), QString("40 deg"));
  }

  void editingKeepsEveryDigitAndTheUnitThatIsShown() {
    const auto mass = numberSpec(base::dimensions::mass);
    QCOMPARE(panels::editText(0.012345678, Json(), mass), QString("12.345678 g"));
    QCOMPARE(panels::editText(0.0124, "12.4 g", mass), QString("12.4 g"));
  }

  void bareNumbersTakeTheUnitThatIsShown() {
    const auto mass = numberSpec(base::dimensions::mass);
    QVERIFY(panels::parseText("15", "12.40 g", mass) == Json("15 g"));
    QVERIFY(panels::parseText("15 kg", "12.40 g", mass) == Json("15 kg"));
    QVERIFY(panels::parseText("0.3", "0.25", numberSpec(base::dimensions::none)) == Json(0.3));
    // What is no number goes to the scene as it is, which says what is wrong with it.
    for (const char* bad : {"nan", "inf", "heavy", ""}) QVERIFY(panels::parseText(bad, "12.40 g", mass).is_string());
  }

  void shortVectorsStandInOneLine() {
    base::ParameterSpec vector;
    vector.kind = base::ValueKind::list;
    vector.items = {numberSpec(base::dimensions::acceleration)};
    const Json gravity{0, 0, -9.81};
    QVERIFY(panels::isShortVector(gravity, vector));
    QCOMPARE(panels::displayText(gravity, gravity, vector).count(','), 2);
    const Json typed = panels::parseText("0, 0, -1.62 m/s^2", panels::displayText(gravity, gravity, vector), vector);
    QCOMPARE(typed.size(), 3u);
    QVERIFY(typed[2] == Json("-1.62 m/s^2"));
    QVERIFY(!panels::isShortVector(Json{0, 1, 2, 3, 4, 5}, vector));
  }

  void roundedQuantitiesMeanWhatTheySay() {
    for (const double value : {0.0123456, 1.0, 3.14159e-6, 512.3456}) {
      const auto near = panels::rounded(value, base::dimensions::mass);
      QCOMPARE(base::parseQuantity(near.text, base::dimensions::mass), near.value);
      QVERIFY(std::abs(near.value - value) < 1e-3 * value);
    }
  }
};

QTEST_MAIN(TestValueText)
#include "test_value_text.moc"
