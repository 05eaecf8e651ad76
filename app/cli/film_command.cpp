#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>

#include "app/cli/interlock_pictures.hpp"
#include "app/cli/moment.hpp"
#include "app/cli/progress_display.hpp"
#include "core/base/error.hpp"
#ifdef PLIANT_HAS_RENDERER
#include "app/cli/picture_size.hpp"
#include "ui/render/film.hpp"
#endif

namespace pliant::cli {

using base::InputError;

bool isFilm(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(
      extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ".ogv" || extension == ".png";
}

#ifdef PLIANT_HAS_RENDERER

ExitStatus exportFilm(const MotionOptions& options, const FilmSettings& settings) {
  render::FilmOptions film;
  film.picture = pictureOf(settings.size);
  film.picturesPerSecond = settings.picturesPerSecond;
  film.speed = settings.speed;
  film.periods = settings.periods;
  if (!options.time.empty())
    throw InputError("--time", "A video and numbered pictures show all of a motion; `render` draws one moment.");
  if (options.result.empty())
    throw InputError("--result", "A video and numbered pictures need the folder that `run` wrote.");
  const auto sheet = findSheetMotion(options);
  const Moment moment = sheet ? Moment() : findMoment(options);
  film.picture.caption = sheet ? sheet->provenance.study : moment.caption;
  if (!sheet && moment.model->dimension < 3) film.picture.view = render::AxisView::top;  // as in the window

  ProgressDisplay display;
  base::ExecutionContext context([&](double fraction, const std::string&) { display.show(fraction, options.out); });
  const CancelOnInterrupt interrupt(context);
  const auto clock = moment.cloth && moment.cloth->studyType() != "cloth_motion" ? render::FrameClock::steps
                                                                                 : render::FrameClock::seconds;
  const std::optional<render::Film> made =
      sheet          ? render::filmMacro(sheet, film, options.out, context)
      : moment.cloth ? render::filmCloth(moment.cloth->problem, moment.cloth->frames, clock, film, options.out, context)
                     : render::filmMotion(moment.problem, moment.z, moment.period, film, options.out, context);
  display.clear();
  if (!made) return cancelled;
  std::cout << options.out << ": " << made->pictures << " pictures of " << film.picture.width << " x "
            << film.picture.height << " pixels, " << base::formatQuantity(made->rate.perSecond(), {}) << " a second\n";
  return done;
}

#else

ExitStatus exportFilm(const MotionOptions&, const FilmSettings&) {
  throw InputError("export", "This build of pliant-cli has no renderer; build with PLIANT_BUILD_UI.");
}

#endif

}  // namespace pliant::cli
