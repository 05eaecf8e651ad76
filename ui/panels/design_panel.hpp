#pragma once

#include <QWidget>
#include <memory>

#include "core/scene/design_result.hpp"
#include "ui/document/document.hpp"

class QLabel;
class QPushButton;
class QSlider;
class QStackedLayout;
class QTableWidget;

namespace pliant::plots {
class LinePlot;
}

namespace pliant::panels {

/// What a study of the type `design` found, while it runs and after: its objective over the iterations, and every
/// design on the way with its parameters and its motion, which plays in the viewport. Any of them can be taken into the
/// scene, as one step of undo.
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
  QString summary() const;
  /// Of the history; -1: none.
  int shownDesign() const { return shown_; }
  void showDesign(int index);

 Q_SIGNALS:
  /// A design's motion, as coefficients of `problem`.
  void designChosen(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const harmonic::Vector& z,
                    const QString& caption);
  void designLeft();
  void runRequested(const std::string& study);
  /// A study began to have designs to show.
  void designsGrow();

 private:
  void refresh();
  void follow(const std::string& name);
  void fillTable();
  void play();
  void takeDesign();
  const document::StudyState* study() const;

  document::Document& document_;
  std::shared_ptr<const scene::DesignResult> result_;
  int shown_ = -1;
  bool follows_ = true;  ///< the last design is shown as the study finds better ones
  QStackedLayout* pages_;
  QLabel* note_;
  QPushButton* run_;
  QLabel* summary_;
  plots::LinePlot* plot_;
  QTableWidget* table_;
  QSlider* slider_;
  QLabel* position_;
  QPushButton* take_;
};

}  // namespace pliant::panels
