#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/math/parallel.hpp"
#include "core/scene/bending_result.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/polar_curves.hpp"
#include "core/scene/study.hpp"

using namespace pliant;

namespace {

constexpr const char* sceneText = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "thick", "type": "threefold", "ring_radius": "5.2 mm", "wire_radius": "1.6 mm",
                          "distance": "5 mm", "lean": "50 deg", "spacing": "13.5 mm"},
                         {"name": "mail", "type": "four_in_one"}],
  "studies": [
    {"name": "bend", "type": "bending_test", "cell": "thick", "radius": "14 mm", "bend": "down", "trials": 1},
    {"name": "fold", "type": "bending_test", "cell": "mail", "radius": "11 mm", "trials": 1},
    {"name": "limits", "type": "curvature_limits", "cell": "thick", "radius": "14 mm", "directions": 2, "trials": 1},
    {"name": "size", "type": "bending_size", "cell": "thick", "radii": ["14 mm", "14.5 mm"], "trials": 1},
    {"name": "boundary", "type": "bending_boundary", "cell": "thick", "radius": "14 mm", "subdivisions": 0,
     "trials": 1, "test_star_shape": false},
    {"name": "hang", "type": "gravity_bending", "cell": "thick", "size": ["60 mm", "5 mm"]}
  ]
})";

std::shared_ptr<const scene::Result> resultOf(const std::string& text, const std::string& study) {
  const scene::Scene scene = scene::Scene::parse(text, ".", "thick.json");
  base::ExecutionContext context;
  return scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study)->run(context);
}

QString errorOf(const std::string& what, const std::string& with, const std::string& study) {
  std::string text = sceneText;
  const std::size_t place = text.find(what);
  if (place == std::string::npos) qFatal("nothing to replace");
  try {
    resultOf(text.replace(place, what.size(), with), study);
  } catch (const base::InputError& error) {
    return QString::fromStdString(error.location() + ": " + error.problem());
  }
  return {};
}

}  // namespace

class TestBendingScenes : public QObject {
  Q_OBJECT

 private slots:
  void limitAndFold() {
    const auto limit = resultOf(sceneText, "bend")->summary();
    QCOMPARE(limit["outcome"].get<std::string>(), std::string("locked"));
    QVERIFY(limit["curvature_limit"].get<double>() < 0);
    QCOMPARE(limit["elements"].get<int>(), 7);
    QVERIFY(limit["mean_gap"].get<double>() <= 1e-3 * 1.6e-3);
    QVERIFY(!limit.contains("warnings") || limit["warnings"].empty());
    // A fold gives no limit, and says so.
    const auto result = resultOf(sceneText, "fold");
    const auto fold = result->summary();
    QCOMPARE(fold["outcome"].get<std::string>(), std::string("folded"));
    QVERIFY(fold["curvature_limit"].is_null() && fold["orthogonal_curvature"].is_null());
    QCOMPARE(result->warnings().size(), std::size_t(1));
  }

  /// What is written says what the summary says; the surface is closed.
  void filesOfResults() {
    QTemporaryDir temporary;
    const std::filesystem::path folder = temporary.path().toStdString();
    for (const char* study : {"bend", "limits", "size", "boundary"}) resultOf(sceneText, study)->write(folder / study);
    const auto limits = scene::readCsv(scene::readTextFile(folder / "limits/curvature_limits.csv"));
    QCOMPARE(limits.size(), std::size_t(4));
    for (const auto& row : limits) {
      // k along x is k_xx in the first direction, k_yy in the second.
      const double along = scene::csvNumber(row[3]), xx = scene::csvNumber(row[5]), yy = scene::csvNumber(row[6]);
      QVERIFY(std::abs(along - (scene::csvNumber(row[0]) == 0 ? xx : yy)) < 1e-9 * std::abs(along));
      QVERIFY((row[1] == "up") == (along > 0));
    }
    QCOMPARE(scene::readCsv(scene::readTextFile(folder / "size/bending_size.csv")).size(), std::size_t(10));
    QCOMPARE(scene::readCsv(scene::readTextFile(folder / "boundary/boundary.csv")).size(), std::size_t(12));
    const geometry::SurfaceMesh mesh = geometry::readMesh(folder / "boundary/boundary.ply", 1);
    QCOMPARE(mesh.triangles.size(), std::size_t(20));
    for (const geometry::MeshEdge& edge : geometry::meshEdges(geometry::weldMesh(mesh, 1e-9).triangles))
      QVERIFY(edge.triangles[0] >= 0 && edge.triangles[1] >= 0);
    QVERIFY(std::filesystem::exists(folder / "bend/patch.ply") &&
            std::filesystem::exists(folder / "bend/elements.csv"));
  }

  /// Curves in all directions: up and down, along and across; a fold leaves a gap.
  void polarCurves() {
    auto result = std::make_shared<scene::CurvatureLimitsResult>(
        *std::dynamic_pointer_cast<const scene::CurvatureLimitsResult>(resultOf(sceneText, "limits")));
    result->directions[1].down.kind = interlock::BendingKind::folded;
    const scene::PolarCurves all = scene::curvatureLimitCurves(*result);
    QCOMPARE(all.unit, std::string("1/m"));
    QCOMPARE(all.curves.size(), std::size_t(4));
    for (std::size_t i = 0; i < 2; ++i) {
      const interlock::BendingLimits& limits = result->directions[i];
      for (const scene::PolarCurve& curve : all.curves) QCOMPARE(curve.angles[i], limits.up.angle);
      QCOMPARE(all.curves[0].values[i], limits.up.curvature);
      QCOMPARE(all.curves[1].values[i], limits.up.orthogonal);
      QVERIFY(i == 1 ? std::isnan(all.curves[2].values[i]) : all.curves[2].values[i] == -limits.down.curvature);
      QVERIFY(i == 1 ? std::isnan(all.curves[3].values[i]) : all.curves[3].values[i] == -limits.down.orthogonal);
    }
  }

  /// A strip that hangs from one side: what the clamped elements carry is the weight of the others.
  void weightIsCarried() {
    const auto result = std::dynamic_pointer_cast<const scene::GravityBendingResult>(resultOf(sceneText, "hang"));
    const auto summary = result->summary();
    QCOMPARE(summary["elements"].get<int>(), 5);
    QCOMPARE(summary["clamped"].get<int>(), 1);
    QVERIFY2(result->rest.converged(), result->rest.message.c_str());
    const double carried = 4.0 / 5 * result->weight;
    QVERIFY2((result->reaction - Eigen::Vector3d(0, 0, -carried)).norm() < 0.02 * carried,
             qPrintable(QString("%1 of %2").arg(result->reaction.z()).arg(carried)));
    QVERIFY(summary["tip_displacement"]["z"].get<double>() < 0);
  }

  void sameForAnyNumberOfThreads() {
    QTemporaryDir temporary;
    const std::filesystem::path folder = temporary.path().toStdString();
    for (const int threads : {1, 2}) {
      math::setThreadCount(threads);
      resultOf(sceneText, "limits")->write(folder / std::to_string(threads));
    }
    math::setThreadCount(0);
    QVERIFY(scene::readTextFile(folder / "1/curvature_limits.csv") ==
            scene::readTextFile(folder / "2/curvature_limits.csv"));
  }

  void badInput() {
    QVERIFY(errorOf(R"("radius": "14 mm", )", "", "bend").contains("/studies/0: Either \"radius\" or \"size\""));
    QVERIFY(errorOf(R"("radius": "14 mm", )", R"("radius": "1 mm", )", "bend").contains("needs two at least"));
    QVERIFY(errorOf(R"("radius": "14 mm", )", R"("radius": "20 m", )", "bend").contains("more than 4000"));
  }
};

QTEST_GUILESS_MAIN(TestBendingScenes)
#include "test_bending_scenes.moc"
