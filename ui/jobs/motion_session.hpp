#pragma once

#include <QObject>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/harmonic/response_sensitivity.hpp"
#include "ui/document/document.hpp"
#include "ui/jobs/job_runner.hpp"
#include "ui/jobs/study_runner.hpp"

namespace pliant::jobs {

/// Which number stands for how far a node swings.
enum class AmplitudeMeasure { pathLength, maximumDisplacement };

/// The amplitude [m] of a node by one measure.
double amplitudeOf(const harmonic::HarmonicBalanceProblem& problem, const harmonic::Vector& z, int node,
                   AmplitudeMeasure measure);

/// The motion that the window shows, with all that is needed to predict from it.
struct ShownMotion {
  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem;
  harmonic::PeriodicMotion motion;
  scene::Scene scene;                                                ///< that it was solved for
  std::shared_ptr<const harmonic::ResponseSensitivity> sensitivity;  ///< null as long as it is computed
  std::string study;  ///< whose result it is; empty if it was solved by itself
  int point = -1;     ///< on that study's curve
  /// Whether it solves the driven model: a linear response and a free motion do not, and nothing is predicted from
  /// them.
  bool solvesDrivenModel = true;
};

/// What a parameter does to the amplitude of the selected node.
struct ParameterEffect {
  std::string pointer;
  double slope = 0;  ///< d(amplitude) / d(parameter), SI
};

/// One motion on show: chosen from a result or solved for a frequency, with its first-order dependence on the
/// parameters computed behind it, and the motion predicted for the parameters as they are set now. `update` solves
/// anew, from the prediction, and says how good that was. Solves run as jobs of `quick`; studies run beside them.
///
/// What is shown has the nodes of the document's model: where an edit gives that other nodes, the motion is put aside
/// until the edit is undone. The selected node is always one of the model's: a probe stays selected by its name.
class MotionSession final : public QObject {
  Q_OBJECT

 public:
  MotionSession(document::Document& document, JobRunner& quick, StudyRunner& studies, QObject* parent = nullptr);

  const std::optional<ShownMotion>& shown() const { return shown_; }
  /// Whether the scene has changed since the shown motion was solved.
  bool isStale() const { return stale_; }
  /// Whether the scene differs from the one that the shown motion was solved for in parameters alone.
  bool isComparable() const { return comparable_; }
  /// The predicted coefficients; none if nothing differs, or nothing can be predicted.
  const std::optional<harmonic::Vector>& prediction() const { return prediction_; }
  /// The document's model with the parameter that is being dragged.
  std::shared_ptr<const mechanics::Model> previewedModel() const;
  /// Why parameters cannot be predicted from the shown motion; empty if they can, or will soon.
  QString predictionObstacle() const;

  int node() const { return node_; }
  AmplitudeMeasure measure() const { return measure_; }
  double shownAmplitude() const;  ///< [m]; 0 if nothing is shown
  std::optional<double> predictedAmplitude() const;
  /// One entry a parameter, empty as long as the sensitivity is not known.
  const std::vector<ParameterEffect>& effects() const { return effects_; }

  /// Runs studies and shows what they find as soon as there is something.
  void run(const std::vector<std::string>& names);
  void runAll();
  /// Solves the shown motion anew with the scene as it is, starting from the prediction, and runs outdated studies
  /// again.
  void update();
  /// Ends everything that runs; what has been found stays.
  void cancel();
  bool isBusy() const;

  void showPoint(const std::string& study, int point);
  /// Solves at `omega` [rad/s] from the curve's nearest point and shows that motion.
  void solveAt(double omega, const std::string& study, int nearestPoint);

  /// A parameter is being dragged: predicts with `value` in the place of the scene's.
  void preview(const std::string& pointer, double value) { previewAll({{pointer, value}}); }
  /// The same for several at once.
  void previewAll(std::map<std::string, double> values);
  void endPreview();
  bool isPreviewing() const { return !preview_.empty(); }
  /// How far the parameters as they are set now, dragged ones included, are from those of `solved`; none: nowhere.
  std::optional<harmonic::Vector> changeFrom(const mechanics::Model& solved) const;

  void selectNode(int node);
  void setMeasure(AmplitudeMeasure measure);

 Q_SIGNALS:
  void shownChanged();
  /// The prediction, or whether the shown motion is stale, changed.
  void predictionChanged();
  void effectsChanged();
  void nodeChanged(int node);
  void measureChanged();
  void busyChanged(bool busy);
  /// An update ended. Without a prediction `predicted` is NaN. Amplitudes of the selected node in metres.
  void updated(double predicted, double solved);

 private:
  void reset();
  void follow(const std::string& study);
  void show(ShownMotion shown);
  void putAsideIfUnfit();
  void takeBackIfFit();
  void refreshNode();
  void computeSensitivity();
  void refreshStaleness();
  void refreshPrediction();
  void refreshEffects();

  document::Document& document_;
  JobRunner& quick_;
  StudyRunner& studies_;
  std::optional<ShownMotion> shown_;
  std::optional<ShownMotion> aside_;                 ///< of other nodes than the model's
  std::shared_ptr<const mechanics::Model> nodesOf_;  ///< what `node_` counts in
  bool stale_ = false;
  bool comparable_ = false;  ///< the scenes differ in parameters alone
  std::optional<harmonic::Vector> prediction_;
  std::map<std::string, double> preview_;  ///< by pointer
  std::vector<ParameterEffect> effects_;
  int node_ = 0;
  AmplitudeMeasure measure_ = AmplitudeMeasure::pathLength;
  bool follow_ = false;
  std::shared_ptr<const scene::Result> followed_;
};

}  // namespace pliant::jobs
