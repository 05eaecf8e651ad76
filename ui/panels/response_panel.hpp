#pragma once

#include <QWidget>
#include <memory>
#include <string>

#include "ui/jobs/curve_predictor.hpp"
#include "ui/jobs/motion_session.hpp"
#include "ui/plots/response_plot.hpp"

class QAction;
class QComboBox;
class QToolButton;

namespace pliant::panels {

/// The frequency-response plot with what it is a plot of: study, node, measure of the amplitude, unit of the frequency.
/// Amplitudes of a node that is no probe are computed as a job.
class ResponsePanel final : public QWidget {
  Q_OBJECT

 public:
  ResponsePanel(document::Document& document, jobs::MotionSession& session, jobs::JobRunner& quick,
                QWidget* parent = nullptr);

  plots::ResponsePlot* plot() const { return plot_; }
  const jobs::CurvePredictor& predictor() const { return predictor_; }
  /// The study whose curve is shown; empty if the scene has none.
  std::string study() const { return study_; }
  void setHertz(bool hertz);
  /// Overlays measured amplitudes; see `readMeasurements`. Throws base::InputError.
  void addMeasurements(const QString& file);

 Q_SIGNALS:
  void readoutChanged(const QString& text);
  void hertzChanged(bool hertz);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  /// A model as far out as a motion takes it.
  struct ShapeAt {
    plots::ResponsePlace place;
    std::shared_ptr<const mechanics::Model> model;
    harmonic::Vector positions;
  };

  void rebuild();
  void fillStudies();
  void fillNodes();
  void chooseStudy();
  void refreshCurve();
  void showCurves(const scene::HarmonicResult* result, const std::vector<double>& amplitudes);
  void refreshMarkers();
  void followCurve();
  void refreshPredictedCurve();
  void refreshEmptyState();
  void refreshOverlays();
  void refreshInsets();
  QToolButton* makeMenuButton();

  document::Document& document_;
  jobs::MotionSession& session_;
  jobs::JobRunner& quick_;
  jobs::CurvePredictor predictor_;
  std::string study_;
  std::shared_ptr<const scene::Result> drawn_;
  std::vector<ShapeAt> peaks_;  ///< of the curve that is shown
  QComboBox* studies_;
  QComboBox* nodes_;
  QComboBox* measures_;
  QToolButton* unit_;
  QToolButton* scale_;
  QAction* compare_;
  QAction* shapes_;
  std::vector<plots::ResponseOverlay> measurements_;
  plots::ResponsePlot* plot_;
};

}  // namespace pliant::panels
