#include "core/harmonic/frequency_response.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/harmonic/response_tracer.hpp"

namespace pliant::harmonic {

void requireFrequencyRange(double from, double to) {
  if (!(std::isfinite(from) && std::isfinite(to) && from > 0 && to > 0))
    throw base::InputError("", "the frequencies of a response curve must be finite and above 0");
  if (from == to) throw base::InputError("", "the frequency range of a response curve is empty");
}

FrequencyResponse traceFrequencyResponse(HarmonicBalanceProblem& problem, const FrequencyResponseOptions& options,
                                         base::ExecutionContext& context,
                                         const std::function<void(const ResponsePoint&)>& onPoint) {
  requireFrequencyRange(options.from, options.to);
  const PeriodicMotion start = solvePeriodicMotion(problem, options.from, options.newton, context, options.start);
  FrequencyResponse response;
  if (start.report.converged()) {
    response = ResponseTracer(problem, options, context, onPoint).run(start.z);
  } else {
    response.report = start.report;
    response.report.iterations.clear();
  }
  response.report.seconds += start.report.seconds;
  return response;
}

}  // namespace pliant::harmonic
