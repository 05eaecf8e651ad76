#pragma once

#include <QWidget>
#include <memory>

#include "core/scene/modes_result.hpp"
#include "ui/document/document.hpp"
#include "ui/jobs/motion_session.hpp"
#include "ui/panels/study_choice.hpp"

class QLabel;
class QPushButton;
class QSlider;
class QStackedLayout;
class QTableWidget;

namespace pliant::panels {

/// The gallery of linear modes: frequencies and damping ratios of a study of the type linear_modes. A
/// mode that is chosen is played in the viewport, with a swing to be set, until it is chosen again or something else is
/// shown.
class ModesPanel final : public QWidget {
  Q_OBJECT

 public:
  ModesPanel(document::Document& document, jobs::MotionSession& session, QWidget* parent = nullptr);

  QTableWidget* table() const { return table_; }
  StudyChoice* choice() const { return choice_; }
  /// -1: none is played.
  int playedMode() const { return played_; }

 public Q_SLOTS:
  /// Something else is shown: no mode is played any longer.
  void leave();

 Q_SIGNALS:
  /// A mode as coefficients of `problem`.
  void modeChosen(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const harmonic::Vector& z,
                  const QString& caption);
  void modeLeft();

 private:
  void refresh();
  void choose(int row);
  void play();

  document::Document& document_;
  jobs::MotionSession& session_;
  std::shared_ptr<const scene::ModesResult> result_;
  int played_ = -1;
  StudyChoice* choice_;
  QStackedLayout* pages_;
  QLabel* note_;
  QPushButton* run_;
  QTableWidget* table_;
  QSlider* swing_;
};

}  // namespace pliant::panels
