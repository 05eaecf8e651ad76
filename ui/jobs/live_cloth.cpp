#include "ui/jobs/live_cloth.hpp"

#include <algorithm>

namespace pliant::jobs {

namespace {

bool sameTriangles(const cloth::ClothProblem& a, const cloth::ClothProblem& b) {
  return a.model->nodeCount() == b.model->nodeCount() &&
         std::equal(a.sheet.triangles.begin(), a.sheet.triangles.end(), b.sheet.triangles.begin(),
                    b.sheet.triangles.end(), [](const auto& x, const auto& y) { return x.nodes == y.nodes; });
}

}  // namespace

LiveCloth::LiveCloth(const scene::Scene& scene, std::shared_ptr<const mechanics::Model> model, std::string study)
    : study_(std::move(study)) {
  build(scene, std::move(model));
}

void LiveCloth::build(const scene::Scene& scene, std::shared_ptr<const mechanics::Model> model) {
  scene::ClothMotionSetup setup = scene::clothMotionSetup(scene, model, study_);
  setup.stepping.projection.cone.explainFailure = false;  // takes many times as long as a step
  auto simulation = std::make_unique<cloth::ClothSimulation>(setup.problem, setup.stepping);
  dragging_ = std::make_unique<cloth::Dragging>(*simulation);
  simulation_ = std::move(simulation);
  setup_ = std::move(setup);
  scene_ = scene;
  model_ = std::move(model);
  projection_.reset();
}

void LiveCloth::setScene(const scene::Scene& scene, std::shared_ptr<const mechanics::Model> model) {
  const cloth::ClothState before = simulation_->state();
  const auto hands = dragging_->hands();
  const auto problem = setup_.problem;
  build(scene, std::move(model));
  if (!sameTriangles(*problem, *setup_.problem)) {
    recording_.reset();
    return;
  }
  simulation_->setState(before.time, before.positions, before.velocities);
  for (const auto& [node, hand] : hands) dragging_->pull(node, hand);
  if (recording_) recording_->result().problem = setup_.problem;
}

void LiveCloth::reset() {
  recording_.reset();
  build(*scene_, model_);
}

cloth::StepRecord LiveCloth::step(base::ExecutionContext& context) {
  const cloth::StepRecord record = dragging_->step(context);
  if (!record.done()) return record;
  projection_ = record.projection;
  if (recording_) {
    const double time = record.time - recordingBegan_;
    recording_->addStep(record, time, 0);
    recording_->addFrame(time, simulation_->state().positions, record.time, projection_.get());
  }
  return record;
}

void LiveCloth::startRecording() {
  recording_.emplace(setup_.problem, setup_.provenance);
  recordingBegan_ = simulation_->state().time;
  recording_->addFrame(0, simulation_->state().positions, recordingBegan_, projection_.get());
}

double LiveCloth::recordedSeconds() const { return recording_ ? simulation_->state().time - recordingBegan_ : 0; }

std::optional<RecordedMotion> LiveCloth::stopRecording() {
  if (!recording_) return std::nullopt;
  scene::ClothRecording finished = std::move(*recording_);
  recording_.reset();
  if (finished.result().steps.empty()) return std::nullopt;
  return RecordedMotion{finished.finish(base::TerminationType::converged, "Recorded live, as hands pulled."), *scene_};
}

std::shared_ptr<const scene::ClothFrame> LiveCloth::frame() const {
  const cloth::ClothState& state = simulation_->state();
  return scene::makeClothFrame(*setup_.problem, state.time, state.positions, state.time, projection_.get());
}

}  // namespace pliant::jobs
