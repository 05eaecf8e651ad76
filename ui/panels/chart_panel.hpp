#pragma once

#include "core/scene/result_charts.hpp"
#include "ui/jobs/job_runner.hpp"
#include "ui/panels/design_motion.hpp"
#include "ui/panels/study_panel.hpp"

class QSplitter;

namespace pliant::plots {
class LinePlot;
}

namespace pliant::scene {
class CalibrationStudyResult;
class DesignSpaceResult;
}  // namespace pliant::scene

namespace pliant::panels {

class ValueCard;

/// The charts of calibrations (measured and fitted motions) and of design spaces (what can be reached), side by side,
/// as `pliant-cli plot` draws them. A click on a point or path of a design space looks at that design: its motion, its
/// parameters, and its place in every chart, until it is clicked again. A design that is looked at, and the values that
/// a calibration has fitted, are taken into the scene as one step of undo.
class ChartPanel final : public StudyPanel {
  Q_OBJECT

 public:
  /// Reads charts in `quick`.
  ChartPanel(document::Document& document, jobs::JobRunner& quick, QWidget* parent = nullptr);
  ~ChartPanel() override;

  /// Whether the document has a study for it.
  bool hasStudies() const;
  const std::vector<plots::LinePlot*>& plots() const { return plots_; }
  /// Beside the charts, while there are values to be taken.
  ValueCard* card() const { return card_; }
  /// Of a design space; -1: none is looked at.
  int chosenDesign() const { return chosen_; }
  /// The first chart.
  void exportTo(const QString& file) override;

 public Q_SLOTS:
  /// Of a design space; the one that is looked at, or -1, leaves it.
  void chooseDesign(int design);
  /// Something else is shown: no design is looked at any longer.
  void leave();

 Q_SIGNALS:
  void designChosen(const pliant::panels::DesignMotion& design);
  /// No design is looked at any longer.
  void designLeft();

 private:
  QString absentNote() const override;
  QString waitingNote(const QString& study) const override;
  bool present(const document::StudyState* study) override;
  void showCharts(const std::vector<scene::ResultChart>& charts);
  bool hasMotion(int design) const;
  void refreshCard();
  void showDesign(const scene::DesignSpaceResult& space);
  void showFit(const scene::CalibrationStudyResult& fit);
  void leaveDesign();
  void takeValues();
  QString designText(int design) const;

  jobs::JobRunner& quick_;
  std::shared_ptr<const scene::Result> result_;
  std::shared_ptr<const scene::DesignSpaceResult> space_;     ///< the same, if it is one
  std::shared_ptr<const scene::CalibrationStudyResult> fit_;  ///< likewise
  std::string of_;                                            ///< the study that the result is of
  int chosen_ = -1;
  QSplitter* split_;
  ValueCard* card_;
  std::vector<plots::LinePlot*> plots_;
};

}  // namespace pliant::panels
