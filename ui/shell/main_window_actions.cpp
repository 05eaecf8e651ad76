#include <QActionGroup>
#include <QDesktopServices>
#include <QDockWidget>
#include <QFileInfo>
#include <QMenuBar>
#include <QSettings>
#include <QStackedWidget>
#include <QToolBar>
#include <QToolButton>
#include <QUrl>

#include "core/mechanics/design_parameter.hpp"
#include "ui/panels/icon.hpp"
#include "ui/panels/message_bar.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/response_panel.hpp"
#include "ui/panels/scene_tree.hpp"
#include "ui/shell/cell_link.hpp"
#include "ui/shell/command_palette.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/shell/live_bar.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/playback_bar.hpp"
#include "ui/shell/shipped_files.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

using render::AxisView;

void MainWindow::makeActions() {
  const auto add = [this](const char* id, const QString& text, const char* icon, const QKeySequence& keys,
                          const QString& tooltip, std::function<void()> trigger) {
    return actions_.add({QLatin1String(id), text, QLatin1String(icon), keys, tooltip}, std::move(trigger));
  };
  add("file.open", tr("&Open…"), "open", QKeySequence::Open, tr("Open a scene"), [this] { chooseFile(); });
  add("file.save", tr("&Save"), "save", QKeySequence::Save, tr("Save the scene"), [this] { save(); });
  add("file.saveAs", tr("Save &As…"), "", QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S),
      tr("Save the scene as another file"), [this] { saveAs(); });
  add("file.export", tr("&Export…"), "export", QKeySequence(Qt::CTRL | Qt::Key_E),
      tr("Export a picture, the deformed mesh or the curve"), [this] { exportShown(); });
  add("file.gallery", tr("Shipped Scenes"), "gallery", {}, tr("Show the scenes that come with Pliant"), [this] {
    showDrapes(false);
    pages_->setCurrentIndex(pages_->currentIndex() == 0 && !document_.isEmpty() ? 1 : 0);
  });
  add("file.quit", tr("&Quit"), "", QKeySequence(Qt::CTRL | Qt::Key_Q), tr("Close the window"), [this] { close(); });

  add("edit.undo", tr("&Undo"), "undo", QKeySequence::Undo, tr("Undo the last edit"), [this] { undo(); });
  add("edit.redo", tr("&Redo"), "redo", QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_Z),
      tr("Redo the edit that was undone"), [this] { document_.undoStack().redo(); });
  add("edit.find", tr("&Find Anything…"), "search", QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_P),
      tr("Find actions, parameters, properties and scenes"), [this] { openPalette(); });

  add("view.play", tr("Play"), "play", QKeySequence(Qt::Key_Space), tr("Play or pause the motion"),
      [this] { live_.isOpen() ? live_.setPlaying(!live_.isPlaying()) : viewport_->togglePlaying(); });
  add("view.fit", tr("&Fit"), "fit", QKeySequence(Qt::Key_F), tr("Show all of the motion"),
      [this] { viewport_->fit(); });
  const std::vector<std::tuple<const char*, QString, int, AxisView>> views{
      {"view.front", tr("Front"), Qt::Key_1, AxisView::front},
      {"view.back", tr("Back"), Qt::Key_2, AxisView::back},
      {"view.right", tr("Right"), Qt::Key_3, AxisView::right},
      {"view.left", tr("Left"), Qt::Key_4, AxisView::left},
      {"view.top", tr("Top"), Qt::Key_5, AxisView::top},
      {"view.bottom", tr("Bottom"), Qt::Key_6, AxisView::bottom},
      {"view.isometric", tr("Isometric"), Qt::Key_0, AxisView::isometric}};
  for (const auto& [id, text, key, view] : views)
    add(id, text, "", QKeySequence(key), tr("Look from this side"),
        [this, view = view] { viewport_->setAxisView(view); });
  QAction* stretch =
      add("view.stretch", tr("Colour by Stretch"), "", {}, tr("Colour the surface by its in-plane stretch"), [] {});
  stretch->setCheckable(true);
  stretch->setChecked(true);
  connect(stretch, &QAction::toggled, viewport_, &viewport::Viewport::setFieldVisible);
  QAction* hertz =
      add("view.hertz", tr("Frequencies in Hz"), "", {}, tr("Show frequencies in Hz instead of rad/s"), [] {});
  hertz->setCheckable(true);
  connect(hertz, &QAction::toggled, response_, &panels::ResponsePanel::setHertz);
  connect(response_, &panels::ResponsePanel::hertzChanged, hertz, &QAction::setChecked);
  auto* themes = new QActionGroup(this);
  const std::vector<std::tuple<const char*, QString, Theme>> choices{
      {"view.theme.system", tr("System Colours"), Theme::system},
      {"view.theme.light", tr("Light Colours"), Theme::light},
      {"view.theme.dark", tr("Dark Colours"), Theme::dark}};
  for (const auto& [id, text, theme] : choices) {
    QAction* action = add(id, text, "", {}, tr("Colours of the window"), [this, theme = theme] { setTheme(theme); });
    action->setCheckable(true);
    themes->addAction(action);
    action->setChecked(theme == Theme::system);
  }

  makeClothActions();
  makePartsActions();
  makeLiveActions();
  makeCellActions();
  add("model.reset", tr("&Reset All Parameters"), "reset", {}, tr("Set all parameters as they are in the file"),
      [this] { resetParameters(); });
  add("model.nextProbe", tr("Next &Probe"), "", QKeySequence(Qt::Key_P), tr("Select the next probe"),
      [this] { selectNextProbe(); });

  add("study.run", tr("&Run"), "run", QKeySequence(Qt::CTRL | Qt::Key_R), tr("Run all studies"),
      [this] { session_.runAll(); });
  add("study.update", tr("&Update"), "update", QKeySequence(Qt::Key_U),
      tr("Solve anew with the scene as it is, from the prediction"), [this] { session_.update(); });
  add("study.cancel", tr("&Cancel"), "cancel", QKeySequence(Qt::CTRL | Qt::Key_Period),
      tr("End what runs; what has been found stays"), [this] { cancel(); });

  add("help.format", tr("Scene &Format"), "", QKeySequence::HelpContents, tr("Read what a scene file may say"),
      [] { QDesktopServices::openUrl(QUrl::fromLocalFile(shippedFile(QStringLiteral("scenes/README.md")))); });
  add("help.about", tr("&About Pliant"), "information", {}, tr("Version and licence"), [this] {
    report(base::Severity::information,
           tr("Pliant %1: design of nonlinear mechanical systems. GPL-3.0-or-later, without any warranty.")
               .arg(PLIANT_VERSION));
  });
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, &MainWindow::refreshActions);
  connect(viewport_, &viewport::Viewport::playingChanged, this, &MainWindow::showPlaying);
}

void MainWindow::showPlaying(bool playing) {
  QAction* play = actions_.find(QStringLiteral("view.play"));
  play->setIcon(panels::icon(playing ? QStringLiteral("pause") : QStringLiteral("play")));
  play->setText(playing ? tr("Pause") : tr("Play"));
}

void MainWindow::makeMenus() {
  const auto fill = [this](QMenu* menu, std::initializer_list<const char*> ids) {
    for (const char* id : ids) {
      if (*id == '-')
        menu->addSeparator();
      else
        menu->addAction(actions_.find(QLatin1String(id)));
    }
  };
  QMenu* file = menuBar()->addMenu(tr("&File"));
  fill(file, {"file.open"});
  QMenu* recent = file->addMenu(tr("Open &Recent"));
  connect(recent, &QMenu::aboutToShow, this, [this, recent] { fillRecentMenu(recent); });
  fill(file, {"file.gallery", "-", "file.save", "file.saveAs", "file.export", "file.exportFrames", "file.make", "-",
              "file.quit"});
  fill(menuBar()->addMenu(tr("&Edit")), {"edit.undo", "edit.redo", "-", "edit.find"});
  fill(menuBar()->addMenu(tr("&View")), {"view.play",
                                         "view.fit",
                                         "-",
                                         "view.front",
                                         "view.back",
                                         "view.right",
                                         "view.left",
                                         "view.top",
                                         "view.bottom",
                                         "view.isometric",
                                         "-",
                                         "view.drapes",
                                         "-",
                                         "view.stretch",
                                         "view.limitForce",
                                         "view.directions",
                                         "view.hertz",
                                         "-",
                                         "view.theme.system",
                                         "view.theme.light",
                                         "view.theme.dark"});
  fill(menuBar()->addMenu(tr("&Model")),
       {"model.reset", "model.nextProbe", "-", "model.elements", "model.print", "cell.reset"});
  QMenu* study = menuBar()->addMenu(tr("&Study"));
  connect(study, &QMenu::aboutToShow, this, [this, study] { fillStudyMenu(study); });
  fillStudyMenu(study);
  QMenu* window = menuBar()->addMenu(tr("&Window"));
  for (QDockWidget* dock : docks_) window->addAction(dock->toggleViewAction());
  fill(menuBar()->addMenu(tr("&Help")), {"help.format", "help.about"});
}

void MainWindow::fillStudyMenu(QMenu* menu) {
  menu->clear();
  for (const char* id : {"study.run", "study.update", "study.cancel"})
    menu->addAction(actions_.find(QLatin1String(id)));
  menu->addSeparator();
  for (const char* id : {"live.open", "live.step", "live.reset", "live.record"})
    menu->addAction(actions_.find(QLatin1String(id)));
  if (document_.studies().empty()) return;
  menu->addSeparator();
  for (const auto& study : document_.studies())
    menu->addAction(tr("Run %1").arg(QString::fromStdString(study.name)), this,
                    [this, name = study.name] { session_.run({name}); });
}

void MainWindow::fillRecentMenu(QMenu* menu) {
  menu->clear();
  for (const QString& file : recent_.files())
    menu->addAction(QFileInfo(file).fileName(), this, [this, file] { openFile(file); })->setToolTip(file);
  if (menu->isEmpty()) menu->addAction(tr("Nothing yet"))->setEnabled(false);
}

void MainWindow::makeToolBar() {
  auto* bar = addToolBar(tr("Tools"));
  bar->setObjectName(QStringLiteral("tools"));
  bar->setMovable(false);
  bar->setIconSize({20, 20});
  const auto add = [&](const char* id, bool text) {
    QAction* action = actions_.find(QLatin1String(id));
    bar->addAction(action);
    auto* button = qobject_cast<QToolButton*>(bar->widgetForAction(action));
    button->setToolButtonStyle(text ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
    button->setFocusPolicy(Qt::NoFocus);
    button->setMinimumHeight(32);
  };
  add("file.open", false);
  add("file.save", false);
  bar->addSeparator();
  add("edit.undo", false);
  add("edit.redo", false);
  bar->addSeparator();
  add("study.run", true);
  add("study.update", true);
  add("study.cancel", true);
  bar->addSeparator();
  bar->addWidget(new PlaybackBar(*viewport_, actions_.find(QStringLiteral("view.play"))));
  bar->addSeparator();
  add("view.fit", false);
  auto* views = new QToolButton;
  views->setIcon(panels::icon(QStringLiteral("views")));
  views->setText(tr("Views"));
  views->setToolTip(tr("Look along an axis (1 to 6, 0)"));
  views->setAutoRaise(true);
  views->setFocusPolicy(Qt::NoFocus);
  views->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(views);
  for (const char* id :
       {"view.front", "view.back", "view.right", "view.left", "view.top", "view.bottom", "view.isometric"})
    menu->addAction(actions_.find(QLatin1String(id)));
  views->setMenu(menu);
  bar->addWidget(views);
  bar->addSeparator();
  add("file.export", false);
  auto* space = new QWidget;
  space->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(space);
  add("edit.find", false);
}

void MainWindow::refreshActions() {
  const auto enable = [this](const char* id, bool enabled) { actions_.find(QLatin1String(id))->setEnabled(enabled); };
  const bool open = !document_.isEmpty();
  const bool busy = session_.isBusy();
  // What an edit that still waits for its model would change has to wait for it.
  const bool editing = document_.isEditing();
  for (const char* id : {"file.export", "file.make", "view.fit", "model.nextProbe"}) enable(id, open);
  for (const char* id : {"file.save", "file.saveAs", "model.reset"}) enable(id, open && !editing);
  enable("file.exportFrames", session_.shown().has_value() || viewport_->showsFrames());
  enable("view.play", session_.shown().has_value() || viewport_->showsFrames() || live_.isOpen());
  actions_.find(QStringLiteral("view.drapes"))->setChecked(pages_->currentIndex() == 2);
  for (const char* id : {"cell.reset", "model.print"}) enable(id, showsCells(document_));
  enable("live.open", liveBar_ && !liveBar_->study().empty());
  for (const char* id : {"live.step", "live.reset", "live.record"}) enable(id, live_.isOpen());
  enable("study.run", open && !document_.studies().empty() && !busy && !editing);
  enable("study.update", open && session_.isStale() && !busy && !editing);
  enable("study.cancel", busy || editing || !exportJobs_.isIdle());
  const QUndoStack& stack = document_.undoStack();
  enable("edit.undo", stack.canUndo() || editing);
  enable("edit.redo", stack.canRedo() && !editing);
  actions_.find(QStringLiteral("edit.undo"))
      ->setText(stack.canUndo() ? tr("&Undo %1").arg(stack.undoText()) : tr("&Undo"));
  actions_.find(QStringLiteral("edit.redo"))
      ->setText(stack.canRedo() ? tr("&Redo %1").arg(stack.redoText()) : tr("&Redo"));
}

void MainWindow::resetParameters() {
  document_.undoStack().beginMacro(tr("Reset all parameters"));
  for (const auto& parameter : document_.model()->parameters) {
    const auto saved = document_.savedValueAt(parameter->pointer());
    if (!saved.is_null() && saved != document_.valueAt(parameter->pointer()))
      document_.setValue(parameter->pointer(), saved, tr("Reset %1").arg(parameter->name().c_str()));
  }
  document_.undoStack().endMacro();
}

void MainWindow::selectNextProbe() {
  const auto& probes = document_.model()->probes;
  if (probes.empty()) return;
  std::size_t next = 0;
  for (std::size_t i = 0; i < probes.size(); ++i)
    if (probes[i].node == session_.node()) next = (i + 1) % probes.size();
  session_.selectNode(probes[next].node);
}

void MainWindow::openPalette() {
  std::vector<PaletteEntry> entries;
  for (QAction* action : actions_.all())
    if (action->isEnabled())
      entries.push_back({action->text().remove(QLatin1Char('&')), action->shortcut().toString(QKeySequence::NativeText),
                         [action] { action->trigger(); }});
  if (!document_.isEmpty()) {
    for (const auto& study : document_.studies())
      entries.push_back({tr("Run %1").arg(QString::fromStdString(study.name)), tr("study"),
                         [this, name = study.name] { session_.run({name}); }});
    for (const auto& parameter : document_.model()->parameters)
      entries.push_back(
          {QString::fromStdString(parameter->name()), tr("parameter"), [this, pointer = parameter->pointer()] {
             if (auto* row = parameters_->row(pointer)) row->slider()->setFocus();
           }});
    const auto walk = [&](const auto& self, const panels::SceneItem& item, const QString& path) -> void {
      for (const auto& child : item.children) {
        if (child->editable)
          entries.push_back({child->name, path + child->name, [this, pointer = child->pointer] {
                               const QModelIndex index = tree_->sceneModel().indexOf(pointer);
                               tree_->scrollTo(index);
                               tree_->setCurrentIndex(index);
                               tree_->edit(index);
                             }});
        self(self, *child, path + child->name + QStringLiteral(" › "));
      }
    };
    walk(walk, *tree_->sceneModel().itemAt({}), QString());
  }
  for (const GalleryScene& scene : shippedScenes())
    entries.push_back(
        {tr("Open %1").arg(scene.title), tr("scene"), [this, file = scene.file] { openFile(file, true); }});
  palette_->open(std::move(entries));
}

void MainWindow::setTheme(Theme theme) {
  theme_ = theme;
  applyTheme(theme);
}

void MainWindow::restoreSettings() {
  const QSettings settings;
  restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
  const QString theme = settings.value(QStringLiteral("window/theme"), QStringLiteral("system")).toString();
  if (QAction* action = actions_.find(QStringLiteral("view.theme.") + theme)) action->trigger();
  response_->setHertz(settings.value(QStringLiteral("window/hertz"), false).toBool());
}

void MainWindow::storeSettings() const {
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
  settings.setValue(QStringLiteral("window/theme"), theme_ == Theme::light  ? QStringLiteral("light")
                                                    : theme_ == Theme::dark ? QStringLiteral("dark")
                                                                            : QStringLiteral("system"));
  settings.setValue(QStringLiteral("window/hertz"), response_->plot()->isHertz());
}

}  // namespace pliant::shell
