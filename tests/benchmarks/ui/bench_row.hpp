#pragma once

#include <QCoreApplication>
#include <QElapsedTimer>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "core/scene/json_text.hpp"

namespace pliant::bench {

constexpr int repetitions = 60;

/// Calls act(i) again and again, with all events that it gives rise to, painting included. What it takes is the median;
/// beside it stands the processor's time of all threads, the mean, which a busy machine changes little.
template <class Act>
base::Json rowOf(const std::string& name, int size, const Act& act, int count = repetitions) {
  std::vector<double> seconds;
  const std::clock_t before = std::clock();
  for (int i = 0; i < count; ++i) {
    QElapsedTimer watch;
    watch.start();
    act(i);
    QCoreApplication::processEvents();
    seconds.push_back(1e-9 * static_cast<double>(watch.nsecsElapsed()));
  }
  const double processor =
      static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC / static_cast<double>(seconds.size());
  std::sort(seconds.begin(), seconds.end());
  const double median = seconds[seconds.size() / 2];
  std::printf("%-36s %7d %10.2f ms (fastest %.2f, slowest %.2f), processor %.2f ms\n", name.c_str(), size, 1e3 * median,
              1e3 * seconds.front(), 1e3 * seconds.back(), 1e3 * processor);
  std::fflush(stdout);
  base::Json row;
  row["area"] = "ui";
  row["name"] = name;
  row["seconds"] = median;
  row["processor_seconds"] = processor;
  row["iterations"] = count;
  row["unavoidable_seconds"] = nullptr;
  row["thesis_seconds"] = nullptr;
  row["size"] = size;
  return row;
}

}  // namespace pliant::bench
