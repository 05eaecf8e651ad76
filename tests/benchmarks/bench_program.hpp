#pragma once

#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/scene/json_text.hpp"

namespace pliant::bench {

/// The body of a benchmark's main(): understands `AREA [--json FILE]`, calls `measure` and writes its rows
/// {area, name, seconds, iterations, unavoidable_seconds, thesis_seconds, size}. Exit status 2 with a sentence on wrong
/// usage or bad input.
inline int runBenchmark(int argc, char** argv, const std::string& area, const std::function<base::Json()>& measure) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool withFile = arguments.size() == 3 && arguments[1] == "--json";
  if (arguments.empty() || arguments[0] != area || !(arguments.size() == 1 || withFile)) {
    std::fprintf(stderr, "usage: %s %s [--json FILE]\n", argv[0], area.c_str());
    return 2;
  }
  try {
    const std::filesystem::path file =
        withFile ? arguments[2] : std::string(PLIANT_SOURCE_DIR "/build/bench/") + area + ".json";
    const base::Json rows = measure();
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
