#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/parts_export.hpp"

using namespace pliant;
using geometry::SurfaceMesh;
using std::numbers::pi;

namespace {

constexpr const char* material =
    R"("materials": [{"name": "m", "density": 1000, "young_modulus": 1e9, "poisson_ratio": 0.3}],)";

/// A square of 40 mm in two triangles, and beside it one of a single triangle.
std::string shellScene(const std::string& elements) {
  return std::string(R"({"schema_version": 1, "geometry": [
    {"name": "square", "type": "mesh", "points": [[0,0,0], [0.04,0,0], [0.04,0.04,0], [0,0.04,0]],
     "triangles": [[0,1,2], [0,2,3]]},
    {"name": "corner", "type": "mesh", "points": [[0.1,0,0], [0.14,0,0], [0.1,0.04,0]], "triangles": [[0,1,2]]}],)") +
         material +
         R"("boundary_conditions": [{"name": "held", "type": "locked", "at": {"nodes": [0, 1, 2], "geometry": "corner"}}],
    "elements": [)" +
         elements + "]}";
}

/// Three links in a row along x, of 60, 40 and 30 mm, and a spring from the first to the third.
constexpr const char* chain = R"({"schema_version": 1, "dimension": 2,
  "geometry": [{"name": "joints", "type": "points", "points": [[0,0], [0.06,0], [0.1,0], [0.13,0]]}],
  "elements": [{"name": "a", "type": "link", "joints": [0,1], "mass": 0.01},
               {"name": "b", "type": "link", "joints": [1,2], "mass": 0.01},
               {"name": "c", "type": "link", "joints": [2,3], "mass": 0.01}MORE],
  "springs": [{"name": "s", "type": "local", "coefficients": [10],
               "from": {"type": "link", "link": "a", "along": 0.03, "across": 0.02},
               "to": {"type": "link", "link": "c", "along": 0.015}}]})";

std::string chainWith(const std::string& more) {
  return QString(chain).replace("MORE", QString::fromStdString(more)).toStdString();
}

/// A wire of 30 mm whose end bears a mass.
std::string wireScene(const std::string& element) {
  return std::string(R"({"schema_version": 1, "geometry": [{"name": "w", "type": "mesh",
    "points": [[0,0,0], [0.01,0,0], [0.03,0,0]], "segments": [[0,1], [1,2]]}],)") +
         material + R"("elements": [)" + element + R"(],
    "point_masses": [{"name": "end", "at": {"nodes": [2]}, "mass": "2 g"}]})";
}

struct Made {
  std::vector<scene::Part> parts;
  std::vector<std::string> remarks;
};

Made make(const std::string& text, const scene::PartsRequest& request = {},
          std::vector<mechanics::Vector> motion = {}) {
  const auto scene = scene::Scene::parse(text, ".", "made.json");
  const auto model = scene::buildModel(scene);
  base::ExecutionContext context;
  Made made;
  made.parts = makeParts({scene, *model, model->restPositions, std::move(motion)}, request, context, made.remarks);
  return made;
}

QString errorOf(const std::string& text, const scene::PartsRequest& request = {}) {
  try {
    make(text, request);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

int genusOf(const SurfaceMesh& mesh) {
  return 1 - (static_cast<int>(mesh.points.cols()) - static_cast<int>(mesh.triangles.size() / 2)) / 2;
}

bool near(double value, double expected, double tolerance) { return std::abs(value - expected) < tolerance; }

/// Of a link with a hole at either end.
double linkArea(double length) { return length * 10e-3 + pi / 4 * (10e-3 * 10e-3 - 2 * 3e-3 * 3e-3); }

}  // namespace

class TestPartsExport : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

 private slots:
  void shells() {
    const Made made = make(shellScene(R"(
      {"name": "skin", "type": "shell", "geometry": "square", "thickness": "2 mm", "thickness_factors": [1, 1]},
      {"name": "lining", "type": "membrane", "geometry": "square", "thickness": "1 mm"},
      {"name": "stiffening", "type": "bending", "geometry": "square", "thickness": "5 mm"},
      {"name": "leaf", "type": "bending", "geometry": "corner", "thickness": "0.5 mm"})"));
    QCOMPARE(made.parts.size(), std::size_t(2));
    QCOMPARE(made.parts[0].name, std::string("skin"));
    QCOMPARE(made.parts[1].name, std::string("leaf"));
    QVERIFY(near(enclosedVolume(made.parts[0].mesh), 0.04 * 0.04 * 0.003, 1e-18));
    QVERIFY(near(enclosedVolume(made.parts[1].mesh), 0.5 * 0.04 * 0.04 * 0.0005, 1e-18));
  }

  /// Half of the square twice as thick: along the diagonal it has the mean.
  void thicknessFactors() {
    const Made made = make(shellScene(
        R"({"name": "skin", "type": "shell", "geometry": "square", "thickness": "2 mm", "thickness_factors": [1, 2]},
           {"name": "leaf", "type": "shell", "geometry": "corner", "thickness": "2 mm"})"));
    // A prism over a triangle with a linear thickness: area times the mean of its corners'. The right angles' corners
    // have 2 and 4 mm, those of the diagonal 3 mm.
    const double half = 0.5 * 0.04 * 0.04, volume = half * (2e-3 + 3e-3 + 3e-3) / 3 + half * (4e-3 + 3e-3 + 3e-3) / 3;
    QVERIFY(near(enclosedVolume(made.parts[0].mesh), volume, 1e-15));
  }

  /// An L of two blocks that touch, and a third one apart.
  void solids() {
    const Made made = make(std::string(R"({"schema_version": 1, "geometry": [{"name": "g", "type": "blocks",
      "cell": ["10 mm", "10 mm", "10 mm"], "blocks": [
        {"name": "foot", "minimum": [0,0,0], "maximum": [0.04,0.02,0.02]}, {"name": "leg", "minimum": [0,0.02,0], "maximum": [0.02,0.06,0.02]},
        {"name": "apart", "minimum": [0.06,0,0], "maximum": [0.08,0.02,0.02]}]}],)") +
                           material + R"("elements": [{"name": "body", "type": "solid"}]})");
    QCOMPARE(made.parts.size(), std::size_t(2));
    QVERIFY(near(enclosedVolume(made.parts[0].mesh), 0.04 * 0.02 * 0.02 + 0.02 * 0.04 * 0.02, 1e-17));
    QVERIFY(near(enclosedVolume(made.parts[1].mesh), 8e-6, 1e-17));
    QCOMPARE(genusOf(made.parts[0].mesh), 0);
  }

  /// Plates in layers: the middle link must lie in another one than its neighbours. Their volumes are those of links,
  /// less the spring's hole, and of the first one's arm, which begins at the link's middle and ends in half a disc.
  void links() {
    scene::PartsRequest request;
    request.tolerance = 1e-6;
    const Made made = make(chainWith(""), request);
    QCOMPARE(made.parts.size(), std::size_t(3));
    const double thickness = 3e-3, springHole = pi / 4 * 2e-3 * 2e-3;
    const double arm = (20e-3 - 5e-3) * 10e-3 + pi / 8 * 10e-3 * 10e-3;
    const double areas[] = {linkArea(0.06) + arm - springHole, linkArea(0.04), linkArea(0.03) - springHole};
    const int holes[] = {3, 2, 3};
    for (int i = 0; i < 3; ++i) {
      QVERIFY(near(enclosedVolume(made.parts[i].mesh), areas[i] * thickness, 1e-6 * 0.3 * thickness));
      QCOMPARE(genusOf(made.parts[i].mesh), holes[i]);
    }
    const auto bottomOf = [&](int i) { return made.parts[i].mesh.points.row(2).minCoeff(); };
    QCOMPARE(bottomOf(0), bottomOf(2));
    QVERIFY(near(std::abs(bottomOf(1) - bottomOf(0)), 3.2e-3, 1e-12));
    QCOMPARE(made.remarks.front(), std::string("3 plates in 2 layers; they do not meet at rest."));
  }

  /// Bent double by the motion, the third link comes upon the first.
  void layersKnowTheMotion() {
    mechanics::Vector straight(8), folded(8);
    straight << 0, 0, 0.06, 0, 0.1, 0, 0.13, 0;
    folded << 0, 0, 0.06, 0, 0.06, 0.04, 0.06, 0.01;
    const Made made = make(chainWith(""), {}, {straight, folded});
    QCOMPARE(made.remarks.front(), std::string("3 plates in 3 layers; they do not meet at 2 times of the motion."));
  }

  /// Welded links are one plate without a hole where they meet; side by side nothing overlaps.
  void weldedAndFlat() {
    scene::PartsRequest request;
    request.flat = true;
    request.tolerance = 1e-6;
    const Made made = make(chainWith(R"(, {"name": "w", "type": "rigid_angle", "joints": [0, 1, 2]})"), request);
    QCOMPARE(made.parts.size(), std::size_t(2));
    QCOMPARE(made.parts[0].name, std::string("a, b"));
    QCOMPARE(genusOf(made.parts[0].mesh), 3);  // both ends and the spring's
    for (const scene::Part& part : made.parts) {
      QVERIFY(near(part.mesh.points.row(2).minCoeff(), 0, 1e-15));
      QVERIFY(near(part.mesh.points.row(2).maxCoeff(), 3e-3, 1e-15));
    }
    const auto boxOf = [&](int i) {
      const SurfaceMesh& mesh = made.parts[i].mesh;
      return std::pair<Eigen::Vector3d, Eigen::Vector3d>(
          mesh.points.rowwise().minCoeff(), mesh.points.rowwise().maxCoeff());
    };
    const auto [low, high] = boxOf(0);
    const auto [otherLow, otherHigh] = boxOf(1);
    bool apart = false;
    for (int axis = 0; axis < 2; ++axis)
      apart = apart || otherLow[axis] - high[axis] > 4.9e-3 || low[axis] - otherHigh[axis] > 4.9e-3;
    QVERIFY(apart);
  }

  /// The ball of 2 g of brass has a diameter of 7.66 mm.
  void rodsWithSockets() {
    scene::PartsRequest request;
    request.tolerance = 5e-5;
    const Made made = make(wireScene(R"({"name": "wire", "type": "rod", "diameter": "2 mm"})"), request);
    QCOMPARE(made.parts.size(), std::size_t(1));
    QCOMPARE(genusOf(made.parts[0].mesh), 0);
    const double radius = 0.5 * std::cbrt(6 * 2e-3 / (pi * 8500));
    const auto& points = made.parts[0].mesh.points;
    const double inside = (points.colwise() - Eigen::Vector3d(0.03, 0, 0)).colwise().norm().minCoeff();
    QVERIFY(near(inside, radius + 0.2e-3, 5e-5));
    QVERIFY(near(points.row(0).minCoeff(), -1e-3, 5e-5));
    // It opens away from the wire.
    QVERIFY(near(points.row(0).maxCoeff(), 0.03 + (radius + 0.7e-3) * std::cos(70 * pi / 180) + 0.5e-3, 5e-5));
    QCOMPARE(made.remarks, std::vector<std::string>{"wire has 1 socket for a ball."});
    // What is hardly thicker than the wire has none.
    const Made thick = make(wireScene(R"({"name": "wire", "type": "rod", "diameter": "7 mm"})"), request);
    QVERIFY(thick.remarks.front().find("has no socket") != std::string::npos);
    const Made tube =
        make(wireScene(R"({"name": "wire", "type": "rod", "diameter": "7 mm", "inner_diameter": "3 mm"})"), request);
    QVERIFY(tube.remarks.front().find("are made solid") != std::string::npos);
  }

  /// Every format is read back by assimp: closed, of the same volume, in the right units, where coordinates are
  /// positive.
  void readBack_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<double>("scale");
    QTest::newRow("stl") << "a.stl" << 1e-3;
    QTest::newRow("obj") << "a.obj" << 1.0;
    QTest::newRow("ply") << "a.ply" << 1.0;
    QTest::newRow("gltf") << "a.gltf" << 1.0;
    QTest::newRow("glb") << "a.glb" << 1.0;
  }
  void readBack() {
    QFETCH(QString, name);
    QFETCH(double, scale);
    const auto scene = scene::Scene::parse(chainWith(""), ".", "made.json");
    const auto model = scene::buildModel(scene);
    base::ExecutionContext context;
    const std::string file = folder_.filePath(name).toStdString();
    const auto report = *pliant::scene::exportParts({scene, *model, model->restPositions, {}}, {}, file, context);
    QCOMPARE(report.parts.size(), std::size_t(3));
    const SurfaceMesh read = geometry::weldMesh(geometry::readMesh(file, scale), 1e-8);
    checkClosed(read);
    double volume = 0;
    for (const auto& part : report.parts) volume += part.volume;
    QVERIFY(near(enclosedVolume(read) / volume, 1, 1e-5));
    QVERIFY(read.points.minCoeff() > -1e-9);
    QVERIFY((read.points.rowwise().maxCoeff() - report.size).norm() < 1e-7);
  }

  void cancelled() {
    const auto scene =
        scene::Scene::parse(wireScene(R"({"name": "wire", "type": "rod", "diameter": "2 mm"})"), ".", "made.json");
    const auto model = scene::buildModel(scene);
    base::ExecutionContext context;
    context.requestCancel();
    const std::string file = folder_.filePath("cancelled.stl").toStdString();
    QVERIFY(!pliant::scene::exportParts({scene, *model, model->restPositions, {}}, {}, file, context));
    QVERIFY(!std::filesystem::exists(file));
  }

  void refusals() {
    QVERIFY(
        errorOf(R"({"schema_version": 1, "dimension": 1, "geometry": [{"name": "g", "type": "points", "points": [[0]]}],
      "point_masses": [{"name": "m", "at": {"nodes": [0]}, "mass": 1}]})")
            .contains("no shells, solids, links or rods"));
    scene::PartsRequest request;
    request.springHole = 20e-3;
    QVERIFY(errorOf(chainWith(""), request).startsWith("spring-hole: A hole of 20.00 mm"));
    request = {};
    request.tolerance = 0;
    QVERIFY(errorOf(chainWith(""), request).startsWith("tolerance: "));
    // The spring's hole is beside the joint's.
    const std::string beside = QString(chain).replace("MORE", "").replace("0.015", "0.002").toStdString();
    QVERIFY(errorOf(beside).contains("Two of its holes run into each other"));
    QVERIFY(errorOf(R"({"schema_version": 1, "geometry": [{"name": "g", "type": "points",
      "points": [[0,0,0], [0.1,0,0]]}], "elements": [{"name": "bar", "type": "link", "joints": [0,1], "mass": 1}]})")
                .contains("2 dimensions"));
    // Three sheets at one edge.
    QVERIFY(errorOf(std::string(R"({"schema_version": 1, "geometry": [{"name": "g", "type": "mesh", "points":
      [[0,0,0], [1,0,0], [0,1,0], [0,-1,0]], "triangles": [[0,1,2], [1,0,3]]},
      {"name": "fin", "type": "mesh", "points": [[0,0,0], [1,0,0], [0,0,1]], "triangles": [[0,1,2]]}],
      "seams": [{"name": "s", "edges": [{"geometry": "g", "nodes": [0,1]}, {"geometry": "fin", "nodes": [0,1]}]}],)") +
                    material + R"("elements": [{"name": "x", "type": "membrane", "geometry": "g", "thickness": 0.01},
      {"name": "y", "type": "membrane", "geometry": "fin", "thickness": 0.01}]})") != QString());
  }
};

QTEST_GUILESS_MAIN(TestPartsExport)
#include "test_parts_export.moc"
