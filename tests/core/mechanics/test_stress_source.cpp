#include <QTest>
#include <random>

#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/registry.hpp"

using namespace pliant;
using mechanics::ElasticAssembler;
using mechanics::Matrix;
using mechanics::Vector;

namespace {

Matrix hessian(const ElasticAssembler& assembler, const Vector& x, const Vector& from, const Vector& to) {
  const int rows = ElasticAssembler::paddedRows(1);
  const auto repeat = [&](const Vector& v) -> Matrix { return v.transpose().replicate(rows, 1); };
  const ElasticAssembler::StressSource stresses{repeat(from), repeat(to)};
  Matrix gradient, result;
  assembler.evaluate(repeat(x), gradient, &result, &stresses);
  return result;
}

Vector randomShape(const mechanics::Model& model, std::mt19937& random) {
  std::uniform_real_distribution<double> step(-0.1, 0.1);
  return model.restPositions + Vector::NullaryExpr(model.coordinateCount(), [&] { return step(random); });
}

}  // namespace

/// Hessians whose stresses belong to other positions, for every registered kind of energy.
class TestStressSource : public QObject {
  Q_OBJECT

 private slots:
  void ownStressesGiveTheOwnHessian_data() { kinds(); }
  void ownStressesGiveTheOwnHessian();
  void stressesAndPositionsAreSeparate_data() { kinds(); }
  void stressesAndPositionsAreSeparate();
  void stressesAreExtrapolatedLinearly_data() { kinds(); }
  void stressesAreExtrapolatedLinearly();
  void stretchedElementsHaveThem();

 private:
  static void kinds() {
    QTest::addColumn<int>("kind");
    for (std::size_t i = 0; i < mechanics::energyKinds().size(); ++i)
      QTest::newRow(mechanics::energyKinds()[i].name.c_str()) << static_cast<int>(i);
  }

  std::shared_ptr<const mechanics::Model> example() {
    QFETCH(int, kind);
    random_.seed(42 + kind);
    return std::make_shared<const mechanics::Model>(mechanics::energyKinds()[kind].example(random_));
  }

  std::mt19937 random_;
};

void TestStressSource::ownStressesGiveTheOwnHessian() {
  const auto model = example();
  const ElasticAssembler assembler(model);
  const Vector x = randomShape(*model, random_);
  Matrix gradient, own;
  assembler.evaluate(x.transpose().replicate(ElasticAssembler::paddedRows(1), 1), gradient, &own);
  QVERIFY((hessian(assembler, x, x, x) - own).norm() <= 1e-13 * own.norm());
}

void TestStressSource::stressesAndPositionsAreSeparate() {
  // H(x; y) is a function of x plus one of the stresses at y.
  const auto model = example();
  const ElasticAssembler assembler(model);
  const Vector x = randomShape(*model, random_);
  const Vector y = randomShape(*model, random_);
  const auto mixed = [&](const Vector& at, const Vector& stress) { return hessian(assembler, at, stress, stress); };
  const Matrix sum = mixed(x, x) + mixed(y, y);
  if (mixed(x, y) == mixed(x, x)) return;  // the kind has no stresses of its own
  QFETCH(int, kind);
  if (mechanics::energyKinds()[kind].name == "rod 3D") return;  // its stresses act along the edge, wherever that points
  QVERIFY((mixed(x, y) + mixed(y, x) - sum).norm() <= 1e-13 * sum.norm());
}

void TestStressSource::stressesAreExtrapolatedLinearly() {
  const auto model = example();
  const ElasticAssembler assembler(model);
  const Vector x = randomShape(*model, random_);
  const Vector from = randomShape(*model, random_);
  const Vector change = randomShape(*model, random_) - model->restPositions;
  const Matrix start = hessian(assembler, x, from, from);
  const Matrix rate = hessian(assembler, x, from, from + change) - start;
  // Linear in the change, with the slope of the stresses themselves.
  QVERIFY((hessian(assembler, x, from, from - 2 * change) - start + 2 * rate).norm() <= 1e-12 * start.norm());
  const double step = 1e-4;
  const Vector ahead = from + step * change, behind = from - step * change;
  const Matrix slope = (hessian(assembler, x, ahead, ahead) - hessian(assembler, x, behind, behind)) / (2 * step);
  QVERIFY((slope - rate).norm() <= 1e-9 * start.norm());
}

void TestStressSource::stretchedElementsHaveThem() {
  for (const auto& kind : mechanics::energyKinds()) {
    const auto starts = [&](const char* name) { return kind.name.starts_with(name); };
    if (!starts("membrane") && !starts("solid") && !starts("rigid_bar")) continue;
    const auto model = std::make_shared<const mechanics::Model>(kind.example(random_));
    const ElasticAssembler assembler(model);
    const Vector x = randomShape(*model, random_);
    const Vector y = randomShape(*model, random_);
    QVERIFY((hessian(assembler, x, y, y) - hessian(assembler, x, x, x)).norm() > 0);
  }
}

QTEST_GUILESS_MAIN(TestStressSource)
#include "test_stress_source.moc"
