#include <QComboBox>
#include <QFile>
#include <QFloat16>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "tests/ui/panels/sheet_scene.hpp"
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
  void initTestCase() {
    QFile file(folder_.filePath("sheet.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(sheetScene);
  }

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
    QCOMPARE(panels::constraintsOf(cloth::IsotropicLimit{1.1}, {ConstraintMethod::ellipses, 7}).overshoot, 0.0);
    // Thesis 3.3.1: directions alone let an isotropic limit be exceeded by 1 / cos(π / 2m) - 1.
    const double overshoot =
        panels::constraintsOf(cloth::IsotropicLimit{1.1}, {ConstraintMethod::directions, 7}).overshoot;
    QVERIFY(std::abs(overshoot - (1 / std::cos(std::numbers::pi / 14) - 1)) < 1e-4);
    const Json isotropic = panels::entryWith({}, cloth::IsotropicLimit{1.1}, {ConstraintMethod::directions, 7});
    QVERIFY(isotropic["directions"] == 7 && !isotropic.contains("count"));
    QVERIFY((panels::constraintChoiceOf(isotropic) == panels::ConstraintChoice{ConstraintMethod::directions, 7}));
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

  void aDragIsOneUndoStep() {
    document::Document document;
    QVERIFY(document.open(folder_.filePath("sheet.json")));
    panels::LimitPanel panel(document);
    panel.resize(320, 640);
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));
    QCOMPARE(panel.limits()->count(), 2);
    QCOMPARE(panel.shownLimit(), 0);
    panel.showLimit(1);
    QCOMPARE(panel.kinds()->currentIndex(), 2);
    const auto model = document.model();
    plots::PolarEditor& editor = *panel.editor();
    const auto pixel = [&](double stretch) { return editor.axis().point(45 * degree, stretch).toPoint(); };
    QTest::mousePress(&editor, Qt::LeftButton, {}, pixel(1.17));
    for (const double stretch : {1.16, 1.14, 1.12, 1.10}) QTest::mouseMove(&editor, pixel(stretch));
    QTest::mouseRelease(&editor, Qt::LeftButton, {}, pixel(1.10));
    QCOMPARE(document.undoStack().count(), 1);
    const Json entry = document.valueAt("/stretch_limits/1");
    QVERIFY(std::abs(entry["points"][1]["stretch"].get<double>() - 1.10) < 0.003);
    QVERIFY(entry["name"] == "bias" && entry["element"] == "patch");
    QVERIFY(document.model() == model);  // limits are no part of it
    document.undoStack().undo();
    QCOMPARE(cloth::stretchAt(editor.shape()->limit(), 45 * degree), 1.17);
    document.undoStack().redo();
    QVERIFY(std::abs(cloth::stretchAt(editor.shape()->limit(), 45 * degree) - 1.10) < 0.003);
    // A drag that Escape takes back leaves no step.
    document.undoStack().undo();
    QTest::mousePress(&editor, Qt::LeftButton, {}, pixel(1.17));
    QTest::mouseMove(&editor, pixel(1.12));
    QTest::keyClick(&editor, Qt::Key_Escape);
    QCOMPARE(cloth::stretchAt(editor.shape()->limit(), 45 * degree), 1.17);
    QVERIFY(!document.undoStack().canUndo());
  }

  void everyControlWritesTheScene() {
    document::Document document;
    QVERIFY(document.open(folder_.filePath("sheet.json")));
    panels::LimitPanel panel(document);
    panel.editor()->setKind(plots::LimitKind::orthotropic);
    QVERIFY(document.valueAt("/stretch_limits/0/type") == "orthotropic");
    panel.table()->item(0, 1)->setText("8 %");
    QVERIFY(std::abs(document.valueAt("/stretch_limits/0/first").get<double>() - 1.08) < 1e-12);
    panel.table()->item(0, 1)->setText("0.9");
    QVERIFY(panel.message().contains("below 1"));
    QVERIFY(std::abs(document.valueAt("/stretch_limits/0/first").get<double>() - 1.08) < 1e-12);
    QCOMPARE(panel.table()->item(0, 1)->text(), QString("1.08"));
    panel.editor()->takePreset(plots::limitPresets()[1]);
    QVERIFY(document.valueAt("/stretch_limits/0/points").size() == 8);
    QVERIFY(panel.message().isEmpty());
    QCOMPARE(document.undoStack().count(), 3);
    // Without any limit a preset makes the first.
    QVERIFY(document.setValue("/stretch_limits", Json::array(), "none"));
    QCOMPARE(panel.shownLimit(), -1);
    panel.editor()->takePreset(plots::limitPresets()[0]);
    QVERIFY(document.valueAt("/stretch_limits/0/stretch") == 1.05);
    QCOMPARE(panel.shownLimit(), 0);
  }

  void onlyStudiesOfClothDependOnLimits() {
    const scene::Scene before = scene::Scene::load(folder_.filePath("sheet.json").toStdString());
    const scene::Scene after = before.withValue("/stretch_limits/0/stretch", 1.2);
    QVERIFY(document::sameModel(before, after));
    QVERIFY(document::sameStudy(before, before, "swing"));
    QVERIFY(!document::sameStudy(before, after, "swing"));
    QVERIFY(document::sameStudy(before, after, "modes"));
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

 private:
  QTemporaryDir folder_;
};

QTEST_MAIN(TestLimitPanel)
#include "test_limit_panel.moc"
