#include <QTest>
#include <algorithm>
#include <filesystem>

#include "core/scene/cloth_result.hpp"
#include "core/scene/expected_values.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"
#include "tests/core/geometry/brute_force_intersections.hpp"

using namespace pliant;
namespace fs = std::filesystem;

namespace {

/// Of the folder that the test is to look at, or of all.
std::vector<fs::path> sceneFiles() {
  fs::path folder = PLIANT_SOURCE_DIR "/scenes";
  if (const std::string part = qEnvironmentVariable("PLIANT_TEST_PART", "all").toStdString(); part != "all")
    folder /= part;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Looks at every frame of a cloth that must not go through itself or a body.
void requireNoIntersection(const scene::ClothResult& result) {
  const cloth::ClothProblem& problem = *result.problem;
  if (!problem.selfContact) return;
  std::vector<std::array<int, 3>> sheet;
  for (const cloth::SheetTriangle& triangle : problem.sheet.triangles) sheet.push_back(triangle.nodes);
  for (const auto& frame : result.frames) {
    const Eigen::Index nodes = frame->positions.cols();
    Eigen::Matrix3Xd all(3, nodes + frame->bodyPoints.cols());
    all << frame->positions, frame->bodyPoints;
    std::vector<std::array<int, 3>> triangles = sheet;
    int first = static_cast<int>(nodes);
    for (const cloth::Body& body : problem.bodies) {
      for (const auto& [a, b, c] : body.triangles) triangles.push_back({first + a, first + b, first + c});
      QVERIFY(body.edges.empty());  // nothing here looks at capsules
      if (body.triangles.empty())
        for (Eigen::Index point = 0; point < body.points.cols(); ++point)
          QVERIFY(distanceByBruteForce(frame->positions, sheet, all.col(first + point)) > body.radius);
      first += static_cast<int>(body.points.cols());
    }
    QCOMPARE(countIntersectionsByBruteForce(all, triangles), 0);
  }
}

}  // namespace

/// Every scene that is shipped does what it promises. The expected values of a scene come from a closed form or from
/// more harmonics and samples than the scene itself uses.
class TestShippedScenes : public QObject {
  Q_OBJECT

 private slots:
  void studiesGiveTheExpectedValues_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("study");
    for (const fs::path& file : sceneFiles())
      for (const std::string& study : scene::studyNames(scene::Scene::load(file)))
        QTest::addRow("%s %s", file.filename().c_str(), study.c_str())
            << QString::fromStdString(file.string()) << QString::fromStdString(study);
  }

  void studiesGiveTheExpectedValues() {
    QFETCH(QString, file);
    QFETCH(QString, study);
    const scene::Scene scene = scene::Scene::load(file.toStdString());
    const std::string name = study.toStdString();
    base::ExecutionContext context;
    const auto result = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), name)->run(context);
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    if (const auto* motion = dynamic_cast<const scene::ClothResult*>(result.get())) {
      requireNoIntersection(*motion);
      if (QTest::currentTestFailed()) return;
    }
    const auto values = scene::compareWithExpected(scene, name, result->summary());
    QVERIFY(!values.empty());
    for (const scene::ExpectedValue& value : values)
      QVERIFY2(value.holds(), qPrintable(QString("%1 is %2, expected %3")
                                             .arg(QString::fromStdString(value.pointer))
                                             .arg(value.found, 0, 'g', 12)
                                             .arg(value.expected, 0, 'g', 12)));
  }
};

QTEST_GUILESS_MAIN(TestShippedScenes)
#include "test_shipped_scenes.moc"
