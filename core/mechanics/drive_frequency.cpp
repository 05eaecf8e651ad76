#include "core/mechanics/drive_frequency.hpp"

#include <algorithm>

#include "core/mechanics/checks.hpp"

namespace pliant::mechanics {

namespace {

class FrequencyDerivative final : public ModelDerivative {
 public:
  using ModelDerivative::ModelDerivative;
  double driveFrequency() const override { return 1; }
};

class DriveFrequency final : public DesignParameter {
 public:
  explicit DriveFrequency(DriveFrequencyOptions options) : options_(std::move(options)) {
    requirePositive(options_.value, "the drive frequency '" + options_.name + "'");
  }

  std::string name() const override { return options_.name; }
  base::Dimension dimension() const override { return base::dimensions::angularFrequency; }
  std::string pointer() const override { return options_.pointer; }
  /// What stands in this model's own list, which another value replaces there.
  double value(const Model& model) const override {
    for (const auto& parameter : model.parameters)
      if (const DriveFrequency* same = asThis(*parameter)) return same->options_.value;
    return options_.value;
  }
  double minimum(const Model&) const override { return options_.minimum; }
  double maximum(const Model&) const override { return options_.maximum; }

  Model withValue(const Model& model, double value) const override {
    DriveFrequencyOptions changed = options_;
    changed.value = value;
    const auto other = std::make_shared<const DriveFrequency>(std::move(changed));
    Model result = model;
    for (auto& parameter : result.parameters)
      if (asThis(*parameter)) parameter = other;
    return result;
  }

  std::unique_ptr<ModelDerivative> derivative(const Model& model) const override {
    return std::make_unique<FrequencyDerivative>(model);
  }

 private:
  const DriveFrequency* asThis(const DesignParameter& parameter) const {
    const auto* frequency = dynamic_cast<const DriveFrequency*>(&parameter);
    return frequency && frequency->options_.pointer == options_.pointer ? frequency : nullptr;
  }

  DriveFrequencyOptions options_;
};

}  // namespace

std::shared_ptr<const DesignParameter> makeDriveFrequency(DriveFrequencyOptions options) {
  return std::make_shared<DriveFrequency>(std::move(options));
}

bool isDriveFrequency(const DesignParameter& parameter) {
  return dynamic_cast<const DriveFrequency*>(&parameter) != nullptr;
}

std::optional<double> driveFrequency(const Model& model) {
  for (const auto& parameter : model.parameters)
    if (isDriveFrequency(*parameter)) return parameter->value(model);
  return std::nullopt;
}

std::shared_ptr<const Model> withoutDriveFrequencies(std::shared_ptr<const Model> model,
                                                     const std::function<bool(const std::string& pointer)>& isKept) {
  const auto goes = [&](const std::shared_ptr<const DesignParameter>& parameter) {
    return isDriveFrequency(*parameter) && !isKept(parameter->pointer());
  };
  if (std::none_of(model->parameters.begin(), model->parameters.end(), goes)) return model;
  auto changed = std::make_shared<Model>(*model);
  std::erase_if(changed->parameters, goes);
  return changed;
}

}  // namespace pliant::mechanics
