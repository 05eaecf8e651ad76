#pragma once

#include <QLabel>
#include <QPushButton>
#include <QStackedLayout>
#include <array>
#include <vector>

#include "ui/plots/custom_plot.hpp"
#include "ui/plots/plot_style.hpp"
#include "ui/plots/response_plot.hpp"

namespace pliant::plots {

/// Fills `into`, and `unstable`, if given, with the unstable parts, smoothly with up to `between` more points in each
/// gap; both begin anew where another branch begins.
inline constexpr int smoothPointsBetween = 7;
void fillCurve(QCPCurve* into, const ResponseCurve& curve, double perOmega, double perMetre,
               int between = smoothPointsBetween, QCPCurve* unstable = nullptr);

/// "fold"; empty for a regular point.
QString kindName(harmonic::PointKind kind);

/// A fold, a peak or another bifurcation with its text.
struct Landmark {
  double omega = 0;
  double amplitude = 0;
  bool peak = false;
  QString text;
  QCPItemText* label = nullptr;
};

/// A picture and the line from it to its place.
struct InsetItem {
  ResponsePlace place;
  QCPItemPixmap* picture = nullptr;
  QCPItemLine* leader = nullptr;
};

/// What a ResponsePlot is made of.
struct ResponsePlot::Parts {
  QStackedLayout* pages = nullptr;
  QWidget* emptyPage = nullptr;
  QLabel* emptyText = nullptr;
  QPushButton* emptyAction = nullptr;
  QCustomPlot* plot = nullptr;
  QPushButton* chip = nullptr;

  /// What moves while a slider is dragged, labels that make room for it included: drawn again without the rest.
  QCPLayer* markers = nullptr;
  bool markersQueued = false;
  bool outdated = true;                 ///< more than the markers has changed since all was drawn
  std::array<QCPRange, 2> drawnRanges;  ///< of the axes when all was drawn

  QCPCurve* earlier = nullptr;    ///< the curve before this one, grey
  std::vector<QCPCurve*> others;  ///< of nodes that are not selected
  QCPCurve* selected = nullptr;
  QCPCurve* unstable = nullptr;  ///< the unstable parts of the selected curve
  std::vector<QCPCurve*> overlayCurves;
  QCPCurve* folds = nullptr;
  QCPCurve* peaks = nullptr;
  QCPCurve* bifurcations = nullptr;  ///< that are no folds
  QCPCurve* shown = nullptr;
  QCPCurve* predicted = nullptr;
  QCPCurve* step = nullptr;  ///< from the shown motion to the predicted one
  QCPCurve* predictedCurve = nullptr;
  QCPCurve* predictedPeaks = nullptr;
  QCPCurve* hover = nullptr;
  QCPItemStraightLine* cursor = nullptr;
  QCPItemText* cursorLabel = nullptr;
  QCPItemText* predictedLabel = nullptr;
  QCPItemText* hoverLabel = nullptr;
  std::vector<Landmark> landmarks;
  std::vector<Landmark> predictedLandmarks;  ///< labels are kept and used again
  std::vector<InsetItem> insets;

  PlotStyle style;
  std::vector<ResponseCurve> curves;
  std::vector<ResponseOverlay> overlays;
  int selectedCurve = 0;
  document::StudyStatus status = document::StudyStatus::none;
  bool stale = false;
  QString note;
  ResponseCurve earlierCurve;
  QString amplitudeLabel;
  bool hertz = false;
  LengthUnit unit{QStringLiteral("mm"), 1e3};
  double from = 0;
  double to = 0;
  double top = 0;  ///< of the amplitude axis when everything is shown [m]
  bool logarithmic = false;
  bool zoomed = false;  ///< the designer chose what is shown
  std::optional<ResponsePlace> shownPlace;
  std::optional<ResponsePlace> predictedPlace;
  std::optional<PredictedResponse> predictedResponse;

  bool pressed = false;
  bool draggingCursor = false;
  QPointF pressPosition;
  double cursorOmega = 0;
  int cursorPoint = -1;

  const ResponseCurve* curve() const {
    return selectedCurve < static_cast<int>(curves.size()) ? &curves[selectedCurve] : nullptr;
  }
};

}  // namespace pliant::plots
