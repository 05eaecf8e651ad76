#pragma once

#include <QWidget>

#include "ui/document/document.hpp"
#include "ui/panels/cloth_charts.hpp"

class QComboBox;
class QToolButton;

namespace pliant::panels {

/// Charts of the scene's cloth studies while they run and after: energies over time, one line a study, and what the
/// solver did.
class EnergyPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit EnergyPanel(document::Document& document, QWidget* parent = nullptr);

  plots::LinePlot* plot() const { return plot_; }
  QComboBox* kinds() const { return kinds_; }
  QComboBox* studies() const { return studies_; }
  /// The study that is in the viewport: charts of one study are of this.
  void setStudy(const std::string& name);
  /// Marks the instant that the viewport shows [s].
  void setInstant(double seconds);

 Q_SIGNALS:
  /// Another study is to be shown.
  void studyChosen(const std::string& name);
  /// An instant of a chart over time was clicked [s].
  void instantChosen(double seconds);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void fillStudies();
  void refresh();
  void exportChart();
  const ClothChartKind& kind() const;

  document::Document& document_;
  QComboBox* studies_;
  QComboBox* kinds_;
  QToolButton* compare_;
  plots::LinePlot* plot_;
};

/// The results of cloth studies in the document, in the order of the scene; that of `first` before all others.
std::vector<ClothRun> clothRuns(const document::Document& document, const std::string& first);

}  // namespace pliant::panels
