#pragma once

#include <QWidget>
#include <map>
#include <memory>

#include "core/scene/design_result.hpp"
#include "ui/document/document.hpp"
#include "ui/panels/design_motion.hpp"

class QHBoxLayout;
class QLabel;
class QPushButton;
class QSlider;
class QSpinBox;
class QStackedLayout;
class QTableWidget;

namespace pliant::plots {
class LinePlot;
}

namespace pliant::panels {

class StudyChoice;
class TargetBar;

/// What a study of the type `design` found, while it runs and after: its objective over the iterations, and every
/// design on the way with its parameters and its motion, which plays in the viewport. While the study finds better ones
/// and until one is picked, the first design's motion is shown with the best one's as a ghost; any two can be seen side
/// by side. Any of them can be taken into the scene, as one step of undo.
class DesignPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit DesignPanel(document::Document& document, QWidget* parent = nullptr);

  /// Whether the panel has something to say of a scene.
  static bool hasDesign(const document::Document& document);

  plots::LinePlot* plot() const { return plot_; }
  QTableWidget* table() const { return table_; }
  QSlider* slider() const { return slider_; }
  QPushButton* take() const { return take_; }
  QPushButton* runButton() const { return run_; }
  /// Which study, where there are several.
  StudyChoice* choice() const { return choice_; }
  QString summary() const;
  /// Of the history; -1: none.
  int shownDesign() const { return shown_; }
  /// Its motion is played.
  void showDesign(int index);
  /// Shows another design to the left of the one that is picked.
  QPushButton* compareButton() const { return compare_; }
  QSpinBox* comparedDesign() const { return compared_; }
  TargetBar* targetBar() const { return targets_; }

 Q_SIGNALS:
  void designChosen(const pliant::panels::DesignMotion& design);
  /// The best one so far, over the first.
  void progressMade(const pliant::panels::DesignMotion& first, const pliant::panels::DesignMotion& best);
  void comparisonChosen(const pliant::panels::DesignMotion& left, const pliant::panels::DesignMotion& right);
  void designLeft();
  void runRequested(const std::string& study);
  /// A study began to have designs to show.
  void designsGrow();

 private:
  enum Column { nameColumn, beforeColumn, shownColumn, rangeColumn, columnCount };

  void refresh();
  void chooseStudy();
  void forget();
  void takeResult();
  void follow(const std::string& name);
  QWidget* makeEmptyPage();
  QWidget* makePage();
  QHBoxLayout* makeBottomRow();
  void put(int index);
  void fillTable();
  void play();
  DesignMotion motionOf(int index);
  void takeDesign();

  document::Document& document_;
  std::shared_ptr<const scene::DesignResult> result_;
  int shown_ = -1;
  bool follows_ = true;  ///< the last design is shown as the study finds better ones
  bool picked_ = false;  ///< somebody chose a design
  std::map<const mechanics::Model*, std::shared_ptr<const harmonic::HarmonicBalanceProblem>> problems_;
  QString played_;  ///< what was shown last, so that it is not shown anew
  TargetBar* targets_;
  StudyChoice* choice_;
  QStackedLayout* pages_;
  QLabel* note_;
  QPushButton* run_;
  QLabel* summary_;
  plots::LinePlot* plot_;
  QTableWidget* table_;
  QSlider* slider_;
  QLabel* position_;
  QPushButton* compare_;
  QSpinBox* compared_;
  QPushButton* take_;
};

}  // namespace pliant::panels
