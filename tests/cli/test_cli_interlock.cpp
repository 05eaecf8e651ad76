#include <QTemporaryDir>
#include <QTest>
#include <set>

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

constexpr const char* thickScene = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "thick", "type": "threefold", "ring_radius": "5.2 mm", "wire_radius": "1.6 mm",
                          "distance": "5 mm", "lean": "50 deg", "spacing": "13.5 mm"}],
  "studies": [
    {"name": "bend", "type": "bending_test", "radius": "14 mm", "trials": 1},
    {"name": "limits", "type": "curvature_limits", "radius": "14 mm", "final_gap": 0.05, "directions": 1, "trials": 1},
    {"name": "size", "type": "bending_size", "radii": ["14 mm"], "trials": 1, "final_gap": 0.05},
    {"name": "boundary", "type": "bending_boundary", "radius": "14 mm", "subdivisions": 0, "trials": 1,
     "test_star_shape": false, "final_gap": 0.05},
    {"name": "hang", "type": "gravity_bending", "size": ["60 mm", "5 mm"]}
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

  /// Patches in their equilibrium, limits over directions and sizes, the boundary in curvature.
  void bendingIsDrawn() {
    scene::writeTextFile(file("thick.json").toStdString(), thickScene);
    const auto run = runCli({"run", file("thick.json"), "--out", file("bent")});
    QVERIFY2(run.status == 0, qPrintable(run.errors));
    const auto exported = [&](const char* name) {
      return runCli(
          {"export", file("thick.json"), "--result", file("bent"), "--study", "boundary", "--out", file(name)});
    };
    QVERIFY(exported("k.ply").output.contains("12 limits, 20 triangles, in curvature [1/m]"));
    QCOMPARE(geometry::readMesh(file("k.ply").toStdString(), 1).triangles.size(), std::size_t(20));
    QVERIFY(exported("k.csv").output.contains("12 limits"));
    QVERIFY(bytes("k.csv") == bytes("bent/boundary/boundary.csv"));
#ifdef PLIANT_HAS_RENDERER
    const auto picture = [&](const char* study, const QStringList& more = {}) {
      return runCli(QStringList{"render", file("thick.json"), "--result", file("bent"), "--study", study, "--out",
                                file(study) + ".png", "--size", "480x360"} +
                    more);
    };
    std::set<std::string> pictures;
    for (const char* study : {"bend", "limits", "size", "boundary", "hang"}) {
      const auto result = picture(study);
      QVERIFY2(result.status == 0, qPrintable(result.errors));
      pictures.insert(scene::readTextFile((file(study) + ".png").toStdString()));
      QVERIFY(pictures.rbegin()->starts_with("\x89PNG"));
    }
    QCOMPARE(pictures.size(), std::size_t(5));
    QVERIFY(picture("boundary", {"--slice", "k_xy=2 1/m"}).status == 0);
    QVERIFY(picture("boundary", {"--slice", "E_xy=2 %"}).errors.contains("Expected k_xx, k_yy or k_xy"));
    QVERIFY(picture("boundary", {"--compare", file("results") + "/boundary"}).errors.contains("one is of stretch"));
    // Polar plots and charts in one picture.
    const auto plotted =
        runCli({"plot", file("thick.json"), "--result", file("bent"), "--out", file("q.png"), "--size", "640x320"});
    QVERIFY2(plotted.status == 0, qPrintable(plotted.errors));
    QVERIFY(bytes("q.png").starts_with("\x89PNG"));
#endif
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
