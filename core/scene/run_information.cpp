#include "core/scene/run_information.hpp"

#include <ctime>
#include <numbers>

#include "core/math/parallel.hpp"

namespace pliant::scene {

namespace {

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

Json summaryHead(const Result& result) {
  const Json& options = result.provenance.options;
  return {{"kind", result.kind()},
          {"study", result.provenance.study},
          {"type", options.is_object() ? options.value("type", "") : ""},
          {"termination", base::toString(result.termination)},
          {"message", result.message}};
}

void addRunInformation(Json& summary, const Result& result) {
  const Provenance& from = result.provenance;
  summary["warnings"] = result.warnings();
  summary["seconds"] = result.seconds;
  summary["provenance"] = {{"version", from.version}, {"scene", from.sceneName},        {"scene_hash", from.sceneHash},
                           {"date", now()},           {"threads", math::threadCount()}, {"options", from.options}};
}

Json parameterValues(const mechanics::Model& model) {
  Json parameters = Json::array();
  for (const auto& parameter : model.parameters)
    parameters.push_back({{"name", parameter->name()},
                          {"pointer", parameter->pointer()},
                          {"value", parameter->value(model)},
                          {"unit", base::siUnit(parameter->dimension())}});
  return parameters;
}

void addFrequency(Json& json, double omega) {
  json["frequency"] = omega;
  json["frequency_hz"] = omega / (2 * std::numbers::pi);
}

Provenance provenanceOf(const Scene& scene, const Json& options) {
  return {PLIANT_VERSION, scene.name(), hashScene(scene), options["name"], options};
}

}  // namespace pliant::scene
