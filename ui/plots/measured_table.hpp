#pragma once

#include <QString>
#include <QStringList>
#include <functional>
#include <vector>

namespace pliant::plots {

/// A value that was measured in one direction.
struct MeasuredValue {
  double angle = 0;  ///< [rad]
  double value = 0;
  double lower = 0;  ///< ends of the error bar; both are the value where none is known
  double upper = 0;
};

/// Measured values of one quantity.
struct MeasuredTable {
  QString quantity;  ///< the name of its column
  std::vector<MeasuredValue> values;
};

/// Reads a comma-separated table with the columns "angle [deg]" (or [rad]) and one of `quantities` (with [%] in the
/// header values are divided by 100) and, if errors are known, "lower" and "upper" or "error" (half the bar); further
/// columns, empty lines and lines that begin with # are passed over. `check` gets each value and returns a sentence's
/// end about what is wrong with it, or nothing. Throws base::InputError with the file as location and one sentence that
/// names the line.
MeasuredTable readMeasuredTable(const QString& file, const QStringList& quantities,
                                const std::function<QString(double)>& check = {});

}  // namespace pliant::plots
