#include <QFloat16>  // comparing JSON asks about every type that Qt can compare
#include <QTemporaryDir>
#include <QTest>

#include "core/geometry/surface_mesh.hpp"
#include "core/scene/format_tables.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/scene.hpp"
#include "tests/cli/cli_process.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using test::runCli;
namespace fs = std::filesystem;

/// The verbs, through the program itself.
class TestCli : public QObject {
  Q_OBJECT

  const QString mail_ = PLIANT_SOURCE_DIR "/scenes/interlock/chainmail_4in1.json";
  const QString duffing_ = PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json";
  QTemporaryDir folder_;

  QString file(const char* name) const { return folder_.filePath(name); }
  scene::Json summary(const char* study) const {
    return scene::parseJson(scene::readTextFile(file("results").toStdString() + "/" + study + "/summary.json"));
  }

 private slots:
  void initTestCase() {
    scene::writeTextFile(file("full.json").toStdString(), test::fullScene);
    const scene::Scene unmet = test::parse(test::fullScene).withValue("/expected/0/value", 3);
    unmet.save(file("unmet.json").toStdString());
  }

  void helpAndVersion() {
    QCOMPARE(runCli({"--version"}).output, "pliant-cli " PLIANT_VERSION "\n");
    const auto help = runCli({"--help"});
    QCOMPARE(help.status, 0);
    for (const char* verb : {"list", "run", "validate", "render", "drapes", "plot", "export", "schema"}) {
      QVERIFY2(help.output.contains(verb), verb);
      QCOMPARE(runCli({verb, "--help"}).status, 0);
    }
  }

  void wrongUsage_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::newRow("nothing") << QStringList();
    QTest::newRow("unknown verb") << QStringList{"solve"};
    QTest::newRow("no scene") << QStringList{"run", "--out", file("x")};
    QTest::newRow("no out") << QStringList{"run", duffing_};
    QTest::newRow("unknown option") << QStringList{"list", duffing_, "--fast"};
    QTest::newRow("threads") << QStringList{"run", duffing_, "--out", file("x"), "--threads", "-1"};
    QTest::newRow("unknown study") << QStringList{"run", duffing_, "--out", file("x"), "--study", "nothing"};
    QTest::newRow("set without value") << QStringList{"run", duffing_, "--out", file("x"), "--set", "/title"};
    QTest::newRow("set unknown") << QStringList{"run", duffing_, "--out", file("x"), "--set", "/damping/mass=1"};
    QTest::newRow("set wrong unit") << QStringList{
        "run", duffing_, "--out", file("x"), "--set", "/point_masses/0/mass=2 m"};
    QTest::newRow("out is a file") << QStringList{"run", duffing_, "--out", duffing_};
    QTest::newRow("export format") << QStringList{"export", file("full.json"), "--out", file("mesh.docx")};
    QTest::newRow("export nothing") << QStringList{"export", duffing_, "--out", file("mesh.stl")};
    QTest::newRow("no result") << QStringList{
        "export", file("full.json"), "--result", file("nowhere"), "--out", file("a.stl")};
    QTest::newRow("time") << QStringList{"export", file("full.json"), "--time", "3 kg", "--out", file("a.stl")};
    const QStringList patch{"export", mail_, "--cell", "material", "--out", file("patch.stl")};
    QTest::newRow("patch of which material") << QStringList{"export", mail_, "--out", file("patch.stl")};
    QTest::newRow("patch outline") << patch + QStringList{"--patch", "10 by 8"};
    QTest::newRow("patch tolerance") << patch + QStringList{"--tolerance", "0"};
    QTest::newRow("patch clearance") << patch + QStringList{"--clearance", "1 mm"};
    QTest::newRow("patch result") << patch + QStringList{"--result", file("results")};
    QTest::newRow("size") << QStringList{"render", duffing_, "--out", file("a.png"), "--size", "big"};
  }
  void wrongUsage() {
    QFETCH(QStringList, arguments);
    const auto outcome = runCli(arguments);
    QVERIFY2(outcome.status == 2, qPrintable(outcome.errors));
    QVERIFY2(outcome.errors.count('\n') == 1, qPrintable(outcome.errors));
  }

  void listNamesStudiesAndParameters() {
    const auto outcome = runCli({"list", file("full.json")});
    QCOMPARE(outcome.status, 0);
    for (const char* part : {"motion", "frequency_response", "tip", "/point_masses/0/mass", "2.000 g", "10.00 g"})
      QVERIFY2(outcome.output.contains(part), part);
  }

  void validateCounts() {
    const auto outcome = runCli({"validate", file("full.json")});
    QCOMPARE(outcome.status, 0);
    QVERIFY2(outcome.output.contains("17 nodes, 16 triangles"), qPrintable(outcome.output));
  }

  void schemaPrintsTheGeneratedDocuments() {
    QCOMPARE(runCli({"schema"}).output.toStdString(), scene::formatJson(scene::jsonSchema()));
    QCOMPARE(runCli({"schema", "--tables"}).output.toStdString(), scene::formatTables());
  }

  void runWritesEveryStudy() {
    const auto outcome = runCli({"run", duffing_, "--out", file("results")});
    QVERIFY2(outcome.status == 0, qPrintable(outcome.errors));
    QCOMPARE(summary("motion")["termination"], scene::Json("converged"));
    QCOMPARE(summary("response")["fold_count"], scene::Json(2));
    QVERIFY(outcome.output.contains("fold at"));
  }

  void runTakesSettingsAndStudies() {
    const auto outcome =
        runCli({"run", duffing_, "--out", file("results"), "--study", "motion", "--threads", "1", "--set",
                "/studies/0/frequency=2 Hz", "--set", "/point_masses/0/mass=1.5", "--set", "/title=A heavier bob"});
    QVERIFY2(outcome.status == 0, qPrintable(outcome.errors));
    QCOMPARE(summary("motion")["frequency_hz"].get<double>(), 2.0);
    QCOMPARE(summary("motion")["parameters"][0]["value"].get<double>(), 1.5);
    QCOMPARE(summary("motion")["provenance"]["threads"].get<int>(), 1);
  }

  void settingsMayComeInAnyOrder() {
    // 40 harmonics need more samples than the scene has.
    const auto outcome = runCli({"run", duffing_, "--out", file("results"), "--study", "motion", "--set",
                                 "/studies/0/harmonics=40", "--set", "/studies/0/samples=128"});
    QVERIFY2(outcome.status == 0, qPrintable(outcome.errors));
    QCOMPARE(summary("motion")["harmonics"].get<int>(), 40);
    QVERIFY(outcome.output.contains("last correction"));
  }

  void anUnconvergedStudyIsWrittenAndSaysSo() {
    const auto outcome = runCli(
        {"run", duffing_, "--out", file("results"), "--study", "response", "--set", "/studies/1/maximum_points=5"});
    QVERIFY2(outcome.status == 1, qPrintable(outcome.errors));
    QCOMPARE(summary("response")["termination"], scene::Json("iteration limit"));
    QVERIFY(!summary("response")["message"].get<std::string>().empty());
    QVERIFY(summary("response")["point_count"].get<int>() > 0);
  }

  void runSaysWhetherExpectedValuesAreMet() {
    const auto met = runCli({"run", file("full.json"), "--out", file("results"), "--study", "motion"});
    QVERIFY2(met.status == 0 && met.output.contains("1 of 1 met"), qPrintable(met.output + met.errors));
    const auto unmet = runCli({"run", file("unmet.json"), "--out", file("results"), "--study", "motion"});
    QVERIFY2(unmet.output.contains("0 of 1 met") && unmet.output.contains("expected 3"), qPrintable(unmet.output));
  }

  void exportFollowsTheMotion() {
    QCOMPARE(runCli({"run", file("full.json"), "--out", file("results"), "--study", "motion"}).status, 0);
    const auto points = [&](const QStringList& more) -> Eigen::Matrix3Xd {
      const auto outcome = runCli(QStringList{"export", file("full.json"), "--out", file("mesh.ply")} + more);
      if (outcome.status != 0) qWarning() << outcome.errors;
      return geometry::readMesh(file("mesh.ply").toStdString(), 1).points;
    };
    const Eigen::Matrix3Xd rest = points({}), start = points({"--result", file("results")});
    const Eigen::Matrix3Xd half = points({"--result", file("results"), "--time", "0.2 s"});
    const Eigen::Matrix3Xd period = points({"--result", file("results"), "--study", "motion", "--time", "400 ms"});
    QVERIFY((rest - start).norm() > 1e-4);
    QVERIFY((half - start).norm() > 1e-4);
    QVERIFY((period - start).norm() < 1e-6);
  }

  void exportOfAPatch() {
    const auto outcome = runCli({"export", mail_, "--cell", "material", "--patch", "2x3", "--tolerance", "0.1 mm",
                                 "--clearance", "0.5 mm", "--out", file("patch.3mf")});
    QVERIFY2(outcome.status == 0, qPrintable(outcome.errors));
    QVERIFY2(outcome.output.contains("12 elements") && outcome.output.contains("Clearance between elements 600.0 µm"),
             qPrintable(outcome.output));
    QVERIFY(QFile::exists(file("patch.3mf")));
  }

  void plotDrawsCurves() {
    const QStringList plot{"plot", file("full.json"), "--result", file("results"), "--out", file("curve.png")};
    QCOMPARE(runCli({"run", file("full.json"), "--out", file("results"), "--study", "response"}).status, 0);
    const auto outcome = runCli(plot + QStringList{"--study", "response", "--size", "640x400"});
#ifdef PLIANT_HAS_RENDERER
    QVERIFY2(outcome.status == 0, qPrintable(outcome.errors));
    QVERIFY(scene::readTextFile(file("curve.png").toStdString()).starts_with("\x89PNG"));
    const auto missing = runCli(plot + QStringList{"--study", "nothing"});
    QCOMPARE(missing.status, 2);
    QVERIFY2(missing.errors.contains("no result of the study"), qPrintable(missing.errors));
#else
    QCOMPARE(outcome.status, 2);
    QVERIFY(outcome.errors.contains("no renderer"));
#endif
  }

  void renderDrawsAPicture() {
#ifdef PLIANT_HAS_RENDERER
    QCOMPARE(runCli({"run", file("full.json"), "--out", file("results"), "--study", "motion"}).status, 0);
    for (const QStringList& more : {QStringList(), QStringList { "--result", file("results"), "--time", "0.1" }}) {
      const auto outcome =
          runCli(QStringList{"render", file("full.json"), "--out", file("picture.png"), "--size", "320x240"} + more);
      QVERIFY2(outcome.status == 0, qPrintable(outcome.errors));
      const std::string png = scene::readTextFile(file("picture.png").toStdString());
      QVERIFY(png.starts_with("\x89PNG"));
      QVERIFY(png.size() > 2000);
      fs::remove(file("picture.png").toStdString());
      QVERIFY2(outcome.errors.isEmpty(), qPrintable(outcome.errors));
    }
    const QStringList changed{"--set", "/drives/0/harmonics/0/amplitude=0.002", "--study", "motion"};
    QCOMPARE(runCli(QStringList{"run", file("full.json"), "--out", file("changed")} + changed).status, 0);
    const auto outcome =
        runCli({"render", file("full.json"), "--out", file("picture.png"), "--result", file("changed")});
    QVERIFY2(outcome.status == 0 && outcome.errors.contains("has changed since"), qPrintable(outcome.errors));
#else
    const auto outcome = runCli({"render", duffing_, "--out", file("picture.png")});
    QCOMPARE(outcome.status, 2);
    QVERIFY(outcome.errors.contains("no renderer"));
#endif
  }
};

QTEST_GUILESS_MAIN(TestCli)
#include "test_cli.moc"
