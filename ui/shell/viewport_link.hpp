#pragma once

#include <QObject>

#include "ui/jobs/motion_session.hpp"
#include "ui/panels/design_motion.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

/// Shows the document's model and the session's motion and prediction in a viewport, and brings picks back.
class ViewportLink final : public QObject {
  Q_OBJECT

 public:
  ViewportLink(document::Document& document, jobs::MotionSession& session, viewport::Viewport& viewport,
               QObject* parent = nullptr);

  /// The session's motion, after a mode.
  void showMotion();
  /// A linear mode, until the session shows something else.
  void showMode(const std::shared_ptr<const harmonic::HarmonicBalanceProblem>& problem, const harmonic::Vector& z,
                const QString& caption);
  /// The motion of a design, whose shape at rest may be another one than the document's, until something else is shown.
  void showDesign(const panels::DesignMotion& design);
  /// The best design's motion as a ghost over the first one's.
  void showProgress(const panels::DesignMotion& first, const panels::DesignMotion& best);
  void showComparison(const panels::DesignMotion& left, const panels::DesignMotion& right);

 private:
  void showModel();
  void showPrediction();
  QString caption() const;

  document::Document& document_;
  jobs::MotionSession& session_;
  viewport::Viewport& viewport_;
  std::shared_ptr<const mechanics::Model> drawn_;
  bool own_ = true;               ///< the session's motion is on show, if it has one
  const void* design_ = nullptr;  ///< the problem of the design on show
};

}  // namespace pliant::shell
