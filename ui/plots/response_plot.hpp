#pragma once

#include <QImage>
#include <QString>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "core/harmonic/frequency_response.hpp"
#include "ui/document/study_state.hpp"

class QCustomPlot;
class QMouseEvent;

namespace pliant::plots {

/// How far one node swings along a frequency-response curve; all three lists in the order of the curve.
struct ResponseCurve {
  QString name;                   ///< of the node
  std::vector<double> omega;      ///< [rad/s]
  std::vector<double> amplitude;  ///< [m]
  std::vector<harmonic::PointKind> kinds;
  std::vector<char> unstable;  ///< 1 where the motion is known to be unstable; empty: nothing is known
  std::vector<int> branches;   ///< which branch each point is on; empty: one branch
};

/// A curve to compare with: of another study, or measured.
struct ResponseOverlay {
  QString name;
  std::vector<double> omega;      ///< [rad/s]
  std::vector<double> amplitude;  ///< [m]
  bool dots = false;              ///< single motions rather than a curve
};

/// One motion in the plot.
struct ResponsePlace {
  double omega = 0;      ///< [rad/s]
  double amplitude = 0;  ///< [m]
};

/// A curve foretold for parameters that are not those of the solved one.
struct PredictedResponse {
  ResponseCurve curve;  ///< of the selected node
  std::vector<ResponsePlace> peaks;
};

/// A picture that belongs to a place of the curve.
struct ResponseInset {
  ResponsePlace place;
  QImage image;
};

/// A frequency-response curve with its folds and peaks, growing while it is computed. It shows which motion the
/// viewport plays, what is predicted, and what the curve is worth: solved, stale, cancelled. It only draws.
///
/// A click on the curve asks for that motion; the frequency cursor can be dragged; the wheel zooms, dragging pans, and
/// a double click shows everything again. The axes keep still while the curve grows: only what would leave the plot
/// enlarges them, and at its end they are fitted once.
class ResponsePlot final : public QWidget {
  Q_OBJECT

 public:
  explicit ResponsePlot(QWidget* parent = nullptr);
  ~ResponsePlot() override;

  /// The frequencies between which the study looks [rad/s].
  void setFrequencyRange(double from, double to);
  /// `selected` is the curve of the node that amplitudes are read of; its points are the ones that signals count.
  /// `note` says why the curve ended early.
  void setCurves(std::vector<ResponseCurve> curves, int selected, document::StudyStatus status, bool stale,
                 const QString& note);
  /// Drawn thin in colours of their own, named in a legend; the axes are fitted to the study's own curves.
  void setOverlays(std::vector<ResponseOverlay> overlays);
  const std::vector<ResponseOverlay>& overlays() const;
  /// Drawn beside their places, the first ones first, where there is room.
  void setInsets(std::vector<ResponseInset> insets);
  int visibleInsets() const;
  /// Amplitudes on a logarithmic axis.
  void setLogarithmic(bool logarithmic);

  /// Forgets the curves; an earlier one does not stay behind in grey.
  void clear();
  /// What the plot says as long as there is no curve, and the button beside it (none if `action` is empty).
  void setEmptyState(const QString& sentence, const QString& action);

  /// "Path length of left tip".
  void setAmplitudeLabel(const QString& label);
  void setHertz(bool hertz);
  bool isHertz() const;
  QCustomPlot* plot() const;

  void setShownMotion(std::optional<ResponsePlace> place);
  void setPrediction(std::optional<ResponsePlace> place);
  /// Dashed, with its peaks marked. It enlarges the axes to no more than twice what is solved: a linear prediction goes
  /// anywhere when parameters are far away.
  void setPredictedCurve(std::optional<PredictedResponse> curve);
  const std::optional<PredictedResponse>& predictedCurve() const;

  /// Shows everything.
  void fit();

  /// For tests and accessibility: where a motion is drawn, in this widget's coordinates, and what stands on the axes.
  QPointF positionOf(const ResponsePlace& place) const;
  double largestFrequencyShown() const;  ///< [rad/s]
  double largestAmplitudeShown() const;  ///< [m]
  QString statusText() const;
  std::optional<ResponsePlace> shownMotion() const;
  std::optional<ResponsePlace> prediction() const;
  int pointCount() const;

  QSize sizeHint() const override { return {720, 240}; }
  QSize minimumSizeHint() const override { return {320, 160}; }

 Q_SIGNALS:
  /// A point of the selected curve was clicked, or the cursor was dragged past it.
  void pointChosen(int index);
  /// The cursor was dropped between the computed frequencies; `nearestIndex` is the closest computed point.
  void frequencyRequested(double omega, int nearestIndex);
  void emptyActionTriggered();
  void updateRequested();
  /// What stands under the pointer, for the status bar; empty: nothing.
  void readoutChanged(const QString& text);

 protected:
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  struct Parts;

  void build();
  void applyStyle();
  void redrawCurves();
  void redrawOverlays();
  void fitAmplitudes();
  void redrawMarkers();
  void replotMarkers();
  void redrawPredictedCurve();
  void placeLabels();
  void placeInsets(const std::vector<QRectF>& taken);
  void updateChip();
  void updateAxisLabels();
  void enlargeToFit();

  void press(QMouseEvent* event);
  void move(QMouseEvent* event);
  void release(QMouseEvent* event);
  void dragCursor(const QPointF& pixel);
  bool isOnCursor(const QPointF& pixel) const;
  void readOut(const QPointF& pixel);
  /// The point of the selected curve drawn nearest to a pixel and its distance; -1 if there is none. `across` weights
  /// vertical distances: 1 for the eye's distance, less to follow the frequency.
  std::pair<int, double> nearestPoint(const QPointF& pixel, double across) const;

  double frequencyFactor() const;
  QString pointText(int index) const;

  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::plots
