#pragma once

#include <QColor>
#include <QPalette>
#include <QString>

class QCustomPlot;
class QWidget;

namespace pliant::plots {

/// The colours of a plot in a light or dark window. Categories are Okabe and Ito's; predicted and shown motions have
/// the colours that they have in the viewport.
struct PlotStyle {
  QColor background;
  QColor text;
  QColor mutedText;  ///< contrast with the background at least 4.5 : 1
  QColor grid;
  QColor curve;       ///< solved
  QColor otherCurve;  ///< solved, of nodes that are not selected
  QColor stale;
  QColor prediction;
  QColor shown;
  QColor warning;
};

bool isDark(const QPalette& palette);
PlotStyle plotStyle(const QPalette& palette);

/// Colours and fonts of a chart's background, axes and legend.
void styleChart(QCustomPlot& plot, const QWidget& owner);

/// "43.10 mm": four significant digits and a fitting prefix.
QString formatLength(double metres);
QString formatFrequency(double radiansPerSecond, bool hertz);

/// The unit in which lengths up to `largest` [m] are best read, and how many of it make a metre.
struct LengthUnit {
  QString name;
  double perMetre = 1;
};
LengthUnit fittingLengthUnit(double largest);

/// The smallest of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten that is not below `value` (> 0).
double roundedUp(double value);

}  // namespace pliant::plots
