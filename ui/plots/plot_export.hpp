#pragma once

#include <QString>
#include <functional>

class QCustomPlot;

namespace pliant::plots {

/// The name filters of an export dialog.
QString plotExportFilters();

/// Writes a plot into `file`, by its extension: png, svg, pdf, or csv with the text of `csv`. Throws base::InputError.
void exportPlot(QCustomPlot& plot, const QString& file, const std::function<QString()>& csv);

}  // namespace pliant::plots
