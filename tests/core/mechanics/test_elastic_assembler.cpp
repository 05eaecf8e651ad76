#include <QTest>
#include <cstring>

#include "core/math/parallel.hpp"
#include "core/mechanics/spring.hpp"
#include "tests/core/mechanics/shell_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

bool sameBits(const Matrix& a, const Matrix& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

Model forkModel() {
  const geometry::SurfaceMesh mesh = geometry::makeFork({0.13, 0.14, 0.02, 0.04, 13, 14, 2});
  const ShellMaterial material{.youngModulus = 3e9, .poissonRatio = 0.36, .density = 1200, .thickness = 1e-3};
  Model model = modelOf(mesh, 3);
  model.energies.push_back(makeMembrane(3, model.restPositions, mesh.triangles, material));
  model.energies.push_back(makeHingeBending(model.restPositions, mesh.triangles, material));
  model.energies.push_back(makeSpring(3, mesh.groups.at("left_tip")[1], mesh.groups.at("right_tip")[1], 0.04, {{10}}));
  model.lockedCoordinates.assign(model.coordinateCount(), 0);
  for (const int node : mesh.groups.at("base"))
    for (int axis = 0; axis < 3; ++axis) model.lockedCoordinates[3 * node + axis] = 1;
  model.finish();
  return model;
}

}  // namespace

class TestElasticAssembler : public QObject {
  Q_OBJECT

 private slots:
  void patternIsSortedAndFree();
  void resultsDoNotDependOnThreads();
  void sampleRowsAreIndependent();
  void hessianOfFreeCoordinates();
};

void TestElasticAssembler::patternIsSortedAndFree() {
  const Model model = forkModel();
  const ElasticAssembler assembler(std::make_shared<const Model>(model));
  QCOMPARE(model.dofs.freeCount(), 3 * (144 - 3));
  for (int s = 0; s < assembler.entryCount(); ++s) {
    const int row = assembler.rows()[s], column = assembler.columns()[s];
    QVERIFY(0 <= column && column <= row && row < model.dofs.freeCount());
    if (s == 0) continue;
    const auto previous = std::pair(assembler.columns()[s - 1], assembler.rows()[s - 1]);
    QVERIFY(previous < std::pair(column, row));
  }
  QCOMPARE(ElasticAssembler::paddedRows(1), 8);
  QCOMPARE(ElasticAssembler::paddedRows(64), 64);
  QCOMPARE(ElasticAssembler::paddedRows(65), 72);
}

void TestElasticAssembler::resultsDoNotDependOnThreads() {
  const Model model = forkModel();
  const ElasticAssembler assembler(std::make_shared<const Model>(model));
  Matrix x = model.restPositions.transpose().replicate(64, 1);
  x += 1e-3 * Matrix::Random(x.rows(), x.cols());
  Matrix gradient[2], hessian[2];
  for (int i = 0; i < 2; ++i) {
    math::setThreadCount(1 + i);
    for (int repetition = 0; repetition < 5; ++repetition) {
      Matrix g, h;
      assembler.evaluate(x, g, &h);
      if (repetition > 0) QVERIFY(sameBits(g, gradient[i]) && sameBits(h, hessian[i]));
      gradient[i] = g;
      hessian[i] = h;
    }
  }
  math::setThreadCount(0);
  QVERIFY(sameBits(gradient[0], gradient[1]));
  QVERIFY(sameBits(hessian[0], hessian[1]));
}

void TestElasticAssembler::sampleRowsAreIndependent() {
  const Model model = forkModel();
  const ElasticAssembler assembler(std::make_shared<const Model>(model));
  Matrix x = model.restPositions.transpose().replicate(16, 1);
  x += 1e-3 * Matrix::Random(x.rows(), x.cols());
  Matrix gradient, hessian;
  assembler.evaluate(x, gradient, &hessian);
  x.row(5).setConstant(std::nan(""));
  Matrix gradientBeside, hessianBeside;
  assembler.evaluate(x, gradientBeside, &hessianBeside);
  for (int row = 0; row < 16; ++row) {
    QCOMPARE(sameBits(gradient.row(row), gradientBeside.row(row)), row != 5);
    QCOMPARE(sameBits(hessian.row(row), hessianBeside.row(row)), row != 5);
  }
}

void TestElasticAssembler::hessianOfFreeCoordinates() {
  Model locked = forkModel(), whole = locked;
  whole.lockedCoordinates.assign(whole.coordinateCount(), 0);
  whole.finish();
  const Vector x = locked.restPositions + 1e-3 * Vector::Random(locked.coordinateCount());
  const Matrix all = ElasticAssembler(std::make_shared<const Model>(whole)).hessian(x);
  const Matrix part = ElasticAssembler(std::make_shared<const Model>(locked)).hessian(x);
  const auto& free = locked.dofs.freeCoordinates;
  QVERIFY(part == all(free, free));
}

QTEST_GUILESS_MAIN(TestElasticAssembler)
#include "test_elastic_assembler.moc"
