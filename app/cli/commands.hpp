#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/exit_status.hpp"

/// The verbs of the command line. Each prints its answer on standard output and throws base::InputError for bad input.
namespace pliant::cli {

ExitStatus list(const std::string& scene);

/// Which results to plot.
struct PlotOptions {
  std::string scene;
  std::string result;                ///< folder that `run` wrote
  std::vector<std::string> studies;  ///< empty: all that have a result
  std::string quantity = "path-length";
  bool logarithmic = false;  ///< the values of response curves
  std::string out;
};
ExitStatus plot(const PlotOptions& options, const std::string& size);

struct RunOptions {
  std::string scene;
  std::string out;
  std::vector<std::string> studies;   ///< empty: all
  std::vector<std::string> settings;  ///< "/json/pointer=VALUE"
  int threads = 0;                    ///< 0: all cores
  std::string plot;                   ///< PNG file for what the results show; empty: none
};
ExitStatus run(const RunOptions& options);
/// Only one share of the work, such as "3/8".
ExitStatus runShard(const RunOptions& options, const std::string& shard);
/// The results of what shards have computed; of all studies that have shards if none is named.
ExitStatus mergeShards(const RunOptions& options);

ExitStatus validate(const std::string& scene);

/// Where a picture or a mesh is taken from.
struct MotionOptions {
  std::string scene;
  std::string out;
  std::string result;  ///< folder that `run` wrote; empty: the rest shape
  std::string study;   ///< empty: the first of the scene that has a result
  std::string time;    ///< empty: not given
};

/// How `render` shows a strain-space boundary.
struct BoundaryLook {
  std::string quantity;  ///< that colours it; empty: the distance
  std::string compare;   ///< folder of another boundary's result, or a boundary.ply; empty: none
  std::string slice;     ///< such as "E_xy=2 %"; empty: none
  double opacity = 1;
};
ExitStatus render(const MotionOptions& options, const BoundaryLook& look, const std::string& size);
ExitStatus exportMesh(const MotionOptions& options);

/// A piece of an interlocking material for a printer; texts that are empty are not given.
struct PatchSettings {
  std::string cell, outline, tolerance, clearance;
};
/// Whether the export of a scene is a patch.
bool isPatch(const MotionOptions& options);
ExitStatus exportPatch(const MotionOptions& options, const PatchSettings& settings);

/// How the bodies of a scene are made.
struct PartsSettings {
  std::map<std::string, std::string>
      numbers;  ///< by the keys of scene::partsNumbers(); texts that are empty do not count
  bool flat = false;
};
ExitStatus exportParts(const MotionOptions& options, const PartsSettings& settings);
/// Whether a file of this name is written by exportTable.
bool isTable(const std::string& file);
/// The design parameters, with the sizes of masses.
ExitStatus exportTable(const MotionOptions& options, const PartsSettings& settings);

/// How a whole motion becomes a video or numbered pictures.
struct FilmSettings {
  std::string size = "1280x720";
  std::optional<double> picturesPerSecond;  ///< none: as recorded
  std::optional<double> speed;              ///< times faster than life; none: see render::FilmOptions
  int periods = 1;                          ///< of a periodic motion
};
/// Whether a file of this name is written by exportFilm.
bool isFilm(const std::string& file);
ExitStatus exportFilm(const MotionOptions& options, const FilmSettings& settings);
/// All of a motion as an animated .glb.
ExitStatus exportAnimation(const MotionOptions& options, const FilmSettings& settings);

/// Drapes side by side, with their limits.
struct DrapesOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> results;  ///< a folder that `run` wrote for each scene; empty: they are computed
  std::string out;
};
ExitStatus drapes(const DrapesOptions& options, const std::string& size);

/// The JSON Schema, or the tables of scenes/README.md.
ExitStatus schema(bool tables);

}  // namespace pliant::cli
