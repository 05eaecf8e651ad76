#include <QAction>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>

#include "core/base/error.hpp"
#include "ui/panels/boundary_panel.hpp"
#include "ui/panels/boundary_predictor.hpp"
#include "ui/panels/cell_test_panel.hpp"
#include "ui/panels/sheet_panel.hpp"
#include "ui/panels/size_panel.hpp"
#include "ui/panels/travel_panel.hpp"
#include "ui/shell/boundary_export.hpp"
#include "ui/shell/interlock_link.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

namespace {

constexpr double heightShare = 0.44;  ///< of the window, that a boundary to be turned needs
constexpr int plotHeight = 312;       ///< of the other docks at the bottom

}  // namespace

void MainWindow::makeInterlockDocks() {
  boundary_ = new panels::BoundaryPanel(document_, quickJobs_);
  travel_ = new panels::TravelPanel(document_);
  sizes_ = new panels::SizePanel(document_);
  sheets_ = new panels::SheetPanel(document_);
  cellTests_ = new panels::CellTestPanel(document_);
  const auto add = [this](const QString& title, const char* name, QWidget* widget) {
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName(QLatin1String(name));
    dock->setWidget(widget);
    addDockWidget(Qt::BottomDockWidgetArea, dock);
    tabifyDockWidget(docks_[3], dock);
    docks_.push_back(dock);
    interlockDocks_.push_back(dock);
  };
  add(tr("Boundary"), "boundary", boundary_);
  add(tr("Directions"), "travel", travel_);
  add(tr("Patch size"), "sizes", sizes_);
  add(tr("Limits"), "cell_tests", cellTests_);
  add(tr("Sheet"), "sheet", sheets_);
}

void MainWindow::connectInterlock() {
  auto* link =
      new InterlockLink(document_, quickJobs_, *viewport_, *boundary_, *travel_, *sizes_, *sheets_, *cellTests_, this);
  new panels::BoundaryPredictor(document_, *cellPanel_, *boundary_, this);
  connect(actions_.find(QStringLiteral("cell.reset")), &QAction::triggered, link, &InterlockLink::leave);
  const auto run = [this](const std::string& study) {
    if (!study.empty()) session_.run({study});
  };
  connect(boundary_, &panels::BoundaryPanel::runRequested, this, run);
  connect(travel_, &panels::TravelPanel::runRequested, this, run);
  connect(sizes_, &panels::SizePanel::runRequested, this, run);
  connect(sheets_, &panels::SheetPanel::runRequested, this, run);
  connect(sheets_, &panels::SheetPanel::studiesRequested, this,
          [this](const std::vector<std::string>& studies) { session_.run(studies); });
  connect(cellTests_, &panels::CellTestPanel::runRequested, this, run);
  connect(link, &InterlockLink::resultGrows, this, [this](const std::string& type) {
    interlockDocks_[panels::BoundaryPanel::shows(type) ? 0
                    : travel_->shows(type)             ? 1
                    : sizes_->shows(type)              ? 2
                    : sheets_->shows(type)             ? 4
                                                       : 3]
        ->raise();
  });
  connect(boundary_, &panels::BoundaryPanel::exportRequested, this, [this] {
    const QString name = QFileInfo(document_.file()).completeBaseName() + QStringLiteral("_boundary.png");
    const QString file = QFileDialog::getSaveFileName(this, tr("Export the boundary"), name, boundaryFilters());
    if (!file.isEmpty()) exportBoundaryTo(file);
  });
}

void MainWindow::exportBoundaryTo(const QString& file) {
  try {
    writeBoundary(file, *boundary_);
    report(base::Severity::information, tr("Exported to %1.").arg(file));
  } catch (const base::InputError& error) {
    report(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

void MainWindow::showInterlockDocks(bool shown) {
  // Whether the docks at the bottom are tall already: what somebody made of that stays, scene by scene.
  const bool before = interlockDocks_[0]->property("tall").toBool();
  for (QDockWidget* dock : interlockDocks_) dock->setVisible(shown);
  if (shown) interlockDocks_[0]->raise();
  interlockDocks_[0]->setProperty("tall", shown);
  if (shown != before)
    resizeDocks({shown ? interlockDocks_[0] : docks_[3]},
                {shown ? static_cast<int>(heightShare * height()) : plotHeight}, Qt::Vertical);
}

}  // namespace pliant::shell
