#include <QTemporaryDir>
#include <QTest>

#include "core/geometry/surface_mesh.hpp"
#include "core/scene/json_text.hpp"
#include "tests/cli/cli_process.hpp"

using namespace pliant;
using test::runCli;

namespace {

constexpr const char* netScene = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "net", "type": "ring_net", "ring_radius": "4 mm", "wire_radius": "0.6 mm",
                          "spacing": "12 mm"}],
  "studies": [
    {"name": "stretch", "type": "cell_test", "direction": "90 deg"},
    {"name": "travel", "type": "free_travel", "directions": 4},
    {"name": "boundary", "type": "stretch_boundary", "subdivisions": 1}
  ]
})";

}  // namespace

/// What the command line draws and exports of interlocking materials.
class TestCliInterlock : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

  QString file(const char* name) const { return folder_.filePath(name); }
  QStringList drawn(const char* study, const char* picture, const QStringList& more = {}) const {
    return QStringList{"render", file("net.json"), "--result",    file("results"), "--study",
                       study,    "--out",          file(picture), "--size",        "480x360"} +
           more;
  }
  std::string bytes(const char* name) const { return scene::readTextFile(file(name).toStdString()); }

 private slots:
  void initTestCase() {
    scene::writeTextFile(file("net.json").toStdString(), netScene);
    const auto run = runCli({"run", file("net.json"), "--out", file("results")});
    QVERIFY2(run.status == 0, qPrintable(run.errors));
  }

  void aBoundaryIsExportedAsASurface() {
    const auto exported = runCli(
        {"export", file("net.json"), "--result", file("results"), "--study", "boundary", "--out", file("b.stl")});
    QVERIFY2(exported.status == 0, qPrintable(exported.errors));
    QVERIFY(exported.output.contains("42 limits, 80 triangles"));
    QCOMPARE(geometry::readMesh(file("b.stl").toStdString(), 1).triangles.size(), std::size_t(80));
  }

  void resultsAreDrawn() {
#ifdef PLIANT_HAS_RENDERER
    for (const auto& [study, picture] :
         {std::pair("boundary", "b.png"), std::pair("stretch", "s.png"), std::pair("travel", "t.png")}) {
      const auto result = runCli(drawn(study, picture));
      QVERIFY2(result.status == 0, qPrintable(result.errors));
      QVERIFY(bytes(picture).starts_with("\x89PNG"));
    }
    const std::string plain = bytes("b.png");
    for (const QStringList& more : {QStringList{"--colour", "contacts"}, QStringList{"--slice", "E_xy=1 %"},
                                    QStringList{"--opacity", "0.5"}, QStringList {
                                      "--compare",
                                      file("results") + "/boundary"
                                    }}) {
      const auto result = runCli(drawn("boundary", "other.png", more));
      QVERIFY2(result.status == 0, qPrintable(result.errors));
      QVERIFY(bytes("other.png") != plain);
    }
    const auto plotted =
        runCli({"plot", file("net.json"), "--result", file("results"), "--out", file("p.png"), "--size", "480x360"});
    QVERIFY2(plotted.status == 0, qPrintable(plotted.errors));
    QVERIFY(bytes("p.png") == bytes("t.png"));
    // Bad input gets a sentence each.
    const std::vector<std::pair<QStringList, const char*>> wrong{
        {drawn("boundary", "x.png", {"--colour", "speed"}), "there are: distance, remaining"},
        {drawn("boundary", "x.png", {"--slice", "E_z=1 %"}), "Expected E_x, E_y or E_xy"},
        {drawn("boundary", "x.png", {"--slice", "E_x=1 mm"}), "--slice"},
        {drawn("boundary", "x.png", {"--compare", file("results")}), "no boundary.ply"},
        { drawn("boundary", "x.png", {"--time", "1"}),
          "A limit has no time" }};
    for (const auto& [arguments, sentence] : wrong) {
      const auto result = runCli(arguments);
      QCOMPARE(result.status, 2);
      QVERIFY2(result.errors.contains(QLatin1String(sentence)), qPrintable(result.errors));
    }
#else
    QVERIFY(runCli(drawn("boundary", "b.png")).errors.contains("no renderer"));
#endif
  }
};

QTEST_GUILESS_MAIN(TestCliInterlock)
#include "test_cli_interlock.moc"
