#pragma once

#include <optional>
#include <vector>

#include "core/harmonic/curve_sensitivity.hpp"
#include "ui/jobs/motion_session.hpp"

namespace pliant::jobs {

/// How each point of a response curve moves with the parameters, as far as it has been found.
struct CurveSensitivity {
  std::vector<std::optional<harmonic::PointSensitivity>> points;
  std::vector<std::optional<harmonic::PeakSensitivity>> peaks;  ///< those of the points that are peaks
};

/// A response curve foretold for one probe.
struct PredictedCurve {
  struct Place {
    double omega = 0;       ///< [rad/s]
    double pathLength = 0;  ///< [m]
  };
  std::vector<Place> points;  ///< in the order of the curve
  std::vector<int> branches;  ///< which one each of the points is on
  std::vector<Place> peaks;
};

/// Foretells a solved response curve for the parameters as they are set: what each of its points and peaks does with
/// them is found on a thread of its own, coarsely first, and from then on a prediction is a linear combination.
class CurvePredictor final : public QObject {
  Q_OBJECT

 public:
  CurvePredictor(document::Document& document, MotionSession& session, QObject* parent = nullptr);

  /// What is foretold from here on; null: nothing. A curve that still grows is best not given.
  void setCurve(std::shared_ptr<const scene::HarmonicResult> curve, const std::optional<scene::Scene>& solvedScene);

  /// Of the curve; null if there is none.
  std::shared_ptr<const mechanics::Model> model() const { return curve_ ? curve_->problem->sharedModel() : nullptr; }
  /// None if the parameters are those of the curve, more than they has changed, or too little is known yet.
  std::optional<PredictedCurve> predict(int probe) const;
  /// Whether all of the curve's points are known.
  bool isComplete() const { return complete_; }

 Q_SIGNALS:
  /// More of the curve can be foretold, or less.
  void changed();

 private:
  void compare();
  void compute();

  document::Document& document_;
  MotionSession& session_;
  std::shared_ptr<const scene::HarmonicResult> curve_;
  std::optional<scene::Scene> solvedScene_;
  bool comparable_ = false;
  std::shared_ptr<const CurveSensitivity> sensitivity_;
  bool complete_ = false;
  JobRunner runner_;
};

}  // namespace pliant::jobs
