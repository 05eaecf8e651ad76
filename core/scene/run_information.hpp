#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// What stands at the head of every summary.json: kind, study, type, termination, message.
Json summaryHead(const Result& result);
/// What stands at its end: warnings, seconds and provenance.
void addRunInformation(Json& summary, const Result& result);
/// Name, pointer, value and unit of every design parameter.
Json parameterValues(const mechanics::Model& model);
/// "frequency" in rad/s and "frequency_hz".
void addFrequency(Json& json, double omega);

/// Where the numbers of a study with these options come from.
Provenance provenanceOf(const Scene& scene, const Json& options);

}  // namespace pliant::scene
