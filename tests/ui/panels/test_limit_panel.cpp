#include <QComboBox>
#include <QFloat16>
#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "ui/panels/limit_panel.hpp"
#include "ui/panels/limit_table.hpp"
#include "ui/plots/polar_editor.hpp"

using namespace pliant;
using panels::ConstraintMethod;
using panels::Json;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// As the scene normalises it: angles in radians.
Json normalized(Json entry) {
  const auto read = [](Json& value) {
    if (value.is_string()) value = base::parseQuantity(value.get<std::string>(), base::dimensions::angle);
  };
  if (entry.contains("angle")) read(entry["angle"]);
  if (entry.contains("points"))
    for (Json& point : entry["points"]) read(point["angle"]);
  return entry;
}

}  // namespace

/// Stretch limits between the polar editor and the scene.
class TestLimitPanel : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void entriesComeBackFromTheScene() {
    const cloth::StretchLimit limits[] = {cloth::IsotropicLimit{1.01}, cloth::OrthotropicLimit{1.1, 1.02, 30 * degree},
                                          cloth::LimitCurve({{0.1, 1.1}, {37.5 * degree, 1.2}, {179 * degree, 1.05}})};
    Json entry = {{"name", "linen"}, {"element", "sheet"}, {"direction", {1, 0, 0}}};
    for (const cloth::StretchLimit& limit : limits) {
      entry = panels::entryWith(entry, limit, {ConstraintMethod::directions, 8});
      QVERIFY(plots::sameLimit(panels::limitOf(normalized(entry)), limit));
      QVERIFY(entry["name"] == Json("linen"));
      QVERIFY(entry["element"] == Json("sheet"));
      QVERIFY(entry["direction"] == Json({1, 0, 0}));
    }
    QVERIFY(entry["points"][1]["angle"] == Json("37.5 deg"));
    QVERIFY((panels::constraintChoiceOf(entry) == panels::ConstraintChoice{ConstraintMethod::directions, 8}));
    // What the other kinds have no use for goes.
    entry = panels::entryWith(entry, limits[0], {});
    QCOMPARE(entry.size(), std::size_t(5));
  }

  void theChoiceOfConstraintsIsKept() {
    const cloth::StretchLimit curve = cloth::LimitCurve({{0, 1.1}, {1, 1.2}, {2, 1.05}});
    QCOMPARE(panels::constraintsOf(curve, {ConstraintMethod::ellipses, 7}).ellipses.size(), std::size_t(7));
    QCOMPARE(panels::constraintsOf(curve, {ConstraintMethod::directions, 7}).directions.size(), std::size_t(7));
    QCOMPARE(panels::constraintsOf(cloth::IsotropicLimit{1.1}, {ConstraintMethod::directions, 7}).overshoot, 0.0);
  }

  void numbersAreTyped() {
    panels::LimitTable table;
    const plots::LimitShape shape(cloth::LimitCurve({{0, 1.1}, {60 * degree, 1.2}, {100 * degree, 1.05}}));
    table.setShape(&shape);
    QCOMPARE(table.rowCount(), 3);
    QCOMPARE(table.item(1, 0)->text(), QString("60"));
    QCOMPARE(table.item(1, 1)->text(), QString("1.2"));
    QSignalSpy typed(&table, &panels::LimitTable::typed), refused(&table, &panels::LimitTable::refused);
    const auto place = [&] { return typed.last()[1].value<cloth::DirectionLimit>(); };
    table.item(1, 0)->setText("62.5°");
    QVERIFY(std::abs(place().angle - 62.5 * degree) < 1e-12 && place().stretch == 1.2);
    table.item(2, 1)->setText("+7.5 %");
    QVERIFY(std::abs(place().stretch - 1.075) < 1e-12 && std::abs(place().angle - 100 * degree) < 1e-12);
    QCOMPARE(typed.count(), 2);
    table.item(2, 1)->setText("wide");
    QCOMPARE(typed.count(), 2);
    QCOMPARE(refused.last()[0].toString(), QString("“wide” is no number."));
    // An isotropic limit has no direction to type.
    const plots::LimitShape isotropic;
    table.setShape(&isotropic);
    QVERIFY(!(table.item(0, 0)->flags() & Qt::ItemIsEditable));
    QVERIFY(table.item(0, 1)->flags() & Qt::ItemIsEditable);
  }

  void withoutLimitsThereIsNothingToEdit() {
    document::Document document;
    panels::LimitPanel panel(document);
    QVERIFY(document.open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/membrane_strip.json")));
    QCOMPARE(panel.shownLimit(), -1);
    QVERIFY(!panel.kinds()->isEnabled());
    QVERIFY(!panel.editor()->shape());
    QCOMPARE(panel.table()->rowCount(), 0);
  }
};

QTEST_MAIN(TestLimitPanel)
#include "test_limit_panel.moc"
