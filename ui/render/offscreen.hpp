#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/harmonic/harmonic_balance_problem.hpp"
#include "ui/render/cloth_view.hpp"
#include "ui/render/image.hpp"
#include "ui/render/motion_view.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// How a still picture is made.
struct PictureOptions {
  int width = 1280;  ///< pixels
  int height = 720;  ///< pixels
  Theme theme = Theme::light;
  AxisView view = AxisView::isometric;
  std::string caption;  ///< the small label; empty: none
  std::optional<int> selectedNode;
};

/// Draws a model at `tau` [rad] of a periodic motion with coefficients `z` (the rest state if `problem` is null),
/// without a display: through OSMesa, else through EGL without a surface. Throws base::InputError if the size is not
/// positive or too large, and std::runtime_error with one sentence if this machine has neither library.
Image renderToImage(const std::shared_ptr<const mechanics::Model>& model,
                    const std::shared_ptr<const harmonic::HarmonicBalanceProblem>& problem, const mechanics::Vector& z,
                    double tau, const PictureOptions& options);

/// The same of a cloth at the last of `frames` (at rest if there is none); all of them are in view.
Image renderToImage(const std::shared_ptr<const cloth::ClothProblem>& problem,
                    const std::vector<std::shared_ptr<const scene::ClothFrame>>& frames, const PictureOptions& options);

/// A motion as above, written as a PNG file, atomically.
void renderToPng(const std::shared_ptr<const mechanics::Model>& model,
                 const std::shared_ptr<const harmonic::HarmonicBalanceProblem>& problem, const mechanics::Vector& z,
                 double tau, const PictureOptions& options, const std::filesystem::path& file);

}  // namespace pliant::render
