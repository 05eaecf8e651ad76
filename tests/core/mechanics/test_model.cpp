#include <QTest>
#include <cmath>
#include <functional>

#include "core/base/error.hpp"
#include "core/mechanics/model.hpp"
#include "core/mechanics/prescribed_motion.hpp"
#include "core/mechanics/spring.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

constexpr double pi = M_PI;

Vector vector(std::initializer_list<double> values) {
  Vector result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.data());
  return result;
}

/// Three nodes in the plane, joined by two springs.
Model chain() {
  Model model;
  model.dimension = 2;
  model.restPositions = vector({0, 0, 1, 0, 2, 0.5});
  model.energies = {makeSpring(2, 0, 1, 1, {{10}}), makeSpring(2, 1, 2, 1, {{10}})};
  return model;
}

PeriodicSignal signal(double amplitude) { return {{{1, amplitude, 0}}}; }

std::string refusal(const std::function<void(Model&)>& change) {
  Model model = chain();
  change(model);
  try {
    model.finish();
  } catch (const base::InputError& error) {
    return error.problem();
  }
  return {};
}

bool mentions(const std::string& sentence, const std::string& part) { return sentence.find(part) != std::string::npos; }

}  // namespace

class TestModel : public QObject {
  Q_OBJECT

 private slots:
  void signalIsASumOfCosines();
  void unknownsAreWhatIsNeitherDrivenNorLocked();
  void massMatrixHoldsElementsAndPoints();
  void externalForcesAreGravityAndLoads();
  void translationMovesItsNodes();
  void rotationIsExact();
  void contradictionsAreRefused();
  void badMotionsAreRefused();
};

void TestModel::signalIsASumOfCosines() {
  const PeriodicSignal sum{{{0, 0.5, 0}, {1, 2, pi / 2}, {3, 0.1, -0.3}}};
  for (const double tau : {0.0, 0.4, 2.0, 7.0})
    QVERIFY(std::abs(sum(tau) - (0.5 - 2 * std::sin(tau) + 0.1 * std::cos(3 * tau - 0.3))) <= 1e-14);
  QCOMPARE(PeriodicSignal()(1.0), 0.0);
}

void TestModel::unknownsAreWhatIsNeitherDrivenNorLocked() {
  Model model = chain();
  model.drives.push_back(makeTranslation({0}, vector({0, 1}), signal(0.1)));
  model.lockedCoordinates = {0, 0, 0, 1, 0, 0};
  model.finish();
  QCOMPARE(model.dofs.freeCount(), 3);
  QVERIFY((model.dofs.freeCoordinates == std::vector{2, 4, 5}));
  QVERIFY((model.dofs.freeIndex == std::vector{-1, -1, 0, -1, 1, 2}));
  const Vector x = model.configuration(vector({7, 8, 9}), 0);
  QVERIFY((x - vector({0, 0.1, 7, 0, 8, 9})).norm() <= 1e-15);
}

void TestModel::massMatrixHoldsElementsAndPoints() {
  Model model = chain();
  SparseMatrix elements(6, 6);
  elements.insert(2, 2) = 3;
  elements.insert(0, 2) = 0.5;
  elements.insert(2, 0) = 0.5;
  model.elementMass = std::make_shared<const SparseMatrix>(elements);
  model.pointMasses = {{"a", {1, 2}, 4, 0, 10}, {"b", {2}, 1, 0, 10}};
  model.finish();
  Matrix expected = Vector(vector({0, 0, 7, 4, 5, 5})).asDiagonal();
  expected(0, 2) = expected(2, 0) = 0.5;
  QCOMPARE((Matrix(model.massMatrix()) - expected).norm(), 0.0);
  model.elementMass = nullptr;
  QCOMPARE(Matrix(model.massMatrix()).trace(), 18.0);
}

void TestModel::externalForcesAreGravityAndLoads() {
  Model model = chain();
  SparseMatrix elements(6, 6);
  elements.setIdentity();
  model.elementMass = std::make_shared<const SparseMatrix>(elements);
  model.pointMasses = {{"a", {2}, 4, 0, 10}};
  model.gravity = vector({0, -10});
  model.forces = {{"push", {0, 1}, vector({2, 0}), {{{2, 3, 0}}}}};
  model.finish();
  const double push = 6 * std::cos(2 * 0.3);
  QVERIFY((model.externalForce(0.3) - vector({push, -10, push, -10, 0, -50})).norm() <= 1e-13);
}

void TestModel::translationMovesItsNodes() {
  const auto drive = makeTranslation({0}, vector({0, 2, 0}), {{{1, 0.5, -pi / 2}}});
  QVERIFY((drive->values(vector({1, 1, 1}), 0.8) - vector({1, 1 + std::sin(0.8), 1})).norm() <= 1e-15);
}

void TestModel::rotationIsExact() {
  const Vector center = vector({1, 0, 0});
  const auto drive = makeRotation({0}, center, {0, 0, 5}, signal(pi / 2));
  QVERIFY((drive->values(vector({3, 0, 7}), 0) - vector({1, 2, 7})).norm() <= 1e-14);  // a quarter turn at τ = 0
  const Vector rest = vector({0.3, -0.4, 2});
  for (const double tau : {0.1, 1.0, 2.5})
    QVERIFY(std::abs((drive->values(rest, tau) - center).norm() - (rest - center).norm()) <= 1e-14);
  const auto plane = makeRotation({0}, vector({1, 0}), {0, 0, 0}, signal(pi / 2));  // its axis is z
  QVERIFY((plane->values(vector({3, 0}), 0) - vector({1, 2})).norm() <= 1e-14);
}

void TestModel::contradictionsAreRefused() {
  const double nan = std::nan("");
  QCOMPARE(refusal([](Model&) {}), std::string());
  const auto drive = [](int node) { return makeTranslation({node}, vector({0, 1}), signal(1)); };
  QVERIFY(mentions(refusal([&](Model& m) { m.drives = {drive(1), drive(1)}; }), "node 1 is driven more than once"));
  QVERIFY(mentions(refusal([&](Model& m) {
                     m.drives = {drive(1)};
                     m.lockedCoordinates = {0, 0, 0, 1, 0, 0};
                   }),
                   "node 1 is both driven and locked"));
  QVERIFY(mentions(refusal([&](Model& m) { m.drives = {drive(0), drive(1), drive(2)}; }), "every coordinate"));
  QVERIFY(mentions(refusal([&](Model& m) { m.drives = {drive(3)}; }), "node 3"));
  QVERIFY(mentions(refusal([&](Model& m) { m.restPositions[2] = nan; }), "rest positions"));
  QVERIFY(mentions(refusal([&](Model& m) { m.gravity = vector({0, nan}); }), "gravity"));
  QVERIFY(mentions(refusal([&](Model& m) { m.gravity = vector({0, 1, 2}); }), "gravity"));
  QVERIFY(mentions(refusal([&](Model& m) { m.massDamping = -1; }), "mass damping"));
  QVERIFY(mentions(refusal([&](Model& m) { m.stiffnessDamping = nan; }), "stiffness damping"));
  QVERIFY(mentions(refusal([&](Model& m) { m.pointMasses = {{"tip", {1}, -1, 0, 1}}; }), "point mass 'tip'"));
  QVERIFY(mentions(refusal([&](Model& m) { m.pointMasses = {{"tip", {9}, 1, 0, 1}}; }), "node 9"));
  QVERIFY(mentions(refusal([&](Model& m) { m.forces = {{"pull", {0}, vector({1}), signal(1)}}; }), "force 'pull'"));
  QVERIFY(mentions(refusal([&](Model& m) {
                     m.forces = {{"pull", {0}, vector({1, 0}), signal(nan)}};
                   }),
                   "force 'pull'"));
  QVERIFY(mentions(refusal([&](Model& m) { m.forces = {{"pull", {0}, vector({1, 0}), {{{-1, 1, 0}}}}}; }), "order"));
  QVERIFY(mentions(refusal([&](Model& m) { m.probes = {{"end", -1}}; }), "probe 'end'"));
  QVERIFY(mentions(refusal([&](Model& m) { m.energies.push_back(makeSpring(2, 0, 5, 1, {{1}})); }), "node 5"));
  QVERIFY(mentions(refusal([&](Model& m) { m.lockedCoordinates = {1}; }), "locked"));
  QVERIFY(!refusal([](Model& m) { m.restPositions = Vector(); }).empty());
  QVERIFY(!refusal([](Model& m) { m.dimension = 4; }).empty());
  QVERIFY(!refusal([](Model& m) { m.elementMass = std::make_shared<const SparseMatrix>(4, 4); }).empty());
}

void TestModel::badMotionsAreRefused() {
  const double nan = std::nan("");
  QVERIFY_EXCEPTION_THROWN(makeTranslation({0}, vector({nan, 0}), signal(1)), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeTranslation({0}, vector({1, 0, 0, 0}), signal(1)), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeTranslation({0}, vector({1, 0}), signal(nan)), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeRotation({0}, vector({1, 0, 0}), {0, 0, 0}, signal(1)), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeRotation({0}, vector({1, nan, 0}), {0, 0, 1}, signal(1)), base::InputError);
}

QTEST_GUILESS_MAIN(TestModel)
#include "test_model.moc"
