#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// "macro_equilibrium". Throws base::InputError.
std::unique_ptr<Study> makeMacroEquilibriumStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                                 const Json& options);

/// "macro_motion". Throws base::InputError.
std::unique_ptr<Study> makeMacroMotionStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options);

}  // namespace pliant::scene
