#include "ui/plots/plot_export.hpp"

#include <QFileInfo>
#include <QSaveFile>
#include <QSvgGenerator>

#include "core/base/error.hpp"
#include "ui/plots/custom_plot.hpp"

namespace pliant::plots {

namespace {

[[noreturn]] void cannotWrite(const QString& file) {
  throw base::InputError(file.toStdString(), "The file cannot be written.");
}

void writeSvg(QCustomPlot& plot, const QString& file) {
  QSvgGenerator generator;
  generator.setFileName(file);
  generator.setSize(plot.size());
  generator.setViewBox(QRect(QPoint(0, 0), plot.size()));
  QCPPainter painter;
  if (!painter.begin(&generator)) cannotWrite(file);
  painter.setMode(QCPPainter::pmVectorized);
  painter.setMode(QCPPainter::pmNoCaching);
  plot.toPainter(&painter, plot.width(), plot.height());
  painter.end();
}

}  // namespace

QString plotExportFilters() {
  return QObject::tr("PDF (*.pdf);;SVG (*.svg);;PNG (*.png);;Numbers, comma-separated (*.csv)");
}

void exportPlot(QCustomPlot& plot, const QString& file, const std::function<QString()>& csv) {
  const QString type = QFileInfo(file).suffix().toLower();
  if (type == "csv") {
    QSaveFile out(file);
    if (!out.open(QIODevice::WriteOnly) || out.write(csv().toUtf8()) < 0 || !out.commit()) cannotWrite(file);
  } else if (type == "svg") {
    writeSvg(plot, file);
  } else if (type == "pdf") {
    if (!plot.savePdf(file)) cannotWrite(file);
  } else if (type == "png") {
    if (!plot.savePng(file, 0, 0, 2.0)) cannotWrite(file);
  } else {
    throw base::InputError(file.toStdString(), "The file's name must end in .pdf, .svg, .png or .csv.");
  }
}

}  // namespace pliant::plots
