#pragma once

#include "app/cli/commands.hpp"
#include "core/scene/cloth_result.hpp"

namespace pliant::cli {

/// A model at one time of a motion; `problem` is null for the rest shape.
struct Moment {
  std::shared_ptr<const mechanics::Model> model;
  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem;
  mechanics::Vector z;
  double tau = 0;
  double period = 0;                                ///< of the motion [s]
  std::string caption;                              ///< of all of the motion
  std::string instant;                              ///< what more the caption of a single picture says
  std::shared_ptr<const scene::ClothResult> cloth;  ///< or null
  std::shared_ptr<const scene::ClothFrame> frame;   ///< of the cloth
};

/// What the options ask for. Throws base::InputError.
Moment findMoment(const MotionOptions& options);

}  // namespace pliant::cli
