#include "ui/shell/sheet_link.hpp"

#include <utility>

#include "ui/panels/sheet_panel.hpp"
#include "ui/render/macro_picture.hpp"
#include "ui/viewport/sheet_brush.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

using panels::SheetPanel;
using viewport::Viewport;

SheetLink::SheetLink(document::Document& document, Viewport& viewport, SheetPanel& sheets, QObject* parent)
    : QObject(parent),
      document_(document),
      viewport_(viewport),
      sheets_(sheets),
      view_(std::make_shared<render::MacroView>()),
      brush_(new viewport::SheetBrush(view_, this)) {
  connect(&sheets_, &SheetPanel::viewChanged, this, &SheetLink::refresh);
  connect(&sheets_, &SheetPanel::instantChosen, this, [this](double time) {
    viewport_.pause();
    viewport_.setTime(time);
  });
  connect(&viewport_, &Viewport::nodePicked, this, [this](int picked) {
    if (isShown() && sheets_.clicks() != SheetPanel::Clicks::paint) sheets_.take(picked);
  });
  connect(brush_, &viewport::SheetBrush::strokeGrows, this, [this](const std::vector<int>& stroke, bool wipes) {
    if (!sheets_.canPaint()) return;
    auto [materials, names] = sheets_.paintedWith(stroke, wipes);
    view_->setMaterials(std::move(materials), std::move(names));
    viewport_.redrawGuest();
  });
  connect(brush_, &viewport::SheetBrush::strokeEnded, this, [this](const std::vector<int>& stroke, bool wipes) {
    sheets_.paint(stroke, wipes);
    showPaint();
  });
  connect(&document_, &document::Document::sceneEdited, this, &SheetLink::showPaint);
  connect(&viewport_, &Viewport::clothChanged, this, &SheetLink::showPaint);  // another guest may have come
  connect(&viewport_, &Viewport::timeChanged, this, [this](double time) {
    if (isShown()) sheets_.setFrame(view_->frame(), time);
  });
}

SheetLink::~SheetLink() = default;

bool SheetLink::isShown() const { return viewport_.guest() == view_; }

void SheetLink::setStale(bool stale) { view_->setStale(stale); }

void SheetLink::show(const std::shared_ptr<const scene::MacroResult>& sheet, bool growing) {
  const auto before = view_->result();
  const bool another = !before || before->sheet != sheet->sheet;
  const bool grown = isShown() && growing_ && viewport_.time() >= viewport_.duration();
  view_->setResult(sheet);
  refresh();
  showCaption();
  viewport_.setGuest(view_);
  std::vector<double> times;
  for (const auto& frame : sheet->frames) times.push_back(frame->time);
  viewport_.setGuestFrames(
      std::move(times), growing, sheet->isMotion() ? render::FrameClock::seconds : render::FrameClock::loads);
  if (!std::exchange(framed_, true))
    viewport_.setAxisView(render::AxisView::isometric);
  else if (another)
    viewport_.fit();
  viewport_.redrawGuest(true);
  // What is complete is played, unless somebody looks at a frame of it.
  if (!growing && !sheet->frames.empty() && (another || grown)) viewport_.play();
  growing_ = growing;
}

void SheetLink::showCaption() {
  const std::string numbers = render::macroCaption(*view_->result(), view_->nativeVisible());
  view_->setCaption(document_.title().toStdString() + '\n' + numbers);
}

/// While somebody paints the sheet's materials are seen, and the brush has the mouse.
void SheetLink::showPaint() {
  const bool paints = isShown() && sheets_.clicks() == SheetPanel::Clicks::paint && sheets_.canPaint();
  auto [materials, names] = paints ? sheets_.materials() : std::pair<std::vector<int>, std::vector<std::string>>();
  view_->setMaterials(std::move(materials), std::move(names));
  viewport_.setGuestTool(paints ? brush_ : nullptr);
  if (isShown()) viewport_.redrawGuest();
}

void SheetLink::refresh() {
  view_->setField(sheets_.field());
  view_->setElementsVisible(sheets_.showsElements());
  const bool divided = view_->nativeVisible();
  view_->setNativeVisible(sheets_.showsNative());
  view_->setPicks(sheets_.clicks() == SheetPanel::Clicks::read ? render::MacroView::Picks::triangles
                                                               : render::MacroView::Picks::nodes);
  view_->setSelectedTriangle(sheets_.selectedTriangle());
  showPaint();
  if (!isShown()) return;
  const bool changed = divided != view_->nativeVisible();
  if (changed) showCaption();
  viewport_.redrawGuest(changed);
}

}  // namespace pliant::shell
