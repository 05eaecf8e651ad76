#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/detail_export.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/macro_reading.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"

using namespace pliant;

namespace {

constexpr const char* sceneText = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "mail", "type": "threefold"}],
  "bodies": [{"name": "floor", "type": "ground", "point": [0, 0, "-20 mm"], "size": "1 m"}],
  "contact": {"distance": "2 mm"},
  "studies": [
    {"name": "study", "type": "macro_motion", "shape": "outline", "rings": 4,
     "corners": [["-50 mm", "-30 mm"], ["50 mm", "-30 mm"], ["50 mm", "30 mm"], ["-50 mm", "30 mm"]],
     "regions": [{"name": "turned", "angle": "90 deg", "corners": [[0, "-40 mm"], ["60 mm", "-40 mm"], ["60 mm", "40 mm"], [0, "40 mm"]]}],
     "grips": [{"point": ["-50 mm", 0], "radius": "40 mm", "release": "50 ms", "path": [{"time": 0}, {"time": "50 ms", "translation": [0, 0, "10 mm"]}]}],
     "duration": "120 ms", "time_step": "10 ms", "frame_every": 3}
  ]
})";

std::string changed(const std::string& what, const std::string& with) {
  std::string text = sceneText;
  const std::size_t place = text.find(what);
  if (place == std::string::npos) qFatal("nothing to replace");
  return text.replace(place, what.size(), with);
}

std::shared_ptr<const scene::MacroResult> run(const scene::Scene& scene) {
  base::ExecutionContext context;
  return std::dynamic_pointer_cast<const scene::MacroResult>(
      scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "study")->run(context));
}

scene::Scene parsed(const std::string& text, const std::string& directory = ".") {
  return scene::Scene::parse(text, directory, "mail.json");
}

}  // namespace

class TestMacroMotion : public QObject {
  Q_OBJECT

 private slots:
  void motionIsReadBackToTheLastBit() {
    const scene::Scene scene = parsed(sceneText);
    const auto result = run(scene);
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    QCOMPARE(result->steps.size(), std::size_t(12));
    QCOMPARE(result->frames.size(), std::size_t(5));
    const scene::Json summary = result->summary();
    QVERIFY(summary["motion"]["smallest_gap"].get<double>() > 0);
    QVERIFY(summary["motion"]["largest_stretch_gauge"].get<double>() < 1);
    QCOMPARE(summary["regions"].size(), std::size_t(1));
    QVERIFY(summary["regions"][0]["triangles"].get<int>() > 0);
    // It has fallen onto the floor, and not through it.
    const auto& last = *result->frames.back();
    QVERIFY(last.positions.row(2).minCoeff() > -0.02);
    QVERIFY(last.positions.row(2).minCoeff() < -0.018);
    QTemporaryDir directory;
    const std::filesystem::path folder = directory.filePath("study").toStdString();
    result->write(folder);
    const auto again = scene::readMacro(scene, folder);
    QVERIFY(again->isMotion());
    QCOMPARE(again->frames.size(), result->frames.size());
    for (std::size_t i = 0; i < result->frames.size(); ++i) {
      QVERIFY(again->frames[i]->positions == result->frames[i]->positions);
      QVERIFY(again->frames[i]->stretchGauge == result->frames[i]->stretchGauge);
      QVERIFY(again->frames[i]->bodyPoints == result->frames[i]->bodyPoints);
      QCOMPARE(again->frames[i]->time, result->frames[i]->time);
    }
    QCOMPARE(again->steps.back().energies.total(), result->steps.back().energies.total());
    QCOMPARE(again->bodies.size(), std::size_t(1));
  }

  void outlinesComeFromFiles() {
    QTemporaryDir directory;
    std::ofstream(directory.filePath("loops.csv").toStdString())
        << "x [mm],y [mm],loop\n-50,-30,0\n50,-30,0\n50,30,0\n-50,30,0\n-10,-5,1\n10,-5,1\n0,5,1\n";
    std::ofstream(directory.filePath("loops.obj").toStdString())
        << "v -0.05 -0.03 0\nv 0.05 -0.03 0\nv 0.05 0.03 0\nv -0.05 0.03 0\nv -0.01 -0.005 0\nv 0.01 -0.005 0\n"
           "v 0 0.005 0\nl 1 2 3 4 1\nl -3 -2 -1 -3\n";
    const std::string corners =
        R"("corners": [["-50 mm", "-30 mm"], ["50 mm", "-30 mm"], ["50 mm", "30 mm"], ["-50 mm", "30 mm"]])";
    std::vector<double> areas;
    for (const char* file : {"loops.csv", "loops.obj"}) {
      std::string text = changed(corners, R"("outline": ")" + std::string(file) + R"(")");
      text.replace(text.find("120 ms"), 6, "10 ms");
      const auto result = run(parsed(text, directory.path().toStdString()));
      double area = 0;
      const auto& mesh = result->sheet->mesh;
      for (const auto& [a, b, c] : mesh.triangles)
        area += 0.5 * Eigen::Vector3d(mesh.points.col(b) - mesh.points.col(a))
                          .cross(Eigen::Vector3d(mesh.points.col(c) - mesh.points.col(a)))
                          .z();
      areas.push_back(area);
    }
    for (const double area : areas) QVERIFY(std::abs(area - (0.1 * 0.06 - 0.5 * 0.02 * 0.01)) < 1e-12);
  }

  void elementsArePlacedReadBackAndPrinted() {
    const std::string text = R"({
      "schema_version": 1,
      "interlocking_cells": [{"name": "mail", "type": "threefold"}],
      "bodies": [{"name": "ball", "type": "sphere", "center": [0, 0, 0], "radius": "60 mm"}],
      "contact": {"distance": "2 mm"},
      "studies": [{"name": "study", "type": "macro_equilibrium", "shape": "disk", "radius": "30 mm", "rings": 4,
        "elements": true, "young_modulus": "20 kPa", "placement": {"position": [0, 0, "63 mm"]},
        "clamps": [{"point": [0, 0], "radius": "8 mm"}]}]})";
    const scene::Scene scene = parsed(text);
    const auto result = run(scene);
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    QVERIFY(result->placed && result->placed->check.holds() && result->placed->before.holds());
    QCOMPARE(result->placed->check.links, result->placed->before.links);
    QTemporaryDir directory;
    const std::filesystem::path folder = directory.filePath("study").toStdString();
    result->write(folder);
    const auto again = scene::readMacro(scene, folder);
    QVERIFY(again->placed.has_value());
    QVERIFY(again->placed->detail.elements == result->placed->detail.elements);
    QVERIFY(again->placed->detail.state.positions == result->placed->detail.state.positions);
    QVERIFY((again->placed->detail.state.rotations[0] - result->placed->detail.state.rotations[0]).norm() < 1e-12);
    base::ExecutionContext context;
    const std::filesystem::path file = directory.filePath("mail.stl").toStdString();
    const scene::PatchReport report = scene::exportPlaced(*again, 2e-4, 0, file, context);
    QCOMPARE(report.elements, static_cast<int>(result->placed->detail.elements.size()));
    QCOMPARE(static_cast<long>(std::filesystem::file_size(file)), 84 + 50 * report.triangles);
    QVERIFY_THROWS_EXCEPTION(base::InputError, scene::exportPlaced(*again, 2e-4, 1, file, context));
  }

  void elementsOfAMotionStandOnItsLastFrame() {
    const std::string text = R"({
      "schema_version": 1,
      "interlocking_cells": [{"name": "mail", "type": "threefold"}],
      "bodies": [{"name": "ball", "type": "sphere", "center": [0, 0, 0], "radius": "60 mm"}],
      "contact": {"distance": "2 mm", "friction": 0.3},
      "studies": [{"name": "study", "type": "macro_motion", "shape": "disk", "radius": "30 mm", "rings": 4,
        "elements": true, "young_modulus": "20 kPa", "placement": {"position": ["10 mm", 0, "62 mm"]},
        "duration": "100 ms", "margin": 0.1}]})";
    const scene::Scene scene = parsed(text);
    const auto result = run(scene);
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    QVERIFY(result->placed && result->placed->check.holds());
    QVERIFY(result->state.stretchGauge.maxCoeff() < 0.9);
    const scene::Json summary = result->summary();
    QVERIFY(summary["motion"]["dissipated"].get<double>() > 0);
    // An element's place is near the triangle that is nearest to it, whichever that is.
    const auto nodes = result->frames.back()->positions;
    for (const Eigen::Vector3d place : result->placed->detail.state.positions.colwise())
      QVERIFY((nodes.colwise() - place).colwise().norm().minCoeff() < 0.01);
    QTemporaryDir directory;
    const std::filesystem::path folder = directory.filePath("study").toStdString();
    result->write(folder);
    const auto again = scene::readMacro(scene, folder);
    QVERIFY(again->placed->detail.state.positions == result->placed->detail.state.positions);
    QCOMPARE(again->steps.back().energies.dissipated, result->steps.back().energies.dissipated);
  }

  void elementsOfRegionsShareTheirLattice() {
    const std::string text = R"({
      "schema_version": 1,
      "interlocking_cells": [{"name": "mail", "type": "threefold"},
        {"name": "thin", "type": "threefold", "wire_radius": "0.8 mm"},
        {"name": "wide", "type": "threefold", "spacing": "15 mm"}],
      "studies": [{"name": "study", "type": "macro_equilibrium", "cell": "mail", "shape": "rectangle",
        "size": ["80 mm", "60 mm"], "rings": 8, "elements": true, "young_modulus": "20 kPa",
        "regions": [{"name": "right", "cell": "thin", "corners": [[0, "-40 mm"], ["60 mm", "-40 mm"], ["60 mm", "40 mm"], [0, "40 mm"]]}],
        "clamps": [{"point": ["-40 mm", 0], "radius": "40 mm"}]}]})";
    const scene::Scene scene = parsed(text);
    const auto result = run(scene);
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    QVERIFY(result->placed->check.holds());
    const auto& detail = result->placed->detail;
    const std::size_t own = result->cell->elements.size() / 2;
    int left = 0, right = 0;
    for (std::size_t i = 0; i < detail.elements.size(); ++i) {
      const bool isThin = detail.elements[i].element >= static_cast<int>(own);
      const double x = detail.state.positions(0, static_cast<Eigen::Index>(i));
      (isThin ? right : left) += 1;
      QVERIFY(isThin ? x > -0.01 : x < 0.01);
      const auto& element = result->cell->elements[static_cast<std::size_t>(detail.elements[i].element)];
      const double radius = result->cell->shapes[static_cast<std::size_t>(element.shape)].pieces[0].radius;
      QCOMPARE(radius < 9e-4, isThin);
    }
    QVERIFY(left > 5 && right > 5);
    QTemporaryDir directory;
    const std::filesystem::path folder = directory.filePath("study").toStdString();
    result->write(folder);
    const auto again = scene::readMacro(scene, folder);
    QVERIFY(again->placed->detail.elements == detail.elements);
    QCOMPARE(again->cell->elements.size(), 2 * own);

    const auto refused = [&](const std::string& what, const std::string& with) {
      std::string other = text;
      other.replace(other.find(what), what.size(), with);
      QVERIFY_THROWS_EXCEPTION(base::InputError, run(parsed(other)));
    };
    refused("\"cell\": \"thin\"", "\"cell\": \"wide\"");
    refused("\"cell\": \"thin\"", "\"cell\": \"thin\", \"angle\": \"20 deg\"");
  }

  void badInputIsRefused_data() {
    QTest::addColumn<std::string>("what");
    QTest::addColumn<std::string>("with");
    QTest::newRow("corners that cross") << std::string(R"(["50 mm", "30 mm"], ["-50 mm", "30 mm"]])")
                                        << std::string(R"(["-50 mm", "30 mm"], ["50 mm", "30 mm"]])");
    QTest::newRow("a floor in the sheet") << std::string(R"([0, 0, "-20 mm"])") << std::string("[0, 0, 0]");
    QTest::newRow("an empty region") << std::string(R"([0, "-40 mm"], ["60 mm", "-40 mm"])")
                                     << std::string(R"(["59 mm", "-40 mm"], ["60 mm", "-40 mm"])");
    QTest::newRow("keyframes that do not ascend") << std::string(R"("time": "50 ms")") << std::string(R"("time": 0)");
    QTest::newRow("a region twice over") << std::string(R"("angle": "90 deg",)")
                                         << std::string(R"("angle": "90 deg", "triangles": [0],)");
  }
  void badInputIsRefused() {
    QFETCH(std::string, what);
    QFETCH(std::string, with);
    std::string text = changed(what, with);
    if (std::string(QTest::currentDataTag()) == "an empty region")
      text.replace(text.find("[0, \"40 mm\"]"), 12, "[\"59 mm\", \"40 mm\"]");
    QVERIFY_THROWS_EXCEPTION(base::InputError, run(parsed(text)));
  }
};

QTEST_APPLESS_MAIN(TestMacroMotion)
#include "test_macro_motion.moc"
