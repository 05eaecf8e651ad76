#include <QTest>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>

#include "core/cloth/cloth_contact.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/scene/cloth_result.hpp"
#include "core/scene/model_builder.hpp"
#include "tests/core/geometry/brute_force_intersections.hpp"

using namespace pliant;
using scene::ClothResult;
using scene::Scene;

namespace {

const std::filesystem::path scenes = PLIANT_SOURCE_DIR "/scenes";

/// An OBJ file, read line by line.
struct Garment {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pattern;
  std::vector<std::array<std::array<int, 3>, 2>> triangles;  ///< indices of points, and of the pattern's

  explicit Garment(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line, key;
    while (std::getline(stream, line)) {
      std::istringstream words(line);
      words >> key;
      if (key == "v") words >> points.emplace_back()[0] >> points.back()[1] >> points.back()[2];
      if (key == "vt") words >> pattern.emplace_back()[0] >> pattern.back()[1];
      if (key != "f") continue;
      auto& triangle = triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        char slash = 0;
        words >> triangle[0][i] >> slash >> triangle[1][i];
        --triangle[0][i], --triangle[1][i];
      }
    }
  }

  /// The model's node where a point starts.
  std::vector<int> nodesIn(const Eigen::Matrix3Xd& start) const {
    std::vector<int> nodes;
    for (const Eigen::Vector3d& point : points) {
      Eigen::Index node = 0;
      if (!((start.colwise() - point).colwise().norm().minCoeff(&node) < 1e-5)) return {};
      nodes.push_back(static_cast<int>(node));
    }
    return nodes;
  }

  /// By which part stretches may differ because meshes are read as floats: a coordinate below 2 m by half of 2⁻²³ m at
  /// most, and so a side of a triangle by √2 2⁻²³ m, which counts for most against the smallest height.
  double readingError() const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& triangle : triangles) {
      const auto& flat = triangle[1];
      double longest = 0;
      Eigen::Matrix2d sides;
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector2d side = pattern[flat[(i + 1) % 3]] - pattern[flat[i]];
        if (i < 2) sides.col(i) = side;
        longest = std::max(longest, side.norm());
      }
      smallest = std::min(smallest, std::abs(sides.determinant()) / longest);
    }
    return 2 * std::numbers::sqrt2 * std::exp2(-23) / smallest;  // two sides
  }

  /// The largest singular value of any triangle's map from the pattern to space.
  double largestStretch(const Eigen::Matrix3Xd& positions, const std::vector<int>& nodes) const {
    double largest = 0;
    for (const auto& [corners, flat] : triangles) {
      Eigen::Matrix<double, 3, 2> now;
      Eigen::Matrix2d rest;
      for (int i = 0; i < 2; ++i) {
        now.col(i) = positions.col(nodes[corners[i + 1]]) - positions.col(nodes[corners[0]]);
        rest.col(i) = pattern[flat[i + 1]] - pattern[flat[0]];
      }
      largest = std::max(largest, (now * rest.inverse()).jacobiSvd().singularValues()[0]);
    }
    return largest;
  }
};

}  // namespace

/// A garment from a file, whose pattern is its texture coordinates, around a dress form.
class TestGarment : public QObject {
  Q_OBJECT

 private slots:
  void theTunicIsSewnFromFlatPanels_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<int>("least");
    QTest::addRow("coarse") << "tunic_coarse.obj" << 1000;
    QTest::addRow("fine") << "tunic.obj" << 10'000;
  }
  void theTunicIsSewnFromFlatPanels() {
    QFETCH(QString, file);
    QFETCH(int, least);
    const Garment garment(scenes / "assets" / file.toStdString());
    QVERIFY(static_cast<int>(garment.triangles.size()) >= least);
    // One piece in space, with the openings of neck, arms and hem; two in the pattern.
    std::vector<std::array<int, 3>> inSpace, inPattern;
    for (const auto& [corners, flat] : garment.triangles) {
      inSpace.push_back(corners);
      inPattern.push_back(flat);
    }
    const auto euler = [](const std::vector<std::array<int, 3>>& triangles) {
      std::set<int> nodes;
      for (const auto& triangle : triangles) nodes.insert(triangle.begin(), triangle.end());
      return static_cast<long>(nodes.size() + triangles.size()) -
             static_cast<long>(geometry::meshEdges(triangles).size());
    };
    QCOMPARE(euler(inSpace), 2L - 4);
    QCOMPARE(euler(inPattern), 2L);
  }

  void nothingGoesThroughAnythingAndLimitsHold_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("mesh");
    QTest::addColumn<double>("duration");
    QTest::addRow("coarse") << "garment_coarse"
                            << "tunic_coarse.obj" << 0.16;
    QTest::addRow("fine") << "garment"
                          << "tunic.obj" << 0.02;
  }
  void nothingGoesThroughAnythingAndLimitsHold() {
    QFETCH(QString, name);
    QFETCH(QString, mesh);
    QFETCH(double, duration);
    const Scene scene = Scene::load(scenes / "cloth" / (name.toStdString() + ".json"))
                            .withValue("/studies/0/duration", duration)
                            .withValue("/studies/0/frame_every", 1);
    base::ExecutionContext context;
    const auto result = std::dynamic_pointer_cast<const ClothResult>(
        scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "drape")->run(context));
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    const Garment garment(scenes / "assets" / mesh.toStdString());
    const Eigen::Index nodes = result->frames.front()->positions.cols();
    const std::vector<int> nodeOf = garment.nodesIn(result->frames.front()->positions);
    QCOMPARE(nodeOf.size(), static_cast<std::size_t>(nodes));
    std::vector<std::array<int, 3>> triangles;
    for (const auto& triangle : garment.triangles)
      triangles.push_back({nodeOf[triangle[0][0]], nodeOf[triangle[0][1]], nodeOf[triangle[0][2]]});
    for (auto triangle : result->problem->bodies.front().triangles) {
      for (int& node : triangle) node += static_cast<int>(nodes);
      triangles.push_back(triangle);
    }
    QCOMPARE(result->frames.size(), 1 + static_cast<std::size_t>(std::lround(duration / 0.02)));
    for (const auto& frame : result->frames) {
      Eigen::Matrix3Xd all(3, nodes + frame->bodyPoints.cols());
      all << frame->positions, frame->bodyPoints;
      QCOMPARE(countIntersectionsByBruteForce(all, triangles), 0);
      const double stretch = garment.largestStretch(frame->positions, nodeOf);
      // The form carries it: nothing else keeps its shoulders from falling.
      QVERIFY(frame->positions.row(2).maxCoeff() > result->frames.front()->positions.row(2).maxCoeff() - 0.04);
      QVERIFY2(stretch < 1.02 * (1 + garment.readingError()), qPrintable(QString::number(stretch, 'g', 12)));
    }
  }
};

QTEST_GUILESS_MAIN(TestGarment)
#include "test_garment.moc"
