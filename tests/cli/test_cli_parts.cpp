#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/scene/json_text.hpp"
#include "tests/cli/cli_process.hpp"

using namespace pliant;
using test::runCli;

namespace {

/// Two links in a row that hang and swing as their pivot is shaken.
constexpr const char* pendulum = R"({
  "schema_version": 1,
  "dimension": 2,
  "geometry": [{"name": "joints", "type": "points", "points": [[0, 0], [0, -0.1], [0, -0.18]]}],
  "elements": [{"name": "upper", "type": "link", "joints": [0, 1], "mass": "10 g"},
               {"name": "lower", "type": "link", "joints": [1, 2], "mass": "10 g"}],
  "point_masses": [{"name": "bob", "at": {"nodes": [2]}, "mass": "20 g"}],
  "loads": [{"name": "weight", "type": "gravity", "acceleration": [0, -9.81]}],
  "damping": {"mass_proportional": "2 1/s"},
  "drives": [{"name": "pivot", "type": "translation", "at": {"nodes": [0]}, "direction": [1, 0],
              "harmonics": [{"amplitude": "2 mm"}]}],
  "probes": [{"name": "bob", "at": {"nodes": [2]}}],
  "studies": [{"name": "swing", "type": "periodic_motion", "frequency": "1 Hz", "harmonics": 3}]
})";

}  // namespace

/// Bodies to be made, and the table of parameters.
class TestCliParts : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

  QString file(const char* name) const { return folder_.filePath(name); }
  test::CliOutcome exported(const char* out, const QStringList& more = {}) const {
    return runCli(QStringList{"export", file("scene.json"), "--out", file(out)} + more);
  }
  double volumeIn(const char* name) const {
    const auto mesh = geometry::weldMesh(geometry::readMesh(file(name).toStdString(), 1e-3), 1e-8);
    geometry::checkClosed(mesh);
    return geometry::enclosedVolume(mesh);
  }

 private slots:
  void initTestCase() { scene::writeTextFile(file("scene.json").toStdString(), pendulum); }

  void platesAreWritten() {
    const auto result = exported("links.stl", {"--make"});
    QVERIFY2(result.status == 0, qPrintable(result.errors));
    QVERIFY(result.output.contains("upper: 10.00 mm x 110.0 mm x 3.000 mm"));
    QVERIFY(result.output.contains("2 plates in 2 layers; they do not meet at rest."));
    QVERIFY(result.output.contains("2 bodies, "));
    QVERIFY(result.output.contains("checked: closed, normals outwards, no body cuts itself"));
    // Twice as thick, the file holds twice as much.
    const auto thick = exported("thick.stl", {"--make", "--thickness", "6 mm", "--flat"});
    QVERIFY2(thick.status == 0, qPrintable(thick.errors));
    QVERIFY(std::abs(volumeIn("thick.stl") / volumeIn("links.stl") - 2) < 1e-4);
  }

  void aMotionIsLookedAt() {
    const auto run = runCli({"run", file("scene.json"), "--out", file("results")});
    QVERIFY2(run.status == 0, qPrintable(run.errors));
    const auto result = exported("moved.3mf", {"--make", "--result", file("results"), "--time", "0.3"});
    QVERIFY2(result.status == 0, qPrintable(result.errors));
    QVERIFY(result.output.contains("they do not meet at 32 times of the motion"));
    QVERIFY(QFile::exists(file("moved.3mf")));
  }

  void theTable() {
    const auto result = exported("parameters.csv", {"--density", "1 g/cm^3"});
    QVERIFY2(result.status == 0, qPrintable(result.errors));
    const std::string text = scene::readTextFile(file("parameters.csv").toStdString());
    QVERIFY(text.starts_with("name,pointer,value,unit,"));
    QVERIFY(text.find("bob,/point_masses/0/mass,0.02,kg,") != std::string::npos);
    QVERIFY(text.find(",33.67") != std::string::npos);  // 20 cm³
  }

  void refusals_data() {
    QTest::addColumn<QStringList>("options");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("wide hole") << QStringList{"--make", "--hole", "12 mm"} << "--hole: A hole of 12.00 mm does not fit";
    QTest::newRow("no number") << QStringList{"--make", "--width", "broad"} << "--width: ";
    QTest::newRow("nothing thick") << QStringList{"--make", "--thickness", "0"}
                                   << "--thickness: Expected a number above 0.";
    QTest::newRow("flat alone") << QStringList{"--flat"} << "--make";
  }
  void refusals() {
    QFETCH(QStringList, options);
    QFETCH(QString, sentence);
    const auto result = exported("none.stl", options);
    QCOMPARE(result.status, 2);
    QVERIFY2(result.errors.contains(sentence), qPrintable(result.errors));
    QCOMPARE(result.errors.count('\n'), 1);
    QVERIFY(!QFile::exists(file("none.stl")));
  }
};

QTEST_GUILESS_MAIN(TestCliParts)
#include "test_cli_parts.moc"
