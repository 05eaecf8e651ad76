#include "ui/render/view.hpp"

#include "ui/render/stage.hpp"

namespace pliant::render {

View::View() : stage_(std::make_unique<Stage>()) {}
View::~View() = default;

void View::attach(vtkRenderWindow* window) { stage_->attach(window); }
void View::setCaption(const std::string& text) { stage_->setCaption(text); }
std::string View::caption() const { return stage_->caption(); }
void View::setTheme(Theme theme) { stage_->setTheme(theme); }
void View::setFieldVisible(bool visible) { stage_->setFieldVisible(visible); }
bool View::fieldVisible() const { return stage_->fieldVisible(); }
void View::setFrameless(bool frameless) { stage_->setFrameless(frameless); }
void View::setPixelRatio(double ratio) { stage_->setPixelRatio(ratio); }
void View::setFineQuality(bool fine) { stage_->setFineQuality(fine); }
void View::fit() { stage_->camera().fit(); }
void View::setAxisView(AxisView view) { stage_->camera().setAxisView(view); }
CameraPose View::cameraPose() const { return stage_->camera().pose(); }
void View::setCameraPose(const CameraPose& pose) { stage_->camera().setPose(pose); }
void View::orbit(double dx, double dy) { stage_->camera().orbit(dx, dy); }
void View::pan(double dx, double dy) { stage_->camera().pan(dx, dy); }
void View::zoom(double factor, double x, double y) { stage_->camera().zoom(factor, x, y); }

}  // namespace pliant::render
