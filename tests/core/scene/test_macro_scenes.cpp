#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/hexagon_mesh.hpp"
#include "core/math/parallel.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/macro_reading.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"

using namespace pliant;

namespace {

constexpr const char* sceneText = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "mail", "type": "threefold"}],
  "studies": [
    {"name": "row", "type": "cell_test", "cell": "mail"},
    {"name": "pull", "type": "macro_equilibrium", "shape": "hexagon", "radius": "29 mm", "rings": 4,
     "gravity": [0, 0, 0], "native": true, "clamps": [{"point": [0, 0]}],
     "loads": [{"point": ["29 mm", 0], "force": ["1 N", 0, 0]}, {"point": ["-29 mm", 0], "force": ["-1 N", 0, 0]}]}
  ]
})";

std::shared_ptr<const scene::MacroResult> resultOf(const std::string& text, const std::string& directory = ".") {
  const scene::Scene scene = scene::Scene::parse(text, directory, "mail.json");
  base::ExecutionContext context;
  return std::dynamic_pointer_cast<const scene::MacroResult>(
      scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "pull")->run(context));
}

std::string replaced(const std::string& what, const std::string& with) {
  std::string text = sceneText;
  const std::size_t place = text.find(what);
  if (place == std::string::npos) qFatal("nothing to replace");
  return text.replace(place, what.size(), with);
}

QString errorOf(const std::string& what, const std::string& with) {
  try {
    resultOf(replaced(what, with));
  } catch (const base::InputError& error) {
    return QString::fromStdString(error.location() + ": " + error.problem());
  }
  return {};
}

}  // namespace

class TestMacroScenes : public QObject {
  Q_OBJECT

 private slots:
  void meshesOfRingsAreWhole() {
    for (const int rings : {1, 2, 8}) {
      for (const geometry::SurfaceMesh& mesh : {geometry::makeHexagon(2, rings), geometry::makeDisk(2, rings)}) {
        QCOMPARE(mesh.points.cols(), 1 + 3 * rings * (rings + 1));
        QCOMPARE(mesh.triangles.size(), std::size_t(6 * rings * rings));
        geometry::checkMesh(mesh);
        double area = 0;
        for (const auto& [a, b, c] : mesh.triangles) {
          const Eigen::Vector3d u = mesh.points.col(b) - mesh.points.col(a),
                                v = mesh.points.col(c) - mesh.points.col(a);
          QVERIFY(u.cross(v).z() > 0);
          area += 0.5 * u.cross(v).z();
        }
        QVERIFY(area > 0.9999 * 6 * std::sqrt(3.0) && area < 4 * M_PI);
      }
    }
  }

  /// Pulled by opposite forces at its ends, the middle row of the sheet is as long as the material allows; that of the
  /// elements is longer, for those at its ends have few neighbours that hold them back.
  void pulledRowIsAsLongAsTheMaterialAllows() {
    const auto result = resultOf(sceneText);
    QVERIFY(result && result->termination == base::TerminationType::converged);
    QCOMPARE(result->state.violation, 0.0);
    const base::Json summary = result->summary();
    const auto longer = [](const base::Json& ends) { return ends[0][0].get<double>() - ends[1][0].get<double>(); };
    const double sheet = longer(summary["deflections"]), elements = longer(summary["native"]["deflections"]);
    const scene::Scene scene = scene::Scene::parse(sceneText, ".", "mail.json");
    base::ExecutionContext context;
    const auto row = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "row")->run(context);
    const double limit = 58e-3 * row->summary()["strain"].get<double>();
    qInfo("longer by %.4f mm, its elements by %.4f mm, a row by %.4f mm", 1e3 * sheet, 1e3 * elements, 1e3 * limit);
    QVERIFY(std::abs(sheet / limit - 1) < 2e-3);
    QVERIFY(elements > sheet);
  }

  void sameBytesForAnyNumberOfThreads() {
    std::vector<std::string> texts;
    for (const int threads : {1, 2}) {
      math::setThreadCount(threads);
      QTemporaryDir folder;
      resultOf(replaced("\"native\": true", "\"native\": false"))->write(folder.filePath("r").toStdString());
      texts.push_back(scene::readTextFile(folder.filePath("r/nodes.csv").toStdString()) +
                      scene::readTextFile(folder.filePath("r/triangles.csv").toStdString()));
    }
    math::setThreadCount(0);
    QVERIFY(texts[0] == texts[1]);
  }

  void resultIsReadFromItsFolder() {
    const auto result = resultOf(sceneText);
    QTemporaryDir folder;
    result->write(folder.filePath("r").toStdString());
    const scene::Scene scene = scene::Scene::parse(sceneText, ".", "mail.json");
    const auto read = scene::readMacro(scene, folder.filePath("r").toStdString());
    QVERIFY(read->state.positions == result->state.positions);
    QVERIFY(read->sheet->mesh.triangles == result->sheet->mesh.triangles);
    QVERIFY(read->state.stretchGauge == result->state.stretchGauge);
    QVERIFY(read->clamped == result->clamped);
    QVERIFY(read->native && read->native->rest.state.positions == result->native->rest.state.positions);
  }

  /// What a study of the boundary writes is read again.
  void limitsAreReadFromFiles() {
    QTemporaryDir folder;
    const std::string boundaryScene =
        replaced(R"("studies": [)", R"("studies": [{"name": "boundary", "type": "stretch_boundary", "cell": "mail"},)");
    const scene::Scene scene = scene::Scene::parse(boundaryScene, ".", "mail.json");
    base::ExecutionContext context;
    scene::StudyRegistry::instance()
        .make(scene, scene::buildModel(scene), "boundary")
        ->run(context)
        ->write(folder.filePath("b").toStdString());
    const auto fromFile =
        resultOf(replaced(R"("shape": "hexagon")", R"("stretch_limits": "b/boundary.ply", "shape": "hexagon")"),
                 folder.path().toStdString());
    const auto computed = resultOf(sceneText);
    QVERIFY((fromFile->state.positions - computed->state.positions).cwiseAbs().maxCoeff() < 1e-6);
  }

  void badInput_data() {
    QTest::addColumn<std::string>("what");
    QTest::addColumn<std::string>("with");
    QTest::addColumn<QString>("expected");
    QTest::newRow("no size") << std::string("hexagon") << std::string("rectangle")
                             << "mail.json: /studies/1: A rectangle needs \"size\".";
    QTest::newRow("no radius") << std::string(R"("radius": "29 mm",)") << std::string()
                               << "mail.json: /studies/1: A hexagon needs \"radius\".";
    QTest::newRow("no such file") << std::string(R"("rings": 4)")
                                  << std::string(R"("rings": 4, "stretch_limits": "nothing.ply")")
                                  << "mail.json: /studies/1/stretch_limits: ";
    QTest::newRow("turned native patch") << std::string(R"("rings": 4)")
                                         << std::string(R"("rings": 4, "angle": "20 deg")")
                                         << "mail.json: /studies/1: A native patch is a disk, a hexagon or a rectangle "
                                            "along the material's axes.";
  }
  void badInput() {
    QFETCH(std::string, what);
    QFETCH(std::string, with);
    QFETCH(QString, expected);
    const QString error = errorOf(what, with);
    QVERIFY2(error.startsWith(expected), qPrintable(error));
  }
};

QTEST_APPLESS_MAIN(TestMacroScenes)
#include "test_macro_scenes.moc"
