#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/interlock_result.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"

using namespace pliant;

namespace {

constexpr const char* netText = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "net", "type": "ring_net", "ring_radius": "4 mm", "wire_radius": "0.6 mm",
                          "spacing": "12 mm"}],
  "studies": [
    {"name": "stretch", "type": "cell_test", "direction": "90 deg"},
    {"name": "travel", "type": "free_travel", "directions": 4},
    {"name": "boundary", "type": "stretch_boundary", "subdivisions": 1}
  ]
})";

scene::Scene parsed(const std::string& text, const QString& folder = ".") {
  return scene::Scene::parse(text, folder.toStdString(), "net.json");
}

std::shared_ptr<const scene::Result> resultOf(const scene::Scene& scene, const std::string& study) {
  base::ExecutionContext context;
  return scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study)->run(context);
}

QString errorOf(const std::string& text, const std::string& study) {
  try {
    resultOf(parsed(text), study);
  } catch (const base::InputError& error) {
    return QString::fromStdString(error.location() + ": " + error.problem());
  }
  return {};
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t place = text.find(what);
  if (place == std::string::npos) qFatal("nothing to replace");
  return text.replace(place, what.size(), with);
}

}  // namespace

class TestInterlockScenes : public QObject {
  Q_OBJECT

 private slots:
  void stretchOfARingNet() {
    const auto summary = resultOf(parsed(netText), "stretch")->summary();
    // Two links a cell, each 2 (R - r) long when taut.
    QVERIFY(std::abs(summary["strain"].get<double>() - (4 * 3.4 / 12 - 1)) < 2e-5);
    QCOMPARE(summary["rest"].get<std::string>(), std::string("locked"));
    QCOMPARE(summary["kind"].get<std::string>(), std::string("interlock"));
    QVERIFY(summary["mean_gap"].get<double>() <= 1e-4 * 0.6e-3);
    QVERIFY(summary["smallest_gap"].get<double>() > 0);
  }

  /// What a study writes says what its summary says.
  void filesOfResults() {
    QTemporaryDir folder;
    const scene::Scene scene = parsed(netText);
    const auto read = [&](const char* name) {
      return scene::readTextFile(std::filesystem::path(folder.path().toStdString()) / name);
    };
    for (const char* study : {"stretch", "travel", "boundary"})
      resultOf(scene, study)->write(std::filesystem::path(folder.path().toStdString()) / study);
    const auto travel = read("travel/free_travel.csv");
    const auto rows = scene::readCsv(travel);
    QCOMPARE(rows.size(), std::size_t(4));
    for (const auto& row : rows) {
      const double stretch = scene::csvNumber(row[1]), compression = scene::csvNumber(row[2]);
      QVERIFY(compression < 0 && stretch > 0);
      QVERIFY(std::abs(scene::csvNumber(row[3]) - (stretch - compression) / (1 + compression)) < 1e-12);
    }
    const auto boundary = read("boundary/boundary.csv");
    QCOMPARE(scene::readCsv(boundary).size(), std::size_t(42));
    const geometry::SurfaceMesh mesh =
        geometry::readMesh(std::filesystem::path(folder.path().toStdString()) / "boundary/boundary.ply", 1);
    QCOMPARE(mesh.triangles.size(), std::size_t(80));
    for (const geometry::MeshEdge& edge : geometry::meshEdges(geometry::weldMesh(mesh, 1e-9).triangles))
      QVERIFY(edge.triangles[0] >= 0 && edge.triangles[1] >= 0);  // closed
    const auto summary = scene::parseJson(read("boundary/summary.json"));
    QCOMPARE(summary["states"].get<int>(), 42);
    QVERIFY(summary["closed"].get<bool>());
    const geometry::SurfaceMesh patch =
        geometry::readMesh(std::filesystem::path(folder.path().toStdString()) / "stretch/patch.ply", 1);
    QVERIFY(patch.triangles.size() > 1000);
    // 3 x 3 cells of 12 mm, the last row of which ends a ring beyond: taut along y.
    const double height = patch.points.row(1).maxCoeff() - patch.points.row(1).minCoeff();
    QVERIFY(height > 2.5 * 13.6e-3 && height < 3.2 * 13.6e-3);
    QVERIFY(!read("stretch/contacts.csv").empty() && !read("stretch/elements.csv").empty());
  }

  /// A boundary with a checkpoint is the same as one without, and found again at once.
  void checkpoints() {
    QTemporaryDir folder;
    const std::string text =
        replaced(netText, "\"subdivisions\": 1", "\"subdivisions\": 1, \"checkpoint\": \"limits.txt\"");
    const auto plain = resultOf(parsed(netText), "boundary")->summary();
    const auto first = resultOf(parsed(text, folder.path()), "boundary")->summary();
    const auto second = resultOf(parsed(text, folder.path()), "boundary")->summary();
    QCOMPARE(first["recalled"].get<int>(), 0);
    QVERIFY(second["recalled"].get<int>() >= 42);
    for (const char* key : {"volume", "mean_distance", "largest_remaining"}) {
      QCOMPARE(first[key].get<double>(), plain[key].get<double>());
      QCOMPARE(second[key].get<double>(), plain[key].get<double>());
    }
  }

  void badInput_data() {
    QTest::addColumn<QString>("what");
    QTest::addColumn<QString>("with");
    QTest::addColumn<QString>("study");
    QTest::addColumn<QString>("error");
    const auto row = [](const char* what, const char* with, const char* study, const char* error) {
      QTest::addRow("%s", error) << what << with << study << error;
    };
    row("\"wire_radius\": \"0.6 mm\"", "\"wire_radius\": \"1.5 mm\"", "stretch",
        "/interlocking_cells/0: Element 0 and");
    row("\"wire_radius\": \"0.6 mm\"", "\"wire_radius\": 0", "stretch", "/interlocking_cells/0/wire_radius");
    row("\"spacing\": \"12 mm\"", "\"spacing\": \"40 mm\"", "stretch", "are linked 0 times");
    row("\"spacing\": \"12 mm\"", "\"spacing\": \"12 mm\", \"supercell\": [1]", "stretch", "/supercell");
    row("\"type\": \"ring_net\"", "\"type\": \"ring_nets\"", "stretch", "ring_nets");
    row("\"type\": \"free_travel\", \"directions\": 4", "\"type\": \"linear_modes\"", "travel",
        "/geometry: The scene has no nodes, which the study \"travel\" needs.");
    row("\"direction\": \"90 deg\"", "\"cell\": \"nets\"", "stretch", "There is no entry named \"nets\"");
  }

  void badInput() {
    QFETCH(QString, what);
    QFETCH(QString, with);
    QFETCH(QString, study);
    QFETCH(QString, error);
    const QString found = errorOf(replaced(netText, what.toStdString(), with.toStdString()), study.toStdString());
    QVERIFY2(found.contains(error), qPrintable(found));
    QVERIFY(!found.contains('\n'));
  }
};

QTEST_GUILESS_MAIN(TestInterlockScenes)
#include "test_interlock_scenes.moc"
