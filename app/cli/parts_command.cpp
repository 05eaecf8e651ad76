#include <filesystem>
#include <iostream>
#include <numbers>

#include "app/cli/commands.hpp"
#include "app/cli/moment.hpp"
#include "core/base/error.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/parameter_table.hpp"
#include "core/scene/parts_export.hpp"

namespace pliant::cli {

namespace {

/// So many times of a period are looked at for links that meet.
constexpr int motionSamples = 32;

scene::PartsRequest requestFrom(const PartsSettings& settings) {
  scene::PartsRequest request;
  request.flat = settings.flat;
  for (const scene::PartsNumber& number : scene::partsNumbers())
    if (const auto given = settings.numbers.find(number.key); given != settings.numbers.end() && !given->second.empty())
      request.*number.value =
          scene::locate("--" + given->first, [&] { return base::parseQuantity(given->second, number.dimension); });
  try {
    checkRequest(request);
  } catch (const base::InputError& error) {
    throw base::InputError("--" + error.location(), error.problem());
  }
  return request;
}

}  // namespace

bool isTable(const std::string& file) { return std::filesystem::path(file).extension() == ".csv"; }

ExitStatus exportParts(const MotionOptions& options, const PartsSettings& settings) {
  const scene::PartsRequest request = requestFrom(settings);
  const auto scene = scene::Scene::load(options.scene);
  const Moment moment = findMoment(options);
  scene::PartsSource source{scene, *moment.model, moment.model->restPositions, {}};
  if (moment.problem) {
    source.positions = moment.problem->configurationAt(moment.z, moment.tau);
    const int samples = motionSamples * moment.problem->basis().periods();
    for (int i = 0; i < samples; ++i)
      source.motion.push_back(moment.problem->configurationAt(moment.z, 2 * std::numbers::pi * i / samples));
  }
  base::ExecutionContext context;
  const scene::PartsReport report = *scene::exportParts(source, request, options.out, context);  // nobody cancels
  std::vector<std::string> lines = linesOf(report);
  lines.back() = options.out + ": " + lines.back();
  for (const std::string& line : lines) std::cout << line << '\n';
  return done;
}

ExitStatus exportTable(const MotionOptions& options, const PartsSettings& settings) {
  const scene::PartsRequest request = requestFrom(settings);
  const Moment moment = findMoment(options);
  const int rows = scene::writeParameterTable(*moment.model, request, options.out);
  std::cout << options.out << ": " << rows << " parameters\n";
  return done;
}

}  // namespace pliant::cli
