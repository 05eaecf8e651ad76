#include "ui/render/round_numbers.hpp"

#include <cmath>

namespace pliant::render {

std::vector<double> roundNumbers(double minimum, double maximum, int count) {
  const double span = maximum - minimum;
  if (!(span > 0) || !std::isfinite(span)) return {minimum};
  const double rough = span / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1 - 1e-9)) {
      step = factor * power;
      break;
    }
  std::vector<double> numbers;
  for (double i = std::ceil(minimum / step - 1e-9); i * step <= maximum + 1e-9 * span; ++i) numbers.push_back(i * step);
  return numbers;
}

}  // namespace pliant::render
