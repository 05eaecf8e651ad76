#pragma once

#include <map>
#include <optional>

#include "core/harmonic/prediction_error.hpp"
#include "ui/jobs/motion_session.hpp"

namespace pliant::jobs {

/// How far each parameter, and many of them together, can be moved before what the session predicts is off by more than
/// a tenth of the motion's swing: estimated (harmonic::PredictionError) on a thread of its own after every solve.
class TrustedRanges final : public QObject {
  Q_OBJECT

 public:
  static constexpr double share = 0.1;  ///< of the oscillation

  explicit TrustedRanges(MotionSession& session, QObject* parent = nullptr);

  /// None as long as it is not known, and where the motion has no derivative.
  std::optional<harmonic::ParameterRange> range(const std::string& pointer) const;
  /// Two ways of all parameters of the motion on show (size np each), to either side; empty: none.
  void setWays(harmonic::Vector towards, harmonic::Vector away);
  /// What parts of the ways can be gone, none if that is not known.
  struct Reach {
    double towards = 0, away = 0;
  };
  const std::optional<Reach>& reach() const { return reach_; }

 Q_SIGNALS:
  void changed();

 private:
  void follow();
  void findReach();

  MotionSession& session_;
  std::shared_ptr<const harmonic::ResponseSensitivity> of_;  ///< whose predictions are judged
  std::map<std::string, harmonic::ParameterRange> ranges_;   ///< by pointer
  std::shared_ptr<const harmonic::PredictionError> error_;
  harmonic::Vector towards_, away_;
  std::optional<Reach> reach_;
  JobRunner runner_;
};

}  // namespace pliant::jobs
