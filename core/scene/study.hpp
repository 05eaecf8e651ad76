#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/harmonic/frequency_response.hpp"
#include "core/harmonic/response_sensitivity.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// Where numbers come from: version, scene, its hash, options, threads, date (kept out of anything compared bytewise).
struct Provenance {
  std::string version;
  std::string sceneName;
  std::string sceneHash;
  std::string study;
};

/// What a study returns. A kind of result knows how it is written and read back.
class Result {
 public:
  virtual ~Result() = default;
  /// "harmonic": which views can show it.
  virtual std::string kind() const = 0;
  /// Every scalar that a person would quote (summary.json).
  virtual Json summary() const = 0;
  /// Writes summary.json and the tables beside it into `directory`, atomically (a temporary folder that is renamed).
  virtual void write(const std::filesystem::path& directory) const = 0;

  base::TerminationType termination = base::TerminationType::failed;
  std::string message;  ///< one sentence if not converged
  double seconds = 0;
  Provenance provenance;
};

/// Periodic motions of one model: a single one, or the points of a response curve.
class HarmonicResult final : public Result {
 public:
  std::string kind() const override { return "harmonic"; }
  Json summary() const override;
  void write(const std::filesystem::path& directory) const override;
  static std::shared_ptr<HarmonicResult> read(const Scene& scene, const std::filesystem::path& directory);

  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem;
  std::vector<harmonic::ResponsePoint> points;
  base::SolverReport report;
  std::shared_ptr<const harmonic::ResponseSensitivity> sensitivity;  ///< periodic_motion: at points[0]; else null
  bool isCurve = false;                                              ///< true for a frequency_response
};

/// Called from the working thread with a snapshot of what there is so far, at most about 20 times a second.
using ResultObserver = std::function<void(std::shared_ptr<const Result>)>;

/// One entry of the scene's "studies", chosen by its "type".
class Study {
 public:
  virtual ~Study() = default;
  virtual std::string name() const = 0;
  virtual std::string type() const = 0;
  /// Pure: same scene, options and version give the same result. A cancelled or failed study returns what it has;
  /// only bad input throws (base::InputError).
  virtual std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe = {}) const = 0;
};

/// Makes a study from its normalised JSON object, on a model already built.
using StudyFactory = std::function<std::unique_ptr<Study>(const Scene&, std::shared_ptr<const mechanics::Model>,
                                                          const Json& options)>;

/// Kinds of studies by "type": "periodic_motion", "frequency_response".
class StudyRegistry {
 public:
  static const StudyRegistry& instance();
  const std::vector<base::ParameterSpec>& specs() const { return specs_; }
  std::unique_ptr<Study> make(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                              const std::string& studyName) const;

 private:
  StudyRegistry();
  std::vector<base::ParameterSpec> specs_;
  std::map<std::string, StudyFactory> factories_;
};

/// Names of the scene's studies in order.
std::vector<std::string> studyNames(const Scene& scene);

}  // namespace pliant::scene
