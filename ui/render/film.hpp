#pragma once

#include "core/base/execution_context.hpp"
#include "ui/render/cloth_view.hpp"
#include "ui/render/macro_field.hpp"
#include "ui/render/offscreen.hpp"
#include "ui/render/theora_video.hpp"

namespace pliant::scene {
class MacroResult;
}

namespace pliant::render {

/// What a frame's time counts: seconds, the steps of a drape, or the part of all loads that acts.
enum class FrameClock { seconds, steps, loads };

constexpr double drapeStepsPerSecond = 5;  ///< how fast drapes play
constexpr double loadsPerSecond = 0.25;    ///< how fast loads come
/// What a clock counts in a second, when nothing is shown faster than it is.
constexpr double clockRate(FrameClock clock) {
  return clock == FrameClock::steps ? drapeStepsPerSecond : clock == FrameClock::loads ? loadsPerSecond : 1;
}
constexpr double secondsPerPeriod = 2;  ///< how long a period of a periodic motion takes to play

/// How what moves becomes pictures.
struct FilmOptions {
  PictureOptions picture;            ///< a line with the time stands below the caption of a cloth or sheet
  double pixelRatio = 1;             ///< scales text, lines and markers
  std::optional<CameraPose> camera;  ///< else as `picture.view` looks, with all of the motion in view
  bool fieldVisible = true;
  ClothField field = ClothField::stretchRatio;
  bool directionsVisible = false;
  MacroField macroField = MacroField::nearest;
  std::optional<int> selectedTriangle;  ///< of a sheet of interlocking material
  /// [1/s]; else every frame of a cloth has its picture, as far as frames are evenly recorded, and a periodic motion
  /// has 30.
  std::optional<double> picturesPerSecond;
  /// Times faster than life; else 1 (drapes: drapeStepsPerSecond), and secondsPerPeriod for a periodic motion.
  std::optional<double> speed;
  int periods = 1;  ///< of a periodic motion
};

/// What was written.
struct Film {
  int pictures = 0;
  FrameRate rate;
  int files = 0;
};

/// Draws a cloth at its frames, each until the next one's time, without a display and on any thread, and writes a video
/// (FILE.ogv) or numbered pictures (FILE_00000.png, ...). The video plays in real time whatever its rate. All files
/// appear at the end; where the context is cancelled there are none, and no Film. Throws base::InputError for another
/// extension, for rates and sizes that cannot be, or if a file cannot be written, and std::runtime_error as
/// renderToImage does.
std::optional<Film> filmCloth(const std::shared_ptr<const cloth::ClothProblem>& problem,
                              const std::vector<std::shared_ptr<const scene::ClothFrame>>& frames, FrameClock clock,
                              const FilmOptions& options, const std::filesystem::path& file,
                              base::ExecutionContext& context);

/// The same of the frames of a "macro_motion".
std::optional<Film> filmMacro(const std::shared_ptr<const scene::MacroResult>& result, const FilmOptions& options,
                              const std::filesystem::path& file, base::ExecutionContext& context);

/// The same of the periodic motion with coefficients `z` and this period [s], in pictures evenly spaced, so that the
/// last is followed by the first.
std::optional<Film> filmMotion(const std::shared_ptr<const harmonic::HarmonicBalanceProblem>& problem,
                               const mechanics::Vector& z, double period, const FilmOptions& options,
                               const std::filesystem::path& file, base::ExecutionContext& context);

}  // namespace pliant::render
