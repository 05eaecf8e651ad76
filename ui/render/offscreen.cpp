#include "ui/render/offscreen.hpp"

#include <vtkRenderWindow.h>

#include "ui/render/offscreen_target.hpp"

namespace pliant::render {

Image renderToImage(const std::shared_ptr<const mechanics::Model>& model,
                    const std::shared_ptr<const harmonic::HarmonicBalanceProblem>& problem, const mechanics::Vector& z,
                    double tau, const PictureOptions& options) {
  OffscreenTarget target;
  target.setSize(options.width, options.height);
  Image image;
  {
    MotionView view;
    view.attach(target.window());
    view.setTheme(options.theme);
    view.setModel(model);
    if (problem) view.setMotion(problem, z);
    view.setTau(tau);
    view.setSelectedNode(options.selectedNode);
    view.setCaption(options.caption);
    view.setAxisView(options.view);
    target.render(image);
  }
  return image;
}

Image renderToImage(const std::shared_ptr<const cloth::ClothProblem>& problem,
                    const std::vector<std::shared_ptr<const scene::ClothFrame>>& frames,
                    const PictureOptions& options) {
  OffscreenTarget target;
  target.setSize(options.width, options.height);
  Image image;
  {
    ClothView view;
    view.attach(target.window());
    view.setTheme(options.theme);
    view.setProblem(problem);
    view.setFrames(frames);
    view.setFrame(static_cast<int>(frames.size()) - 1);
    view.setSelectedNode(options.selectedNode);
    view.setCaption(options.caption);
    view.setAxisView(options.view);
    target.render(image);
  }
  return image;
}

void renderToPng(const std::shared_ptr<const mechanics::Model>& model,
                 const std::shared_ptr<const harmonic::HarmonicBalanceProblem>& problem, const mechanics::Vector& z,
                 double tau, const PictureOptions& options, const std::filesystem::path& file) {
  writePng(renderToImage(model, problem, z, tau, options), file);
}

}  // namespace pliant::render
