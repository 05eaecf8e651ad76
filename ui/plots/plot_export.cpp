#include "ui/plots/plot_export.hpp"

#include <QFileInfo>
#include <QImage>
#include <QPainter>
#include <QPdfWriter>
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

void writeText(const QString& file, const QString& text) {
  QSaveFile out(file);
  if (!out.open(QIODevice::WriteOnly) || out.write(text.toUtf8()) < 0 || !out.commit()) cannotWrite(file);
}

[[noreturn]] void unknownType(const QString& file) {
  throw base::InputError(file.toStdString(), "The file's name must end in .pdf, .svg, .png or .csv.");
}

/// Paints onto something that paints into `file`.
void paintInto(QPaintDevice& device, const QString& file, const std::function<void(QPainter&)>& paint) {
  QPainter painter;
  if (!painter.begin(&device)) cannotWrite(file);
  paint(painter);
  painter.end();
}

}  // namespace

QString plotExportFilters() {
  return QObject::tr("PDF (*.pdf);;SVG (*.svg);;PNG (*.png);;Numbers, comma-separated (*.csv)");
}

void exportPlot(QCustomPlot& plot, const QString& file, const std::function<QString()>& csv) {
  const QString type = QFileInfo(file).suffix().toLower();
  if (type == "csv") {
    writeText(file, csv());
  } else if (type == "svg") {
    writeSvg(plot, file);
  } else if (type == "pdf") {
    if (!plot.savePdf(file)) cannotWrite(file);
  } else if (type == "png") {
    if (!plot.savePng(file, 0, 0, 2.0)) cannotWrite(file);
  } else {
    unknownType(file);
  }
}

void exportPainting(QSize size, const QString& file, const std::function<void(QPainter&)>& paint,
                    const std::function<QString()>& csv) {
  constexpr double sharpness = 2;  // of a PNG, as of other plots
  const QString type = QFileInfo(file).suffix().toLower();
  if (type == "csv") {
    writeText(file, csv());
  } else if (type == "svg") {
    QSvgGenerator generator;
    generator.setFileName(file);
    generator.setSize(size);
    generator.setViewBox(QRect(QPoint(0, 0), size));
    paintInto(generator, file, paint);
  } else if (type == "pdf") {
    QPdfWriter writer(file);
    writer.setResolution(96);  // a pixel on paper is what it is on the screen
    writer.setPageSize(QPageSize(QSizeF(size) * 0.75, QPageSize::Point));
    writer.setPageMargins(QMarginsF());
    paintInto(writer, file, paint);
  } else if (type == "png") {
    QImage image(size * sharpness, QImage::Format_RGB32);
    image.setDevicePixelRatio(sharpness);
    paintInto(image, file, paint);
    if (!image.save(file)) cannotWrite(file);
  } else {
    unknownType(file);
  }
}

}  // namespace pliant::plots
