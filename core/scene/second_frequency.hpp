#pragma once

#include <string>
#include <vector>

#include "core/scene/csv.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// Whether a study's options ask for motions with two driving frequencies.
bool hasSecondFrequency(const Json& options);

/// The basis of a study of harmonic balance with these options.
math::HarmonicBasis basisOf(const Json& options);
/// That of a result with this summary. Throws std::invalid_argument if the numbers are impossible.
math::HarmonicBasis basisOfResult(const Json& summary);

/// Throws base::InputError at the study if drives or loads have terms of a second frequency that it does not know, or
/// if it has options that two frequencies rule out.
void checkSecondFrequency(const Scene& scene, const Json& options);

/// What a summary says more of motions with two frequencies: the second one, and of the probes of a single motion the
/// strongest combinations.
void addSecondFrequency(const HarmonicResult& result, Json& json);
void addSecondFrequencyUnits(Json& units);

/// A row a point and combination: its multiples, its frequency, and how far it moves each probe.
std::string combinationTable(const HarmonicResult& result);

/// Rows of trajectories.csv of a point: over the span, and of a curve's points over a period of the first frequency.
void addTimeSeries(const HarmonicResult& result, const harmonic::ResponsePoint& point, int index, CsvWriter& csv);

/// Sentences about a second frequency that nothing drives at, or that a common period would do for.
std::vector<std::string> secondFrequencyWarnings(const harmonic::HarmonicBalanceProblem& problem);

}  // namespace pliant::scene
