#include <Eigen/Dense>
#include <QTest>
#include <cmath>
#include <random>

#include "core/geometry/mesh_generators.hpp"
#include "core/math/parallel.hpp"
#include "tests/core/mechanics/contact_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using geometry::SimplexPair;

namespace {

double barrier(double gap, double range = options.range) {
  return gap < range ? -options.stiffness * std::pow(gap - range, 2) * std::log(gap / range) : 0;
}

/// Two crumpled sheets of deformable nodes, one above the other, and a body of two triangles below.
struct Layers {
  ContactGeometry geometry;
  Matrix3Xd x;
};

Layers makeLayers(int cells, double distance, unsigned seed) {
  std::mt19937 random(seed);
  const geometry::SurfaceMesh sheet = geometry::makeGrid(1, 1, cells, cells), floor = geometry::makeGrid(2, 2, 1, 1);
  const int n = static_cast<int>(sheet.points.cols()), m = static_cast<int>(floor.points.cols());
  std::uniform_real_distribution<double> jitter(-0.3 * distance, 0.3 * distance);
  Layers layers;
  layers.x.resize(3, 2 * n + m);
  layers.x << sheet.points, sheet.points, floor.points;
  layers.x.row(2).segment(n, n).array() += distance;
  layers.x.row(2).tail(m).array() -= distance;
  for (int i = 0; i < 2 * n; ++i) layers.x.col(i) += Vector3d(jitter(random), jitter(random), jitter(random));
  for (int i = 0; i < 3; ++i)
    for (auto triangle : i < 2 ? sheet.triangles : floor.triangles) {
      for (int& node : triangle) node += i * n;
      layers.geometry.triangles.push_back(triangle);
    }
  layers.geometry.radii.assign(2 * n + m, 0);
  layers.geometry.bodies.assign(2 * n, 0);
  layers.geometry.bodies.resize(2 * n + m, 1);
  return layers;
}

MatrixXd dense(const std::vector<ContactBlock>& blocks, int nodes) {
  MatrixXd matrix = MatrixXd::Zero(3 * nodes, 3 * nodes);
  for (const ContactBlock& block : blocks) {
    matrix.block<3, 3>(3 * block.row, 3 * block.column) += block.entry;
    if (block.row != block.column) matrix.block<3, 3>(3 * block.column, 3 * block.row) += block.entry.transpose();
  }
  return matrix;
}

}  // namespace

class TestContactBarrier : public QObject {
  Q_OBJECT

 private slots:
  void energiesOfKnownGaps();
  void parallelCapsulesRepel();
  void gradientOfManyContacts();
  void hessianOfOneContact();
  void hessianIsPositive();
  void candidatesAreKeptSafely();
  void whatDoesNotCollide();
  void stepsAgainstClosedForms();
  void smallestGapOfAllPairs();
  void sameForAnyNumberOfThreads();
};

void TestContactBarrier::energiesOfKnownGaps() {
  ContactBarrier point(triangleAndPoint(0, 0.02), triangleAndPointAt({0.2, 0.3, 0.05}), options);
  point.update(triangleAndPointAt({0.2, 0.3, 0.05}));
  QCOMPARE(point.value(), barrier(0.03));
  QCOMPARE(point.contacts().size(), std::size_t(1));
  const Contact contact = point.contacts()[0];
  QVERIFY((contact.pair == ContactPair{SimplexPair::pointTriangle, {3, 0, 1, 2}}));
  QVERIFY(std::abs(contact.gap - 0.03) < 1e-15 && (contact.place - Vector3d(0.2, 0.3, 0.025)).norm() < 1e-15);
  const double slope = (barrier(0.03 + 1e-7) - barrier(0.03 - 1e-7)) / 2e-7;
  QVERIFY((contact.force - Vector3d(0, 0, -slope)).norm() < 1e-6);
  point.update(triangleAndPointAt({0.2, 0.3, -0.13}));
  QCOMPARE(point.value(), 0.0);
  QVERIFY(point.contacts().empty());

  // Two spheres; a separation counts as a radius.
  ContactOptions apart = options;
  apart.separation = 0.01;
  Matrix3Xd x = Matrix3Xd::Zero(3, 2);
  x.col(1) << 0, 0.3, 0.4;
  ContactBarrier spheres(
      {.triangles = {}, .edges = {}, .points = {0, 1}, .radii = {0.2, 0.25}, .bodies = {0, 2}}, x, apart);
  spheres.update(x);
  QVERIFY(std::abs(spheres.value() - barrier(0.04)) < 1e-14);
  QVERIFY(std::abs(spheres.smallestGap(x) - 0.04) < 1e-14);
}

void TestContactBarrier::parallelCapsulesRepel() {
  Matrix3Xd x(3, 4);
  x << 0, 1, 0.25, 1.25, 0, 0, 0.25, 0.25, 0, 0, 0, 0;
  ContactBarrier capsules(
      {.triangles = {}, .edges = {{0, 1}, {3, 2}}, .points = {}, .radii = {0.1, 0.1, 0.1, 0.1}, .bodies = {0, 0, 1, 1}},
      x, options);
  capsules.update(x);
  QVERIFY(std::abs(capsules.value() - 2 * barrier(0.05)) < 1e-14);  // of the two ends that lie beside the other
  Matrix3Xd gradient = Matrix3Xd::Zero(3, 4);
  capsules.addGradient(gradient);
  QVERIFY(gradient.row(1).sum() > 0);
  QVERIFY(gradient.rightCols(2).isZero(0));  // no derivatives of bodies
}

void TestContactBarrier::gradientOfManyContacts() {
  const Layers layers = makeLayers(4, 0.06, 1);
  ContactBarrier contact(layers.geometry, layers.x, options);
  contact.requireFree(layers.x);
  contact.update(layers.x);
  QVERIFY(contact.contacts().size() > 100);
  const int deformable = contact.primitives().deformableCount();
  Matrix3Xd gradient = Matrix3Xd::Zero(3, deformable);
  contact.addGradient(gradient);
  constexpr double step = 1e-7;
  for (int i = 0; i < 3 * deformable; ++i) {
    std::array<double, 2> values;
    for (const int side : {0, 1}) {
      Matrix3Xd x = layers.x;
      x.reshaped()[i] += side == 0 ? -step : step;
      contact.update(x);
      values[side] = contact.value();
    }
    QVERIFY(std::abs(gradient.reshaped()[i] - (values[1] - values[0]) / (2 * step)) <= 1e-6 * gradient.norm());
  }
}

void TestContactBarrier::hessianOfOneContact() {
  const Matrix3Xd x = triangleAndPointAt({0.2, 0.3, 0.04});
  ContactBarrier contact(triangleAndPoint(0), x, options), onBody(triangleAndPoint(1), x, options);
  MatrixXd differences(12, 12);
  constexpr double step = 1e-7;
  for (int i = 0; i < 12; ++i) {
    Matrix3Xd change = Matrix3Xd::Zero(3, 4);
    for (const double sign : {-1.0, 1.0}) {
      Matrix3Xd moved = x, gradient = Matrix3Xd::Zero(3, 4);
      moved.reshaped()[i] += sign * step;
      contact.update(moved);
      contact.addGradient(gradient);
      change += sign * gradient;
    }
    differences.col(i) = change.reshaped() / (2 * step);
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(0.5 * (differences + differences.transpose()));
  QVERIFY(solver.eigenvalues().minCoeff() < -1e-2);
  const MatrixXd positive =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() * solver.eigenvectors().transpose();
  std::vector<ContactBlock> blocks, blocksOnBody;
  contact.update(x);
  contact.addHessian(blocks);
  for (const ContactBlock& block : blocks) QVERIFY(block.row >= block.column);
  QVERIFY((dense(blocks, 4) - positive).norm() <= 1e-6 * positive.norm());
  onBody.update(x);
  onBody.addHessian(blocksOnBody);
  QVERIFY((dense(blocksOnBody, 3) - positive.topLeftCorner(9, 9)).norm() <= 1e-6 * positive.norm());
}

void TestContactBarrier::hessianIsPositive() {
  const Layers layers = makeLayers(4, 0.06, 2);
  ContactBarrier contact(layers.geometry, layers.x, options);
  contact.update(layers.x);
  std::vector<ContactBlock> blocks;
  contact.addHessian(blocks);
  const MatrixXd matrix = dense(blocks, contact.primitives().deformableCount());
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix).eigenvalues();
  QVERIFY(values.maxCoeff() > 0);
  QVERIFY(values.minCoeff() >= -1e-12 * values.maxCoeff());
}

void TestContactBarrier::candidatesAreKeptSafely() {
  // Sheets that approach each other in small moves: the same bytes as from a barrier that starts anew.
  const Layers layers = makeLayers(5, 0.4, 3);
  ContactBarrier contact(layers.geometry, layers.x, options);
  Matrix3Xd x = layers.x;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> jitter(-0.004, 0.004);
  std::size_t most = 0;
  for (int i = 0; i < 20; ++i) {
    for (double& coordinate : x.reshaped()) coordinate += jitter(random);
    x.row(2).head(36).array() += 0.008;
    x.row(2).segment(36, 36).array() -= 0.008;
    contact.update(x);
    ContactBarrier fresh(layers.geometry, layers.x, options);
    fresh.update(x);
    QCOMPARE(contact.contacts().size(), fresh.contacts().size());
    QVERIFY(contact.value() == fresh.value());
    most = std::max(most, contact.contacts().size());
  }
  QVERIFY(most > 100);
}

void TestContactBarrier::whatDoesNotCollide() {
  // Triangles that share nodes, and those of two bodies, may lie on each other; a deformable one may not.
  Matrix3Xd x(3, 6);
  x << 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0.01, 0.01, 0.01;
  ContactGeometry geometry{
      .triangles = {{0, 1, 2}, {3, 4, 5}}, .edges = {}, .points = {}, .radii = {0, 0, 0, 0, 0, 0}, .bodies = {}};
  for (const auto& [bodies, touch] : std::vector<std::pair<std::vector<int>, bool>>{{{1, 1, 1, 1, 1, 1}, false},
                                                                                    {{1, 1, 1, 2, 2, 2}, false},
                                                                                    {{0, 0, 0, 2, 2, 2}, true},
                                                                                    {{0, 0, 0, 0, 0, 0}, true}}) {
    geometry.bodies = bodies;
    ContactBarrier contact(geometry, x, options);
    contact.update(x);
    QCOMPARE(contact.value() > 0, touch);
    QCOMPARE(contact.smallestGap(x) < 1, touch);
    Matrix3Xd dx = Matrix3Xd::Zero(3, 6);
    dx.row(2).head(3).setConstant(1);
    QCOMPARE(contact.largestStep(x, dx) < 0.01, touch);
  }
  // Neighbours in a mesh whose heights are above the range.
  const geometry::SurfaceMesh mesh = geometry::makeGrid(1, 1, 5, 5);
  ContactBarrier sheet(
      {mesh.triangles, {}, {}, std::vector<double>(36, 0), std::vector<int>(36, 0)}, mesh.points, options);
  sheet.requireFree(mesh.points);
  sheet.update(mesh.points);
  QVERIFY(sheet.contacts().empty());
}

void TestContactBarrier::stepsAgainstClosedForms() {
  const Matrix3Xd x = triangleAndPointAt({0.2, 0.3, 1});
  const ContactBarrier contact(triangleAndPoint(1, 0.25), x, options);
  Matrix3Xd dx = Matrix3Xd::Zero(3, 4);
  for (const double share : {0.0, 1.0, 0.3}) {  // of the body's in the motion
    dx.row(2).head(3).setConstant(3 * (1 - share));
    dx(2, 3) = -3 * share;
    const double step = contact.largestStep(x, dx);
    QVERIFY(step < 0.25 && 3 * (0.25 - step) <= 0.01 * (1 + 1e-9));  // a gap of 0.75, closed with speed 3
    QCOMPARE(contact.largestStep(x, dx / 4.01), 1.0);
    QCOMPARE(contact.largestStep(x, -dx), 1.0);
  }
  dx.setZero();
  dx(2, 3) = -2;  // through to the other side
  QVERIFY(contact.largestStep(x, dx) < 0.375);
  QCOMPARE(contact.largestStep(triangleAndPointAt({0.2, 0.3, 0.2}), dx), 0.0);
}

void TestContactBarrier::smallestGapOfAllPairs() {
  for (const double distance : {0.01, 0.2, 3.0}) {
    const Layers layers = makeLayers(3, distance, 5);
    const ContactBarrier contact(layers.geometry, layers.x, options);
    double expected = std::numeric_limits<double>::infinity();
    const auto& triangles = layers.geometry.triangles;
    const auto measure = [&](SimplexPair pair, const std::array<int, 4>& nodes) {
      for (int i = 0; i < 4; ++i)
        if (std::count(nodes.begin(), nodes.end(), nodes[i]) > 1) return;
      geometry::Corners corners;
      for (int i = 0; i < 4; ++i) corners.col(i) = layers.x.col(nodes[i]);
      expected = std::min(expected, std::sqrt(geometry::closestPoints(pair, corners).squaredDistance));
    };
    for (const auto& [a, b, c] : triangles)
      for (const auto& [d, e, f] : triangles) {
        for (const int node : {d, e, f}) measure(SimplexPair::pointTriangle, {node, a, b, c});
        for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}})
          for (const auto& [r, s] : {std::pair{d, e}, {e, f}, {f, d}}) measure(SimplexPair::edgeEdge, {p, q, r, s});
      }
    QCOMPARE(contact.smallestGap(layers.x), expected);
  }
}

void TestContactBarrier::sameForAnyNumberOfThreads() {
  const Layers layers = makeLayers(12, 0.03, 6);
  Matrix3Xd dx = Matrix3Xd::Zero(3, layers.x.cols());
  dx.row(2).head(169).setConstant(0.2);
  std::array<std::vector<double>, 2> results;
  for (const int i : {0, 1}) {
    math::setThreadCount(i == 0 ? 1 : 4);
    ContactBarrier contact(layers.geometry, layers.x, options);
    contact.update(layers.x);
    Matrix3Xd gradient = Matrix3Xd::Zero(3, layers.x.cols());
    contact.addGradient(gradient);
    std::vector<ContactBlock> blocks;
    contact.addHessian(blocks);
    results[i].assign(gradient.data(), gradient.data() + gradient.size());
    for (const ContactBlock& block : blocks)
      results[i].insert(results[i].end(), block.entry.data(), block.entry.data() + 9);
    for (const double value : {contact.value(), contact.largestStep(layers.x, dx), contact.smallestGap(layers.x)})
      results[i].push_back(value);
  }
  math::setThreadCount(0);
  QVERIFY(results[0].size() > 10000);
  QVERIFY(results[0] == results[1]);
}

QTEST_GUILESS_MAIN(TestContactBarrier)
#include "test_contact_barrier.moc"
