#include <QTest>
#include <cmath>
#include <functional>

#include "core/base/error.hpp"
#include "tests/core/mechanics/contact_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;
using Eigen::Matrix3Xd;

namespace {

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const base::InputError& error) {
    return error.problem();
  }
  return {};
}

}  // namespace

class TestContactInput : public QObject {
  Q_OBJECT

 private slots:
  void badStartIsRefused();
  void badInputIsRefused();
  void notFiniteIsNotFree();
};

void TestContactInput::badStartIsRefused() {
  const auto start = [](const ContactGeometry& geometry, const Matrix3Xd& x) {
    return refusal([&] { ContactBarrier(geometry, x, options).requireFree(x); });
  };
  QCOMPARE(start(triangleAndPoint(1, 0.1), triangleAndPointAt({0.2, 0.3, 0.11})), std::string());
  QCOMPARE(start(triangleAndPoint(1, 0.1), triangleAndPointAt({0.2, 0.3, 0.05})),
           std::string("node 3 and the triangle of nodes 0, 1 and 2 are 0.05 m apart at the start, but their radii "
                       "and the separation need more than 0.1 m"));
  Matrix3Xd x(3, 5);
  x << 0, 1, 0, 0.2, 0.2, 0, 0, 1, 0.2, 0.2, 0, 0, 0, -1, 1;
  ContactGeometry geometry{
      .triangles = {{0, 1, 2}}, .edges = {{3, 4}}, .points = {}, .radii = {0, 0, 0, 0, 0}, .bodies = {0, 0, 0, 1, 1}};
  QCOMPARE(start(geometry, x),
           std::string("the edge between nodes 3 and 4 crosses the triangle of nodes 0, 1 and 2, but surfaces must be "
                       "apart at the start"));
  geometry.bodies = {2, 2, 2, 1, 1};
  QCOMPARE(start(geometry, x), std::string());
}

void TestContactInput::badInputIsRefused() {
  const Matrix3Xd x = triangleAndPointAt({0, 0, 1});
  const auto build = [&](const std::function<void(ContactGeometry&, ContactOptions&)>& change) {
    ContactGeometry geometry = triangleAndPoint(1);
    ContactOptions changed = options;
    change(geometry, changed);
    return refusal([&] { ContactBarrier(geometry, x, changed); });
  };
  const auto says = [](const std::string& sentence, const char* part) {
    return sentence.find(part) != std::string::npos;
  };
  QCOMPARE(build([](auto&, auto&) {}), std::string());
  QVERIFY(says(build([](auto& g, auto&) { g.points = {4}; }), "node 4"));
  QVERIFY(says(build([](auto& g, auto&) { g.edges = {{2, -1}}; }), "nodes 2 and -1"));
  QVERIFY(says(build([](auto& g, auto&) { g.triangles[0][2] = 1; }), "twice"));
  QVERIFY(says(build([](auto& g, auto&) { g.edges = {{2, 3}}; }), "two bodies"));
  QVERIFY(says(build([](auto& g, auto&) { g.radii[1] = 0.1; }), "radii"));
  QVERIFY(says(build([](auto& g, auto&) { g.radii[1] = -0.1; }), "node 1"));
  QVERIFY(says(build([](auto& g, auto&) { g.radii[1] = std::nan(""); }), "node 1"));
  QVERIFY(says(build([](auto& g, auto&) { g.radii.pop_back(); }), "3 contact radii"));
  QVERIFY(says(build([](auto& g, auto&) { g.bodies = {1, 1, 1, 0}; }), "node 3"));
  QVERIFY(says(build([](auto&, auto& o) { o.range = 0; }), "range"));
  QVERIFY(says(build([](auto&, auto& o) { o.stiffness = -1; }), "stiffness"));
  QVERIFY(says(build([](auto&, auto& o) { o.separation = std::nan(""); }), "separation"));
  QVERIFY(says(refusal([&] { ContactBarrier(triangleAndPoint(1), x.leftCols(3), options); }), "3 positions"));
  QVERIFY(says(refusal([&] { ContactBarrier(triangleAndPoint(1), x / 0.0, options); }), "not finite"));
}

void TestContactInput::notFiniteIsNotFree() {
  Matrix3Xd x = triangleAndPointAt({0.2, 0.3, 0.05});
  ContactBarrier contact(triangleAndPoint(0), x, options);
  contact.update(x);
  x(1, 3) = std::nan("");
  QCOMPARE(contact.largestStep(x, Matrix3Xd::Zero(3, 4)), 0.0);
  QVERIFY(std::isnan(contact.smallestGap(x)));
  contact.update(x);
  QVERIFY(std::isinf(contact.value()));
}

QTEST_GUILESS_MAIN(TestContactInput)
#include "test_contact_input.moc"
