#include <QAction>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "core/base/error.hpp"
#include "ui/panels/chart_panel.hpp"
#include "ui/shell/cloth_link.hpp"
#include "ui/shell/drape_gallery.hpp"
#include "ui/shell/exporter.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/shell/interlock_link.hpp"
#include "ui/shell/live_bar.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

void MainWindow::makeClothActions() {
  const auto checkable = [this](const char* id, const QString& text, const QString& tooltip) {
    QAction* action = actions_.add({QLatin1String(id), text, {}, {}, tooltip}, [] {});
    action->setCheckable(true);
    return action;
  };
  QAction* force = checkable(
      "view.limitForce", tr("Colour by Limit Force"), tr("Colour a cloth by what its stretch limits press with"));
  connect(force, &QAction::toggled, this, [this](bool on) {
    viewport_->clothView().setField(on ? render::ClothField::limitForce : render::ClothField::stretchRatio);
    viewport_->redrawCloth();
  });
  QAction* directions =
      checkable("view.directions", tr("Material Directions"), tr("Show the first material direction of a cloth"));
  connect(directions, &QAction::toggled, this, [this](bool on) {
    viewport_->clothView().setDirectionsVisible(on);
    viewport_->redrawCloth();
  });
  QAction* drapes = checkable("view.drapes", tr("&Drapes Side by Side"),
                              tr("Compare drapes of several scenes, with their stretch limits above"));
  connect(drapes, &QAction::triggered, this, &MainWindow::showDrapes);
  actions_.add({QStringLiteral("file.exportFrames"),
                tr("Export &Frames…"),
                {},
                {},
                tr("Export all of a motion as a video or numbered pictures, and of a cloth as meshes")},
               [this] { exportFrames(); });
}

void MainWindow::makeDrapeGallery() {
  drapes_ = new DrapeGallery(drapeJobs_, quickJobs_);
  pages_->addWidget(drapes_);
  connect(drapes_, &DrapeGallery::messageRaised, this, &MainWindow::report);
  connect(drapes_, &DrapeGallery::addRequested, this, &MainWindow::addShownDrape);
  connect(drapes_, &DrapeGallery::closeRequested, this, [this] { showDrapes(false); });
  connect(drapes_, &DrapeGallery::exportRequested, this, [this] {
    const QString file = QFileDialog::getSaveFileName(
        this, tr("Export the figure"), QStringLiteral("drapes.png"), tr("Pictures (*.png)"));
    if (!file.isEmpty()) drapes_->exportTo(file);
  });
}

/// The figure is wide: it has the window to itself.
void MainWindow::showDrapes(bool shown) {
  const bool before = pages_->currentWidget() == drapes_;
  if (shown == before) return;
  if (shown) {
    docksBefore_ = saveState();
    pages_->setCurrentWidget(drapes_);
    for (QDockWidget* dock : docks_) dock->hide();
    drapes_->fillAtFirst(DrapeGallery::shippedDrapes());
  } else {
    pages_->setCurrentWidget(document_.isEmpty() ? static_cast<QWidget*>(gallery_) : viewport_->parentWidget());
    restoreState(docksBefore_);
  }
  refreshActions();
}

void MainWindow::addShownDrape() {
  const int frame = viewport_->showsCloth() ? viewport_->clothView().frame() : -1;
  if (!viewport_->showsCloth()) {
    report(base::Severity::warning, tr("No cloth is shown: run a study of one first."));
    return;
  }
  drapes_->add({document_.title().toStdString(), viewport_->clothProblem(),
                frame < 0 ? nullptr : viewport_->clothFrames().at(static_cast<std::size_t>(frame))});
}

void MainWindow::makeLiveActions() {
  QAction* open =
      actions_.add({QStringLiteral("live.open"), tr("&Live"), QStringLiteral("hand"), QKeySequence(Qt::Key_L),
                    tr("Let the cloth move by itself and pull its nodes with the mouse; Ctrl keeps a node "
                       "where you let it go, or frees it")},
                   [this] { openLive(); });
  open->setCheckable(true);
  actions_.add({QStringLiteral("live.step"), tr("Single S&tep"), QStringLiteral("step"), QKeySequence(Qt::Key_Period),
                tr("One step of the live cloth")},
               [this] { live_.step(); });
  actions_.add({QStringLiteral("live.reset"),
                tr("Begin &Again"),
                QStringLiteral("reset"),
                {},
                tr("The live cloth begins again at rest, without hands")},
               [this] { live_.reset(); });
  QAction* record = actions_.add({QStringLiteral("live.record"),
                                  tr("Rec&ord"),
                                  QStringLiteral("record"),
                                  {},
                                  tr("Keep what the live cloth does as the result of its study")},
                                 [this] { live_.setRecording(!live_.isRecording()); });
  record->setCheckable(true);
  connect(&live_, &jobs::ClothSession::openChanged, this, [this, open](bool isOpen) {
    open->setChecked(isOpen);
    refreshActions();
  });
  connect(&live_, &jobs::ClothSession::recordingChanged, record, &QAction::setChecked);
  connect(&live_, &jobs::ClothSession::playingChanged, this, &MainWindow::showPlaying);
}

void MainWindow::makeLiveBar() {
  liveBar_ = new LiveBar(document_, live_, actions_);
  stage_->addWidget(liveBar_);
  connect(liveBar_, &LiveBar::studyChosen, this, [this] {
    if (!live_.isOpen()) return;
    live_.close();
    openLive();
  });
}

void MainWindow::openLive() {
  if (live_.isOpen()) {
    live_.close();
    return;
  }
  live_.open(liveBar_->study());
  live_.setPlaying(true);
}

/// Files are written in the background; one sentence says how many there are.
void MainWindow::exportFrames() {
  const QString name = QFileInfo(document_.file()).completeBaseName() + QStringLiteral(".ogv");
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Export the motion"), name, frameExportFilters(*viewport_));
  if (!file.isEmpty()) exportFramesTo(file);
}

void MainWindow::exportFramesTo(const QString& file) {
  try {
    jobs::Job job;
    job.topic = QStringLiteral("export ") + file;
    job.title = tr("Export %1").arg(QFileInfo(file).fileName());
    job.work = [this, file, work = frameExport(file, session_, *viewport_)](
                   base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
      const int count = work(context);
      if (count == 0) return {};
      return [this, file, count] {
        report(base::Severity::information,
               count == 1 ? tr("Exported to %1.").arg(file) : tr("Exported %1 files beside %2.").arg(count).arg(file));
      };
    };
    exportJobs_.submit(std::move(job));
  } catch (const base::InputError& error) {
    report(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

void MainWindow::showFittingDocks() {
  const bool cloth = hasCloth(document_), interlock = hasInterlock(document_);
  const auto& studies = document_.studies();
  const bool harmonic = (!cloth && !interlock) || std::any_of(studies.begin(), studies.end(), [this](const auto& s) {
                          return !document::isClothStudy(s.type) && !isInterlockStudy(document_, s.name);
                        });
  for (QDockWidget* dock : harmonicDocks_) dock->setVisible(harmonic);
  for (QDockWidget* dock : clothDocks_) dock->setVisible(cloth);
  chartDock_->setVisible(charts_->hasStudies());
  docks_[1]->raise();
  docks_[3]->raise();
  if (cloth)
    for (QDockWidget* dock : clothDocks_) dock->raise();
  fitCellDocks();
  showInterlockDocks(interlock);
}

}  // namespace pliant::shell
