#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <functional>

#include "core/base/error.hpp"
#include "core/interlock/cell_surface.hpp"
#include "core/interlock/element_body.hpp"
#include "core/scene/interlock_builder.hpp"
#include "core/scene/interlock_result.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"
#include "tests/core/interlock/torus_mesh.hpp"

using namespace pliant;
using Eigen::Vector3d;
using scene::Json;

namespace {

constexpr double ringRadius = 4, wireRadius = 0.6;  // mm, as in the files

/// As text, so that what is wrong with a mesh gets through.
void writeObj(const geometry::SurfaceMesh& mesh, const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    file.write(qPrintable(QString("v %1 %2 %3\n")
                              .arg(mesh.points(0, i), 0, 'g', 9)
                              .arg(mesh.points(1, i), 0, 'g', 9)
                              .arg(mesh.points(2, i), 0, 'g', 9)));
  for (const auto& [a, b, c] : mesh.triangles)
    file.write(qPrintable(QString("f %1 %2 %3\n").arg(a + 1).arg(b + 1).arg(c + 1)));
}

/// A chain of rings read from ring.obj, flat and upright in turn.
Json chain() {
  const Json piece = {{"type", "mesh"}, {"file", "ring.obj"}, {"scale", 1e-3}};
  const Json upright = {
      {"shape", "ring"}, {"position", {"6 mm", 0, 0}}, {"rotation", {{"axis", {1, 0, 0}}, {"angle", "90 deg"}}}};
  const Json cell = {
      {"name", "chain"},
      {"type", "composed"},
      {"lattice", {{"12 mm", 0}, {0, "20 mm"}}},
      {"shapes", Json::array({{{"name", "ring"}, {"pieces", Json::array({piece})}}})},
      {"elements", Json::array({{{"shape", "ring"}}, upright})},
      {"links", Json::array({{{"a", 0}, {"b", 1}, {"number", -1}}, {{"a", 0}, {"b", 1}, {"shift", {-1, 0}}}})}};
  return {{"schema_version", 1},
          {"interlocking_cells", Json::array({cell})},
          {"studies", Json::array({{{"name", "x"}, {"type", "cell_test"}, {"lateral", "held"}}})}};
}

}  // namespace

class TestMeshScenes : public QObject {
  Q_OBJECT

 private slots:
  void init() { writeObj(torusMesh(ringRadius, wireRadius, 24, 8), file()); }

  /// A chain whose corners are those of circular rings: as long as that of circles, and drawn and printed as it is.
  void chainFromFile() {
    const scene::Scene scene = parsed(chain());
    base::ExecutionContext context;
    const auto result = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "x")->run(context);
    const Json summary = result->summary();
    QCOMPARE(summary["rest"].get<std::string>(), std::string("locked"));
    const double exact = 4 * (ringRadius - wireRadius) / 12 - 1, strain = summary["strain"];
    QVERIFY2(strain < exact && exact - strain < 2e-5, qPrintable(QString::number(strain - exact)));

    const interlock::UnitCell cell = scene::buildCell(scene, "chain");
    const auto drawn = interlock::cellSurface(cell, interlock::restState(cell), 1, 1);
    QCOMPARE(drawn.triangles.size(), std::size_t{2 * 2 * 24 * 8});
    const auto printed = interlock::ElementBody(cell.shapes[0]).mesh(1e-5);
    QCOMPARE(printed.mesh.triangles.size(), std::size_t{2 * 24 * 8});
  }

  /// Limits with friction stop short of those without.
  void friction() {
    Json text = chain();
    text["studies"][0]["friction"] = 0.2;
    const scene::Scene scene = parsed(text);
    base::ExecutionContext context;
    const auto result = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "x")->run(context);
    const Json summary = result->summary();
    QCOMPARE(summary["friction"].get<double>(), 0.2);
    QCOMPARE(summary["termination"].get<std::string>(), std::string("converged"));
    QVERIFY(summary["strain"].get<double>() < 4 * (ringRadius - wireRadius) / 12 - 1);
    QVERIFY(summary["strain"].get<double>() > 0.1);
  }

  void badInput_data() {
    QTest::addColumn<std::function<void(Json&, geometry::SurfaceMesh&)>>("spoil");
    QTest::addColumn<QString>("error");
    const auto row = [](const char* error, std::function<void(Json&, geometry::SurfaceMesh&)> spoil) {
      QTest::addRow("%s", error) << std::move(spoil) << QString(error);
    };
    using Mesh = geometry::SurfaceMesh;
    const auto piece = [](Json& scene) -> Json& { return scene["interlocking_cells"][0]["shapes"][0]["pieces"][0]; };
    row("/pieces/0/file: The surface is open at the edge between points",
        [](Json&, Mesh& mesh) { mesh.triangles.pop_back(); });
    row("/pieces/0/file: The triangles of the mesh face inwards", [](Json&, Mesh& mesh) {
      for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
    });
    row("Triangle 1 has no area: its corners are points", [](Json&, Mesh& mesh) {
      mesh.points.col(0) = Vector3d(5, 0, 0);  // places that floats hold
      mesh.points.col(1) = Vector3d(5, 0, 0.25);
      mesh.points.col(9) = Vector3d(5, 0, 0.5);
    });
    row("The mesh runs into itself: the edge between points",
        [](Json&, Mesh& mesh) { mesh.points.col(3) += Vector3d(-9, 0, 0); });
    row("The mesh falls into 2 separate surfaces", [](Json&, Mesh& mesh) {
      const Mesh one = mesh;
      const int count = static_cast<int>(one.points.cols());
      mesh.points.resize(3, 2 * count);
      mesh.points << one.points, one.points.colwise() + Vector3d(0, 0, 5);
      for (const auto& [a, b, c] : one.triangles) mesh.triangles.push_back({a + count, b + count, c + count});
    });
    row("/pieces/0/file: ", [piece](Json& scene, Mesh&) { piece(scene)["file"] = "missing.obj"; });
    row("/pieces/0/radius: ", [piece](Json& scene, Mesh&) { piece(scene)["radius"] = "-1 mm"; });
    row("/shapes/0/contact_length: ",
        [](Json& scene, Mesh&) { scene["interlocking_cells"][0]["shapes"][0]["contact_length"] = 0; });
    row("are linked 0 times at rest, but declared are", [](Json& scene, Mesh&) {
      scene["interlocking_cells"][0]["lattice"][0][0] = "24 mm";
      scene["interlocking_cells"][0]["elements"][1]["position"][0] = "12 mm";
    });
    row("linked -1 times at rest, but this is not declared",
        [](Json& scene, Mesh&) { scene["interlocking_cells"][0]["links"].erase(0); });
    row("Handle 1 of piece 0 of element 0 and handle 0 of piece 0 of element 1",
        [](Json& scene, Mesh&) { scene["interlocking_cells"][0]["links"][0]["handle_a"] = 1; });
    row("overlap", [](Json& scene, Mesh&) { scene["interlocking_cells"][0]["elements"][1]["position"][0] = "8 mm"; });
  }

  void badInput() {
    QFETCH(std::function<void(Json&, geometry::SurfaceMesh&)>, spoil);
    QFETCH(QString, error);
    Json text = chain();
    geometry::SurfaceMesh mesh = torusMesh(ringRadius, wireRadius, 24, 8);
    spoil(text, mesh);
    writeObj(mesh, file());
    QString found;
    try {
      scene::buildCell(parsed(text), "chain");
    } catch (const base::InputError& thrown) {
      found = thrown.what();
    }
    QVERIFY2(found.contains(error), qPrintable(found));
    QVERIFY(!found.contains('\n'));
  }

 private:
  scene::Scene parsed(const Json& text) {
    return scene::Scene::parse(text.dump(), folder_.path().toStdString(), "chain.json");
  }
  QString file() const { return folder_.filePath("ring.obj"); }

  QTemporaryDir folder_;
};

QTEST_GUILESS_MAIN(TestMeshScenes)
#include "test_mesh_scenes.moc"
