#pragma once

#include <vector>

namespace pliant::render {

/// Round numbers in [minimum, maximum], about `count` of them: 1, 2 or 5 times a power of ten apart.
std::vector<double> roundNumbers(double minimum, double maximum, int count);

}  // namespace pliant::render
