#pragma once

#include "ui/panels/study_panel.hpp"

namespace pliant::plots {
class LinePlot;
}

namespace pliant::panels {

/// How limits of curvature depend on the size of a patch (thesis Fig. 4.8), while they are computed as well.
class SizePanel final : public StudyPanel {
  Q_OBJECT

 public:
  explicit SizePanel(document::Document& document, QWidget* parent = nullptr);

  plots::LinePlot* plot() const { return plot_; }
  void exportTo(const QString& file) override;

 private:
  QString absentNote() const override;
  QString waitingNote(const QString& study) const override;
  bool present(const document::StudyState* study) override;

  std::shared_ptr<const scene::Result> result_;
  plots::LinePlot* plot_;
};

}  // namespace pliant::panels
