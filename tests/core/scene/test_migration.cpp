#include <QFloat16>  // comparing JSON asks about every type that Qt can compare
#include <QTest>

#include "core/base/error.hpp"
#include "core/scene/migration.hpp"
#include "core/scene/scene.hpp"

using namespace pliant;
using scene::Json;

class TestMigration : public QObject {
  Q_OBJECT

 private slots:
  void appliesTheStepsInOrder() {
    const std::vector<scene::MigrationStep> steps{
        {2, [](Json& s) { s["c"] = s["b"].get<int>() * 10, s.erase("b"); }},
        {1, [](Json& s) { s["b"] = s["a"].get<int>() + 1, s.erase("a"); }},
    };
    const Json expected{{"schema_version", 3}, {"c", 60}};
    QCOMPARE(scene::migrate(Json{{"schema_version", 1}, {"a", 5}}, steps, 3), expected);
    QCOMPARE(scene::migrate(Json{{"schema_version", 2}, {"b", 6}}, steps, 3), expected);
    QCOMPARE(scene::migrate(expected, steps, 3), expected);
  }

  void refusesVersionsItCannotReach_data() {
    QTest::addColumn<QString>("scene");
    QTest::addColumn<QString>("location");
    QTest::newRow("missing") << "{}"
                             << "/schema_version";
    QTest::newRow("newer") << R"({"schema_version": 4})"
                           << "/schema_version";
    QTest::newRow("older than any") << R"({"schema_version": 0})"
                                    << "/schema_version";
    QTest::newRow("far older") << R"({"schema_version": -9000000000000000000})"
                               << "/schema_version";
    QTest::newRow("text") << R"({"schema_version": "3"})"
                          << "/schema_version";
    QTest::newRow("fraction") << R"({"schema_version": 2.5})"
                              << "/schema_version";
    QTest::newRow("no object") << "[1]"
                               << "";
  }
  void refusesVersionsItCannotReach() {
    QFETCH(QString, scene);
    QFETCH(QString, location);
    const std::vector<scene::MigrationStep> steps{{1, [](Json&) {}}, {2, [](Json&) {}}};
    try {
      scene::migrate(Json::parse(scene.toStdString()), steps, 3);
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QCOMPARE(QString::fromStdString(error.location()), location);
    }
  }

  void theShippedStepsReachTheNewestVersion() {
    int version = scene::schemaVersion - static_cast<int>(scene::migrationSteps().size());
    for (const scene::MigrationStep& step : scene::migrationSteps()) QCOMPARE(step.from, version++);
    QCOMPARE(version, scene::schemaVersion);
  }
};

QTEST_GUILESS_MAIN(TestMigration)
#include "test_migration.moc"
