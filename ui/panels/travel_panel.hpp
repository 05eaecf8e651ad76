#pragma once

#include "ui/panels/study_panel.hpp"

namespace pliant::plots {
class PolarPlot;
}

namespace pliant::panels {

/// Limits of stretch and compression and the free travel between them over the direction (thesis Fig. 4.6), or limits
/// of curvature (Fig. 4.7), with what was measured; or those that a design of an element is to have, had first, and has
/// found, which may be taken into the scene as one step of undo.
class TravelPanel final : public StudyPanel {
  Q_OBJECT

 public:
  explicit TravelPanel(document::Document& document, QWidget* parent = nullptr);

  plots::PolarPlot* plot() const { return plot_; }
  /// Takes the element that a design has found.
  QPushButton* take() const { return take_; }
  /// What is said of it.
  QString summary() const;
  /// Throws base::InputError.
  void importMeasured(const QString& file);
  void exportTo(const QString& file) override;

 private:
  QString absentNote() const override;
  QString waitingNote(const QString& study) const override;
  bool present(const document::StudyState* study) override;
  void refreshSwitches();
  void refreshDesign(bool busy);
  void takeElement();
  void chooseMeasured();

  std::shared_ptr<const scene::Result> result_;
  plots::PolarPlot* plot_;
  QWidget* designRow_;
  QLabel* summary_;
  QPushButton* take_;
};

}  // namespace pliant::panels
