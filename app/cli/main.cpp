#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <new>

#include "app/cli/commands.hpp"
#include "core/base/error.hpp"
#include "core/scene/parts_request.hpp"
#include "core/scene/result_charts.hpp"

namespace pliant::cli {
namespace {

int complain(std::string sentence, ExitStatus status) {
  std::replace_if(
      sentence.begin(), sentence.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  std::cerr << sentence << std::endl;
  return status;
}

void addScene(CLI::App* verb, std::string& scene) { verb->add_option("SCENE", scene, "Scene file")->required(); }

void addMotion(CLI::App* verb, MotionOptions& motion) {
  addScene(verb, motion.scene);
  verb->add_option("--result", motion.result, "Folder that `run` wrote; without it, the rest shape");
  verb->add_option("--study", motion.study, "Study whose motion is shown; else the first that has a result");
  verb->add_option(
      "--time", motion.time, "Time within the period, such as 0.1 or \"20 ms\" (0), or of a cloth (its last frame)");
}

void addRun(CLI::App* verb, RunOptions& options, const char* studies) {
  addScene(verb, options.scene);
  verb->add_option("--out", options.out, "Folder for the results, one folder a study")->required();
  verb->add_option("--study", options.studies, studies)->allow_extra_args(false);
  verb->add_option("--set", options.settings, "/json/pointer=VALUE: change a value of the scene; may be repeated")
      ->allow_extra_args(false);
  verb->add_option("--threads", options.threads, "Threads; 0: all cores")->check(CLI::Range(0, 1024));
}

/// The numbers of a patch and of the table of parameters are among these.
void addParts(CLI::App* verb, PartsSettings& parts, bool& make) {
  const std::string group = "Bodies to be made";
  CLI::Option* flag =
      verb->add_flag("--make", make,
                     "Closed bodies: shells with their thickness, solids, links as plates with holes, rods as wires "
                     "with sockets for balls of the masses; STL and 3MF in millimetres");
  flag->group(group);
  verb->add_flag("--flat", parts.flat, "Links side by side, to be printed, instead of in layers as they are mounted")
      ->group(group)
      ->needs(flag);
  for (const scene::PartsNumber& number : scene::partsNumbers()) {
    const std::string key = number.key;
    char usual[64];
    std::snprintf(usual, sizeof usual, " (%g %s)", inOwnUnit({}, number), number.unit);
    std::string description = number.description + std::string(usual);
    if (key == "clearance") description += "; of a patch, between its elements at least (0)";
    CLI::Option* option = verb->add_option("--" + key, parts.numbers[key], description)->group(group);
    if (!number.table && key != "clearance" && key != "tolerance") option->needs(flag);
  }
}

int runProgram(int argc, char** argv) {
  CLI::App program("Designs nonlinear mechanical systems: computes what a scene file describes.", "pliant-cli");
  program.set_version_flag("--version", "pliant-cli " PLIANT_VERSION);
  program.require_subcommand(1);
  ExitStatus status = done;

  std::string scene;
  CLI::App* verb = program.add_subcommand("list", "Print the studies and parameters of a scene");
  addScene(verb, scene);
  verb->callback([&] { status = list(scene); });

  RunOptions runOptions;
  std::string shard;
  verb = program.add_subcommand("run", "Compute studies and write their results");
  addRun(verb, runOptions, "Study to compute; may be repeated; else all");
  CLI::Option* plotFile =
      verb->add_option("--plot", runOptions.plot, "PNG file for the charts of the results, as `plot` draws them");
  verb->add_option(
          "--shard", shard, "I/N: compute only the I-th of N shares, for `merge`; for processes that share a large job")
      ->excludes(plotFile);
  verb->callback([&] { status = shard.empty() ? run(runOptions) : runShard(runOptions, shard); });

  verb = program.add_subcommand("merge", "Make the results of what `run --shard` has computed");
  addRun(verb, runOptions, "Study to merge; may be repeated; else all that have shards");
  verb->callback([&] { status = mergeShards(runOptions); });

  verb = program.add_subcommand("validate", "Check a scene without computing");
  addScene(verb, scene);
  verb->callback([&] { status = validate(scene); });

  MotionOptions motion;
  std::string size = "1280x720";
  verb = program.add_subcommand("render", "Draw a picture, without a display");
  addMotion(verb, motion);
  verb->add_option("--out", motion.out, "PNG file")->required();
  verb->add_option("--size", size, "Pixels, WIDTHxHEIGHT")->capture_default_str();
  BoundaryLook look;
  verb->add_option(
      "--colour", look.quantity, "What colours a boundary: distance, remaining, gap, contacts, iterations, way");
  verb->add_option("--compare", look.compare, "Another boundary over it: its result's folder, or its boundary.ply");
  verb->add_option("--slice", look.slice, "Plane that cuts a boundary, such as \"E_xy=2 %\" or \"k_xy=20 1/m\"");
  verb->add_option("--opacity", look.opacity, "Of a boundary")->check(CLI::Range(0.05, 1.0))->capture_default_str();
  verb->callback([&] { status = render(motion, look, size); });

  PlotOptions plotOptions;
  verb = program.add_subcommand(
      "plot",
      "Draw response curves, comparisons of methods, energies, or limits over directions and sizes, without a display");
  addScene(verb, plotOptions.scene);
  verb->add_option("--result", plotOptions.result, "Folder that `run` wrote")->required();
  verb->add_option("--study", plotOptions.studies, "Study to plot; may be repeated; else all that have a result")
      ->allow_extra_args(false);
  verb->add_option("--quantity", plotOptions.quantity, "What response curves show")
      ->check(CLI::IsMember(scene::responseQuantities()))
      ->capture_default_str();
  verb->add_flag("--log", plotOptions.logarithmic, "Show it on a logarithmic axis");
  verb->add_option("--out", plotOptions.out, "PNG file")->required();
  verb->add_option("--size", size, "Pixels, WIDTHxHEIGHT")->capture_default_str();
  verb->callback([&] { status = plot(plotOptions, size); });

  DrapesOptions drapesOptions;
  verb = program.add_subcommand("drapes", "Draw stretch limits and the drapes they lead to, side by side");
  verb->add_option("SCENE", drapesOptions.scenes, "Scene files")->required();
  verb->add_option("--result", drapesOptions.results,
                   "Folder that `run` wrote, once for each scene in their order; else the drapes are computed")
      ->allow_extra_args(false);
  verb->add_option("--out", drapesOptions.out, "PNG file")->required();
  verb->add_option("--size", size, "Pixels, WIDTHxHEIGHT")->capture_default_str();
  verb->callback([&] { status = drapes(drapesOptions, size); });

  FilmSettings film;
  verb =
      program.add_subcommand("export",
                             "Write the surface as STL, OBJ, PLY, glTF, glb or 3MF (of an interlocking material, a "
                             "patch for a printer), closed bodies to be made with --make, the "
                             "whole motion as a video, pictures or an animation, or the design parameters as a table");
  addMotion(verb, motion);
  verb->add_option(
          "--out", motion.out,
          "Mesh file, video (.ogv), numbered pictures (.png) or table of parameters (.csv); its ending chooses the "
          "format")
      ->required();
  verb->add_option("--size", film.size, "Pixels of a video or of pictures, WIDTHxHEIGHT")->capture_default_str();
  verb->add_option("--fps", film.picturesPerSecond,
                   "Pictures in a second; else a cloth's as its frames were recorded, and 30 of a periodic motion")
      ->check(CLI::Range(0.01, 1000.0));
  verb->add_option("--speed", film.speed,
                   "Times faster than life; else a cloth moves in real time, and a period takes 2 seconds")
      ->check(CLI::PositiveNumber);
  verb->add_option("--periods", film.periods, "Periods of a periodic motion")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  bool animate = false;
  verb->add_flag("--animate", animate, "The whole motion as an animated .glb; of a periodic motion one period");
  PatchSettings patch;
  verb->add_option("--cell", patch.cell, "Interlocking material, where the scene has several");
  verb->add_option(
      "--patch", patch.outline,
      "Piece of an interlocking material: 10x8 cells, a rectangle \"60 mm x 40 mm\", a circle \"50 mm\", or "
      "a polygon FILE.csv (3x3)");
  PartsSettings parts;
  bool make = false;
  addParts(verb, parts, make);
  verb->callback([&] {
    patch.tolerance = parts.numbers["tolerance"];
    patch.clearance = parts.numbers["clearance"];
    if (isFilm(motion.out))
      status = exportFilm(motion, film);
    else if (animate)
      status = exportAnimation(motion, film);
    else if (isPatch(motion))
      status = exportPatch(motion, patch);
    else if (isTable(motion.out))
      status = exportTable(motion, parts);
    else
      status = make ? exportParts(motion, parts) : exportMesh(motion);
  });

  bool tables = false;
  verb = program.add_subcommand("schema", "Print the JSON Schema of scene files");
  verb->add_flag("--tables", tables, "Print the tables of scenes/README.md instead");
  verb->callback([&] { status = schema(tables); });

  program.footer("Exit status: 0 done; 1 not converged; 2 wrong usage or input; 130 cancelled.");
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return complain(std::string("pliant-cli: ") + error.what() + " (see --help)", wrongInput);
  }
  return status;
}

}  // namespace
}  // namespace pliant::cli

int main(int argc, char** argv) {
  using namespace pliant;
  try {
    return cli::runProgram(argc, argv);
  } catch (const base::InputError& error) {
    return cli::complain(error.what(), cli::wrongInput);
  } catch (const std::bad_alloc&) {
    return cli::complain("There is not enough memory for this computation.", cli::notConverged);
  } catch (const std::exception& error) {
    return cli::complain(error.what(), cli::notConverged);
  }
}
