#pragma once

#include "core/scene/result_charts.hpp"
#include "ui/jobs/job_runner.hpp"
#include "ui/panels/study_panel.hpp"

class QSplitter;

namespace pliant::plots {
class LinePlot;
}

namespace pliant::panels {

/// The charts of calibrations (measured and fitted motions) and of design spaces (what can be reached), side by side,
/// as `pliant-cli plot` draws them.
class ChartPanel final : public StudyPanel {
  Q_OBJECT

 public:
  /// Reads charts in `quick`.
  ChartPanel(document::Document& document, jobs::JobRunner& quick, QWidget* parent = nullptr);
  ~ChartPanel() override;

  /// Whether the document has a study for it.
  bool hasStudies() const;
  const std::vector<plots::LinePlot*>& plots() const { return plots_; }
  /// The first chart.
  void exportTo(const QString& file) override;

 private:
  QString absentNote() const override;
  QString waitingNote(const QString& study) const override;
  bool present(const document::StudyState* study) override;
  void take(const std::vector<scene::ResultChart>& charts);

  jobs::JobRunner& quick_;
  std::shared_ptr<const scene::Result> result_;
  QSplitter* split_;
  std::vector<plots::LinePlot*> plots_;
};

}  // namespace pliant::panels
