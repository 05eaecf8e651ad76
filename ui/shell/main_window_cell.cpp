#include <QAction>
#include <QDockWidget>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "core/base/error.hpp"
#include "ui/panels/cell_family.hpp"
#include "ui/panels/cell_panel.hpp"
#include "ui/shell/cell_bar.hpp"
#include "ui/shell/cell_link.hpp"
#include "ui/shell/element_gallery.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

void MainWindow::makeCellActions() {
  actions_.add({QStringLiteral("model.elements"),
                tr("&Interlocking Materials…"),
                QStringLiteral("gallery"),
                {},
                tr("Choose a kind of chain mail: put it into the scene, or begin a new one with it")},
               [this] { showElements(pages_->currentWidget() != elements_); });
  actions_.add({QStringLiteral("cell.reset"),
                tr("Back to Rest"),
                QStringLiteral("reset"),
                {},
                tr("Put the elements of the interlocking material back to where they rest")},
               [this] { liveCell_.reset(); });
}

void MainWindow::makeCellDock() {
  cellPanel_ = new panels::CellPanel(document_);
  cellDock_ = new QDockWidget(tr("Material"), this);
  cellDock_->setObjectName(QStringLiteral("material"));
  cellDock_->setWidget(cellPanel_);
  addDockWidget(Qt::RightDockWidgetArea, cellDock_);
  docks_.push_back(cellDock_);
  tabifyDockWidget(docks_[1], cellDock_);
}

void MainWindow::makeCellViews() {
  elements_ = new ElementGallery(document_, quickJobs_);
  pages_->addWidget(elements_);
  cellBar_ = new CellBar(actions_.find(QStringLiteral("cell.reset")));
  stage_->addWidget(cellBar_);
  new CellLink(document_, liveCell_, *viewport_, *cellPanel_, *cellBar_, this);
  connect(gallery_, &Gallery::materialsRequested, this, [this] { showElements(true); });
  connect(cellPanel_, &panels::CellPanel::familyRequested, this, [this] { showElements(true); });
  connect(elements_, &ElementGallery::closeRequested, this, [this] { showElements(false); });
  connect(elements_, &ElementGallery::familyChosen, this, &MainWindow::chooseFamily);
}

void MainWindow::showElements(bool shown) {
  showDrapes(false);
  if (shown) elements_->setTarget(showsCells(document_) ? cellPanel_->shownCell() : -1);
  QWidget* otherwise = document_.isEmpty() ? static_cast<QWidget*>(gallery_) : viewport_->parentWidget();
  pages_->setCurrentWidget(shown ? elements_ : otherwise);
}

void MainWindow::chooseFamily(const std::string& type, int cell) {
  if (cell >= 0) {
    const std::string pointer = "/interlocking_cells/" + std::to_string(cell);
    const scene::Json name = document_.valueAt(pointer + "/name");
    showElements(false);
    document_.setValue(
        pointer, {{"name", name}, {"type", type}}, tr("Material: %1").arg(panels::cellFamilyTitle(type)));
    return;
  }
  jobs::Job job;
  job.topic = QStringLiteral("open");
  job.title = tr("Open %1").arg(panels::cellFamilyTitle(type));
  job.work = [this, type](base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
    auto loaded = familyScene(type);
    if (context.cancelRequested()) return {};
    return [this, loaded = std::move(loaded)] {
      keepUnsaved();
      document_.adopt(loaded, {});
    };
  };
  sceneJobs_.submit(std::move(job));
}

/// Nothing of an interlocking material vibrates: it has its own panel in the place of the parameters.
void MainWindow::fitCellDocks() {
  const bool cells = showsCells(document_);
  for (QDockWidget* dock : {cellDock_, printDock_}) dock->setVisible(cells);
  if (!cells) return;
  for (QDockWidget* dock : harmonicDocks_) dock->hide();
  // The material is seen as large as possible; the status bar's button brings the messages.
  for (QDockWidget* dock : {docks_[1], docks_[2], docks_[4]}) dock->hide();
  cellDock_->raise();
}

}  // namespace pliant::shell
