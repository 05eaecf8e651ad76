#include "ui/plots/measured_limit.hpp"

#include "ui/plots/measured_table.hpp"

namespace pliant::plots {

std::vector<MeasuredLimit> readMeasuredLimits(const QString& file) {
  const MeasuredTable table = readMeasuredTable(file, {QStringLiteral("stretch")}, [](double stretch) {
    return stretch > 0 ? QString() : QStringLiteral("must be above 0");
  });
  std::vector<MeasuredLimit> measured;
  for (const MeasuredValue& row : table.values) measured.push_back({row.angle, row.value, row.lower, row.upper});
  return measured;
}

}  // namespace pliant::plots
