#include "ui/render/film.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/pending_file.hpp"
#include "core/scene/macro_result.hpp"
#include "ui/render/macro_view.hpp"
#include "ui/render/offscreen_target.hpp"

namespace pliant::render {
namespace {

constexpr double motionRate = 30;     // [1/s] of a periodic motion
constexpr double stillRate = 25;      // [1/s] of a single frame
constexpr double mostPictures = 1e6;  // more is a mistake
constexpr double slack = 1e-6;        // of the time between two pictures

/// Where pictures go.
class Reel {
 public:
  virtual ~Reel() = default;
  virtual void add(const Image& image) = 0;
  /// Returns the number of files.
  virtual int commit() = 0;
};

class VideoReel final : public Reel {
 public:
  VideoReel(const std::filesystem::path& file, const PictureOptions& picture, FrameRate rate)
      : video_(file, picture.width, picture.height, rate) {}
  void add(const Image& image) override { video_.add(image); }
  int commit() override {
    video_.commit();
    return 1;
  }

 private:
  TheoraVideo video_;
};

class PictureReel final : public Reel {
 public:
  explicit PictureReel(std::filesystem::path file) : file_(std::move(file)) {}
  void add(const Image& image) override {
    char number[16];
    std::snprintf(number, sizeof number, "_%05d", static_cast<int>(files_.size()));
    base::PendingFile& file =
        files_.emplace_back(file_.parent_path() / (file_.stem().string() + number + file_.extension().string()));
    file.write(pngOf(image));
    file.finish();
  }
  int commit() override {
    for (base::PendingFile& file : files_) file.commit();
    return static_cast<int>(files_.size());
  }

 private:
  std::filesystem::path file_;
  std::vector<base::PendingFile> files_;
};

std::unique_ptr<Reel> makeReel(const std::filesystem::path& file, const PictureOptions& picture, FrameRate rate) {
  std::string extension = file.extension().string();
  std::transform(
      extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  if (extension == ".ogv") return std::make_unique<VideoReel>(file, picture, rate);
  if (extension == ".png") return std::make_unique<PictureReel>(file);
  throw base::InputError(file.string(), "The name of a video must end in .ogv, that of numbered pictures in .png.");
}

int checkedCount(double pictures) {
  if (!(pictures <= mostPictures)) throw base::InputError("", "This film would have more than a million pictures.");
  return std::max(1, static_cast<int>(pictures));
}

double checkedSpeed(const FilmOptions& options, double usual) {
  const double speed = options.speed.value_or(usual);
  if (!(speed > 0 && std::isfinite(speed))) throw base::InputError("", "The speed of a film must be positive.");
  return speed;
}

/// `show` brings the view to the picture with a number, before it is drawn.
std::optional<Film> shoot(View& view, int count, FrameRate rate, const std::function<void(int)>& show,
                          const FilmOptions& options, const std::filesystem::path& file, OffscreenTarget& target,
                          base::ExecutionContext& context) {
  target.setSize(options.picture.width, options.picture.height);  // refuses before a file is begun
  const std::unique_ptr<Reel> reel = makeReel(file, options.picture, rate);
  view.attach(target.window());
  view.setPixelRatio(options.pixelRatio);
  view.setTheme(options.picture.theme);
  view.setFieldVisible(options.fieldVisible);
  view.setCaption(options.picture.caption);
  show(0);  // the camera is fitted beside the legend, which is there with the first frame
  view.setAxisView(options.picture.view);
  if (options.camera) view.setCameraPose(*options.camera);
  Image image;
  for (int i = 0; i < count; ++i) {
    if (context.cancelRequested()) return std::nullopt;
    show(i);
    target.render(image);
    reel->add(image);
    context.reportProgress(static_cast<double>(i + 1) / count);
  }
  if (context.cancelRequested()) return std::nullopt;
  return Film{count, rate, reel->commit()};
}

std::string timeLine(double time, FrameClock clock) {
  char text[40];
  std::snprintf(text, sizeof text, clock == FrameClock::seconds ? "t = %.3f s" : "step %.0f", time);
  return text;
}

}  // namespace

namespace {

/// Films frames, each until the next one's time: `showFrame(i)` shows one. The caption tells the time if the view does
/// not.
template <class Frame>
std::optional<Film> filmFrames(View& view, OffscreenTarget& target,
                               const std::vector<std::shared_ptr<const Frame>>& frames, FrameClock clock,
                               bool viewTellsTime, const std::function<void(int)>& showFrame,
                               const FilmOptions& options, const std::filesystem::path& file,
                               base::ExecutionContext& context) {
  const double speed = checkedSpeed(options, 1) * clockRate(clock);
  double shortest = INFINITY;
  for (std::size_t i = 1; i < frames.size(); ++i) shortest = std::min(shortest, frames[i]->time - frames[i - 1]->time);
  const double recorded = frames.size() > 1 ? std::clamp(speed / shortest, 1.0, FrameRate::fastest) : stillRate;
  const FrameRate rate = frameRate(options.picturesPerSecond.value_or(recorded));
  const double begin = frames.front()->time, end = frames.back()->time;
  const double between = speed / rate.perSecond();
  const int count = checkedCount(std::ceil((end - begin) / between - slack) + 1);
  std::size_t shown = 0;
  const auto show = [&](int picture) {
    const double reached = begin + (picture + slack) * between;
    while (shown + 1 < frames.size() && (frames[shown + 1]->time <= reached || picture == count - 1)) ++shown;
    showFrame(static_cast<int>(shown));
    if (viewTellsTime) return;
    view.setCaption(options.picture.caption + (options.picture.caption.empty() ? "" : "\n") +
                    timeLine(frames[shown]->time, clock));
  };
  return shoot(view, count, rate, show, options, file, target, context);
}

}  // namespace

std::optional<Film> filmCloth(const std::shared_ptr<const cloth::ClothProblem>& problem,
                              const std::vector<std::shared_ptr<const scene::ClothFrame>>& frames, FrameClock clock,
                              const FilmOptions& options, const std::filesystem::path& file,
                              base::ExecutionContext& context) {
  if (frames.empty()) throw base::InputError(file.string(), "There are no frames of a cloth to film.");
  OffscreenTarget target;
  ClothView view;
  view.setProblem(problem);
  view.setFrames(frames);
  view.setSelectedNode(options.picture.selectedNode);
  view.setField(options.field);
  view.setDirectionsVisible(options.directionsVisible);
  return filmFrames(
      view, target, frames, clock, false, [&](int frame) { view.setFrame(frame); }, options, file, context);
}

std::optional<Film> filmMacro(const std::shared_ptr<const scene::MacroResult>& result, const FilmOptions& options,
                              const std::filesystem::path& file, base::ExecutionContext& context) {
  if (result->frames.empty()) throw base::InputError(file.string(), "There are no frames of a sheet to film.");
  OffscreenTarget target;
  MacroView view;
  view.setResult(result);
  view.setField(options.macroField);
  view.setSelectedTriangle(options.selectedTriangle);
  return filmFrames(
      view, target, result->frames, result->isMotion() ? FrameClock::seconds : FrameClock::loads, true,
      [&](int frame) { view.setFrame(frame); }, options, file, context);
}

std::optional<Film> filmMotion(const std::shared_ptr<const harmonic::HarmonicBalanceProblem>& problem,
                               const mechanics::Vector& z, double period, const FilmOptions& options,
                               const std::filesystem::path& file, base::ExecutionContext& context) {
  const double speed = checkedSpeed(options, period / (secondsPerPeriod * problem->basis().periods()));
  const FrameRate rate = frameRate(options.picturesPerSecond.value_or(motionRate));
  const int each = checkedCount(std::round(period / speed * rate.perSecond()));
  const int count = checkedCount(static_cast<double>(each) * std::max(1, options.periods));

  OffscreenTarget target;
  MotionView view;
  view.setModel(problem->sharedModel());
  view.setMotion(problem, z);
  view.setSelectedNode(options.picture.selectedNode);
  const auto show = [&](int picture) { view.setTau(2 * std::numbers::pi * (picture % each) / each); };
  return shoot(view, count, rate, show, options, file, target, context);
}

}  // namespace pliant::render
