#pragma once

#include "core/harmonic/method_comparison.hpp"
#include "core/harmonic/time_integration.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// The last period of a time integration.
class TimeResult final : public Result {
 public:
  std::string kind() const override { return "time"; }
  Json summary() const override;
  /// summary.json, trajectories.csv (of the probes in the last period), periods.csv (how the periods came to agree).
  void write(const std::filesystem::path& directory) const override;

  std::shared_ptr<const mechanics::Model> model;
  harmonic::TimeIntegration integration;
};

/// Harmonic balance against time integration.
class ComparisonResult final : public Result {
 public:
  std::string kind() const override { return "comparison"; }
  Json summary() const override;
  /// summary.json, harmonics.csv (Fig. 2.3: the error over the harmonics), steps.csv (that of Newmark's method over the
  /// steps), samples.csv (Fig. 2.15: the difference over equally many samples and steps).
  void write(const std::filesystem::path& directory) const override;

  double omega = 0;
  harmonic::MethodComparison comparison;
};

}  // namespace pliant::scene
