#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/patch_export.hpp"

using namespace pliant;

namespace {

constexpr const char* netText = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "net", "type": "ring_net", "ring_radius": "4 mm", "wire_radius": "0.6 mm",
                          "spacing": "12 mm"}],
  "studies": [
    {"name": "stretch", "type": "cell_test"},
    {"name": "travel", "type": "free_travel", "directions": 4}
  ]
})";

scene::Scene parsed(const std::string& text) { return scene::Scene::parse(text, ".", "net.json"); }

/// The connected parts of a mesh that was read, each closed.
std::vector<geometry::SurfaceMesh> bodiesIn(const geometry::SurfaceMesh& mesh) {
  std::vector<int> parent(mesh.points.cols());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& [a, b, c] : mesh.triangles) parent[root(b)] = root(a), parent[root(c)] = root(a);
  std::map<int, geometry::SurfaceMesh> bodies;
  for (const auto& triangle : mesh.triangles) bodies[root(triangle[0])].triangles.push_back(triangle);
  std::vector<geometry::SurfaceMesh> result;
  for (auto& [node, body] : bodies) {
    body.points = mesh.points;
    result.push_back(body);
  }
  return result;
}

}  // namespace

class TestPatchExport : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::string file(const char* name) const { return folder_.filePath(name).toStdString(); }

  scene::PatchReport exported(const scene::PatchRequest& request, const char* name) const {
    base::ExecutionContext context;
    return scene::exportPatch(parsed(netText), request, file(name), context);
  }

  QString errorOf(const scene::PatchRequest& request) const {
    try {
      exported(request, "bad.stl");
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  }

 private slots:
  /// The file holds as many closed bodies as there are rings, of a ring's volume each.
  void readBack() {
    scene::PatchRequest request;
    request.outline = "3x2";
    request.tolerance = 4e-5;
    const scene::PatchReport report = exported(request, "patch.stl");
    QCOMPARE(report.elements, 18);
    QCOMPARE(report.leftOut, 0);
    QVERIFY(std::abs(report.clearance - 0.8e-3) < 1e-9);
    const geometry::SurfaceMesh read = geometry::weldMesh(geometry::readMesh(file("patch.stl"), 1e-3), 0);
    QCOMPARE(static_cast<long>(read.triangles.size()), report.triangles);
    const auto bodies = bodiesIn(read);
    QCOMPARE(bodies.size(), std::size_t(18));
    const double volume = 2 * std::numbers::pi * std::numbers::pi * 4e-3 * 0.36e-6;
    const double area = 4 * std::numbers::pi * std::numbers::pi * 4e-3 * 0.6e-3;
    double sum = 0;
    for (const geometry::SurfaceMesh& body : bodies) {
      geometry::checkClosed(body);
      QVERIFY(std::abs(enclosedVolume(body) - volume) < request.tolerance * area);
      sum += enclosedVolume(body);
    }
    QVERIFY(std::abs(sum - report.volume) < 1e-5 * sum);
    // Three cells of 12 mm, and what rings of 9.2 mm stand out at both ends: half a flat one, half an upright one.
    QVERIFY(read.points.rowwise().minCoeff().norm() < 1e-8);
    QVERIFY((read.points.rowwise().maxCoeff() - report.size).norm() < 1e-7);
    QVERIFY(std::abs(report.size[0] - (2 * 12 + 6 + 9.2) * 1e-3) < 2 * request.tolerance);
    QVERIFY(std::abs(report.size[2] - 9.2e-3) < 2 * request.tolerance);
  }

  /// Every format holds the same patch.
  void formats() {
    scene::PatchRequest request;
    request.outline = "1x1";
    request.tolerance = 1e-4;
    const scene::PatchReport report = exported(request, "patch.3mf");
    QVERIFY(QFile(folder_.filePath("patch.3mf")).size() > 10'000);
    for (const char* name : {"patch.ply", "patch.obj", "patch.glb"}) {
      exported(request, name);
      const auto read = geometry::weldMesh(geometry::readMesh(file(name), 1), 0);
      QCOMPARE(bodiesIn(read).size(), std::size_t(3));
      QVERIFY(std::abs(enclosedVolume(read) - report.volume) < 1e-5 * report.volume);
    }
  }

  /// Stretched along x until rings are taut: a cell is 4 (R - r) long, and rings touch to the gap.
  void limitState() {
    scene::PatchRequest request;
    request.outline = "2x1";
    request.study = "stretch";
    request.tolerance = 1e-4;
    const scene::PatchReport report = exported(request, "taut.stl");
    QCOMPARE(report.elements, 6);
    QVERIFY(report.clearance > 0 && report.clearance < 2e-4 * 0.6e-3);
    // Two cells from the middle of a flat ring on: another half one before, and less than a whole one behind.
    QVERIFY(std::abs(report.size[0] - (13.6 + 6.8 + 9.2) * 1e-3) < 3e-4);
  }

  void polygons() {
    scene::writeTextFile(file("outline.csv"), "x [mm],y [cm]\n0,0\n100,0\n0,10\n");
    scene::PatchRequest request;
    request.outline = file("outline.csv");
    request.tolerance = 1e-4;
    const int elements = exported(request, "triangle.stl").elements;
    // Half of a square of 100 mm, with three rings in each 144 mm²; one row more or less at the rim.
    QVERIFY2(std::abs(elements - 5000 / 144.0 * 3) < 20, qPrintable(QString::number(elements)));
    request.outline = "50 mm";
    const int inCircle = exported(request, "circle.stl").elements;
    int expected = 0;
    for (int i = -9; i <= 9; ++i)
      for (int j = -9; j <= 9; ++j) {
        expected += std::hypot(12 * i, 12 * j) < 25;
        expected += std::hypot(12 * i + 6, 12 * j) < 25;
        expected += std::hypot(12 * i, 12 * j + 6) < 25;
      }
    QCOMPARE(inCircle, expected);
  }

  void badInput_data() {
    QTest::addColumn<QString>("outline");
    QTest::addColumn<QString>("error");
    scene::writeTextFile(file("unitless.csv"), "x,y\n0,0\n1,0\n0,1\n");
    scene::writeTextFile(file("single.csv"), "x [mm]\n0\n1\n2\n");
    scene::writeTextFile(file("words.csv"), "x [mm],y [mm]\n0,0\n1,a\n0,1\n");
    const auto row = [](const std::string& outline, const char* error) {
      QTest::addRow("%s", outline.c_str()) << QString::fromStdString(outline) << error;
    };
    row("0x4", "--patch \"0x4\": A patch needs at least one cell");
    row("wide", "--patch \"wide\"");
    row("60 mm x", "--patch \"60 mm x\"");
    row("-60 mm x 20 mm", "must be above 0");
    row("60 kg", "--patch \"60 kg\"");
    row("1 mm", "Elements");
    row(file("nothing.csv"), "nothing.csv");
    row(file("unitless.csv"), "names no unit");
    row(file("single.csv"), "needs two columns");
    row(file("words.csv"), "words.csv");
  }
  void badInput() {
    QFETCH(QString, outline);
    QFETCH(QString, error);
    scene::PatchRequest request;
    request.outline = outline.toStdString();
    request.tolerance = 1e-4;
    if (outline == "1 mm") request.minimumClearance = 1e-3;
    const QString found = errorOf(request);
    QVERIFY2(found.contains(error), qPrintable(found));
    QVERIFY(!found.contains('\n'));
    QVERIFY(!QFile::exists(folder_.filePath("bad.stl")));
  }

  void badRequests() {
    scene::PatchRequest request;
    request.minimumClearance = 0.9e-3;
    QVERIFY(errorOf(request).contains("net.json: Elements are 800.0 µm apart, but at least 900.0 µm are asked for."));
    request = {};
    request.study = "travel";
    QVERIFY(errorOf(request).contains("only a \"cell_test\" has one limit state"));
    request.study = "strech";
    QVERIFY(errorOf(request).contains("There is no study named \"strech\"."));
    request = {};
    request.cell = "nets";
    QVERIFY(errorOf(request).contains("There is no material named \"nets\"."));
  }
};

QTEST_GUILESS_MAIN(TestPatchExport)
#include "test_patch_export.moc"
