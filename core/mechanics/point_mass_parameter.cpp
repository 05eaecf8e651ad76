#include "core/mechanics/point_mass_parameter.hpp"

#include "core/mechanics/checks.hpp"

namespace pliant::mechanics {

namespace {

class PointMassDerivative final : public ModelDerivative {
 public:
  PointMassDerivative(const Model& model, int index)
      : ModelDerivative(model), nodes_(model.pointMasses.at(index).nodes) {}

  SparseMatrix mass() const override {
    SparseMatrix derivative(model_.coordinateCount(), model_.coordinateCount());
    std::vector<Eigen::Triplet<double>> entries;
    for (const int node : nodes_)
      for (int axis = 0; axis < model_.dimension; ++axis)
        entries.emplace_back(node * model_.dimension + axis, node * model_.dimension + axis, 1.0);
    derivative.setFromTriplets(entries.begin(), entries.end());
    return derivative;
  }

  Vector externalForce(math::Phases) const override {
    Vector derivative = Vector::Zero(model_.coordinateCount());
    for (const int node : nodes_) derivative.segment(node * model_.dimension, model_.dimension) += model_.gravity;
    return derivative;
  }

 private:
  const std::vector<int>& nodes_;
};

class PointMassParameter final : public DesignParameter {
 public:
  PointMassParameter(int index, std::string name) : index_(index), name_(std::move(name)) {}

  std::string name() const override { return name_; }
  base::Dimension dimension() const override { return base::dimensions::mass; }
  std::string pointer() const override { return "/point_masses/" + std::to_string(index_) + "/mass"; }
  double value(const Model& model) const override { return model.pointMasses.at(index_).mass; }
  double minimum(const Model& model) const override { return model.pointMasses.at(index_).minimum; }
  double maximum(const Model& model) const override { return model.pointMasses.at(index_).maximum; }

  Model withValue(const Model& model, double value) const override {
    requireNotNegative(value, "point mass '" + name_ + "'");
    Model changed = model;
    changed.pointMasses.at(index_).mass = value;
    return changed;
  }

  std::unique_ptr<ModelDerivative> derivative(const Model& model) const override {
    return std::make_unique<PointMassDerivative>(model, index_);
  }

 private:
  int index_;
  std::string name_;
};

}  // namespace

std::shared_ptr<const DesignParameter> makePointMassParameter(int index, std::string name) {
  return std::make_shared<PointMassParameter>(index, std::move(name));
}

}  // namespace pliant::mechanics
