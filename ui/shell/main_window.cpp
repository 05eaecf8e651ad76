#include "ui/shell/main_window.hpp"

#include <QCloseEvent>
#include <QDateTime>
#include <QDir>
#include <QDockWidget>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMimeData>
#include <QSettings>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QStatusBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "core/base/error.hpp"
#include "ui/panels/chart_panel.hpp"
#include "ui/panels/design_panel.hpp"
#include "ui/panels/energy_panel.hpp"
#include "ui/panels/inspector.hpp"
#include "ui/panels/limit_panel.hpp"
#include "ui/panels/log_panel.hpp"
#include "ui/panels/message_bar.hpp"
#include "ui/panels/modes_panel.hpp"
#include "ui/panels/motion_panel.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/response_panel.hpp"
#include "ui/panels/scene_tree.hpp"
#include "ui/plots/plot_style.hpp"
#include "ui/shell/cloth_link.hpp"
#include "ui/shell/command_palette.hpp"
#include "ui/shell/drape_gallery.hpp"
#include "ui/shell/exporter.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/shell/job_status.hpp"
#include "ui/shell/live_bar.hpp"
#include "ui/shell/live_link.hpp"
#include "ui/shell/shipped_files.hpp"
#include "ui/shell/target_link.hpp"
#include "ui/shell/viewport_link.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

namespace {
const QString openTopic = QStringLiteral("open");
}

MainWindow::MainWindow(bool remember, QWidget* parent)
    : QMainWindow(parent),
      remember_(remember),
      studies_(document_, studyJobs_),
      session_(document_, quickJobs_, studies_),
      live_(document_),
      recent_(remember),
      actions_(this) {
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks);
  buildCentre();
  buildDocks();
  buildStatusBar();
  makeActions();
  makeMenus();
  makeToolBar();
  makeLiveBar();
  makeCellViews();
  palette_ = new CommandPalette(this);
  connectParts();
  resize(sizeHint());
  resizeDocks({docks_[0], docks_[1]}, {288, 320}, Qt::Horizontal);
  resizeDocks({docks_[3]}, {312}, Qt::Vertical);
  setDocksVisible(false);
  layout()->activate();  // or what docks asked for that are hidden now would still widen the window
  resize(sizeHint());
  refreshTitle();
  refreshActions();
  if (remember_) restoreSettings();
}

MainWindow::~MainWindow() {
  // Members go before what Qt deletes for us: first nobody listens any more, then the panels that speak to them go.
  document_.disconnect();
  document_.undoStack().disconnect();
  session_.disconnect();
  live_.disconnect();
  liveCell_.disconnect();
  studyJobs_.disconnect(status_);
  quickJobs_.disconnect(status_);
  drapeJobs_.disconnect();
  sceneJobs_.disconnect(status_);
  exportJobs_.disconnect(status_);
  studyJobs_.disconnect(this);
  quickJobs_.disconnect(this);
  sceneJobs_.disconnect(this);
  exportJobs_.disconnect(this);
  delete takeCentralWidget();
  for (QDockWidget* dock : docks_) delete dock;
}

void MainWindow::buildCentre() {
  auto* centre = new QWidget;
  messages_ = new panels::MessageBar;
  gallery_ = new Gallery(quickJobs_);
  viewport_ = new viewport::Viewport;
  pages_ = new QStackedWidget;
  pages_->addWidget(gallery_);
  auto* stage = new QWidget;
  stage_ = new QVBoxLayout(stage);
  stage_->setContentsMargins(0, 0, 0, 0);
  stage_->setSpacing(0);
  stage_->addWidget(viewport_, 1);
  pages_->addWidget(stage);
  makeDrapeGallery();
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(messages_);
  column->addWidget(pages_, 1);
  setCentralWidget(centre);
}

void MainWindow::buildDocks() {
  tree_ = new panels::SceneTree(document_);
  parameters_ = new panels::ParameterPanel(document_, session_);
  response_ = new panels::ResponsePanel(document_, session_, quickJobs_);
  motion_ = new panels::MotionPanel(session_);
  modes_ = new panels::ModesPanel(document_, session_);
  design_ = new panels::DesignPanel(document_);
  limits_ = new panels::LimitPanel(document_);
  energies_ = new panels::EnergyPanel(document_);
  log_ = new panels::LogPanel;
  const auto add = [this](const QString& title, const char* name, QWidget* widget, Qt::DockWidgetArea area) {
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName(QLatin1String(name));
    dock->setWidget(widget);
    addDockWidget(area, dock);
    docks_.push_back(dock);
    return dock;
  };
  setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  add(tr("Scene"), "scene", tree_, Qt::LeftDockWidgetArea);
  add(tr("Parameters"), "parameters", parameters_, Qt::RightDockWidgetArea);
  add(tr("Inspector"), "inspector", new panels::Inspector(document_, session_), Qt::RightDockWidgetArea);
  QDockWidget* plot = add(tr("Frequency response"), "response", response_, Qt::BottomDockWidgetArea);
  QDockWidget* log = add(tr("Messages"), "messages", log_, Qt::BottomDockWidgetArea);
  QDockWidget* motion = add(tr("Motion"), "motion", motion_, Qt::BottomDockWidgetArea);
  QDockWidget* modes = add(tr("Modes"), "modes", modes_, Qt::RightDockWidgetArea);
  QDockWidget* limits = add(tr("Stretch limits"), "limits", limits_, Qt::RightDockWidgetArea);
  QDockWidget* energies = add(tr("Energy and solver"), "energy", energies_, Qt::BottomDockWidgetArea);
  QDockWidget* design = add(tr("Design"), "design", design_, Qt::BottomDockWidgetArea);
  charts_ = new panels::ChartPanel(document_, quickJobs_);
  connect(
      charts_, &panels::ChartPanel::runRequested, this, [this](const std::string& study) { session_.run({study}); });
  harmonicDocks_ = {plot, motion, modes, design};
  clothDocks_ = {limits, energies};
  tabifyDockWidget(docks_[1], limits);
  tabifyDockWidget(docks_[2], modes);
  docks_[2]->raise();
  tabifyDockWidget(plot, motion);
  tabifyDockWidget(motion, design);
  tabifyDockWidget(design, energies);
  tabifyDockWidget(energies, log);
  makeInterlockDocks();
  plot->raise();
  makeCellDock();
  makePrintDock();
  chartDock_ = add(tr("Charts"), "charts", charts_, Qt::BottomDockWidgetArea);
  tabifyDockWidget(design, chartDock_);
  plot->raise();
}

void MainWindow::buildStatusBar() {
  status_ = new JobStatus;
  readout_ = new QLabel;
  warnings_ = new QToolButton;
  warnings_->setAutoRaise(true);
  warnings_->setFocusPolicy(Qt::NoFocus);
  warnings_->setText(tr("No warnings"));
  warnings_->setToolTip(tr("Show all messages"));
  connect(warnings_, &QToolButton::clicked, this, [this] {
    docks_[4]->show();
    docks_[4]->raise();
  });
  statusBar()->setSizeGripEnabled(false);
  statusBar()->addWidget(status_);
  statusBar()->addPermanentWidget(readout_);
  statusBar()->addPermanentWidget(warnings_);
}

void MainWindow::connectParts() {
  auto* link = new ViewportLink(document_, session_, *viewport_, this);
  auto* clothLink = new ClothLink(document_, *viewport_, *limits_, *energies_, this);
  new LiveLink(document_, live_, *viewport_, *clothLink, this);
  connectInterlock();
  connect(modes_, &panels::ModesPanel::modeChosen, link, &ViewportLink::showMode);
  connect(modes_, &panels::ModesPanel::modeLeft, link, &ViewportLink::showMotion);
  targets_ = new TargetLink(document_, session_, *viewport_, *design_->targetBar(), this);
  connect(design_, &panels::DesignPanel::designChosen, link, &ViewportLink::showDesign);
  connect(design_, &panels::DesignPanel::progressMade, link, &ViewportLink::showProgress);
  connect(design_, &panels::DesignPanel::comparisonChosen, link, &ViewportLink::showComparison);
  connect(design_, &panels::DesignPanel::designLeft, link, &ViewportLink::showMotion);
  connect(design_, &panels::DesignPanel::runRequested, this, [this](const std::string& name) { session_.run({name}); });
  connect(design_, &panels::DesignPanel::designsGrow, this, [this] {
    if (auto* dock = qobject_cast<QDockWidget*>(design_->parentWidget())) dock->raise();
  });
  connect(charts_, &panels::ChartPanel::designChosen, modes_, &panels::ModesPanel::leave);
  connect(charts_, &panels::ChartPanel::designChosen, link, &ViewportLink::showDesign);
  connect(charts_, &panels::ChartPanel::designLeft, link, &ViewportLink::showMotion);
  connect(&session_, &jobs::MotionSession::shownChanged, charts_, &panels::ChartPanel::leave);
  connect(&session_, &jobs::MotionSession::shownChanged, modes_, &panels::ModesPanel::leave);
  connect(viewport_, &viewport::Viewport::tauChanged, motion_, &panels::MotionPanel::setTau);
  status_->watch(studyJobs_);
  status_->watch(sceneJobs_);
  status_->watch(drapeJobs_);
  status_->watch(quickJobs_);
  status_->watch(exportJobs_);
  connect(status_, &JobStatus::cancelRequested, this, &MainWindow::cancel);
  document_.setBackground([this](document::BackgroundWork work) {
    sceneJobs_.submit({QStringLiteral("edit"), tr("Building the model"),
                       [work = std::move(work)](base::ExecutionContext&, const jobs::Publish&) { return work(); }});
  });
  connect(&document_, &document::Document::editingChanged, this, &MainWindow::refreshActions);
  for (jobs::JobRunner* runner : {&sceneJobs_, &exportJobs_})
    connect(runner, &jobs::JobRunner::finished, this,
            [this](jobs::JobRunner::Id, const QString&, jobs::JobOutcome outcome, const QString& sentence) {
              if (outcome == jobs::JobOutcome::failed) report(base::Severity::warning, sentence);
            });
  connect(&exportJobs_, &jobs::JobRunner::started, this, &MainWindow::refreshActions);
  connect(&exportJobs_, &jobs::JobRunner::finished, this, &MainWindow::refreshActions);
  connect(gallery_, &Gallery::sceneChosen, this, [this](const QString& file) { openFile(file, true); });
  connect(gallery_, &Gallery::openRequested, this, &MainWindow::chooseFile);
  connect(tree_, &panels::SceneTree::studyActivated, this, [this](const std::string& name) { session_.run({name}); });
  connect(&session_, &jobs::MotionSession::nodeChanged, tree_, &panels::SceneTree::setSelectedNode);
  connect(response_, &panels::ResponsePanel::readoutChanged, readout_, &QLabel::setText);
  connect(&document_, &document::Document::messageRaised, this, &MainWindow::report);
  for (jobs::JobRunner* runner : {&studyJobs_, &quickJobs_, &drapeJobs_, &sceneJobs_, &exportJobs_})
    connect(runner, &jobs::JobRunner::logged, this, [this](base::Severity severity, const QString& sentence) {
      if (severity == base::Severity::warning)
        report(severity, sentence);
      else
        log_->add(severity, sentence);
    });
  connect(&document_, &document::Document::sceneReplaced, this, &MainWindow::showScene);
  connect(&document_, &document::Document::fileChanged, this, &MainWindow::refreshTitle);
  connect(&document_, &document::Document::sceneEdited, this, &MainWindow::refreshTitle);
  connect(&document_.undoStack(), &QUndoStack::cleanChanged, this, &MainWindow::refreshTitle);
  for (auto changed : {&jobs::MotionSession::shownChanged, &jobs::MotionSession::predictionChanged})
    connect(&session_, changed, this, &MainWindow::refreshActions);
  connect(&session_, &jobs::MotionSession::busyChanged, this, &MainWindow::refreshActions);
  connect(viewport_, &viewport::Viewport::clothChanged, this, &MainWindow::refreshActions);
  connect(&session_, &jobs::MotionSession::updated, this, &MainWindow::reportUpdate);
}

void MainWindow::openFile(const QString& file, bool run) {
  jobs::Job job;
  job.topic = openTopic;
  job.title = tr("Open %1").arg(QFileInfo(file).fileName());
  job.work = [this, file, run](base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
    auto loaded = document::loadScene(file);
    if (context.cancelRequested()) return {};
    return [this, file, run, loaded = std::move(loaded)] {
      keepUnsaved();
      document_.adopt(loaded, file);
      recent_.add(file);
      if (run) session_.runAll();
    };
  };
  sceneJobs_.submit(std::move(job));
}

void MainWindow::undo() {
  if (document_.isEditing())
    document_.cancelEdits();
  else
    document_.undoStack().undo();
}

void MainWindow::cancel() {
  session_.cancel();
  document_.cancelEdits();
  sceneJobs_.cancelTopic(openTopic);
  drapes_->cancel();
  exportJobs_.cancelAll();
}

void MainWindow::chooseFile() {
  const QString folder =
      document_.file().isEmpty() ? shippedFile(QStringLiteral("scenes")) : QFileInfo(document_.file()).absolutePath();
  const QString file = QFileDialog::getOpenFileName(this, tr("Open a scene"), folder, tr("Scenes (*.json)"));
  if (!file.isEmpty()) openFile(file);
}

bool MainWindow::save() { return document_.file().isEmpty() ? saveAs() : document_.saveAs(document_.file()); }

bool MainWindow::saveAs() {
  if (document_.isEmpty()) return false;
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save the scene"), document_.file(), tr("Scenes (*.json)"));
  if (file.isEmpty() || !document_.saveAs(file)) return false;
  recent_.add(file);
  return true;
}

void MainWindow::exportShown() {
  if (document_.isEmpty()) return;
  const QString name = QFileInfo(document_.file()).completeBaseName() + QStringLiteral(".png");
  const QString file = QFileDialog::getSaveFileName(this, tr("Export what is shown"), name, exportFilters());
  if (file.isEmpty()) return;
  try {
    exportTo(file, document_, session_, response_->study(), *viewport_);
    report(base::Severity::information, tr("Exported to %1.").arg(file));
  } catch (const base::InputError& error) {
    report(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

/// Nothing asks in a dialog: edits that were not saved are kept beside the settings and stand among the recent files.
void MainWindow::keepUnsaved() {
  if (!remember_ || document_.isEmpty() || !document_.isModified()) return;
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/unsaved");
  QDir().mkpath(folder);
  const QString file = QStringLiteral("%1/%2 %3.json")
                           .arg(folder, QFileInfo(document_.file()).completeBaseName(),
                                QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd HHmmss")));
  if (!document_.saveAs(file)) return;
  recent_.add(file);
  report(base::Severity::information, tr("The edits that were not saved are kept in %1.").arg(file));
}

void MainWindow::showScene() {
  pages_->setCurrentWidget(viewport_->parentWidget());
  setDocksVisible(true);
  messages_->dismiss();
  viewport_->setFocus();
  refreshTitle();
  refreshActions();
}

void MainWindow::report(base::Severity severity, const QString& sentence) {
  messages_->show(severity, sentence);
  log_->add(severity, sentence);
  const int count = log_->warningCount();
  warnings_->setText(count == 0 ? tr("No warnings") : count == 1 ? tr("1 warning") : tr("%1 warnings").arg(count));
}

void MainWindow::reportUpdate(double predicted, double solved) {
  if (std::isnan(predicted) || !(solved > 0)) {
    report(base::Severity::information, tr("Solved anew: %1.").arg(plots::formatLength(solved)));
    return;
  }
  report(base::Severity::information, tr("The prediction was off by %1 %: predicted %2, solved %3.")
                                          .arg(100 * std::abs(predicted - solved) / solved, 0, 'g', 3)
                                          .arg(plots::formatLength(predicted), plots::formatLength(solved)));
}

void MainWindow::refreshTitle() {
  setWindowTitle(document_.isEmpty() ? QStringLiteral("Pliant") : tr("%1[*] – Pliant").arg(document_.title()));
  setWindowModified(document_.isModified());
}

void MainWindow::setDocksVisible(bool visible) {
  for (QDockWidget* dock : docks_) dock->setVisible(visible);
  if (visible) showFittingDocks();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QList<QUrl> urls = event->mimeData()->urls();
  if (urls.isEmpty() || !urls.first().isLocalFile()) return;
  event->acceptProposedAction();
  openFile(urls.first().toLocalFile());
}

void MainWindow::closeEvent(QCloseEvent* event) {
  keepUnsaved();
  if (remember_) storeSettings();
  event->accept();
}

}  // namespace pliant::shell
