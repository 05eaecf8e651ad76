#pragma once

#include "core/harmonic/calibration.hpp"
#include "core/harmonic/floquet_stability.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// Parameters fitted to measured motions.
class CalibrationStudyResult final : public Result {
 public:
  std::string kind() const override { return "calibration"; }
  Json summary() const override;
  /// summary.json, parameters.csv (values with their intervals), correlation.csv, history.csv (a row an iterate),
  /// measured.csv (every measured value beside the fitted one), fitted.csv (the fitted motion over a period).
  void write(const std::filesystem::path& directory) const override;
  /// Of what is not determined or at a bound, residuals that are not noise, motions that are not stable.
  std::vector<std::string> warnings() const override;

  /// Names with changes that together leave all measured motions as they are, a sentence each.
  std::vector<std::string> undeterminedSentences() const;

  harmonic::CalibrationResult calibration;
  std::vector<std::string> files;                  ///< a measurement each, as in the scene
  std::vector<harmonic::MeasuredMotion> measured;  ///< likewise
  std::vector<harmonic::Stability> stabilities;    ///< likewise; empty if not asked for
  double confidence = 0;
  int harmonics = 0;
  int samples = 0;
};

}  // namespace pliant::scene
