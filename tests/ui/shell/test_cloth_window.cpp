#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QSlider>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "tests/ui/panels/sheet_scene.hpp"
#include "ui/panels/energy_panel.hpp"
#include "ui/panels/limit_panel.hpp"
#include "ui/plots/polar_editor.hpp"
#include "ui/shell/exporter.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/playback_bar.hpp"
#include "ui/viewport/viewport.hpp"

using namespace pliant;
using shell::MainWindow;

namespace {

constexpr int patience = 120'000;  // milliseconds

bool hasDock(const MainWindow& window, const char* name) {
  const auto* dock = window.findChild<QDockWidget*>(QLatin1String(name));
  return dock && !dock->isHidden();
}

}  // namespace

/// A scene with a cloth in the whole window.
class TestClothWindow : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    QFile file(folder_.filePath("sheet.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(sheetScene);
  }

  void init() {
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
  }
  void cleanup() { window_.reset(); }

  void docksFitTheScene() {
    QVERIFY(window_->document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    QVERIFY(!hasDock(*window_, "limits") && !hasDock(*window_, "energy") && hasDock(*window_, "response"));
    QVERIFY(window_->document().open(folder_.filePath("sheet.json")));
    QVERIFY(hasDock(*window_, "limits") && hasDock(*window_, "energy") && hasDock(*window_, "response"));
  }

  void aClothIsRunPlayedAndLimited() {
    QVERIFY(window_->document().open(folder_.filePath("sheet.json")));
    window_->session().run({"swing"});
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().study("swing")->status == document::StudyStatus::solved, patience);
    viewport::Viewport& viewport = window_->viewport();
    QVERIFY(viewport.showsCloth());
    QVERIFY(std::abs(viewport.duration() - 0.2) < 1e-9);
    viewport.pause();
    // Scrubbing.
    auto* scrub = window_->findChild<shell::PlaybackBar*>()->findChild<QSlider*>();
    scrub->setValue(0);
    QCOMPARE(viewport.clothView().frame(), 0);
    scrub->setValue(scrub->maximum());
    QCOMPARE(viewport.clothView().frame(), static_cast<int>(viewport.clothFrames().size()) - 1);
    // What is reached lies within the limit, as far as that is kept.
    plots::PolarEditor& editor = *window_->limits().editor();
    QTRY_VERIFY(editor.picture().reached.size() > 0);
    QTRY_VERIFY(editor.picture().reached.maxCoeff() > 1);
    QVERIFY(editor.picture().reached.maxCoeff() < 1.01 * 1.001);
    // A limit that changes makes it stale; the cloth stays.
    window_->limits().editor()->putHandle(0, {0, 1.03});
    QVERIFY(window_->document().study("swing")->stale);
    QVERIFY(viewport.showsCloth());
    // Another scene has no cloth any more.
    QVERIFY(window_->document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    QVERIFY(!viewport.showsCloth());
    QCOMPARE(editor.picture().reached.size(), Eigen::Index(0));
  }

  void framesAreExported() {
    QVERIFY(window_->document().open(folder_.filePath("sheet.json")));
    base::ExecutionContext context;
    QVERIFY_EXCEPTION_THROWN(shell::frameExport(folder_.filePath("none.glb"), window_->viewport()), base::InputError);
    window_->session().run({"swing"});
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().study("swing")->status == document::StudyStatus::solved, patience);
    const int frames = static_cast<int>(window_->viewport().clothFrames().size());
    QCOMPARE(shell::frameExport(folder_.filePath("a.glb"), window_->viewport())(context), 1);
    QVERIFY(QFileInfo(folder_.filePath("a.glb")).size() > 1000);
    QCOMPARE(shell::frameExport(folder_.filePath("b.obj"), window_->viewport())(context), frames);
    QCOMPARE(QDir(folder_.path()).entryList({"b_*.obj"}).size(), frames);
    QVERIFY_EXCEPTION_THROWN(shell::frameExport(folder_.filePath("c.avi"), window_->viewport()), base::InputError);
    // The frame on show, as a mesh.
    window_->viewport().pause();
    window_->viewport().setTime(0.2);
    shell::exportTo(folder_.filePath("d.ply"), window_->document(), window_->session(), {}, window_->viewport());
    QVERIFY(QFileInfo(folder_.filePath("d.ply")).size() > 500);
  }

 private:
  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

QTEST_MAIN(TestClothWindow)
#include "test_cloth_window.moc"
