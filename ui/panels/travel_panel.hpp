#pragma once

#include "ui/panels/study_panel.hpp"

namespace pliant::plots {
class PolarPlot;
}

namespace pliant::panels {

/// Limits of stretch and compression and the free travel between them over the direction (thesis Fig. 4.6), or limits
/// of curvature (Fig. 4.7), with what was measured.
class TravelPanel final : public StudyPanel {
  Q_OBJECT

 public:
  explicit TravelPanel(document::Document& document, QWidget* parent = nullptr);

  plots::PolarPlot* plot() const { return plot_; }
  /// Throws base::InputError.
  void importMeasured(const QString& file);
  void exportTo(const QString& file) override;

 private:
  QString absentNote() const override;
  QString waitingNote(const QString& study) const override;
  bool present(const document::StudyState* study) override;
  void refreshSwitches();
  void chooseMeasured();

  std::shared_ptr<const scene::Result> result_;
  plots::PolarPlot* plot_;
};

}  // namespace pliant::panels
