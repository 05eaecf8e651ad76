#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/registry.hpp"

using namespace pliant;
using namespace pliant::mechanics;

/// Every registered kind of design parameter: its derivatives against differences of the changed model.
class TestParameters : public QObject {
  Q_OBJECT

 private slots:
  void derivativesAgreeWithDifferences_data();
  void derivativesAgreeWithDifferences();
  void pointMassKnowsItsPlace();
};

void TestParameters::derivativesAgreeWithDifferences_data() {
  QTest::addColumn<int>("kind");
  for (std::size_t i = 0; i < parameterKinds().size(); ++i)
    QTest::newRow(parameterKinds()[i].name.c_str()) << static_cast<int>(i);
}

void TestParameters::derivativesAgreeWithDifferences() {
  QFETCH(int, kind);
  std::mt19937 random(99);
  for (int example = 0; example < 5; ++example) {
    const Model model = parameterKinds()[kind].example(random);
    const DesignParameter& parameter = *model.parameters.at(0);
    const double value = parameter.value(model), step = 1e-3 * (1 + std::abs(value)), tau = 0.7;
    QVERIFY(parameter.minimum(model) <= value && value <= parameter.maximum(model));
    QCOMPARE(parameter.value(parameter.withValue(model, value + step)), value + step);
    QCOMPARE(parameter.value(model), value);

    const Vector x = model.restPositions + 0.1 * Vector::Random(model.coordinateCount());
    const auto shifted = [&](double by) { return parameter.withValue(model, value + by); };
    const auto gradient = [&](double by) {
      return ElasticAssembler(std::make_shared<const Model>(shifted(by))).gradient(x);
    };
    // Richardson's extrapolation of central differences, of fourth order.
    const auto difference = [&](const auto& f) {
      return ((8.0 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step)).eval();
    };
    const Matrix mass = difference([&](double by) { return Matrix(shifted(by).massMatrix()); });
    const Vector force = difference([&](double by) { return shifted(by).externalForce(tau); });
    const Vector elastic = difference(gradient);
    const Vector prescribed =
        difference([&](double by) { return shifted(by).configuration(Vector::Zero(model.dofs.freeCount()), tau); });
    const double size = 1 + mass.norm() + force.norm() + elastic.norm() + prescribed.norm();
    const auto derivative = parameter.derivative(model);
    QVERIFY((Matrix(derivative->mass()) - mass).norm() <= 1e-9 * size);
    QVERIFY((derivative->externalForce(tau) - force).norm() <= 1e-9 * size);
    QVERIFY((derivative->gradient(x.transpose()).transpose() - elastic).norm() <= 1e-9 * size);
    QVERIFY((derivative->prescribed(tau) - prescribed).norm() <= 1e-9 * size);
    QVERIFY(mass.norm() + force.norm() + elastic.norm() + prescribed.norm() > 0);
  }
}

void TestParameters::pointMassKnowsItsPlace() {
  std::mt19937 random(1);
  const Model model = parameterKinds()[0].example(random);
  const DesignParameter& parameter = *model.parameters.at(0);
  QCOMPARE(parameter.name(), std::string("tip"));
  QCOMPARE(parameter.pointer(), std::string("/point_masses/0/mass"));
  QVERIFY(parameter.dimension() == base::dimensions::mass);
  QVERIFY_EXCEPTION_THROWN(parameter.withValue(model, -1e-9), base::InputError);
  QVERIFY_EXCEPTION_THROWN(parameter.withValue(model, std::nan("")), base::InputError);
}

QTEST_GUILESS_MAIN(TestParameters)
#include "test_parameters.moc"
