#include "ui/jobs/compound_direction.hpp"

#include <QTest>
#include <cmath>

#include "core/harmonic/periodic_motion.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/model_builder.hpp"

using namespace pliant;
using jobs::CompoundDirection;
using jobs::MovableParameter;

namespace {

constexpr double omega = 1.2, alpha = 0.1, force = 0.1, mass = 0.9, stiffness = 2;

/// m x'' + α m x' + k x = F cos ωt.
const char* const text = R"({
  "schema_version": 1, "dimension": 1,
  "geometry": [{"name": "body", "type": "points", "points": [[0]]}],
  "point_masses": [{"name": "mass", "at": {"nodes": [0]}, "mass": 0.9, "minimum": 0.2, "maximum": 3}],
  "springs": [{"name": "spring", "type": "grounded", "at": {"nodes": [0]}, "direction": [1], "coefficients": [2]}],
  "loads": [{"name": "push", "type": "harmonic_force", "at": {"nodes": [0]}, "direction": [1],
             "harmonics": [{"amplitude": 0.1}]}],
  "damping": {"mass_proportional": 0.1},
  "parameters": [{"name": "stiffness", "pointer": "/springs/0/coefficients/0", "minimum": 0.5, "maximum": 4}],
  "probes": [{"name": "body", "at": {"nodes": [0]}}], "studies": []
})";

double pathLengthOf(double m, double k) { return 4 * force / std::hypot(k - m * omega * omega, alpha * m * omega); }

}  // namespace

/// Two parameters of an oscillator whose amplitude is known in closed form.
class TestCompoundDirection : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    model_ = scene::buildModel(scene::Scene::parse(text, "/nowhere", "oscillator"));
    problem_ = std::make_unique<harmonic::HarmonicBalanceProblem>(model_, math::HarmonicBasis(1, 16));
    base::ExecutionContext context;
    motion_ = harmonic::solvePeriodicMotion(*problem_, omega, {}, context);
    QVERIFY(motion_.report.converged());
    sensitivity_ = std::make_unique<harmonic::ResponseSensitivity>(*problem_, motion_);
    for (int i = 0; i < 2; ++i) {
      const auto& parameter = *model_->parameters.at(static_cast<std::size_t>(i));
      parameters_.push_back(
          {parameter.pointer(), i, parameter.value(*model_), parameter.minimum(*model_), parameter.maximum(*model_)});
    }
    massPointer_ = "/point_masses/0/mass";
    stiffnessPointer_ = "/springs/0/coefficients/0";
  }

  /// In parts of the ranges, as the gradient of the closed form.
  void isTheGradientInPartsOfRanges() {
    const double h = 1e-6;
    const double byMass = (pathLengthOf(mass + h, stiffness) - pathLengthOf(mass - h, stiffness)) / (2 * h) * 2.8;
    const double byStiffness = (pathLengthOf(mass, stiffness + h) - pathLengthOf(mass, stiffness - h)) / (2 * h) * 3.5;
    const double largest = std::max(std::abs(byMass), std::abs(byStiffness));
    for (const bool more : {true, false}) {
      const auto steps = direction(more, parameters_).steps();
      const double sign = more ? 1 : -1;
      QVERIFY(std::abs(steps.at(massPointer_) - sign * byMass / largest) < 1e-6);
      QVERIFY(std::abs(steps.at(stiffnessPointer_) - sign * byStiffness / largest) < 1e-6);
    }
  }

  void aShortWayDoesWhatItIsFor() {
    const CompoundDirection towards = direction(true, parameters_);
    const auto more = towards.valuesAt(0.02), less = towards.valuesAt(-0.02);
    const double now = pathLengthOf(mass, stiffness);
    QVERIFY(pathLengthOf(more.at(massPointer_), more.at(stiffnessPointer_)) > 1.01 * now);
    QVERIFY(pathLengthOf(less.at(massPointer_), less.at(stiffnessPointer_)) < 0.99 * now);
  }

  void valuesStayWithinTheirBounds() {
    const CompoundDirection towards = direction(true, parameters_);
    for (const double share : {-1.0, -0.5, 0.7, 1.0})
      for (const MovableParameter& parameter : parameters_) {
        const double value = towards.valuesAt(share).at(parameter.pointer);
        QVERIFY(value >= parameter.minimum && value <= parameter.maximum);
      }
  }

  /// A parameter at its bound stays, and the other one takes the whole way; the way back moves both.
  void whatIsAtItsBoundStays() {
    auto parameters = parameters_;
    parameters[1].minimum = parameters[1].value;  // less stiffness would be needed
    const CompoundDirection towards = direction(true, parameters);
    QVERIFY(!towards.valuesAt(0.5).contains(stiffnessPointer_));
    QCOMPARE(towards.steps().at(massPointer_), 1.0);
    QVERIFY(towards.valuesAt(-0.1).at(stiffnessPointer_) > stiffness);
  }

  void lockedOnesAreNotMoved() {
    const CompoundDirection alone = direction(true, {parameters_[0]});
    QCOMPARE(alone.valuesAt(0.1).size(), std::size_t(1));
    QVERIFY(std::abs(alone.valuesAt(0.1).at(massPointer_) - (mass + 0.1 * 2.8)) < 1e-12);
    QVERIFY(direction(true, {}).isEmpty());
  }

 private:
  CompoundDirection direction(bool more, std::vector<MovableParameter> parameters) const {
    jobs::CompoundGoal goal = jobs::amplitudeGoal("swing", {0});
    goal.wantsMore = more;
    return {*problem_, motion_.z, *sensitivity_, goal, std::move(parameters)};
  }

  std::shared_ptr<const mechanics::Model> model_;
  std::unique_ptr<harmonic::HarmonicBalanceProblem> problem_;
  harmonic::PeriodicMotion motion_;
  std::unique_ptr<harmonic::ResponseSensitivity> sensitivity_;
  std::vector<MovableParameter> parameters_;
  std::string massPointer_, stiffnessPointer_;
};

QTEST_GUILESS_MAIN(TestCompoundDirection)
#include "test_compound_direction.moc"
