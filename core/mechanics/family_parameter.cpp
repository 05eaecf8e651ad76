#include "core/mechanics/family_parameter.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/drive_frequency.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/joint_parameter.hpp"

namespace pliant::mechanics {

namespace {

/// Neighbours of a value, in steps, and their weights in the first derivative times the step.
struct Stencil {
  std::array<double, 5> offsets;
  std::array<double, 5> weights;
};

// Order 4, and nothing but the place: in the middle, and at either end of what the family knows.
constexpr std::array<Stencil, 3> stencils = {
    Stencil{{-2, -1, 0, 1, 2}, {1. / 12, -8. / 12, 0, 8. / 12, -1. / 12}},
    Stencil{{0, 1, 2, 3, 4}, {-25. / 12, 48. / 12, -36. / 12, 16. / 12, -3. / 12}},
    Stencil{{0, -1, -2, -3, -4}, {25. / 12, -48. / 12, 36. / 12, -16. / 12, 3. / 12}}};

/// A model with another value of a parameter, and its weight in a derivative.
struct Neighbour {
  double weight;
  std::shared_ptr<const Model> model;
};

double stepOf(const DesignParameter& parameter, const Model& model, double relativeStep) {
  const double range = parameter.maximum(model) - parameter.minimum(model);
  return relativeStep * std::max(std::abs(parameter.value(model)), 0.1 * range);
}

/// `modelAt` gets multiples of the step.
std::vector<Neighbour> neighboursOf(double step, const std::function<Model(double offset)>& modelAt) {
  for (const Stencil& stencil : stencils) try {
      std::vector<Neighbour> neighbours;
      for (std::size_t i = 0; i < stencil.offsets.size(); ++i)
        if (stencil.weights[i] != 0)
          neighbours.push_back(
              {stencil.weights[i] / step, std::make_shared<const Model>(modelAt(stencil.offsets[i] * step))});
      return neighbours;
    } catch (const base::InputError&) {
      // There are no models a little farther; the last stencil's error is the one to report.
      if (&stencil == &stencils.back()) throw;
    }
  return {};
}

std::vector<Neighbour> neighboursOf(const DesignParameter& parameter, const Model& model, double relativeStep) {
  return neighboursOf(stepOf(parameter, model, relativeStep),
                      [&](double offset) { return parameter.withValue(model, parameter.value(model) + offset); });
}

constexpr double usualStep = 2e-3;

class FamilyDerivative final : public ModelDerivative {
 public:
  FamilyDerivative(const Model& model, std::vector<Neighbour> neighbours)
      : ModelDerivative(model), neighbours_(std::move(neighbours)) {}

  SparseMatrix mass() const override {
    SparseMatrix sum = ModelDerivative::mass();
    for (const Neighbour& n : neighbours_) sum += n.weight * n.model->massMatrix();
    return sum;
  }

  Vector externalForce(math::Phases phases) const override {
    Vector sum = ModelDerivative::externalForce(phases);
    for (const Neighbour& n : neighbours_) sum += n.weight * n.model->externalForce(phases);
    return sum;
  }

  Matrix gradient(const Matrix& x) const override {
    Matrix padded(ElasticAssembler::paddedRows(static_cast<int>(x.rows())), x.cols()), gradient;
    padded.topRows(x.rows()) = x;
    padded.bottomRows(padded.rows() - x.rows()).rowwise() = x.row(0);
    Matrix sum = ModelDerivative::gradient(x);
    for (const Neighbour& n : neighbours_) {
      ElasticAssembler(n.model).evaluate(padded, gradient, nullptr);
      sum += n.weight * gradient.topRows(x.rows());
    }
    return sum;
  }

  Vector prescribed(math::Phases phases) const override {
    Vector sum = ModelDerivative::prescribed(phases);
    const Vector free = Vector::Zero(model_.dofs.freeCount());
    for (const Neighbour& n : neighbours_) sum += n.weight * n.model->configuration(free, phases);
    return sum;
  }

  double massDamping() const override {
    double sum = 0;
    for (const Neighbour& n : neighbours_) sum += n.weight * n.model->massDamping;
    return sum;
  }

  double stiffnessDamping() const override {
    double sum = 0;
    for (const Neighbour& n : neighbours_) sum += n.weight * n.model->stiffnessDamping;
    return sum;
  }

  double driveFrequency() const override {
    double sum = 0;
    for (const Neighbour& n : neighbours_) sum += n.weight * mechanics::driveFrequency(*n.model).value_or(0);
    return sum;
  }

 private:
  std::vector<Neighbour> neighbours_;
};

class FamilyMember final : public JointParameter {
 public:
  FamilyMember(int index, FamilyParameter parameter, std::shared_ptr<const ModelFamily> family)
      : index_(index), parameter_(std::move(parameter)), family_(std::move(family)) {}

  std::string name() const override { return parameter_.name; }
  base::Dimension dimension() const override { return parameter_.dimension; }
  std::string pointer() const override { return parameter_.pointer; }
  double value(const Model& model) const override { return model.familyValues.at(index_); }
  double minimum(const Model&) const override { return parameter_.minimum; }
  double maximum(const Model&) const override { return parameter_.maximum; }

  const void* group() const override { return family_.get(); }
  Model withJointValues(const Model& model, const std::vector<const JointParameter*>& members,
                        const std::vector<double>& values) const override {
    std::vector<double> all = model.familyValues;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (!std::isfinite(values[i]))
        throw base::InputError("", "parameter '" + members[i]->name() + "' must be finite");
      all.at(static_cast<const FamilyMember*>(members[i])->index_) = values[i];
    }
    Model changed = (*family_)(all);
    if (changed.coordinateCount() != model.coordinateCount() ||
        changed.dofs.freeCoordinates != model.dofs.freeCoordinates)
      throw base::InputError("", "parameter '" + parameter_.name + "' must not change which coordinates there are");
    changed.parameters = model.parameters;
    return withParameterValues(changed, others(model), otherValues(model));
  }

  std::unique_ptr<ModelDerivative> derivative(const Model& model) const override {
    return std::make_unique<FamilyDerivative>(model, neighboursOf(*this, model, usualStep));
  }

 private:
  /// The parameters that the family does not know.
  std::vector<std::shared_ptr<const DesignParameter>> others(const Model& model) const {
    std::vector<std::shared_ptr<const DesignParameter>> found;
    for (const auto& parameter : model.parameters)
      if (const auto* joint = dynamic_cast<const JointParameter*>(parameter.get()); !joint || joint->group() != group())
        found.push_back(parameter);
    return found;
  }
  Vector otherValues(const Model& model) const {
    const auto found = others(model);
    Vector values(static_cast<Eigen::Index>(found.size()));
    for (std::size_t i = 0; i < found.size(); ++i) values[static_cast<Eigen::Index>(i)] = found[i]->value(model);
    return values;
  }

  int index_;
  FamilyParameter parameter_;
  std::shared_ptr<const ModelFamily> family_;
};

}  // namespace

double derivativeOf(const std::function<double(const Model&)>& number, const DesignParameter& parameter,
                    const Model& model, double relativeStep) {
  double sum = 0;
  for (const Neighbour& neighbour : neighboursOf(parameter, model, relativeStep))
    sum += neighbour.weight * number(*neighbour.model);
  return sum;
}

std::unique_ptr<ModelDerivative> derivativeAlong(const Model& model,
                                                 const std::vector<std::shared_ptr<const DesignParameter>>& parameters,
                                                 const Vector& direction) {
  Vector values(direction.size());
  double step = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    const DesignParameter& parameter = *parameters[static_cast<std::size_t>(i)];
    values[i] = parameter.value(model);
    if (direction[i] != 0) step = std::min(step, stepOf(parameter, model, usualStep) / std::abs(direction[i]));
  }
  if (!std::isfinite(step)) return std::make_unique<ModelDerivative>(model);
  return std::make_unique<FamilyDerivative>(model, neighboursOf(step, [&](double offset) {
                                              return withParameterValues(
                                                  model, parameters, values + offset * direction);
                                            }));
}

std::shared_ptr<const DesignParameter> makeFamilyParameter(int index, FamilyParameter parameter,
                                                           std::shared_ptr<const ModelFamily> family) {
  return std::make_shared<FamilyMember>(index, std::move(parameter), std::move(family));
}

}  // namespace pliant::mechanics
