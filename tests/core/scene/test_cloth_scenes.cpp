#include <QTemporaryDir>
#include <QTest>

#include "core/base/error.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/scene/cloth_result.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/result_charts.hpp"

using namespace pliant;
using scene::ClothResult;
using scene::Json;

namespace {

const std::string clothScene = R"({
  "schema_version": 1,
  "geometry": [{"name": "cloth", "type": "grid", "length": 0.4, "width": 0.4, "length_cells": 4, "width_cells": 4}],
  "materials": [{"name": "fabric", "density": 200, "young_modulus": 1800, "poisson_ratio": 0.41}],
  "elements": [{"name": "sheet", "type": "shell", "thickness": "0.5 mm"}],
  "stretch_limits": [{"name": "all", "type": "isotropic", "stretch": 1.02},
                     {"name": "edge", "type": "orthotropic", "first": 1.01, "second": 1.2, "element": "sheet"}],
  "boundary_conditions": [
    {"name": "corner", "type": "pin", "at": {"nearest": [0, -0.2, 0]}, "path": [{"time": 0}, {"time": 0.1, "translation": [0, 0, 0.02]}]},
    {"name": "other", "type": "pin", "at": {"nearest": [0, 0.2, 0]}, "release": 0.05}
  ],
  "bodies": [{"name": "ball", "type": "sphere", "center": [0, 0, -5], "radius": 0.1, "path": [{"time": 0}, {"time": 1, "translation": [1, 0, 0]}]}],
  "loads": [{"name": "weight", "type": "gravity", "acceleration": [0, 0, -9.81]},
            {"name": "breeze", "type": "wind", "velocity": [1, 0, 2]}],
  "probes": [{"name": "tip", "at": {"nearest": [0.4, 0.2, 0]}}],
  "studies": [
    {"name": "motion", "type": "cloth_motion", "duration": 0.1, "frame_every": 3},
    {"name": "drape", "type": "cloth_drape", "tolerance": 1e-2},
    {"name": "projection", "type": "projection", "candidate": "candidate.csv"}
  ]
})";

/// The text with one part replaced.
std::string edited(const std::string& part, const std::string& by) {
  std::string text = clothScene;
  const auto place = text.find(part);
  return place == std::string::npos ? std::string() : text.replace(place, part.size(), by);
}

const Eigen::Matrix3Xd restPoints = geometry::makeGrid(0.4, 0.4, 4, 4).points;

/// Twice as wide as the rest shape along x.
std::string candidateTable() {
  scene::CsvWriter csv;
  csv.add("node").add("x [m]").add("y [m]").add("z [m]").endRow();
  for (int node = 0; node < 25; ++node)
    csv.add(node).add(2 * restPoints(0, node)).add(restPoints(1, node)).add(restPoints(2, node)).endRow();
  return csv.text();
}

scene::Scene sceneIn(const QTemporaryDir& folder, const std::string& text,
                     const std::string& table = candidateTable()) {
  const std::filesystem::path place = folder.path().toStdString();
  scene::writeTextFile(place / "candidate.csv", table);
  return scene::Scene::parse(text, place, "test.json");
}

std::shared_ptr<const ClothResult> run(const scene::Scene& scene, const std::string& study) {
  base::ExecutionContext context;
  return std::dynamic_pointer_cast<const ClothResult>(
      scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study)->run(context));
}

}  // namespace

class TestClothScenes : public QObject {
  Q_OBJECT

 private slots:
  void aMotionKeepsLimitsAndPins() {
    const QTemporaryDir folder;
    const auto result = run(sceneIn(folder, clothScene), "motion");
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    QCOMPARE(result->steps.size(), std::size_t(10));
    QCOMPARE(result->frames.size(), std::size_t(5));  // 0, 3, 6, 9 and the last
    QVERIFY(result->frameAt(std::numeric_limits<double>::max()) == result->frames.back());
    QVERIFY(result->frameAt(-1) == result->frames.front());
    QVERIFY(result->frameAt(result->frames[1]->time * 1.1) == result->frames[1]);
    const scene::ClothFrame& last = *result->frames.back();
    QVERIFY(last.stretchRatios.maxCoeff() < 1 + 1e-6);
    QVERIFY(std::abs(last.positions(2, result->problem->pins[0].nodes[0]) - 0.02) < 1e-12);
    QVERIFY(std::abs(last.positions(2, result->problem->pins[1].nodes[0])) > 1e-4);  // let go
    QVERIFY(std::abs(last.bodyPoints(0, 0) - 0.1) < 1e-12);
    QVERIFY(last.limitForces.minCoeff() >= 0);
    QVERIFY(result->problem->sheet.triangles.front().limit == 1);  // the later entry
  }

  void whatIsWrittenIsReadBack() {
    const QTemporaryDir folder;
    const scene::Scene scene = sceneIn(folder, clothScene);
    const auto written = run(scene, "motion");
    const std::filesystem::path place = folder.filePath("motion").toStdString();
    written->write(place);
    const auto read = ClothResult::read(scene, place);
    QCOMPARE(read->frames.size(), written->frames.size());
    for (std::size_t i = 0; i < read->frames.size(); ++i) {
      QVERIFY(read->frames[i]->time == written->frames[i]->time);
      QVERIFY(read->frames[i]->positions == written->frames[i]->positions);
      QVERIFY(read->frames[i]->bodyPoints == written->frames[i]->bodyPoints);
      QVERIFY(read->frames[i]->stretchRatios == written->frames[i]->stretchRatios);
      QVERIFY(read->frames[i]->limitForces == written->frames[i]->limitForces);
    }
    QCOMPARE(read->steps.size(), written->steps.size());
    QVERIFY(read->steps[5].energies.total() == written->steps[5].energies.total());
    QVERIFY(read->steps[5].relativeGap == written->steps[5].relativeGap);
    QCOMPARE(read->lastProjection.iterations.size(), written->lastProjection.iterations.size());
    QCOMPARE(read->studyType(), std::string("cloth_motion"));
    const auto charts = scene::resultCharts(scene, folder.path().toStdString(), {"motion"}, "displacement");
    QVERIFY(charts.front().series.front().y.size() == 10);
    const auto other =
        scene::Scene::parse(edited("\"length_cells\": 4", "\"length_cells\": 5"), scene.directory(), "other.json");
    try {
      ClothResult::read(other, place);
      QFAIL("read frames of another mesh");
    } catch (const base::InputError& error) {
      QVERIFY2(QString(error.what()).contains("no frame of a sheet with 30 nodes"), error.what());
    }
  }

  void twoRunsGiveTheSameFrames() {
    const QTemporaryDir folder;
    const scene::Scene scene = sceneIn(folder, clothScene);
    QVERIFY(run(scene, "motion")->frames.back()->positions == run(scene, "motion")->frames.back()->positions);
  }

  void aDrapeBalances() {
    const QTemporaryDir folder;
    const auto result = run(sceneIn(folder, edited("[1, 0, 2]", "[0, 0, 0]")), "drape");
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    QVERIFY(result->summary()["residual"].get<double>() <= 1e-2);
    QVERIFY(result->frames.back()->stretchRatios.maxCoeff() < 1 + 1e-6);
  }

  /// Stretched twice as wide along x, with nothing held but two nodes at x = 0 that are where they were: each row of
  /// cells comes back to the limit of 1 % along x.
  void aProjectionComesWithItsProof() {
    const QTemporaryDir folder;
    const auto result = run(sceneIn(folder, clothScene), "projection");
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    const Json summary = result->summary();
    const double objective = summary["projection"]["objective"], bound = summary["projection"]["bound"];
    QVERIFY(objective > 0 && bound <= objective * (1 + 1e-12) && objective - bound < 1e-7 * objective);
    const Eigen::Matrix3Xd moved = result->frames[1]->positions - result->frames[0]->positions;
    const double distance = 0.5 * moved.colwise().squaredNorm() * result->problem->sheet.masses;
    QVERIFY(std::abs(distance - objective) < 1e-9 * objective);
    QVERIFY(std::abs(result->frames[1]->stretchRatios.maxCoeff() - 1) < 1e-6);
  }

  /// Held nodes farther apart than the limits let them be: no optimum, and a sentence that says why.
  void pinsTooFarApartAreNoOptimum() {
    const QTemporaryDir folder;
    const auto result =
        run(sceneIn(folder, edited("\"at\": {\"nearest\": [0, 0.2, 0]}", "\"at\": {\"nearest\": [0.4, -0.2, 0]}")),
            "projection");
    QVERIFY2(result->termination == base::TerminationType::infeasible, result->message.c_str());
    QVERIFY(QString::fromStdString(result->message).contains("farther apart than the sheet may stretch"));
    const Json summary = result->summary();
    QVERIFY(!summary["projection"]["conflicting_triangles"].empty());
    QCOMPARE(summary["projection"]["conflicting_pins"].size(), std::size_t(2));
  }

  void badInputIsRefused_data() {
    QTest::addColumn<QString>("part");
    QTest::addColumn<QString>("by");
    QTest::addColumn<QString>("study");
    QTest::addColumn<QString>("said");
    QTest::addRow("limit below 1") << "\"stretch\": 1.02"
                                   << "\"stretch\": 0.99"
                                   << "motion"
                                   << "/stretch_limits/0: The rest shape breaks this limit";
    QTest::addRow("no such group") << "\"stretch\": 1.02"
                                   << "\"stretch\": 1.02, \"group\": \"hem\""
                                   << "motion"
                                   << "has no group \"hem\"";
    QTest::addRow("group without triangles") << "\"stretch\": 1.02"
                                             << "\"stretch\": 1.02, \"group\": \"left\""
                                             << "motion"
                                             << "No triangle has all its nodes";
    QTest::addRow("normal direction") << "\"stretch\": 1.02"
                                      << "\"stretch\": 1.02, \"direction\": [0, 0, 1]"
                                      << "motion"
                                      << "/stretch_limits/0";
    QTest::addRow("zero direction") << "\"stretch\": 1.02"
                                    << "\"stretch\": 1.02, \"direction\": [0, 0, 0]"
                                    << "motion"
                                    << "must not be zero";
    QTest::addRow("keyframes") << "{\"time\": 0}, {\"time\": 0.1"
                               << "{\"time\": 0.2}, {\"time\": 0.1"
                               << "motion"
                               << "ascend in time";
    QTest::addRow("pinned twice") << "\"at\": {\"nearest\": [0, 0.2, 0]}"
                                  << "\"at\": {\"nearest\": [0, -0.2, 0]}"
                                  << "motion"
                                  << "pinned twice";
    QTest::addRow("partly locked")
        << "\"type\": \"pin\", \"at\": {\"nearest\": [0, 0.2, 0]}, \"release\": 0.05"
        << "\"type\": \"locked\", \"at\": {\"nearest\": [0, 0.2, 0]}, \"coordinates\": [\"x\"]"
        << "motion"
        << "all three coordinates";
    QTest::addRow("friction") << "\"schema_version\": 1,"
                              << "\"schema_version\": 1, \"contact\": {\"friction\": 0.3},"
                              << "motion"
                              << "/contact/friction: Studies of cloth know no friction";
    QTest::addRow("consistent masses") << "\"schema_version\": 1,"
                                       << "\"schema_version\": 1, \"mass_matrix\": \"consistent\","
                                       << "motion"
                                       << "lumped";
    QTest::addRow("two winds")
        << "{\"name\": \"weight\""
        << "{\"name\": \"w\", \"type\": \"wind\", \"velocity\": [1, 0, 0]}, {\"name\": \"weight\""
        << "motion"
        << "one wind";
    QTest::addRow("no candidate") << "candidate.csv"
                                  << "nothing.csv"
                                  << "projection"
                                  << "no such file";
    QTest::addRow("candidate of another kind") << "candidate.csv"
                                               << "test.txt"
                                               << "projection"
                                               << "";
    QTest::addRow("pattern") << "\"thickness\": \"0.5 mm\""
                             << "\"thickness\": \"0.5 mm\", \"pattern\": {\"points\": [[0, 0, 0]]}"
                             << "motion"
                             << "/elements/0/pattern/points";
  }
  void badInputIsRefused() {
    QFETCH(QString, part);
    QFETCH(QString, by);
    QFETCH(QString, study);
    QFETCH(QString, said);
    const QTemporaryDir folder;
    const std::string text = edited(part.toStdString(), by.toStdString());
    QVERIFY(!text.empty());
    try {
      run(sceneIn(folder, text), study.toStdString());
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QVERIFY2(QString(error.what()).contains(said), error.what());
      QVERIFY2(QString(error.what()).contains("test.json") || study == "projection", error.what());
    }
  }

  void aBadCandidateIsRefusedWithItsLine_data() {
    QTest::addColumn<QString>("table");
    QTest::addColumn<QString>("said");
    const QString good = QString::fromStdString(candidateTable());
    const auto withLine = [&](int line, const QString& text) {
      QStringList lines = good.split('\n');
      lines[line - 1] = text;
      return lines.join('\n');
    };
    QTest::addRow("NaN") << withLine(5, "3,0,nan,0") << "Line 5: \"nan\" is no finite number";
    QTest::addRow("short line") << withLine(4, "2,0") << "Line 4: expected x, y and z";
    QTest::addRow("wrong node") << withLine(7, "9,0,0,0") << "Line 7: expected node 5";
    QTest::addRow("too few") << good.left(good.indexOf("\n20,") + 1) << "has 20 positions";
    QTest::addRow("empty") << ""
                           << "has 0 positions";
  }
  void aBadCandidateIsRefusedWithItsLine() {
    QFETCH(QString, table);
    QFETCH(QString, said);
    const QTemporaryDir folder;
    try {
      run(sceneIn(folder, clothScene, table.toStdString()), "projection");
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QVERIFY2(QString(error.what()).contains(said), error.what());
    }
  }

  /// A pattern half as long makes the sheet start stretched, with the energy and mass of the pattern.
  void aPatternIsTheRestShape() {
    Json points = Json::array();
    for (int node = 0; node < 25; ++node)
      points.push_back({restPoints(0, node) / 2, restPoints(1, node), restPoints(2, node)});
    const QTemporaryDir folder;
    const auto model = scene::buildModel(
        sceneIn(folder, edited("\"thickness\": \"0.5 mm\"",
                               "\"thickness\": \"0.5 mm\", \"pattern\": {\"points\": " + points.dump() + "}")));
    const double area = 0.2 * 0.4, strain = 0.5 * (4 - 1);
    QVERIFY(std::abs(model->massMatrix().diagonal().sum() / 3 - area * 200 * 0.5e-3) < 1e-12);
    const double expected = 0.5 * 1800 * 0.5e-3 / (1 - 0.41 * 0.41) * strain * strain * area;
    const double found = mechanics::ElasticAssembler(model).value(model->restPositions);
    QVERIFY2(std::abs(found - expected) < 1e-9 * expected, qPrintable(QString::number(found / expected)));
  }
};

QTEST_GUILESS_MAIN(TestClothScenes)
#include "test_cloth_scenes.moc"
