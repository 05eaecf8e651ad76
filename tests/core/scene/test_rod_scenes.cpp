#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <QTest>
#include <numbers>

#include "core/base/error.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using mechanics::Model;
using mechanics::Vector;

namespace {

/// A wire of two segments along x, and a third one that joins them in the middle; `hold` holds the node 0.
std::string wireScene(const std::string& hold) {
  return R"({
  "schema_version": 1,
  "geometry": [{"name": "wire", "type": "mesh", "points": [[0, 0, 0], ["10 cm", 0, 0], [0.2, 0, 0], [0.1, 0.1, 0]],
                "segments": [[0, 1], [1, 2], [1, 3]]}],
  "materials": [{"name": "brass", "type": "isotropic", "density": "8500 kg/m^3", "young_modulus": "100 GPa", "poisson_ratio": 0.35}],
  "elements": [{"name": "wire", "type": "rod", "diameter": "2 mm"}],)" +
         hold + "}";
}

constexpr const char* clamped = R"("boundary_conditions": [{"name": "end", "type": "locked", "at": {"nodes": [0]}}])";
constexpr const char* pinned =
    R"("boundary_conditions": [{"name": "end", "type": "locked", "at": {"nodes": [0]}, "coordinates": ["x", "y", "z"]}])";

std::shared_ptr<const Model> build(const std::string& hold) { return scene::buildModel(test::parse(wireScene(hold))); }

std::string turn(const std::string& axis, const std::string& angle) {
  return R"("drives": [{"name": "servo", "type": "rotation", "at": {"nodes": [0]}, "axis": )" + axis +
         R"(, "harmonics": [{"amplitude": ")" + angle + "\"}]}]";
}

}  // namespace

class TestRodScenes : public QObject {
  Q_OBJECT

 private slots:
  void whatIsLockedWhollyIsClamped() {
    // Four nodes, three twists, the joint's frame; a frame where it is clamped as well.
    const auto held = build(clamped), hinged = build(pinned);
    QCOMPARE(held->coordinateCount(), 12 + 3 + 3 + 3);
    QCOMPARE(held->dofs.freeCount(), 9 + 3 + 3);
    QCOMPARE(hinged->coordinateCount(), 12 + 3 + 3);
    QCOMPARE(held->parts[0].segments.size(), 3u);
    const auto softest = [](const Model& model) {
      const Eigen::MatrixXd stiffness =
          mechanics::ElasticAssembler(std::make_shared<const Model>(model)).hessian(model.restPositions);
      return stiffness.ldlt().vectorD().minCoeff() / stiffness.diagonal().maxCoeff();
    };
    QVERIFY(softest(*held) > 1e-9);
    QVERIFY(std::abs(softest(*hinged)) < 1e-12);  // it can turn about the pin
  }

  void massIsThatOfTheWire() {
    const auto mass = build(clamped)->massMatrix();
    double total = 0;
    for (int node = 0; node < 4; ++node) total += mass.coeff(3 * node, 3 * node);
    const double expected = 8500 * std::numbers::pi * 1e-6 * 0.3;
    QVERIFY(std::abs(total - expected) <= 1e-12 * expected);
  }

  void drivesTurnRodsAlong_data() {
    QTest::addColumn<QString>("axis");
    QTest::newRow("across") << "[0, 0, 2]";
    QTest::newRow("along") << "[1, 0, 0]";
    QTest::newRow("oblique") << "[1, 2, -1]";
  }

  /// The whole wire can follow the servo without being bent or twisted.
  void drivesTurnRodsAlong() {
    QFETCH(QString, axis);
    const auto model = build(turn(axis.toStdString(), "50 deg"));
    const mechanics::ElasticAssembler assembler(model);
    Vector free = model->restPositions(model->dofs.freeCoordinates);
    // From rest, Newton's method with the drive raised in steps: cos τ goes from 0 to 1.
    Vector x;
    for (int step = 1; step <= 40; ++step)
      for (int iteration = 0; iteration < 8; ++iteration) {
        x = model->configuration(free, std::acos(step / 40.0));
        const Vector slope = assembler.gradient(x)(model->dofs.freeCoordinates);
        const Eigen::MatrixXd stiffness = assembler.hessian(x);
        const Vector change = stiffness.ldlt().solve(slope);
        free -= change;
      }
    x = model->configuration(free, 0);
    QVERIFY(assembler.value(x) <= 1e-12);
    const auto values = test::parse(wireScene(turn(axis.toStdString(), "50 deg"))).normalized()["drives"][0]["axis"];
    const Eigen::Vector3d direction(values[0], values[1], values[2]);
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(50 * std::numbers::pi / 180, direction.normalized()).toRotationMatrix();
    for (int node = 0; node < 4; ++node) {
      const Eigen::Vector3d rest = model->restPositions.segment<3>(3 * node);
      QVERIFY((x.segment<3>(3 * node) - rotation * rest).norm() <= 1e-6);
    }
  }

  void translationsKeepTheDirection() {
    const auto model = build(
        R"("drives": [{"name": "shaker", "type": "translation", "at": {"nodes": [0]}, "direction": [0, 1, 0],
                       "harmonics": [{"amplitude": "1 cm"}]}])");
    QCOMPARE(model->dofs.freeCount(), 9 + 3 + 3);
    const Vector x = model->configuration(model->restPositions(model->dofs.freeCoordinates), 0);
    QCOMPARE(x[1], 0.01);
    for (int scalar = 12; scalar < x.size(); ++scalar) QCOMPARE(x[scalar], 0.0);
  }

  void badInputIsRefused_data() {
    QTest::addColumn<QString>("replace");
    QTest::addColumn<QString>("by");
    QTest::newRow("hollow") << "\"2 mm\""
                            << "\"2 mm\", \"inner_diameter\": \"2 mm\"";
    QTest::newRow("no segments") << "\"segments\": [[0, 1], [1, 2], [1, 3]]"
                                 << "\"triangles\": [[0, 1, 3], [1, 2, 3]]";
    QTest::newRow("director along a segment")
        << R"("type": "rod", "diameter": "2 mm")"
        << R"("type": "flat_rod", "width": "2 mm", "height": "1 mm", "director": [1, 0, 0])";
  }

  void badInputIsRefused() {
    QFETCH(QString, replace);
    QFETCH(QString, by);
    QString text = QString::fromStdString(wireScene(clamped));
    QVERIFY(text.contains(replace));
    text.replace(replace, by);
    try {
      scene::buildModel(test::parse(text.toStdString()));
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QVERIFY2(QString::fromStdString(error.location()).contains("/elements/0"), error.what());
    }
  }

  void rodsThatTurnTooFarAreReported_data() {
    QTest::addColumn<QString>("angle");
    QTest::addColumn<int>("warnings");
    QTest::newRow("within the limit") << "160 deg" << 0;
    QTest::newRow("past the limit") << "175 deg" << 1;
  }

  /// A servo that is slow beside the wire's vibrations turns the whole wire to and fro.
  void rodsThatTurnTooFarAreReported() {
    QFETCH(QString, angle);
    QFETCH(int, warnings);
    const std::string study =
        R"(, "studies": [{"name": "slow", "type": "periodic_motion", "frequency": "0.05 Hz", "harmonics": 16}])";
    const scene::Scene scene = test::parse(wireScene(turn("[0, 0, 1]", angle.toStdString()) + study));
    QStringList logged;
    base::ExecutionContext context({}, [&](base::Severity severity, const std::string& message) {
      if (severity == base::Severity::warning) logged.push_back(QString::fromStdString(message));
    });
    const auto result = scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), "slow")->run(context);
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    QCOMPARE(logged.size(), warnings);
    const scene::Json inSummary = result->summary().at("warnings");
    QCOMPARE(static_cast<int>(inSummary.size()), warnings);
    if (warnings == 0) return;
    QCOMPARE(QString::fromStdString(inSummary[0]), logged[0]);
    QVERIFY2(logged[0].contains("rod turns by 175 degrees"), qPrintable(logged[0]));
  }

  void turningByHalfATurnIsRefused() {
    QVERIFY_EXCEPTION_THROWN(build(turn("[0, 0, 1]", "180 deg")), base::InputError);
    build(turn("[0, 0, 1]", "179 deg"));
  }
};

QTEST_GUILESS_MAIN(TestRodScenes)
#include "test_rod_scenes.moc"
