#include <Eigen/Geometry>
#include <QTest>

#include "core/base/error.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/mechanism.hpp"
#include "core/scene/model_builder.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using mechanics::Model;
using mechanics::Vector;

namespace {

/// A bent bar that hangs from a hinge, with a lever at its end that a servo turns.
const std::string linkage = R"({
  "schema_version": 1,
  "dimension": 2,
  "mass_matrix": "consistent",
  "geometry": [{"name": "joints", "type": "points", "points": [[0, 0], [3, 0], [3, 4], [4, 4]]}],
  "elements": [
    {"name": "bar", "type": "link", "joints": [0, 2, 1], "mass": "2 kg"},
    {"name": "lever", "type": "link", "joints": [2, 3], "mass": "1 kg"}
  ],
  "springs": [
    {"name": "local", "type": "local", "from": {"type": "link", "link": "bar", "along": 2, "across": 1},
     "to": {"type": "place", "position": [5, 5]}, "coefficients": ["10 N/m"]},
    {"name": "coil", "type": "torsion", "joint": {"nodes": [2]}, "from": {"nodes": [0]}, "to": {"nodes": [3]}, "stiffness": "0.5 N m/rad"}
  ],
  "boundary_conditions": [{"name": "hinge", "type": "locked", "at": {"nodes": [0]}}],
  "drives": [
    {"name": "servo", "type": "servo", "joint": {"nodes": [2]}, "from": {"nodes": [1]}, "to": {"nodes": [3]},
     "stiffness": "100 N m/rad", "harmonics": [{"amplitude": "30 deg"}]}
  ]
})";

/// Two blocks, of which the upper one is softer.
const std::string blocks = R"({
  "schema_version": 1,
  "geometry": [{"name": "body", "type": "blocks", "cell": [1, 1, 1], "blocks": [
    {"name": "foot", "minimum": [0, 0, 0], "maximum": [3, 1, 1]}, {"name": "top", "minimum": [1, 0, 1], "maximum": [2, 1, 3]}]}],
  "materials": [{"name": "hard", "type": "isotropic", "density": 1000, "young_modulus": "1 MPa", "poisson_ratio": 0.3},
                {"name": "soft", "type": "isotropic", "density": 500, "young_modulus": "0.1 MPa", "poisson_ratio": 0.3}],
  "elements": [{"name": "lower", "type": "solid", "material": "hard", "group": "foot"},
               {"name": "upper", "type": "solid", "material": "soft", "group": "top",
                "stiffness_factors": [1, 1, 1, 1, 1, 2, 2, 2, 2, 2]}],
  "boundary_conditions": [{"name": "ground", "type": "locked", "at": {"group": "foot.z_min"}}]
})";

std::shared_ptr<const Model> buildScene(const std::string& text) { return scene::buildModel(test::parse(text)); }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto place = text.find(what);
  return text.replace(place, what.size(), by);
}

}  // namespace

/// Links, bars, their springs and servos, and solids, as scenes.
class TestMechanismScenes : public QObject {
  Q_OBJECT

 private slots:
  void linksHaveMassAndStayRigid();
  void localSpringsPullAtLinks();
  void servosTurnLinks();
  void servosTurnLinksInSpace();
  void solidsHaveLayers();
  void mistakesAreNamed_data();
  void mistakesAreNamed();
};

void TestMechanismScenes::linksHaveMassAndStayRigid() {
  const auto model = buildScene(linkage);
  QVERIFY(std::abs(model->massMatrix().sum() / 2 - 3) <= 1e-14);
  QCOMPARE(model->parts[0].segments.size(), 3u);
  Vector x = model->restPositions;
  QVERIFY(*mechanics::constraintViolation(*model, x) <= 1e-15);
  x[2] += 0.05;  // the bent bar's free end
  QVERIFY(*mechanics::constraintViolation(*model, x) >= 0.005);
}

void TestMechanismScenes::localSpringsPullAtLinks() {
  const auto model = buildScene(linkage);
  QCOMPARE(model->parts[0].springs.size(), 1u);
  const auto& [from, to] = model->parts[0].springs[0];
  // Two metres from (0, 0) towards (3, 4), and one to the left.
  const Vector expected = Eigen::Vector2d(2 * 0.6 - 0.8, 2 * 0.8 + 0.6);
  QVERIFY((mechanics::positionOf(from, 2, model->restPositions) - expected).norm() <= 1e-14);
  QCOMPARE(mechanics::positionOf(to, 2, model->restPositions), Vector(Eigen::Vector2d(5, 5)));
  // It hangs on an arm from the link.
  QCOMPARE(model->parts[0].arms.size(), 1u);
  const auto& [foot, hand] = model->parts[0].arms[0];
  const Vector onLink = Eigen::Vector2d(2 * 0.6, 2 * 0.8);
  QVERIFY((mechanics::positionOf(foot, 2, model->restPositions) - onLink).norm() <= 1e-14);
  QVERIFY(hand == from);
}

void TestMechanismScenes::servosTurnLinks() {
  const auto model = buildScene(replaced(linkage, "0.5 N m/rad", "0 N m/rad"));
  QCOMPARE(model->scalarCount, 1);
  Vector x = model->configuration(model->restPositions(model->dofs.freeCoordinates), 0);
  x.segment<2>(6) = Eigen::Vector2d(3 + std::cos(M_PI / 6), 4 + std::sin(M_PI / 6));
  const mechanics::ElasticAssembler assembler(model);
  // To rounding of lengths in links of 1e7 N.
  QVERIFY(assembler.gradient(x).segment<2>(6).norm() <= 1e-8);
  x.segment<2>(6) = Eigen::Vector2d(4, 4);
  const double moment = assembler.gradient(x)[7];  // of the force at the lever's end, one metre long
  QVERIFY(std::abs(moment + 100 * M_PI / 6) <= 1e-10);
}

void TestMechanismScenes::servosTurnLinksInSpace() {
  const auto model = buildScene(R"({
    "schema_version": 1,
    "geometry": [{"name": "joints", "type": "points", "points": [[0, 0, 0], [0, 0, 1], [-1, 0, 0], [1, 0, 0]]}],
    "elements": [{"name": "arm", "type": "link", "joints": [0, 1, 3]}],
    "boundary_conditions": [{"name": "frame", "type": "locked", "at": {"nodes": [0, 1, 2]}}],
    "drives": [{"name": "servo", "type": "servo", "joint": {"nodes": [0]}, "axis_end": {"nodes": [1]}, "from": {"nodes": [2]},
                "to": {"nodes": [3]}, "harmonics": [{"amplitude": "30 deg"}]}]
  })");
  Vector x = model->configuration(model->restPositions(model->dofs.freeCoordinates), 0);
  const mechanics::ElasticAssembler assembler(model);
  QVERIFY(assembler.gradient(x).segment<3>(9).norm() > 1);
  x.segment<3>(9) = Eigen::AngleAxisd(M_PI / 6, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d(1, 0, 0);
  QVERIFY(assembler.gradient(x).segment<3>(9).norm() <= 1e-8);
}

void TestMechanismScenes::solidsHaveLayers() {
  const auto model = buildScene(blocks);
  QCOMPARE(model->energies.size(), 2u);
  QCOMPARE(model->energies[0]->elementCount(), 15);
  QCOMPARE(model->energies[1]->elementCount(), 10);
  QVERIFY(std::abs(model->massMatrix().sum() / 3 - (3 * 1000 + 2 * 500)) <= 1e-9);
  QVERIFY(!model->parts[0].triangles.empty());
  QCOMPARE(model->dofs.freeCount(), 3 * (model->nodeCount() - 8));
  // The upper block alone, stretched by a half: mean stiffness 1.5.
  Vector x = model->restPositions;
  for (int n = 0; n < model->nodeCount(); ++n)
    if (x[3 * n + 2] > 1) x[3 * n + 2] += 0.5 * (x[3 * n + 2] - 1);
  const double strain = (1.5 * 1.5 - 1) / 2, modulus = 1e5 * 0.7 / (1.3 * 0.4);  // uniaxial strain
  const double expected = 2 * 1.5 * 0.5 * modulus * strain * strain;
  const double energy = mechanics::ElasticAssembler(model).value(x);
  QVERIFY(std::abs(energy - expected) <= 1e-12 * expected);
}

void TestMechanismScenes::mistakesAreNamed_data() {
  QTest::addColumn<QString>("scene");
  QTest::addColumn<QString>("replace");
  QTest::addColumn<QString>("by");
  QTest::addColumn<QString>("pointer");
  const auto row = [](const char* name, const std::string& text, const char* replace, const char* by,
                      const char* pointer) {
    QTest::newRow(name) << QString::fromStdString(text) << replace << by << pointer;
  };
  row("no such joint", linkage, "[0, 2, 1]", "[0, 2, 7]", "/elements/0/joints/2");
  row("a joint twice", linkage, "[0, 2, 1]", "[0, 2, 2]", "/elements/0/joints");
  row("no such link", linkage, "\"link\": \"bar\"", "\"link\": \"baz\"", "/springs/0/from/link");
  row("an end that moves with nothing", linkage, "\"type\": \"link\", \"link\": \"bar\", \"along\": 2, \"across\": 1",
      "\"type\": \"place\", \"position\": [0, 0]", "/springs/0");
  row("a servo's axis in the plane", linkage, "\"stiffness\": \"100 N m/rad\"", "\"axis_end\": {\"nodes\": [1]}",
      "/drives/0/axis_end");
  row("a rod of rubber in the plane", linkage, "\"type\": \"link\", \"joints\": [2, 3], \"mass\": \"1 kg\"",
      "\"type\": \"solid\"", "/elements/1");
  row("no such group", blocks, "\"group\": \"top\"", "\"group\": \"tip\"", "/elements/1/group");
  row("too few factors", blocks, "[1, 1, 1, 1, 1, 2, 2, 2, 2, 2]", "[1, 2]", "/elements/1/stiffness_factors");
  row("half a cell", blocks, "[3, 1, 1]", "[3, 1, 0.5]", "/geometry/0");
  row("incompressible", blocks, "\"poisson_ratio\": 0.3", "\"poisson_ratio\": 0.5", "/elements/0");
}

void TestMechanismScenes::mistakesAreNamed() {
  QFETCH(QString, scene);
  QFETCH(QString, replace);
  QFETCH(QString, by);
  QFETCH(QString, pointer);
  try {
    buildScene(replaced(scene.toStdString(), replace.toStdString(), by.toStdString()));
    QFAIL("The scene was accepted.");
  } catch (const base::InputError& error) {
    QVERIFY2(QString::fromStdString(error.location()).contains(pointer), error.what());
  }
}

QTEST_GUILESS_MAIN(TestMechanismScenes)
#include "test_mechanism_scenes.moc"
