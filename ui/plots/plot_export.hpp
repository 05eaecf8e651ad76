#pragma once

#include <QSize>
#include <QString>
#include <functional>

class QCustomPlot;
class QPainter;

namespace pliant::plots {

/// The name filters of an export dialog.
QString plotExportFilters();

/// Writes a plot into `file`, by its extension: png, svg, pdf, or csv with the text of `csv`. Throws base::InputError.
void exportPlot(QCustomPlot& plot, const QString& file, const std::function<QString()>& csv);

/// The same of something of this size [pixels] that paints itself.
void exportPainting(QSize size, const QString& file, const std::function<void(QPainter&)>& paint,
                    const std::function<QString()>& csv);

}  // namespace pliant::plots
