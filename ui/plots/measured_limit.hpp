#pragma once

#include <QString>
#include <vector>

namespace pliant::plots {

/// A stretch limit that was measured in one direction.
struct MeasuredLimit {
  double angle = 0;  ///< [rad]
  double stretch = 1;
  double lower = 1;  ///< ends of the error bar; both are the stretch where none is known
  double upper = 1;
};

/// Reads a comma-separated table with the columns "angle [deg]" (or [rad]) and "stretch" and, if errors are known,
/// "lower" and "upper" or "error" (half the bar); further columns, empty lines and lines that begin with # are passed
/// over. Throws base::InputError with the file as location and one sentence that names the line.
std::vector<MeasuredLimit> readMeasuredLimits(const QString& file);

}  // namespace pliant::plots
