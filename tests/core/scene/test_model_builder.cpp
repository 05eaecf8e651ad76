#include <QTemporaryDir>
#include <QTest>
#include <numbers>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using mechanics::Model;
using mechanics::Vector;

class TestModelBuilder : public QObject {
  Q_OBJECT

  static std::shared_ptr<const Model> build(const std::string& text) { return scene::buildModel(test::parse(text)); }

  static Vector positionOf(const Model& model, int node) {
    return model.restPositions.segment(node * model.dimension, model.dimension);
  }

 private slots:
  /// A pair beside the plane x = 1, one of three nodes, and one on the plane: one parameter for the masses of all.
  void mirrorImagesShareTheirMass() {
    const std::string text = R"({"schema_version": 1, "dimension": 2,
      "geometry": [{"name": "a", "type": "points", "points": [[0, 0], [2, 0], [1, 3], [2, 1.1], [0, 1]]}],
      "springs": [{"name": "s", "type": "grounded", "at": {"nodes": [0, 1, 2, 3, 4]}, "direction": [1, 1],
                   "coefficients": [1]}],
      "point_masses": [{"name": "feet", "at": {"nodes": [0, 2]}, "mass": 0.5,
                        "mirrored": {"point": [1, 7], "normal": [-3, 0]}},
                       {"name": "hands", "at": {"nodes": [4]}, "mass": 0.1,
                        "mirrored": {"point": ["1 m", 0], "normal": [1, 0]}}]})";
    const auto model = build(text);
    QCOMPARE(model->pointMasses[0].nodes, (std::vector<int>{0, 1, 2}));
    QCOMPARE(model->pointMasses[1].nodes, (std::vector<int>{3, 4}));
    QCOMPARE(model->parameters.size(), std::size_t(2));
    const Model heavier = model->parameters[0]->withValue(*model, 0.7);
    const mechanics::Matrix mass(heavier.massMatrix());
    for (const int node : {0, 1, 2}) QCOMPARE(mass(2 * node, 2 * node), 0.7);
    for (const int node : {3, 4}) QCOMPARE(mass(2 * node, 2 * node), 0.1);
    const auto refusal = [&](const std::string& from, const std::string& to) {
      std::string changed = text;
      changed.replace(changed.find(from), from.size(), to);
      try {
        build(changed);
      } catch (const base::InputError& error) {
        return error.location();
      }
      return std::string();
    };
    QVERIFY(refusal("\"normal\": [-3, 0]", "\"normal\": [0, 0]").ends_with("/point_masses/0/mirrored/normal"));
    QVERIFY(refusal("[1, 7]", "[5, 7]").ends_with("/point_masses/0/mirrored"));
  }

  void buildsEveryPart() {
    const auto model = build(test::fullScene);
    QCOMPARE(model->nodeCount(), 15 + 2);
    QCOMPARE(model->parts.size(), 2u);
    QCOMPARE(model->parts[0].triangles.size(), 16u);
    QCOMPARE(model->parts[0].segments.size(), 0u);
    QCOMPARE(model->parts[0].springs.size() + model->parts[1].springs.size(), 4u);
    QCOMPARE(model->parts[1].firstNode, 15);
    QCOMPARE(model->energies.size(), 2u + 4u);
    QCOMPARE(model->pointMasses.size(), 2u);
    QCOMPARE(model->pointMasses[0].nodes.size(), 3u);
    QCOMPARE(model->parameters[0]->pointer(), std::string("/point_masses/0/mass"));
    QCOMPARE(model->parameters[0]->maximum(*model), 0.01);
    QCOMPARE(model->drives.size(), 1u);
    QCOMPARE(model->forces.size(), 1u);
    QCOMPARE(model->massDamping, 0.5);
    QCOMPARE(model->stiffnessDamping, 5e-5);
    QCOMPARE(model->gravity, Eigen::Vector3d(0, 0, -9.81));
    // 17 nodes of 3 coordinates, less 6 driven nodes and 2 locked coordinates
    QCOMPARE(model->dofs.freeCount(), 51 - 18 - 2);
  }

  void massIsThatOfTheSheetAndThePoints() {
    for (const char* kind : {"lumped", "consistent"}) {
      const auto scene = test::parse(test::fullScene).withValue("/mass_matrix", kind);
      const auto mass = scene::buildModel(scene)->massMatrix();
      const double sheet = 1380 * 0.2e-3 * 0.1 * 0.04, points = 3 * 0.002 + 2 * 0.01;
      QVERIFY(std::abs(mass.sum() / 3 - (sheet + points)) < 1e-12 * (sheet + points));
    }
  }

  void placesGeometry() {
    // A grid along x, turned by 90° about y, points along -z; then it is moved by 1 cm along y.
    const auto model = build(test::fullScene);
    const mechanics::DisplayPart& sheet = model->parts[0];
    double lowest = 0, widest = 0;
    for (int n = 0; n < sheet.nodeCount; ++n) {
      lowest = std::min(lowest, positionOf(*model, n)[2]);
      widest = std::max(widest, positionOf(*model, n)[1]);
      QVERIFY(std::abs(positionOf(*model, n)[0]) < 1e-15);
    }
    QVERIFY(std::abs(lowest + 0.1) < 1e-15);
    QVERIFY(std::abs(widest - 0.03) < 1e-15);
    // The probe was to be nearest to (0, 0, -0.1): the corner or the middle at y = 0.01 or -0.01.
    QVERIFY(std::abs(positionOf(*model, model->probes[0].node)[2] + 0.1) < 1e-15);
  }

  void aDriveMovesItsNodesAsWritten() {
    const auto model = build(test::fullScene);
    const double tau = 0.7, pi = std::numbers::pi;
    const double angle = pi / 180 * std::cos(tau) + pi / 1800 * std::cos(2 * tau + pi / 2);
    const Vector x = model->configuration(Vector::Zero(model->dofs.freeCount()), tau);
    const auto& drive = *model->drives[0];
    QCOMPARE(drive.coordinates().size(), 18u);
    QCOMPARE(model->drivenNodes().size(), 6u);
    for (const int node : model->drivenNodes()) {
      const Vector rest = positionOf(*model, node);
      const Eigen::Vector3d expected(rest[0] * std::cos(angle) + rest[2] * std::sin(angle), rest[1],
                                     rest[2] * std::cos(angle) - rest[0] * std::sin(angle));
      QVERIFY((x.segment(node * 3, 3) - expected).norm() < 1e-15);
    }
  }

  void directionsAreNormalised() {
    const auto model = build(R"({"schema_version": 1, "dimension": 2,
      "geometry": [{"name": "p", "type": "points", "points": [[0, 0]]}],
      "point_masses": [{"name": "m", "at": {"nodes": [0]}, "mass": 1}],
      "springs": [{"name": "s", "type": "grounded", "at": {"nodes": [0]}, "direction": [3, 4], "coefficients": [50]}],
      "loads": [{"name": "f", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [0, 7],
                 "harmonics": [{"amplitude": 2}]}]})");
    QCOMPARE(model->externalForce(0), Eigen::Vector2d(0, 2));
    // 0.1 m along x is an elongation of 0.06 m along (0.6, 0.8), a force of 3 N.
    const Vector gradient = mechanics::ElasticAssembler(model).gradient(Eigen::Vector2d(0.1, 0));
    QVERIFY((gradient - Eigen::Vector2d(1.8, 2.4)).norm() < 1e-14);
  }

  void springsWorkOnALine() {
    const auto model = build(R"({"schema_version": 1, "dimension": 1,
      "geometry": [{"name": "p", "type": "points", "points": [[0], [2]]}],
      "springs": [
        {"name": "a", "type": "grounded", "at": {"nodes": [0]}, "direction": [1], "coefficients": [1, 2, 3]},
        {"name": "b", "type": "between", "from": {"nodes": [0]}, "to": {"nodes": [1]}, "coefficients": [5]},
        {"name": "c", "type": "anchored", "at": {"nodes": [1]}, "anchor": [6], "rest_length": 3, "coefficients": [7]}]})");
    const double e = 0.25;
    const Vector gradient = mechanics::ElasticAssembler(model).gradient(Eigen::Vector2d(e, 2));
    QVERIFY(std::abs(gradient[0] - (e + 2 * e * e + 3 * e * e * e + 5 * e)) < 1e-14);
    QVERIFY(std::abs(gradient[1] - (-5 * e - 7 * (4 - 3))) < 1e-14);
    const auto& springs = model->parts[0].springs;
    QCOMPARE(springs.size(), 3u);
    for (const auto& [from, to] : springs) QCOMPARE(from.terms.size(), 1u);
    QVERIFY(springs[0][0].terms[0].node == 0 && springs[0][1].terms.empty() && springs[0][1].constant[0] == 0);
    QVERIFY(springs[1][0].terms[0].node == 0 && springs[1][1].terms[0].node == 1);
    QVERIFY(springs[2][0].terms[0].node == 1 && springs[2][1].terms.empty() && springs[2][1].constant[0] == 6);
  }

  void refuses_data() {
    QTest::addColumn<QString>("replace");
    QTest::addColumn<QString>("by");
    QTest::addColumn<QString>("pointer");
    const auto row = [](const char* name, const char* replace, const char* by, const char* pointer) {
      QTest::newRow(name) << replace << by << pointer;
    };
    row("unknown group", "\"group\": \"end\"", "\"group\": \"ende\"", "/point_masses/0/at/group");
    row("unknown node", "\"nodes\": [3]", "\"nodes\": [15]", "/springs/0/from/nodes/0");
    row("box outside", "\"group\": \"end\"", "\"box\": {\"minimum\": [5, 5, 5], \"maximum\": [6, 6, 6]}",
        "/point_masses/0/at/box");
    row("two nodes for one", "\"nodes\": [3]", "\"nodes\": [3, 4]", "/springs/0/from");
    row("driven and locked", "\"at\": {\"geometry\": \"hooks\", \"nodes\": [0]}, \"coordinates\"",
        "\"at\": {\"geometry\": \"sheet\", \"group\": \"start\"}, \"coordinates\"", "/drives/0/at");
    row("element without triangles", "\"shell\", \"geometry\": \"sheet\"", "\"shell\", \"geometry\": \"hooks\"",
        "/elements/0/geometry");
    row("node that nothing holds", "\"points\": [[0, 0, 0.3]", "\"points\": [[0, 0, 7], [0, 0, 0.3]", "/geometry/1");
    row("no triangles", "\"type\": \"points\", \"points\"", "\"type\": \"mesh\", \"triangles\": [], \"points\"",
        "/geometry/1");
    row("node of a triangle", "\"type\": \"points\", \"points\"",
        "\"type\": \"mesh\", \"triangles\": [[0, 1, 2]], \"points\"", "/geometry/1/triangles/0/2");
    row("degenerate triangle", "\"type\": \"points\", \"points\"",
        "\"type\": \"mesh\", \"triangles\": [[0, 1, 1]], \"points\"", "/geometry/1");
    row("missing file", "\"type\": \"points\", \"points\": [[0, 0, 0.3], [\"1 mm\", 0, 0.4]]",
        "\"type\": \"file\", \"path\": \"nothing.stl\"", "/geometry/1/path");
  }
  void refuses() {
    QFETCH(QString, replace);
    QFETCH(QString, by);
    QFETCH(QString, pointer);
    QString text = QString::fromStdString(test::fullScene);
    const auto place = text.indexOf(replace);
    QVERIFY(place >= 0);
    text.replace(place, replace.size(), by);
    const scene::Scene scene = test::parse(text.toStdString());
    try {
      scene::buildModel(scene);
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QVERIFY2(QString::fromStdString(error.location()) == "test.json: " + pointer, error.what());
      QVERIFY2(!QString(error.what()).contains('\n') && QString(error.what()).endsWith('.'), error.what());
    }
  }

  void readsMeshFilesBesideTheScene() {
    const QTemporaryDir folder;
    const std::filesystem::path directory = folder.path().toStdString();
    scene::writeTextFile(directory / "square.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3\nf 1 3 4\n");
    const auto scene = scene::Scene::parse(R"({"schema_version": 1,
      "geometry": [{"name": "m", "type": "file", "path": "square.obj", "scale": 1e-3}],
      "materials": [{"name": "a", "density": 1000, "young_modulus": 1e9, "poisson_ratio": 0.3}],
      "elements": [{"name": "e", "type": "membrane", "thickness": "1 mm"}]})",
                                           directory, "test.json");
    const auto model = scene::buildModel(scene);
    QCOMPARE(model->nodeCount(), 4);
    QVERIFY(std::abs(model->massMatrix().sum() / 3 - 1e-4) < 1e-15);
    const geometry::SurfaceMesh surface = scene::surfaceAt(*model, model->restPositions);
    QCOMPARE(surface.triangles.size(), 2u);
    QVERIFY(std::abs(surface.points.maxCoeff() - 0.01) < 1e-15);
  }
};

QTEST_GUILESS_MAIN(TestModelBuilder)
#include "test_model_builder.moc"
