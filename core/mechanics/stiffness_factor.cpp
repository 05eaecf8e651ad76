#include "core/mechanics/stiffness_factor.hpp"

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/joint_parameter.hpp"
#include "core/mechanics/membrane_element.hpp"
#include "core/mechanics/solid_element.hpp"

namespace pliant::mechanics {

namespace {

/// An element whose energy is multiplied.
template <class Element>
struct ScaledElement {
  static constexpr int coordinates = Element::coordinates;
  static constexpr std::string_view name = Element::name;

  Element element;
  double scale = 1;

  template <class T>
  T evaluate(const std::array<T, coordinates>& x, std::array<T, coordinates>* gradient,
             std::array<T, packedSize(coordinates)>* hessian, const std::array<T, coordinates>* stressFrom = nullptr,
             const std::array<T, coordinates>* stressTo = nullptr) const {
    const T value = element.evaluate(x, gradient, hessian, stressFrom, stressTo);
    if (gradient)
      for (T& g : *gradient) g = scale * g;
    if (hessian)
      for (T& h : *hessian) h = scale * h;
    return scale * value;
  }

  template <class T>
  requires requires(const Element& e, std::array<T, coordinates> x, std::array<T, packedSize(coordinates)> h) {
    e.convexHessian(x, h);
  }
  void convexHessian(const std::array<T, coordinates>& x, std::array<T, packedSize(coordinates)>& hessian) const {
    element.convexHessian(x, hessian);
    for (T& h : hessian) h = scale * h;
  }
};

/// An energy whose elements have factors.
class FactoredEnergy : public Energy {
 public:
  virtual const std::vector<double>& factors() const = 0;
  virtual std::shared_ptr<const Energy> withFactors(std::vector<double> factors) const = 0;
  virtual FactoredParts parts() const = 0;
  /// The gradient of an element by its coordinates as if its factor were 1, for each configuration (a row of `x`).
  virtual Matrix unitGradient(int element, const Matrix& x) const = 0;
};

template <class Element>
class FactoredElements final : public FactoredEnergy {
 public:
  /// `made` has the elements as they are with the factors `initial`.
  FactoredElements(std::shared_ptr<const ElementEnergy<Element>> made, std::vector<double> initial,
                   std::vector<double> factors)
      : made_(std::move(made)),
        initial_(std::move(initial)),
        factors_(std::move(factors)),
        scaled_(scaled(*made_, initial_, factors_)) {}

  std::string_view name() const override { return Element::name; }
  int elementCount() const override { return scaled_.elementCount(); }
  std::span<const int> elementCoordinates(int element) const override { return scaled_.elementCoordinates(element); }
  void accumulate(const EvaluationBlock<double>& block) const override { scaled_.accumulate(block); }
  void accumulate(const EvaluationBlock<math::Packet>& block) const override { scaled_.accumulate(block); }

  const std::vector<double>& factors() const override { return factors_; }
  std::shared_ptr<const Energy> withFactors(std::vector<double> factors) const override {
    return std::make_shared<FactoredElements>(made_, initial_, std::move(factors));
  }

  FactoredParts parts() const override {
    FactoredParts parts{made_, factors_};
    for (std::size_t e = 0; e < factors_.size(); ++e) parts.scales[e] /= initial_[e];
    return parts;
  }

  Matrix unitGradient(int element, const Matrix& x) const override {
    constexpr int d = Element::coordinates, width = math::Packet::width;
    const auto index = static_cast<std::size_t>(element);
    const std::span<const int> coordinates = elementCoordinates(element);
    Matrix result(x.rows(), d);
    std::array<math::Packet, d> at, gradient;
    std::array<double, width> lanes;
    for (Eigen::Index first = 0; first < x.rows(); first += width) {
      const Eigen::Index count = std::min<Eigen::Index>(width, x.rows() - first);
      for (int i = 0; i < d; ++i) {
        for (int lane = 0; lane < width; ++lane)
          lanes[lane] = x(first + std::min<Eigen::Index>(lane, count - 1), coordinates[i]);
        math::load(lanes.data(), at[i]);
      }
      made_->elements()[index].evaluate(at, &gradient, static_cast<std::array<math::Packet, packedSize(d)>*>(nullptr));
      for (int i = 0; i < d; ++i) {
        math::store(lanes.data(), gradient[i]);
        for (Eigen::Index lane = 0; lane < count; ++lane)
          result(first + lane, i) = lanes[static_cast<std::size_t>(lane)] / initial_[index];
      }
    }
    return result;
  }

 private:
  static ElementEnergy<ScaledElement<Element>> scaled(const ElementEnergy<Element>& made,
                                                      const std::vector<double>& initial,
                                                      const std::vector<double>& factors) {
    std::vector<ScaledElement<Element>> elements;
    std::vector<std::array<int, Element::coordinates>> coordinates;
    for (std::size_t e = 0; e < factors.size(); ++e) {
      elements.push_back({made.elements()[e], factors[e] / initial[e]});
      const std::span<const int> from = made.elementCoordinates(static_cast<int>(e));
      std::copy(from.begin(), from.end(), coordinates.emplace_back().begin());
    }
    return {std::move(elements), std::move(coordinates)};
  }

  std::shared_ptr<const ElementEnergy<Element>> made_;
  std::vector<double> initial_;
  std::vector<double> factors_;
  ElementEnergy<ScaledElement<Element>> scaled_;
};

template <class Element>
std::shared_ptr<const FactoredEnergy> factoredAs(const std::shared_ptr<const Energy>& energy,
                                                 const std::vector<double>& initial) {
  auto elements = std::dynamic_pointer_cast<const ElementEnergy<Element>>(energy);
  if (!elements) return nullptr;
  std::vector<double> factors = initial;
  if (factors.empty()) factors.assign(static_cast<std::size_t>(elements->elementCount()), 1.0);
  requireFactors(factors, static_cast<std::size_t>(elements->elementCount()));
  return std::make_shared<FactoredElements<Element>>(std::move(elements), factors, factors);
}

/// The energy with factors, if it has none yet; null if it cannot have any.
std::shared_ptr<const FactoredEnergy> factored(const std::shared_ptr<const Energy>& energy,
                                               const std::vector<double>& initial) {
  if (auto already = std::dynamic_pointer_cast<const FactoredEnergy>(energy)) return already;
  for (auto found : {factoredAs<MembraneElement<2>>(energy, initial), factoredAs<MembraneElement<3>>(energy, initial),
                     factoredAs<SolidElement>(energy, initial)})
    if (found) return found;
  return nullptr;
}

class StiffnessFactorDerivative final : public ElasticDerivative {
 public:
  StiffnessFactorDerivative(const Model& model, std::shared_ptr<const FactoredEnergy> energy, int element)
      : ElasticDerivative(model), energy_(std::move(energy)), element_(element) {}

  std::span<const int> coordinates() const override { return energy_->elementCoordinates(element_); }
  Matrix coordinateGradient(const Matrix& x) const override { return energy_->unitGradient(element_, x); }

 private:
  std::shared_ptr<const FactoredEnergy> energy_;
  int element_;
};

struct FactorGroup {
  int energy;
  StiffnessFactorOptions options;
};

class StiffnessFactor final : public JointParameter {
 public:
  StiffnessFactor(std::shared_ptr<const FactorGroup> group, int element)
      : group_(std::move(group)), element_(element) {}

  std::string name() const override { return group_->options.name + " " + std::to_string(element_); }
  base::Dimension dimension() const override { return base::dimensions::none; }
  std::string pointer() const override { return group_->options.pointer + "/" + std::to_string(element_); }
  double value(const Model& model) const override {
    const auto& energy = model.energies.at(static_cast<std::size_t>(group_->energy));
    const auto index = static_cast<std::size_t>(element_);
    if (const auto* found = dynamic_cast<const FactoredEnergy*>(energy.get())) return found->factors()[index];
    return group_->options.values.empty() ? 1 : group_->options.values[index];
  }
  double minimum(const Model&) const override { return group_->options.minimum; }
  double maximum(const Model&) const override { return group_->options.maximum; }

  ElementPlace place() const { return {group_->energy, element_}; }

  const void* group() const override { return group_.get(); }
  Model withJointValues(const Model& model, const std::vector<const JointParameter*>& members,
                        const std::vector<double>& values) const override {
    const auto energy = energyOf(model);
    std::vector<double> factors = energy->factors();
    for (std::size_t i = 0; i < members.size(); ++i)
      factors[static_cast<std::size_t>(static_cast<const StiffnessFactor*>(members[i])->element_)] = values[i];
    requireFactors(factors, factors.size());
    Model changed = model;
    changed.energies[static_cast<std::size_t>(group_->energy)] = energy->withFactors(std::move(factors));
    return changed;
  }

  std::unique_ptr<ModelDerivative> derivative(const Model& model) const override {
    return std::make_unique<StiffnessFactorDerivative>(model, energyOf(model), element_);
  }

 private:
  /// A model that was made anew, by another parameter's change, has its energy without factors.
  std::shared_ptr<const FactoredEnergy> energyOf(const Model& model) const {
    return factored(model.energies.at(static_cast<std::size_t>(group_->energy)), group_->options.values);
  }

  std::shared_ptr<const FactorGroup> group_;
  int element_;
};

}  // namespace

Matrix ElasticDerivative::gradient(const Matrix& x) const {
  Matrix all = Matrix::Zero(x.rows(), x.cols());
  const std::span<const int> where = coordinates();
  const Matrix local = coordinateGradient(x);
  for (std::size_t i = 0; i < where.size(); ++i) all.col(where[i]) += local.col(static_cast<Eigen::Index>(i));
  return all;
}

FactoredParts withoutFactors(const std::shared_ptr<const Energy>& energy) {
  const auto* found = dynamic_cast<const FactoredEnergy*>(energy.get());
  return found ? found->parts() : FactoredParts{energy, {}};
}

std::optional<ElementPlace> factoredElement(const DesignParameter& parameter) {
  const auto* factor = dynamic_cast<const StiffnessFactor*>(&parameter);
  return factor ? std::optional(factor->place()) : std::nullopt;
}

std::vector<std::shared_ptr<const DesignParameter>> makeStiffnessFactors(const Model& model, int energy,
                                                                         const StiffnessFactorOptions& options) {
  const auto found = factored(model.energies.at(static_cast<std::size_t>(energy)), options.values);
  if (!found) throw base::InputError("", "only membranes and solids can have a factor of stiffness for each element");
  const auto group = std::make_shared<const FactorGroup>(FactorGroup{energy, options});
  std::vector<std::shared_ptr<const DesignParameter>> parameters;
  for (int element = 0; element < found->elementCount(); ++element)
    parameters.push_back(std::make_shared<StiffnessFactor>(group, element));
  return parameters;
}

}  // namespace pliant::mechanics
