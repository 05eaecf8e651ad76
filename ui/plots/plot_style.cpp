#include "ui/plots/plot_style.hpp"

#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "ui/plots/custom_plot.hpp"
#include "ui/render/theme.hpp"

namespace pliant::plots {

namespace {

QColor toColor(const render::Color& color) {
  return QColor::fromRgbF(static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2]));
}

}  // namespace

bool isDark(const QPalette& palette) { return palette.color(QPalette::Base).lightness() < 128; }

PlotStyle plotStyle(const QPalette& palette) {
  const bool dark = isDark(palette);
  const render::Palette& shared = render::palette(dark ? render::Theme::dark : render::Theme::light);
  PlotStyle style;
  style.background = palette.color(QPalette::Base);
  style.text = palette.color(QPalette::Text);
  style.mutedText = dark ? QColor(168, 174, 182) : QColor(92, 98, 106);
  style.grid = dark ? QColor(56, 60, 66) : QColor(228, 231, 235);
  style.curve = dark ? QColor(86, 180, 233) : QColor(0, 114, 178);
  style.otherCurve = dark ? QColor(110, 122, 134) : QColor(158, 170, 182);
  style.stale = dark ? QColor(112, 116, 122) : QColor(172, 176, 182);
  style.prediction = toColor(shared.prediction);
  style.shown = toColor(shared.trajectory);
  style.warning = dark ? QColor(240, 180, 80) : QColor(150, 84, 0);
  return style;
}

void styleChart(QCustomPlot& plot, const QWidget& owner) {
  const PlotStyle style = plotStyle(owner.palette());
  plot.setBackground(style.background);
  QFont small = owner.font();
  small.setPointSizeF(owner.font().pointSizeF() * 0.9);
  for (QCPAxis* axis : {plot.xAxis, plot.yAxis}) {
    axis->setBasePen(QPen(style.mutedText, 1));
    axis->setTickPen(QPen(style.mutedText, 1));
    axis->setSubTicks(false);
    axis->setTickLabelColor(style.mutedText);
    axis->setLabelColor(style.text);
    axis->setTickLabelFont(small);
    axis->setLabelFont(owner.font());
    axis->setLabelPadding(6);
    axis->grid()->setPen(QPen(style.grid, 1));
    axis->grid()->setZeroLinePen(QPen(style.mutedText, 1));
  }
  plot.legend->setFont(small);
  plot.legend->setTextColor(style.text);
  QColor box = style.background;
  box.setAlpha(224);
  plot.legend->setBrush(box);
  plot.legend->setBorderPen(Qt::NoPen);
}

QString formatLength(double metres) {
  return QString::fromStdString(base::formatQuantity(metres, base::dimensions::length));
}

QString formatFrequency(double radiansPerSecond, bool hertz) {
  if (hertz) return QString::number(radiansPerSecond / (2 * std::numbers::pi), 'g', 5) + QStringLiteral(" Hz");
  return QString::number(radiansPerSecond, 'g', 5) + QStringLiteral(" rad/s");
}

LengthUnit fittingLengthUnit(double largest) {
  // A curve up to 8 mm reads better in mm than in m; one up to 1.2 m in m.
  if (!(largest > 0) || largest >= 1.0) return {QStringLiteral("m"), 1};
  if (largest >= 1e-3) return {QStringLiteral("mm"), 1e3};
  if (largest >= 1e-6) return {QStringLiteral("µm"), 1e6};
  return {QStringLiteral("nm"), 1e9};
}

double roundedUp(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (step * decade >= value * (1 - 1e-12)) return step * decade;
  return 10 * decade;
}

}  // namespace pliant::plots
