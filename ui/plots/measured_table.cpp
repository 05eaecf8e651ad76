#include "ui/plots/measured_table.hpp"

#include <QFile>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/error.hpp"

namespace pliant::plots {

namespace {

/// The columns of a table of measurements; -1: there is none.
struct MeasuredColumns {
  int angle = -1, value = -1, lower = -1, upper = -1, error = -1;
  double radiansPerUnit = std::numbers::pi / 180;
  double valuePerUnit = 1;
  QString quantity;
  qsizetype count = 0;
};

[[noreturn]] void refuse(const QString& file, const QString& sentence) {
  throw base::InputError(file.toStdString(), sentence.toStdString());
}

MeasuredColumns readHeader(const QString& file, int line, const QStringList& names, const QStringList& quantities) {
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
    } else if (quantities.contains(name) && columns.value < 0) {
      columns.value = index;
      columns.quantity = name;
      if (unit == "%") columns.valuePerUnit = 0.01;
    } else if (name == "lower") {
      columns.lower = index;
    } else if (name == "upper") {
      columns.upper = index;
    } else if (name == "error") {
      columns.error = index;
    }
  }
  for (const auto& [index, name] :
       {std::pair(columns.angle, QStringLiteral("angle [deg]")), std::pair(columns.value, quantities.join("” or “"))})
    if (index < 0) refuse(file, QStringLiteral("Line %1: the header names no column “%2”.").arg(line).arg(name));
  if ((columns.lower < 0) != (columns.upper < 0))
    refuse(file, QStringLiteral("Line %1: of the columns “lower” and “upper” there is only one.").arg(line));
  return columns;
}

double readCell(const QString& file, int line, const QStringList& cells, int column, const QString& name) {
  const QString text = cells[column].trimmed();
  if (text.isEmpty()) refuse(file, QStringLiteral("Line %1: the %2 is empty.").arg(line).arg(name));
  bool isNumber = false;
  const double value = text.toDouble(&isNumber);
  if (!isNumber || !std::isfinite(value))
    refuse(file, QStringLiteral("Line %1: the %2 “%3” is no finite number.").arg(line).arg(name).arg(text));
  return value;
}

MeasuredValue readRow(const QString& file, int line, const QStringList& cells, const MeasuredColumns& columns,
                      const std::function<QString(double)>& check) {
  if (cells.size() != columns.count)
    refuse(file, QStringLiteral("Line %1 has %2 columns, but the header has %3.")
                     .arg(line)
                     .arg(cells.size())
                     .arg(columns.count));
  const auto cell = [&](int column, const QString& name) { return readCell(file, line, cells, column, name); };
  MeasuredValue row;
  row.angle = cell(columns.angle, QStringLiteral("angle")) * columns.radiansPerUnit;
  row.value = cell(columns.value, columns.quantity) * columns.valuePerUnit;
  if (const QString problem = check ? check(row.value) : QString(); !problem.isEmpty())
    refuse(file, QStringLiteral("Line %1: the %2 %3.").arg(line).arg(columns.quantity, problem));
  row.lower = row.upper = row.value;
  if (columns.lower >= 0) {
    row.lower = cell(columns.lower, QStringLiteral("lower end")) * columns.valuePerUnit;
    row.upper = cell(columns.upper, QStringLiteral("upper end")) * columns.valuePerUnit;
  } else if (columns.error >= 0) {
    const double error = cell(columns.error, QStringLiteral("error")) * columns.valuePerUnit;
    row.lower -= error;
    row.upper += error;
  }
  if (row.lower > row.value || row.upper < row.value)
    refuse(file, QStringLiteral("Line %1: the %2 lies outside of its error bar.").arg(line).arg(columns.quantity));
  return row;
}

}  // namespace

MeasuredTable readMeasuredTable(const QString& file, const QStringList& quantities,
                                const std::function<QString(double)>& check) {
  QFile source(file);
  if (!source.open(QIODevice::ReadOnly)) refuse(file, QStringLiteral("The file cannot be read."));
  MeasuredTable measured;
  std::optional<MeasuredColumns> columns;
  const QStringList lines = QString::fromUtf8(source.readAll()).remove(QChar(0xfeff)).split('\n');
  for (qsizetype i = 0; i < lines.size(); ++i) {
    const QString text = lines[i].trimmed();
    if (text.isEmpty() || text.startsWith('#')) continue;
    const int line = static_cast<int>(i) + 1;
    const QStringList cells = text.split(',');
    if (columns)
      measured.values.push_back(readRow(file, line, cells, *columns, check));
    else
      columns = readHeader(file, line, cells, quantities);
  }
  if (!columns)
    refuse(file, QStringLiteral("The file is empty: line 1 must name the columns angle [deg] and %1.")
                     .arg(quantities.join(QStringLiteral(" or "))));
  if (measured.values.empty()) refuse(file, QStringLiteral("There is no measurement below the header."));
  measured.quantity = columns->quantity;
  return measured;
}

}  // namespace pliant::plots
