#include "ui/plots/measured_limit.hpp"

#include <QFile>
#include <QStringList>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace pliant::plots {

namespace {

/// The columns of a table of measured limits; -1: there is none.
struct MeasuredColumns {
  int angle = -1, stretch = -1, lower = -1, upper = -1, error = -1;
  double radiansPerUnit = std::numbers::pi / 180;
  qsizetype count = 0;
};

[[noreturn]] void refuse(const QString& file, const QString& sentence) {
  throw base::InputError(file.toStdString(), sentence.toStdString());
}

MeasuredColumns readHeader(const QString& file, int line, const QStringList& names) {
  MeasuredColumns columns;
  columns.count = names.size();
  for (qsizetype i = 0; i < names.size(); ++i) {
    const QString name = names[i].section('[', 0, 0).trimmed().toLower();
    const QString unit = names[i].section('[', 1).section(']', 0, 0).trimmed();
    const int index = static_cast<int>(i);
    if (name == "angle") {
      columns.angle = index;
      if (unit == "rad")
        columns.radiansPerUnit = 1;
      else if (unit != "deg" && unit != "°" && !unit.isEmpty())
        refuse(file, QStringLiteral("Line %1: angles are in deg or rad, not in %2.").arg(line).arg(unit));
    } else if (name == "stretch") {
      columns.stretch = index;
    } else if (name == "lower") {
      columns.lower = index;
    } else if (name == "upper") {
      columns.upper = index;
    } else if (name == "error") {
      columns.error = index;
    }
  }
  for (const auto& [index, name] : {std::pair(columns.angle, "angle [deg]"), std::pair(columns.stretch, "stretch")})
    if (index < 0) refuse(file, QStringLiteral("Line %1: the header names no column “%2”.").arg(line).arg(name));
  if ((columns.lower < 0) != (columns.upper < 0))
    refuse(file, QStringLiteral("Line %1: of the columns “lower” and “upper” there is only one.").arg(line));
  return columns;
}

double readCell(const QString& file, int line, const QStringList& cells, int column, const char* name) {
  const QString text = cells[column].trimmed();
  if (text.isEmpty()) refuse(file, QStringLiteral("Line %1: the %2 is empty.").arg(line).arg(name));
  bool isNumber = false;
  const double value = text.toDouble(&isNumber);
  if (!isNumber || !std::isfinite(value))
    refuse(file, QStringLiteral("Line %1: the %2 “%3” is no finite number.").arg(line).arg(name).arg(text));
  return value;
}

MeasuredLimit readRow(const QString& file, int line, const QStringList& cells, const MeasuredColumns& columns) {
  if (cells.size() != columns.count)
    refuse(file, QStringLiteral("Line %1 has %2 columns, but the header has %3.")
                     .arg(line)
                     .arg(cells.size())
                     .arg(columns.count));
  MeasuredLimit row;
  row.angle = readCell(file, line, cells, columns.angle, "angle") * columns.radiansPerUnit;
  row.stretch = readCell(file, line, cells, columns.stretch, "stretch");
  if (row.stretch <= 0) refuse(file, QStringLiteral("Line %1: the stretch must be above 0.").arg(line));
  row.lower = row.upper = row.stretch;
  if (columns.lower >= 0) {
    row.lower = readCell(file, line, cells, columns.lower, "lower end");
    row.upper = readCell(file, line, cells, columns.upper, "upper end");
  } else if (columns.error >= 0) {
    const double error = readCell(file, line, cells, columns.error, "error");
    row.lower -= error;
    row.upper += error;
  }
  if (row.lower > row.stretch || row.upper < row.stretch)
    refuse(file, QStringLiteral("Line %1: the stretch lies outside of its error bar.").arg(line));
  return row;
}

}  // namespace

std::vector<MeasuredLimit> readMeasuredLimits(const QString& file) {
  QFile source(file);
  if (!source.open(QIODevice::ReadOnly)) refuse(file, QStringLiteral("The file cannot be read."));
  std::vector<MeasuredLimit> measured;
  std::optional<MeasuredColumns> columns;
  const QStringList lines = QString::fromUtf8(source.readAll()).remove(QChar(0xfeff)).split('\n');
  for (qsizetype i = 0; i < lines.size(); ++i) {
    const QString text = lines[i].trimmed();
    if (text.isEmpty() || text.startsWith('#')) continue;
    const int line = static_cast<int>(i) + 1;
    const QStringList cells = text.split(',');
    if (columns)
      measured.push_back(readRow(file, line, cells, *columns));
    else
      columns = readHeader(file, line, cells);
  }
  if (!columns)
    refuse(file, QStringLiteral("The file is empty: line 1 must name the columns angle [deg] and stretch."));
  if (measured.empty()) refuse(file, QStringLiteral("There is no measurement below the header."));
  return measured;
}

}  // namespace pliant::plots
