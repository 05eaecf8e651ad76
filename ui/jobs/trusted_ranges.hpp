#pragma once

#include <map>
#include <optional>

#include "core/harmonic/prediction_error.hpp"
#include "ui/jobs/motion_session.hpp"

namespace pliant::jobs {

/// How far each parameter can be moved before what the session predicts is off by more than a tenth of the motion's
/// swing: estimated to second order (harmonic::PredictionError) on a thread of its own after every solve.
class TrustedRanges final : public QObject {
  Q_OBJECT

 public:
  static constexpr double share = 0.1;  ///< of the oscillation

  explicit TrustedRanges(MotionSession& session, QObject* parent = nullptr);

  /// None as long as it is not known, and where the motion has no derivative.
  std::optional<harmonic::ParameterRange> range(const std::string& pointer) const;

 Q_SIGNALS:
  void changed();

 private:
  void follow();

  MotionSession& session_;
  std::shared_ptr<const harmonic::ResponseSensitivity> of_;  ///< whose predictions are judged
  std::map<std::string, harmonic::ParameterRange> ranges_;   ///< by pointer
  JobRunner runner_;
};

}  // namespace pliant::jobs
