#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/cloth/dragging.hpp"
#include "core/scene/cloth_recording.hpp"
#include "core/scene/cloth_studies.hpp"
#include "core/scene/scene.hpp"

namespace pliant::jobs {

/// What a recording made of it, with the scene it was made from.
struct RecordedMotion {
  std::shared_ptr<const scene::ClothResult> result;
  scene::Scene scene;
};

/// A study of the type cloth_motion as it is stepped while somebody watches: hands, edits of the scene, recording.
/// Belongs to one thread at a time.
class LiveCloth {
 public:
  /// At rest, at time 0. Throws base::InputError for a scene that has no such study.
  LiveCloth(const scene::Scene& scene, std::shared_ptr<const mechanics::Model> model, std::string study);

  /// Takes an edited scene over. A sheet with the same triangles goes on as it is and stays in its hands; another one
  /// begins at rest. Throws base::InputError and changes nothing.
  void setScene(const scene::Scene& scene, std::shared_ptr<const mechanics::Model> model);
  /// Begins at rest again, without hands.
  void reset();

  cloth::Dragging& dragging() { return *dragging_; }
  const cloth::Dragging& dragging() const { return *dragging_; }
  /// One step; what is done is recorded if that is on.
  cloth::StepRecord step(base::ExecutionContext& context);

  /// From the present state on; times count from here.
  void startRecording();
  bool isRecording() const { return recording_.has_value(); }
  double recordedSeconds() const;
  /// What has been recorded since; none if no step was done.
  std::optional<RecordedMotion> stopRecording();

  const cloth::ClothSimulation& simulation() const { return *simulation_; }
  /// The present state.
  std::shared_ptr<const scene::ClothFrame> frame() const;

 private:
  void build(const scene::Scene& scene, std::shared_ptr<const mechanics::Model> model);

  std::string study_;
  std::optional<scene::Scene> scene_;
  std::shared_ptr<const mechanics::Model> model_;
  scene::ClothMotionSetup setup_;
  std::unique_ptr<cloth::ClothSimulation> simulation_;
  std::unique_ptr<cloth::Dragging> dragging_;
  std::shared_ptr<const solvers::ConeSolution> projection_;  ///< of the last step
  std::optional<scene::ClothRecording> recording_;
  double recordingBegan_ = 0;  ///< [s], of the simulation's time
};

}  // namespace pliant::jobs
