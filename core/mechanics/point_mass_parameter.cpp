#include "core/mechanics/point_mass_parameter.hpp"

#include "core/mechanics/checks.hpp"

namespace pliant::mechanics {

namespace {

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

  SparseMatrix massDerivative(const Model& model) const override {
    SparseMatrix derivative(model.coordinateCount(), model.coordinateCount());
    std::vector<Eigen::Triplet<double>> entries;
    for (const int node : model.pointMasses.at(index_).nodes)
      for (int axis = 0; axis < model.dimension; ++axis)
        entries.emplace_back(node * model.dimension + axis, node * model.dimension + axis, 1.0);
    derivative.setFromTriplets(entries.begin(), entries.end());
    return derivative;
  }

  Vector externalForceDerivative(const Model& model, double) const override {
    Vector derivative = Vector::Zero(model.coordinateCount());
    for (const int node : model.pointMasses.at(index_).nodes)
      derivative.segment(node * model.dimension, model.dimension) += model.gravity;
    return derivative;
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
