#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/harmonic/frequency_response.hpp"
#include "core/harmonic/response_sensitivity.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

/// Where numbers come from.
struct Provenance {
  std::string version;
  std::string sceneName;
  std::string sceneHash;  ///< of the normalised scene and the mesh files it names, see `hashScene`
  std::string study;
  Json options;  ///< the study's normalised entry
};

/// What a study returns. A kind of result knows how it is written and read back.
class Result {
 public:
  virtual ~Result() = default;
  /// "harmonic", "modes", "time", "comparison", "cloth", "interlock": which views can show it.
  virtual std::string kind() const = 0;
  /// Every scalar that a person would quote (summary.json).
  virtual Json summary() const = 0;
  /// Writes summary.json and the tables beside it into `directory`, atomically (a temporary folder that is renamed); an
  /// older result there is replaced. Throws base::InputError if it cannot be written or would replace anything else.
  virtual void write(const std::filesystem::path& directory) const = 0;
  /// Sentences about what makes the numbers doubtful: in the log when the study ends, and in summary.json.
  virtual std::vector<std::string> warnings() const { return {}; }

  base::TerminationType termination = base::TerminationType::failed;
  std::string message;  ///< one sentence if not converged
  double seconds = 0;
  Provenance provenance;
};

/// The points of a curve. Copies share the points, so a snapshot of a growing curve costs a pointer a point.
class ResponsePoints {
 public:
  class Iterator {
   public:
    using Base = std::vector<std::shared_ptr<const harmonic::ResponsePoint>>::const_iterator;
    explicit Iterator(Base base) : base_(base) {}
    const harmonic::ResponsePoint& operator*() const { return **base_; }
    const harmonic::ResponsePoint* operator->() const { return base_->get(); }
    Iterator& operator++() { return ++base_, *this; }
    bool operator==(const Iterator&) const = default;

   private:
    Base base_;
  };

  std::size_t size() const { return points_.size(); }
  bool empty() const { return points_.empty(); }
  const harmonic::ResponsePoint& operator[](std::size_t i) const { return *points_[i]; }
  const harmonic::ResponsePoint& front() const { return *points_.front(); }
  const harmonic::ResponsePoint& back() const { return *points_.back(); }
  Iterator begin() const { return Iterator(points_.begin()); }
  Iterator end() const { return Iterator(points_.end()); }
  void push_back(harmonic::ResponsePoint point) {
    points_.push_back(std::make_shared<const harmonic::ResponsePoint>(std::move(point)));
  }

 private:
  std::vector<std::shared_ptr<const harmonic::ResponsePoint>> points_;
};

struct PeakSensitivities;

/// Periodic motions of one model: a single one, or the points of a response curve.
class HarmonicResult final : public Result {
 public:
  std::string kind() const override { return "harmonic"; }
  Json summary() const override;
  /// summary.json, response.csv (a row a point), coefficients.csv (every point's Fourier coefficients, exactly; zeros
  /// where another point has more of them), trajectories.csv (of the probes), mesh.ply (the rest shape, if there are
  /// triangles), sensitivity.csv, peak_sensitivity.csv, constraint_violation.csv (over a period, if there are rigid
  /// links).
  void write(const std::filesystem::path& directory) const override;
  /// Of rods that turn farther than mechanics::largestTrustedTurn.
  std::vector<std::string> warnings() const override;
  /// What `write` wrote for a scene with the same nodes. The model gets the values of the design parameters with which
  /// the result was computed. Throws base::InputError.
  static std::shared_ptr<HarmonicResult> read(const Scene& scene, const std::filesystem::path& directory);

  /// The problem whose motion a point is: `problem`, or that with its number of drive periods.
  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problemOf(const harmonic::ResponsePoint& point) const;
  /// Makes problemOf(point) if it is not there yet.
  void addProblemOf(const harmonic::ResponsePoint& point);
  /// Whether strains can be told.
  bool hasTriangles() const;

  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem;
  ResponsePoints points;
  base::SolverReport report;
  std::shared_ptr<const harmonic::ResponseSensitivity> sensitivity;  ///< periodic_motion: at points[0]; else null
  std::shared_ptr<const PeakSensitivities> peakSensitivities;        ///< frequency_response, if asked for; else null
  /// Of a motion with harmonics per node: see NodeHarmonicsMotion.
  std::optional<double> leftOut;
  bool isCurve = false;     ///< true for a frequency_response, a linear_response or a backbone
  bool isLinear = false;    ///< the points solve the linearised model, not h(z, ω) = 0
  bool isBackbone = false;  ///< free motions: `problem` has no drive

 private:
  std::map<int, std::shared_ptr<const harmonic::HarmonicBalanceProblem>> subharmonicProblems_;  ///< by drive periods
};

/// Called from the working thread with a snapshot of what there is so far, at most about 20 times a second.
using ResultObserver = std::function<void(std::shared_ptr<const Result>)>;

class ShardedStudy;

/// One entry of the scene's "studies", chosen by its "type".
class Study {
 public:
  virtual ~Study() = default;
  virtual std::string name() const = 0;
  virtual std::string type() const = 0;
  /// Pure: same scene, options and version give the same result. A cancelled or failed study returns what it has;
  /// only bad input throws (base::InputError).
  virtual std::shared_ptr<const Result> run(base::ExecutionContext& context,
                                            const ResultObserver& observe = {}) const = 0;
  /// The same study, if several processes can share its work; else null.
  virtual const ShardedStudy* sharded() const { return nullptr; }
};

/// Makes a study from its normalised JSON object, on a model already built.
using StudyFactory =
    std::function<std::unique_ptr<Study>(const Scene&, std::shared_ptr<const mechanics::Model>, const Json& options)>;

/// Kinds of studies by "type": "periodic_motion", "frequency_response", "backbone", "linear_modes", "linear_response",
/// "time_integration", "comparison", "cloth_motion", "cloth_drape", "projection", "cell_test", "free_travel",
/// "stretch_grid", "stretch_boundary", "bending_test", "curvature_limits", "bending_size", "bending_boundary",
/// "gravity_bending", "macro_equilibrium", "macro_motion".
class StudyRegistry {
 public:
  static const StudyRegistry& instance();
  /// The options of every kind, as in the scene's "studies".
  const std::vector<base::ParameterSpec>& specs() const;
  /// Throws base::InputError if the scene has no such study.
  std::unique_ptr<Study> make(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                              const std::string& studyName) const;

 private:
  StudyRegistry();
  std::map<std::string, StudyFactory> factories_;
};

/// Names of the scene's studies in order.
std::vector<std::string> studyNames(const Scene& scene);

/// Sixteen hexadecimal digits (FNV-1a, 64 bits) of the normalised scene and the contents of the files it names.
std::string hashScene(const Scene& scene);

}  // namespace pliant::scene
