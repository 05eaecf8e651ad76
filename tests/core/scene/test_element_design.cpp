#include <QTemporaryDir>
#include <QTest>
#include <iostream>
#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/element_design_chart.hpp"
#include "core/scene/json_text.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using scene::ElementDesignStudyResult;
using scene::Json;

namespace {

scene::Scene sceneWith(const std::string& cell, const std::string& study, const std::string& directory = "/nowhere") {
  return scene::Scene::parse(R"({"schema_version": 1, "interlocking_cells": [{"name": "m", )" + cell +
                                 R"(}], "studies": [{"name": "s", )" + study + "}]}",
                             directory, "test.json");
}

std::shared_ptr<const scene::Result> run(const scene::Scene& scene, base::ExecutionContext& context,
                                         const scene::ResultObserver& observe = {}) {
  return scene::StudyRegistry::instance().make(scene, nullptr, "s")->run(context, observe);
}

std::shared_ptr<const ElementDesignStudyResult> design(const scene::Scene& scene) {
  base::ExecutionContext context;
  return std::dynamic_pointer_cast<const ElementDesignStudyResult>(run(scene, context));
}

/// Stretch limits of a cell as a test of its own finds them.
double stretchLimit(const std::string& cell, double degrees) {
  base::ExecutionContext context;
  const auto result =
      run(sceneWith(cell, R"("type": "cell_test", "direction": ")" + std::to_string(degrees) + R"( deg")"), context);
  return result->summary()["strain"];
}

std::string polarLimits(const std::string& cell, const std::vector<double>& directions) {
  std::string text;
  for (const double direction : directions)
    text += (text.empty() ? "" : ", ") + (R"({"direction": ")" + std::to_string(direction)) + R"( deg", "stretch": )" +
            QString::number(stretchLimit(cell, direction), 'g', 12).toStdString() + "}";
  return R"("polar_limits": [)" + text + "]";
}

QString problemOf(const std::string& cell, const std::string& study) {
  try {
    design(sceneWith(cell, study));
  } catch (const base::InputError& error) {
    return QString::fromStdString(error.location() + " | " + error.problem());
  }
  return {};
}

}  // namespace

class TestElementDesign : public QObject {
  Q_OBJECT

 private slots:
  /// From limits of a known element, which tests of their own found, back to its numbers. Sizes are held by the wire.
  void recoversElements_data() {
    QTest::addColumn<QString>("known");
    QTest::addColumn<QString>("start");
    QTest::addColumn<QStringList>("numbers");
    QTest::addColumn<QList<double>>("values");
    QTest::newRow("4-in-1") << R"("type": "four_in_one")"
                            << R"("type": "four_in_one", "ring_radius": "5.5 mm", "width": "13 mm", "height": "8 mm")"
                            << QStringList{"ring_radius", "width", "height"} << QList<double>{5e-3, 12.2e-3, 7.5e-3};
    QTest::newRow("ring net") << R"("type": "ring_net")"
                              << R"("type": "ring_net", "ring_radius": "3.7 mm", "wire_radius": "0.45 mm")"
                              << QStringList{"ring_radius", "wire_radius"} << QList<double>{4e-3, 0.6e-3};
    QTest::newRow("rosette") << R"("type": "square_rosette")"
                             << R"("type": "square_rosette", "ring_radius": "4.5 mm", "distance": "5.3 mm")"
                             << QStringList{"ring_radius", "distance"} << QList<double>{3.85e-3, 5.005e-3};
  }

  void recoversElements() {
    QFETCH(QString, known);
    QFETCH(QString, start);
    QFETCH(QStringList, numbers);
    QFETCH(QList<double>, values);
    std::string names;
    for (const QString& name : numbers)
      names += (names.empty() ? "" : ", ") + (R"({"name": ")" + name.toStdString()) + "\"}";
    const auto result = design(
        sceneWith(start.toStdString(), R"("type": "element_design", "tolerance": 3e-6, "parameters": [)" + names +
                                           "], " + polarLimits(known.toStdString(), {0, 20, 45, 70, 90})));
    const auto& history = result->design.history;
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    std::cout << "  residual " << history.front().residual << " to " << history.back().residual << " in "
              << history.back().iteration << " iterations:";
    double farthest = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const double found = history.back().values[i], exact = values[i];
      std::cout << " " << found;
      farthest = std::max(farthest, std::abs(history.front().values[i] / exact - 1));
      // What limits are known to: gaps of 1e-4 wire radii.
      QVERIFY2(std::abs(found / exact - 1) < 2e-4, qPrintable(QString::number(found)));
    }
    std::cout << std::endl;
    QVERIFY(farthest > 0.05 && history.front().residual > 1e3 * history.back().residual);
    // Each element kept is better than those before.
    for (std::size_t i = 1; i < history.size(); ++i) QVERIFY(history[i].residual < history[i - 1].residual);
  }

  /// Limits that no kind of material has by default, with room for a printer; the scene with the element found has
  /// them.
  void findsNewElementWithClearance() {
    const scene::Scene scene = sceneWith(R"("type": "threefold")",
                                         R"("type": "element_design", "clearance": "0.4 mm", "tolerance": 1e-3,
           "parameters": [{"name": "ring_radius"}, {"name": "distance"}, {"name": "lean"}, {"name": "spacing"}],
           "polar_limits": [{"direction": "0 deg", "stretch": 0.1}, {"direction": "15 deg", "stretch": 0.1},
                            {"direction": "30 deg", "stretch": 0.1}])");
    const auto result = design(scene);
    QVERIFY(result->design.end == interlock::DesignEnd::reached);
    for (const auto& element : result->design.history) QVERIFY(element.clearance >= 0.4e-3 * (1 - 1e-6));
    const Json written = designedElementScene(scene, *result, result->design.best());
    Json entry = written["interlocking_cells"][0];
    QCOMPARE(QString::fromStdString(entry.dump()),
             QString::fromStdString(designedEntry(*result, result->design.best()).dump()));
    entry.erase("name");
    const std::string cell = entry.dump().substr(1, entry.dump().size() - 2);
    for (const double direction : {0.0, 15.0, 30.0})
      QVERIFY2(std::abs(stretchLimit(cell, direction) - 0.1) < 2e-3,
               qPrintable(QString::number(stretchLimit(cell, direction))));
  }

  /// Every strain of the region is reached in the end, as single tests along its rays say.
  void containsRegion() {
    const auto result = design(sceneWith(
        R"("type": "square_rosette")",
        R"("type": "element_design", "parameters": [{"name": "ring_radius"}, {"name": "spacing"}, {"name": "distance"},
           {"name": "lean"}], "strain_region": {"type": "ellipsoid", "half_axes": [0.13, 0.13, 0.1], "wanted": "inside"})"));
    QVERIFY(result->design.end == interlock::DesignEnd::reached);
    QVERIFY2(result->design.history.front().residual > 4e-4,
             qPrintable(QString::number(result->design.history.front().residual)));
    QVERIFY(result->design.best().residual <= 1e-4);
    for (const scene::ElementGoal& goal : result->goals) {
      // The wanted point is on the ellipsoid.
      const Eigen::Vector3d green = interlock::greenStrain(goal.limit.wanted * goal.direction);
      QVERIFY(std::abs(green.cwiseQuotient(Eigen::Vector3d(0.13, 0.13, 0.1)).norm() - 1) < 1e-9);
    }
  }

  /// A search that is stopped keeps the best so far; snapshots on the way are seen.
  void cancelKeepsTheBest() {
    base::ExecutionContext context;
    int seen = 0;
    const auto result = std::dynamic_pointer_cast<const ElementDesignStudyResult>(run(
        sceneWith(
            R"("type": "four_in_one", "ring_radius": "5.5 mm", "width": "13 mm", "height": "8 mm")",
            R"("type": "element_design", "parameters": [{"name": "ring_radius"}, {"name": "width"}, {"name": "height"}],
                         "polar_limits": [{"direction": "0 deg", "stretch": 0.29}, {"direction": "90 deg", "stretch": 0.35}])"),
        context, [&](const std::shared_ptr<const scene::Result>&) {
          if (++seen == 2) context.requestCancel();
        }));
    QVERIFY(result->termination == base::TerminationType::cancelled);
    QCOMPARE(result->design.history.size(), std::size_t{2});
    QVERIFY(result->design.best().residual < result->design.history.front().residual);
  }

  void writtenResultIsPlotted() {
    const QTemporaryDir folder;
    const std::string place = folder.filePath("s").toStdString();
    const auto result =
        design(sceneWith(R"("type": "ring_net")",
                         R"("type": "element_design", "iterations": 3, "parameters": [{"name": "ring_radius"}],
           "polar_limits": [{"direction": "200 deg", "stretch": 0.4}, {"direction": 0, "stretch": 0.15, "compression": -0.1}])"));
    result->write(place);
    const scene::DesignedLimits written = scene::readDesignedLimits(place), own = designedLimits(*result);
    QCOMPARE(written.limits.size(), std::size_t{3});
    for (std::size_t i = 0; i < 3; ++i) {
      QCOMPARE(written.limits[i].after, own.limits[i].after);
      QCOMPARE(written.limits[i].wanted, own.limits[i].wanted);
    }
    QCOMPARE(written.residuals, own.residuals);
    const scene::PolarCurves curves = scene::elementDesignCurves(written);
    QCOMPARE(curves.curves.size(), std::size_t{6});
    QCOMPARE(curves.curves[2].name, std::string("stretch wanted"));
    // Sorted within half a turn.
    const scene::PolarCurve& wanted = curves.curves[2];
    QCOMPARE(wanted.values[0], 0.15);
    QCOMPARE(wanted.values[1], 0.4);
    QVERIFY(std::abs(wanted.angles[1] - std::numbers::pi / 9) < 1e-12);
    // Nothing is known of the other directions.
    QCOMPARE(wanted.values.size(), std::size_t{3});
    QVERIFY(std::isnan(wanted.values[2]));
    QVERIFY(curves.curves[5].values[0] < 0);
  }

  void badInputIsSaid() {
    const std::string net = R"("type": "ring_net")", limits = R"("polar_limits": [{"direction": 0, "stretch": 0.1}])";
    const std::string kind = R"("type": "element_design", "parameters": )";
    QVERIFY(problemOf(net, kind + R"([{"name": "lean"}], )" + limits).contains("has no number \"lean\""));
    QVERIFY(problemOf(net, kind + R"([{"name": "aspect"}, {"name": "aspect"}], )" + limits).contains("twice"));
    QVERIFY(problemOf(net, kind + R"([{"name": "spacing", "minimum": 0.02}], )" + limits).contains("not between"));
    QVERIFY(problemOf(net, kind + R"([{"name": "spacing"}])").contains("limits that are wanted"));
    QVERIFY(problemOf(net, kind + R"([{"name": "spacing"}], "strain_region": {"type": "box", "minimum": [0.01, -1, -1],
                                     "maximum": [1, 1, 1]})")
                .contains("rest state"));
  }
};

QTEST_GUILESS_MAIN(TestElementDesign)
#include "test_element_design.moc"
