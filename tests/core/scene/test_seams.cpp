#include <QTemporaryDir>
#include <QTest>
#include <numbers>

#include "core/base/error.hpp"
#include "core/cloth/cloth_simulation.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/scene/cloth_builder.hpp"
#include "core/scene/cloth_result.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"

using namespace pliant;
using mechanics::Model;
using scene::Json;
using scene::Scene;

namespace {

// So stiff that it shows if bending is missing anywhere.
const Json cardboard{{"name", "cardboard"}, {"density", 200}, {"young_modulus", 1e6}, {"poisson_ratio", 0.3}};

Json grid(const std::string& name, double length, int lengthCells, double x) {
  return {{"name", name},     {"type", "grid"},       {"length", length}, {"width", 0.3}, {"length_cells", lengthCells},
          {"width_cells", 3}, {"position", {x, 0, 0}}};
}

Json shell(const std::string& geometry, double thickness = 1e-3) {
  return {{"name", geometry + " cloth"}, {"type", "shell"}, {"geometry", geometry}, {"thickness", thickness}};
}

Json seam(const std::string& from, const std::string& fromGroup, const std::string& to, const std::string& toGroup) {
  return {{"name", from + fromGroup + " to " + to + toGroup},
          {"from", {{"geometry", from}, {"group", fromGroup}}},
          {"to", {{"geometry", to}, {"group", toGroup}}}};
}

Json baseScene() {
  return {{"schema_version", 1},
          {"materials", {cardboard}},
          {"loads", {{{"name", "weight"}, {"type", "gravity"}, {"acceleration", {0.3, 1, -9.81}}}}},
          {"studies", Json::array({{{"name", "motion"},
                                    {"type", "cloth_motion"},
                                    {"scheme", "step_and_project"},
                                    {"duration", 0.1},
                                    {"newton_tolerance", 1e-12},
                                    {"relative_gap", 1e-11}}})}};
}

/// Limits for each element, and one corner held.
void finish(Json& json, const std::string& corner) {
  json["stretch_limits"] = Json::array();
  for (const Json& element : json["elements"])
    json["stretch_limits"].push_back(
        {{"name", element["name"]}, {"type", "isotropic"}, {"stretch", 1.002}, {"element", element["name"]}});
  json["boundary_conditions"] = {
      {{"name", "corner"}, {"type", "locked"}, {"at", {{"geometry", corner}, {"nearest", {0, 0.15, 0}}}}}};
}

Json wholeSheet() {
  Json json = baseScene();
  json["geometry"] = {grid("sheet", 0.6, 6, 0)};
  json["elements"] = {shell("sheet")};
  finish(json, "sheet");
  return json;
}

/// The same as two halves (the first as long as the diagonals' period).
Json twoHalves(double gap = 0) {
  Json json = baseScene();
  json["geometry"] = {grid("one", 0.4, 4, 0), grid("two", 0.2, 2, 0.4 + gap)};
  json["elements"] = {shell("one"), shell("two")};
  json["seams"] = {seam("one", "end", "two", "start")};
  finish(json, "one");
  return json;
}

/// A rectangle rolled up about the z axis so often that `around` cells are one turn: nodes column after column.
struct Rolled {
  Json points = Json::array(), flat = Json::array(), triangles = Json::array(), first = Json::array(),
       last = Json::array();
};
Rolled roll(int columns, int around, int rows = 3) {
  Rolled rolled;
  const double size = 0.05, radius = 0.5 * size / std::sin(std::numbers::pi / around);
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j) {
      const double angle = 2 * std::numbers::pi * (i % around) / around;
      rolled.points.push_back({radius * std::cos(angle), radius * std::sin(angle), size * j});
      rolled.flat.push_back({size * i, size * j, 0.0});
      if (i == 0) rolled.first.push_back(j);
      if (i == columns) rolled.last.push_back(i * (rows + 1) + j);
    }
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const int a = i * (rows + 1) + j, b = a + rows + 1;
      rolled.triangles.push_back({a, b, b + 1});
      rolled.triangles.push_back({a, b + 1, a + 1});
    }
  return rolled;
}

Json rolledScene(const Rolled& rolled, bool sewn) {
  Json json = baseScene();
  json["geometry"] = {
      {{"name", "tube"},
       {"type", "mesh"},
       {"points", rolled.points},
       {"triangles", rolled.triangles},
       {"groups", {{{"name", "first"}, {"nodes", rolled.first}}, {{"name", "last"}, {"nodes", rolled.last}}}}}};
  json["elements"] = {shell("tube")};
  json["elements"][0]["pattern"] = {{"points", rolled.flat}};
  json["stretch_limits"] = {{{"name", "limit"}, {"type", "isotropic"}, {"stretch", 1.01}}};
  if (sewn) json["seams"] = {seam("tube", "first", "tube", "last")};
  return json;
}

Scene parse(const Json& json, const std::filesystem::path& folder = "/nowhere") {
  return Scene::parse(json.dump(), folder, "test.json");
}

std::shared_ptr<const Model> build(const Json& json) { return scene::buildModel(parse(json)); }

double energyOf(const std::shared_ptr<const Model>& model) {
  return mechanics::ElasticAssembler(model).value(model->restPositions);
}

double massOf(const Model& model) { return model.massMatrix().diagonal().sum() / 3; }

std::shared_ptr<const scene::ClothResult> run(const Json& json) {
  const Scene scene = parse(json);
  base::ExecutionContext context;
  return std::dynamic_pointer_cast<const scene::ClothResult>(
      scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "motion")->run(context));
}

/// Each node of one frame and the node of the other that began in the same place.
double largestDifference(const scene::ClothResult& one, const scene::ClothResult& other) {
  const Eigen::Matrix3Xd &start = one.frames.front()->positions, &otherStart = other.frames.front()->positions;
  double largest = start.cols() == otherStart.cols() ? 0 : 1;
  for (Eigen::Index node = 0; node < start.cols(); ++node) {
    Eigen::Index same = 0;
    largest = std::max(largest, (otherStart.colwise() - start.col(node)).colwise().norm().minCoeff(&same));
    largest =
        std::max(largest, (one.frames.back()->positions.col(node) - other.frames.back()->positions.col(same)).norm());
  }
  return largest;
}

/// One of two squares of side 0.1 that are sewn along x = 0, the other turned up by 90 degrees; in the pattern the
/// second lies at `u`, turned over if `turned`.
std::string foldedObj(double u, bool turned) {
  std::string text =
      "v 0 0 0\nv 0 0.1 0\nv -0.1 0 0\nv -0.1 0.1 0\nv 0 0 0.1\nv 0 0.1 0.1\n"
      "vt 0 0\nvt 0 0.1\nvt -0.1 0\nvt -0.1 0.1\n";
  const double side = turned ? -0.1 : 0.1;
  for (const double x : {u, u + side})
    for (const double y : {0.0, 0.1}) text += "vt " + std::to_string(x) + " " + std::to_string(y) + "\n";
  // The last triangle runs the other way round and has to be turned, with its pattern.
  return text + "f 1/1 2/2 3/3\nf 3/3 2/2 4/4\nf 2/6 1/5 5/7\nf 2/6 6/8 5/7\n";
}

Json textureScene() {
  Json json = baseScene();
  json["geometry"] = {{{"name", "tent"}, {"type", "file"}, {"path", "tent.obj"}}};
  json["elements"] = {shell("tent")};
  json["elements"][0]["pattern"] = {{"from", "texture_coordinates"}};
  return json;
}

}  // namespace

class TestSeams : public QObject {
  Q_OBJECT

 private slots:
  void twoHalvesMoveAsOneSheet() {
    const auto whole = run(wholeSheet()), halves = run(twoHalves());
    QVERIFY2(whole->termination == base::TerminationType::converged, whole->message.c_str());
    QVERIFY2(halves->termination == base::TerminationType::converged, halves->message.c_str());
    const Eigen::Matrix3Xd moved = whole->frames.back()->positions - whole->frames.front()->positions;
    QVERIFY(moved.colwise().norm().maxCoeff() > 0.02);
    QVERIFY(whole->frames.back()->limitForces.maxCoeff() > 0);
    const double difference = largestDifference(*whole, *halves);
    QVERIFY2(difference < 1e-10, qPrintable(QString::number(difference)));
  }

  /// A seam between panels of different thickness bends like an edge within one panel whose triangles differ.
  void unlikePanelsMoveAsOneSheetWithFactors() {
    Json halves = twoHalves(), whole = wholeSheet();
    halves["elements"][1]["thickness"] = 3e-3;
    const int cells = 6 * 3, thin = 4 * 3;
    for (int t = 0; t < 2 * cells; ++t) whole["elements"][0]["thickness_factors"].push_back(t < 2 * thin ? 1.0 : 3.0);
    const auto uniform = run(wholeSheet()), one = run(whole), other = run(halves);
    QVERIFY(largestDifference(*uniform, *one) > 1e-6);
    const double difference = largestDifference(*one, *other);
    QVERIFY2(difference < 1e-10, qPrintable(QString::number(difference)));
  }

  void reversedSeamsJoinTheOtherWayRound() {
    Json json = twoHalves();
    json["seams"][0]["reverse"] = true;
    const auto model = build(json);
    QCOMPARE(model->nodeCount(), 5 * 4 + 3 * 4 - 4);
    // Opposite ends of the seam meet in its middle.
    int inTheMiddle = 0;
    for (int node = 0; node < model->nodeCount(); ++node)
      inTheMiddle += (model->restPositions.segment<3>(3 * node) - Eigen::Vector3d(0.4, 0, 0)).norm() < 1e-12 ? 1 : 0;
    QCOMPARE(inTheMiddle, 4);
  }

  /// Of a long strip that is rolled up twice, the second turn has as many cells and as many joints between cells as a
  /// tube that is sewn together.
  void aTubeBendsOverItsSeamAsAnywhere() {
    constexpr int around = 12;
    const auto tube = build(rolledScene(roll(around, around), true));
    const auto once = build(rolledScene(roll(around, around), false));
    const auto twice = build(rolledScene(roll(2 * around, around), false));
    QCOMPARE(tube->nodeCount(), around * 4);
    QCOMPARE(once->nodeCount(), (around + 1) * 4);
    const double expected = energyOf(twice) - energyOf(once);
    QVERIFY2(std::abs(energyOf(tube) - expected) < 1e-10 * expected,
             qPrintable(QString::number(energyOf(tube) / expected, 'g', 12)));
    QVERIFY(expected - energyOf(once) > 1e-3 * expected);  // the seam shows
    QVERIFY(std::abs(massOf(*tube) - massOf(*once)) < 1e-12 * massOf(*once));
    // Every node of a ring carries the same mass.
    const Eigen::VectorXd masses = cloth::lumpedMasses(*tube);
    for (int node = 0; node < tube->nodeCount(); ++node)
      QVERIFY(std::abs(masses[node] - masses[node % 4]) < 1e-12 * masses[node]);
  }

  void aFreeTubeKeepsItsMomentumInAProjection() {
    const Scene scene = parse(rolledScene(roll(12, 12), true));
    const auto problem = scene::buildClothProblem(scene, scene::buildModel(scene));
    const Eigen::Matrix3Xd rest = problem->model->restPositions.reshaped(3, problem->sheet.nodeCount);
    Eigen::Matrix3Xd candidate = rest;
    for (Eigen::Index i = 0; i < candidate.size(); ++i) candidate.data()[i] += 0.02 * std::sin(1.7 * i * i);
    const cloth::SheetCones cones = cloth::sheetCones(problem->sheet, cloth::ProjectionNorm::mass);
    base::ExecutionContext context;
    const auto solution = cloth::makeStrainLimiter("cone", cones.constraints, {})->project(candidate, rest, context);
    QVERIFY2(solution.report.converged(), solution.report.message.c_str());
    QVERIFY(cloth::stretchRatios(problem->sheet, candidate).maxCoeff() > 1.1);
    QVERIFY(cloth::stretchRatios(problem->sheet, solution.positions).maxCoeff() < 1 + 1e-9);
    const Eigen::Matrix3Xd impulses = (solution.positions - candidate) * problem->sheet.masses.asDiagonal();
    const double size = impulses.colwise().norm().sum();
    QVERIFY(size > 0);
    QVERIFY2(impulses.rowwise().sum().norm() < 1e-10 * size,
             qPrintable(QString::number(impulses.rowwise().sum().norm() / size)));
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
    for (Eigen::Index n = 0; n < rest.cols(); ++n)
      turn += Eigen::Vector3d(solution.positions.col(n)).cross(impulses.col(n));
    const double arm = solution.positions.colwise().norm().maxCoeff();
    QVERIFY2(turn.norm() < 1e-10 * size * arm, qPrintable(QString::number(turn.norm() / (size * arm))));
  }

  /// Two tubes, one upon the other, the upper one's nodes counted from elsewhere and the other way round.
  void closedEdgesAreJoinedWhereTheyMeet() {
    constexpr int around = 12;
    Json json = rolledScene(roll(around, around), true);
    Json upper = json["geometry"][0];
    upper["name"] = "upper";
    upper["rotation"] = {{"axis", {1, 0, 0}}, {"angle", std::numbers::pi}};
    upper["position"] = {0, 0, 2 * 0.15};
    json["geometry"].push_back(upper);
    json["elements"].push_back(shell("upper"));
    json["elements"][1]["pattern"] = json["elements"][0]["pattern"];
    json["stretch_limits"][0]["element"] = "tube cloth";
    json["seams"].push_back(seam("upper", "first", "upper", "last"));
    const auto rim = [](const char* geometry) {
      return Json{{"geometry", geometry}, {"box", {{"minimum", {-1, -1, 0.14}}, {"maximum", {1, 1, 0.16}}}}};
    };
    json["seams"].push_back({{"name", "ring"}, {"from", rim("tube")}, {"to", rim("upper")}});
    const auto model = build(json);
    QCOMPARE(model->nodeCount(), around * 4 + around * 3);
    const auto alone = build(rolledScene(roll(around, around), true));
    const auto head = model->restPositions.head(alone->restPositions.size());
    QVERIFY((head - alone->restPositions).cwiseAbs().maxCoeff() < 1e-12);  // nothing had to move
    // Bending: that of two tubes, and none more over the ring, along which the tube is straight, but for diagonals.
    QVERIFY(std::abs(energyOf(model) - 2 * energyOf(alone)) < 1e-9 * energyOf(alone));
  }

  /// Without contact panels may start apart: the first step closes what opens when seams start in the middle.
  void panelsThatStartApartComeTogether() {
    const double gap = 0.05;
    const Json json = twoHalves(gap);
    const auto result = run(json);
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    QVERIFY(std::abs(result->frames.front()->stretchRatios.maxCoeff() - (1 + gap / 2 / 0.1) / 1.002) < 1e-3);
    for (std::size_t i = 1; i < result->frames.size(); ++i)
      QVERIFY(result->frames[i]->stretchRatios.maxCoeff() < 1 + 1e-6);
    QVERIFY(std::abs(massOf(*build(json)) - massOf(*build(wholeSheet()))) < 1e-12);  // the rest shape is as before
  }

  void textureCoordinatesAreAPattern() {
    const QTemporaryDir folder;
    const std::filesystem::path place = folder.path().toStdString();
    const auto energyWith = [&](double u, bool turned, double scale) {
      scene::writeTextFile(place / "tent.obj", foldedObj(u, turned));
      Json json = textureScene();
      json["elements"][0]["pattern"]["scale"] = scale;
      const auto model = scene::buildModel(parse(json, place));
      return std::pair(energyOf(model), massOf(*model));
    };
    // One hinge of length 0.1 between triangles of 0.005 m² each, bent by 90 degrees from flat; no strain.
    const double d = 1e6 * 1e-9 / (12 * (1 - 0.3 * 0.3));
    const double angle = std::numbers::pi / 2, expected = 0.5 * d * 0.01 / 0.01 * angle * angle;
    for (const auto& [u, turned] : {std::pair(0.0, false), {1.0, false}, {0.0, true}, {0.3, true}}) {
      const auto [energy, mass] = energyWith(u, turned, 1);
      QVERIFY2(std::abs(energy - expected) < 1e-5 * expected, qPrintable(QString::number(energy / expected)));
      QVERIFY(std::abs(mass - 200 * 1e-3 * 0.02) < 1e-6 * mass);  // read as floats
    }
    QVERIFY(std::abs(energyWith(0.3, false, 2).second - 4 * 200 * 1e-3 * 0.02) < 1e-7);
  }

  void badInputIsRefused_data() {
    QTest::addColumn<QString>("patch");
    QTest::addColumn<QString>("said");
    const auto row = [](const char* name, const char* patch, const char* said) {
      QTest::addRow("%s", name) << patch << said;
    };
    row("unknown edge", R"([{"op": "replace", "path": "/seams/0/from/group", "value": "hem"}])",
        "/seams/0/from/group: The geometry \"one\" has no group \"hem\"");
    row("unknown geometry", R"([{"op": "replace", "path": "/seams/0/to/geometry", "value": "three"}])",
        "There is no entry named \"three\" in \"geometry\"");
    row("different counts", R"([{"op": "replace", "path": "/seams/0/to/group", "value": "left"}])",
        "/seams/0: Sewn edges need as many nodes as each other, but these have 4 and 3; mesh both edges alike.");
    row("not connected",
        R"([{"op": "replace", "path": "/seams/0/from", "value": {"geometry": "one", "nodes": [0, 1, 18, 19]}}])",
        "/seams/0/from: These 4 nodes are not one connected piece of the boundary: from node 0 of the geometry \"one\" "
        "no way along it leads to node 18.");
    row("inside",
        R"([{"op": "replace", "path": "/seams/0/from", "value": {"geometry": "one", "nodes": [5, 6, 9, 10]}}])",
        "not one connected piece");
    row("one node",
        R"([{"op": "replace", "path": "/seams/0/from", "value": {"geometry": "one", "nearest": [0, 0, 0]}}])",
        "/seams/0/from: A sewn edge has two nodes at least");
    row("to itself", R"([{"op": "replace", "path": "/seams/0/to", "value": {"geometry": "one", "group": "end"}}])",
        "of the geometry \"one\" is on both edges and would be sewn to itself.");
    row("open to closed",
        R"([{"op": "replace", "path": "/geometry/1/length_cells", "value": 1},
            {"op": "replace", "path": "/geometry/1/width_cells", "value": 1},
            {"op": "replace", "path": "/seams/0/to", "value": {"geometry": "two", "nodes": [0, 1, 2, 3]}}])",
        "/seams/0: One of these edges is closed and the other is not.");
    row("sewn shut",
        R"([{"op": "replace", "path": "/geometry/0/width_cells", "value": 1},
            {"op": "replace", "path": "/seams/0/from", "value": {"geometry": "one", "group": "left"}},
            {"op": "replace", "path": "/seams/0/to", "value": {"geometry": "one", "group": "right"}}])",
        "/seams: Corners of triangle 0 of the geometry \"one\" would be sewn together.");
    row("three panels",
        R"([{"op": "add", "path": "/seams/-", "value": {"name": "third", "from": {"geometry": "one", "group": "end"},
             "to": {"geometry": "two", "group": "end"}}}])",
        "an edge may have two at most");
    row("apart with contact",
        R"([{"op": "add", "path": "/contact", "value": {"self_contact": true}},
            {"op": "replace", "path": "/geometry/1/position", "value": [0.45, 0, 0]}])",
        "/seams: Closing the seams stretches triangle ");
    row("no texture", R"([{"op": "add", "path": "/elements/0/pattern", "value": {"from": "texture_coordinates"}}])",
        "/elements/0/pattern/from: The triangles of the geometry \"one\" have no texture coordinates");
  }
  void badInputIsRefused() {
    QFETCH(QString, patch);
    QFETCH(QString, said);
    try {
      run(twoHalves().patch(Json::parse(patch.toStdString())));
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QVERIFY2(QString(error.what()).contains(said), error.what());
      QVERIFY2(QString(error.what()).contains("test.json"), error.what());
    }
  }

  /// A pattern with its triangles in another order than the geometry's.
  void aPatternInAnotherOrderIsRefused() {
    const QTemporaryDir folder;
    const std::filesystem::path place = folder.path().toStdString();
    scene::writeTextFile(place / "tent.obj", foldedObj(0.3, false));
    std::string text = foldedObj(0.3, false);
    text.erase(text.find("f 1/1"));
    scene::writeTextFile(place / "pattern.obj", text + "f 2/6 6/8 5/7\nf 1/1 2/2 3/3\nf 2/6 1/5 5/7\nf 3/3 2/2 4/4\n");
    Json json = textureScene();
    json["elements"][0]["pattern"] = {{"path", "pattern.obj"}};
    try {
      scene::buildModel(parse(json, place));
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QVERIFY2(QString(error.what()).contains("in the same order"), error.what());
    }
  }
};

QTEST_GUILESS_MAIN(TestSeams)
#include "test_seams.moc"
