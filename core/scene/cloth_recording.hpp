#pragma once

#include "core/base/stopwatch.hpp"
#include "core/scene/cloth_result.hpp"

namespace pliant::scene {

/// A frame of a cloth with its bodies where they are at `bodiesAt` [s]; limit forces from `solution`, 0 without one.
std::shared_ptr<const ClothFrame> makeClothFrame(const cloth::ClothProblem& problem, double time,
                                                 const Eigen::Matrix3Xd& positions, double bodiesAt,
                                                 const solvers::ConeSolution* solution);

/// A result that grows, with snapshots of it now and then; frames are shared.
class ClothRecording {
 public:
  ClothRecording(std::shared_ptr<const cloth::ClothProblem> problem, Provenance provenance,
                 const ResultObserver& observe = {});

  void addFrame(double time, const Eigen::Matrix3Xd& positions, double bodiesAt, const solvers::ConeSolution* solution);
  void addFrame(std::shared_ptr<const ClothFrame> frame) { result_->frames.push_back(std::move(frame)); }
  /// `time` stands in the place of the step's own.
  void addStep(const cloth::StepRecord& step, double time, double residual);
  /// Hands out a snapshot unless it did so a moment ago.
  void observe();
  /// The result; nothing may be added any more.
  std::shared_ptr<const ClothResult> finish(base::TerminationType termination, const std::string& message);

  const ClothResult& result() const { return *result_; }
  ClothResult& result() { return *result_; }

 private:
  std::shared_ptr<ClothResult> result_ = std::make_shared<ClothResult>();
  ResultObserver observe_;
  base::Stopwatch watch_, sinceObserved_;
};

}  // namespace pliant::scene
