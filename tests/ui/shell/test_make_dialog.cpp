#include <QAction>
#include <QCheckBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/geometry/surface_mesh.hpp"
#include "ui/panels/message_bar.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/make_dialog.hpp"

using namespace pliant;
using shell::MainWindow;

namespace {

constexpr int patience = 120'000;  // milliseconds

QString shipped(const char* name) {
  return QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/%1.json").arg(QLatin1String(name));
}

}  // namespace

/// Bodies to be made, from the window.
class TestMakeDialog : public QObject {
  Q_OBJECT

  bool said(const char* words) { return window_->messages().sentence().contains(QLatin1String(words)); }
  void openDialog(const char* scene) {
    QVERIFY(window_->document().open(shipped(scene)));
    window_->findChild<QAction*>("file.make")->trigger();
    QVERIFY(window_->makeDialog().isVisible());
    QVERIFY(!window_->makeDialog().isModal());
  }

 private Q_SLOTS:
  void init() {
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
  }
  void cleanup() { window_.reset(); }

  /// A mechanism in two layers, with the sizes that were typed.
  void linksAreExported() {
    openDialog("three_link");
    shell::MakeDialog& dialog = window_->makeDialog();
    QVERIFY(dialog.field("hole")->isVisible() && dialog.flat()->isVisible());
    QVERIFY(!dialog.field("wall")->isVisible());
    dialog.field("thickness")->setValue(5);
    dialog.field("clearance")->setValue(1);
    window_->exportPartsTo(folder_.filePath("links.stl"));
    QTRY_VERIFY_WITH_TIMEOUT(said("Exported to"), patience);
    QVERIFY(dialog.shownText().contains("3 plates in 2 layers"));
    QVERIFY(dialog.shownText().contains("checked: closed"));
    const auto mesh = geometry::readMesh(folder_.filePath("links.stl").toStdString(), 1e-3);
    QVERIFY(std::abs(mesh.points.row(2).maxCoeff() - 11e-3) < 1e-6);
    dialog.flat()->setChecked(true);
    window_->exportPartsTo(folder_.filePath("flat.stl"));
    QTRY_VERIFY_WITH_TIMEOUT(!dialog.shownText().contains("layers"), patience);
    const auto flat = geometry::readMesh(folder_.filePath("flat.stl").toStdString(), 1e-3);
    QVERIFY(std::abs(flat.points.row(2).maxCoeff() - 5e-3) < 1e-6);

    window_->exportParametersTo(folder_.filePath("parameters.csv"));
    QFile table(folder_.filePath("parameters.csv"));
    QVERIFY(table.open(QIODevice::ReadOnly) && table.readAll().contains("knee,/point_masses/0/mass,"));
  }

  /// What does not concern a scene is not asked; what cannot be made is said.
  void sizesFitTheScene() {
    openDialog("fork");
    shell::MakeDialog& dialog = window_->makeDialog();
    QVERIFY(!dialog.field("hole")->isVisible() && !dialog.flat()->isVisible());
    QVERIFY(dialog.field("density")->isVisible());
    // Another scene shows its own.
    QVERIFY(window_->document().open(shipped("fish")));
    QVERIFY(dialog.field("wall")->isVisible() && !dialog.field("width")->isVisible());
    QVERIFY(window_->document().open(shipped("duffing")));
    for (const auto* button : dialog.findChildren<QPushButton*>())
      if (button->text().contains("Bodies")) QVERIFY(!button->isEnabled());
    window_->exportPartsTo(folder_.filePath("none.stl"));
    QTRY_VERIFY_WITH_TIMEOUT(said("no shells, solids, links or rods"), patience);
  }

  /// The wires of the fish take their time; what is cancelled leaves no file.
  void cancelled() {
    openDialog("fish");
    auto* cancel = window_->findChild<QAction*>("study.cancel");
    QVERIFY(!cancel->isEnabled());
    window_->exportPartsTo(folder_.filePath("fish.stl"));
    QTRY_VERIFY(cancel->isEnabled());
    cancel->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!cancel->isEnabled(), patience);
    QVERIFY(QDir(folder_.path()).entryList({"fish*"}, QDir::AllEntries | QDir::Hidden).isEmpty());
  }

 private:
  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

QTEST_MAIN(TestMakeDialog)
#include "test_make_dialog.moc"
