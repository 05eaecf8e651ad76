#pragma once

#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/scene/json_text.hpp"

namespace pliant::bench {

/// What a program can measure, by name.
using Areas = std::map<std::string, std::function<base::Json()>>;

/// The body of a benchmark's main(): understands `AREA [--json FILE]`, measures the area and writes its rows
/// {area, name, seconds, iterations, unavoidable_seconds, thesis_seconds, size}. Exit status 2 with a sentence on wrong
/// usage or bad input.
inline int runBenchmark(int argc, char** argv, const Areas& areas) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool withFile = arguments.size() == 3 && arguments[1] == "--json";
  if (arguments.empty() || !areas.contains(arguments[0]) || !(arguments.size() == 1 || withFile)) {
    for (const auto& [area, measure] : areas)
      std::fprintf(stderr, "usage: %s %s [--json FILE]\n", argv[0], area.c_str());
    return 2;
  }
  try {
    const std::string& area = arguments[0];
    const std::filesystem::path file =
        withFile ? arguments[2] : std::string(PLIANT_SOURCE_DIR "/build/bench/") + area + ".json";
    const base::Json rows = areas.at(area)();
    std::filesystem::create_directories(file.parent_path());
    scene::writeTextFile(file, scene::formatJson(rows));
    std::printf("written to %s\n", file.c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

}  // namespace pliant::bench
