#include "core/harmonic/design_constraint.hpp"

#include <algorithm>

#include "core/harmonic/path_length.hpp"
#include "core/harmonic/smooth_extreme.hpp"
#include "core/harmonic/stress_quantity.hpp"

namespace pliant::harmonic {

namespace {

constexpr int fewestClearanceInstants = 512;
constexpr int instantsPerExact = 4;  // times as many for exact values

ObjectiveValue zeroValue(const HarmonicBalanceProblem& problem) {
  const Model& model = problem.model();
  return {0, Matrix::Zero(problem.basis().size(), model.coordinateCount()),
          Vector::Zero(static_cast<Eigen::Index>(model.parameters.size()))};
}

/// All nodes by one along the first axis, whose kinetic energy tells the mass.
Vector translationOfAll(const Model& model) {
  Vector shift = Vector::Zero(model.coordinateCount());
  for (int node = 0; node < model.nodeCount(); ++node) shift[node * model.dimension] = 1;
  return shift;
}

class TotalMass final : public ConstraintQuantity {
 public:
  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector&) const override {
    ObjectiveValue result = zeroValue(problem);
    const Model& model = problem.model();
    const Vector shift = translationOfAll(model);
    result.value = totalMass(model);
    for (std::size_t i = 0; i < model.parameters.size(); ++i)
      result.byParameters[static_cast<Eigen::Index>(i)] =
          shift.dot(model.parameters[i]->derivative(model)->mass() * shift);
    return result;
  }

  double exactValue(const HarmonicBalanceProblem& problem, const Vector&) const override {
    return totalMass(problem.model());
  }
};

/// Distances of one place from something, and their gradients.
struct DistanceFrom {
  Vector position;
  Vector other;  ///< of the other node, if there is one
  Vector& gradient;

  double operator()(const Plane& plane) {
    gradient = plane.normal.normalized();
    return gradient.dot(position - plane.point);
  }
  double operator()(const Sphere& sphere) {
    const Vector offset = position - sphere.centre;
    gradient = directionOf(offset);
    return offset.norm() - sphere.radius;
  }
  double operator()(const OtherNode&) {
    const Vector offset = position - other;
    gradient = directionOf(offset);
    return offset.norm();
  }

  static Vector directionOf(const Vector& offset) {
    const double length = offset.norm();
    return length > 0 ? Vector(offset / length) : Vector::Unit(offset.size(), 0);
  }
};

class Clearance final : public ConstraintQuantity {
 public:
  explicit Clearance(ClearanceGoal goal) : goal_(std::move(goal)) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    ObjectiveValue result = zeroValue(problem);
    const Model& model = problem.model();
    const math::HarmonicBasis basis = instantsOf(problem, 1);
    std::vector<Matrix> gradients;
    const Eigen::ArrayXXd distances = distancesAt(problem, z, basis, &gradients);
    const SmoothMaximum smallest = smoothMaximum(-distances, goal_.sharpness);
    result.value = -smallest.value;
    for (std::size_t n = 0; n < goal_.nodes.size(); ++n) {
      const Matrix weighted = smallest.weights.col(static_cast<Eigen::Index>(n)).matrix().asDiagonal() * gradients[n];
      const Matrix byCoefficients = basis.synthesis().transpose() * weighted;
      result.byCoefficients.middleCols(goal_.nodes[n] * model.dimension, model.dimension) += byCoefficients;
      if (const auto* other = std::get_if<OtherNode>(&goal_.from))
        result.byCoefficients.middleCols(other->node * model.dimension, model.dimension) -= byCoefficients;
    }
    return result;
  }

  double exactValue(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    return distancesAt(problem, z, instantsOf(problem, instantsPerExact), nullptr).minCoeff();
  }

 private:
  static math::HarmonicBasis instantsOf(const HarmonicBalanceProblem& problem, int times) {
    const math::HarmonicBasis& basis = problem.basis();
    return {basis.harmonics(), times * std::max(fewestClearanceInstants, basis.samples())};
  }

  /// Instants x nodes; their gradients by each node's position: instants x dimension.
  Eigen::ArrayXXd distancesAt(const HarmonicBalanceProblem& problem, const Vector& z, const math::HarmonicBasis& basis,
                              std::vector<Matrix>* gradients) const {
    const int dimension = problem.model().dimension;
    const Matrix& instants = basis.synthesis();
    Matrix other;
    if (const auto* node = std::get_if<OtherNode>(&goal_.from))
      other = instants * nodeCoefficients(problem, z, node->node);
    Eigen::ArrayXXd distances(basis.samples(), static_cast<Eigen::Index>(goal_.nodes.size()));
    Vector gradient;
    for (std::size_t n = 0; n < goal_.nodes.size(); ++n) {
      const Matrix positions = instants * nodeCoefficients(problem, z, goal_.nodes[n]);
      Matrix ofNode(basis.samples(), dimension);
      for (Eigen::Index i = 0; i < positions.rows(); ++i) {
        DistanceFrom distance{positions.row(i).transpose(), {}, gradient};
        if (other.size() > 0) distance.other = other.row(i).transpose();
        distances(i, static_cast<Eigen::Index>(n)) = std::visit(distance, goal_.from);
        ofNode.row(i) = gradient.transpose();
      }
      if (gradients) gradients->push_back(std::move(ofNode));
    }
    return distances;
  }

  ClearanceGoal goal_;
};

std::shared_ptr<const ConstraintQuantity> clearanceExample(std::variant<Plane, Sphere, OtherNode> from) {
  return makeClearance({{1, 2}, std::move(from), 20});  // so that many instants count
}

/// A place far enough from where the nodes move.
Vector farAway(const HarmonicBalanceProblem& problem) {
  return Vector::Constant(problem.model().dimension, problem.model().restPositions.cwiseAbs().maxCoeff() + 1);
}

}  // namespace

double totalMass(const Model& model) {
  const Vector shift = translationOfAll(model);
  return shift.dot(model.massMatrix() * shift);
}

std::shared_ptr<const ConstraintQuantity> makeTotalMass() { return std::make_shared<TotalMass>(); }

std::shared_ptr<const ConstraintQuantity> makeClearance(ClearanceGoal goal) {
  return std::make_shared<Clearance>(std::move(goal));
}

const std::vector<ConstraintKind>& constraintKinds() {
  using Problem = HarmonicBalanceProblem;
  static const std::vector<ConstraintKind> kinds = {
      {"total mass", [](const Problem&, std::mt19937&) { return makeTotalMass(); }},
      {"strain of a triangle",
       [](const Problem&, std::mt19937&) {
         return makeLargestStrain({{{0, 1, 2}}, {}, 20});
       }},
      {"stress of a triangle",
       [](const Problem&, std::mt19937&) {
         return makeLargestStress({{{0, 1, 2}}, {}, mechanics::ElementMeasure::vonMises, 1e-3});
       }},
      {"clearance from a plane",
       [](const Problem& problem, std::mt19937& random) {
         std::normal_distribution<double> entry;
         const Vector normal = Vector::NullaryExpr(problem.model().dimension, [&] { return entry(random); });
         return clearanceExample(Plane{farAway(problem), normal});
       }},
      {"clearance from a sphere",
       [](const Problem& problem, std::mt19937&) {
         return clearanceExample(Sphere{farAway(problem), 0.1});
       }},
      {"clearance from a node", [](const Problem&, std::mt19937&) { return clearanceExample(OtherNode{0}); }}};
  return kinds;
}

}  // namespace pliant::harmonic
