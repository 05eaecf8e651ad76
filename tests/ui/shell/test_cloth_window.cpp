#include <QAction>
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
#include "ui/panels/message_bar.hpp"
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
    const auto exported = [&](const char* name) {
      return shell::frameExport(folder_.filePath(name), window_->session(), window_->viewport());
    };
    QVERIFY_EXCEPTION_THROWN(exported("none.glb"), base::InputError);
    QVERIFY_EXCEPTION_THROWN(exported("none.ogv"), base::InputError);
    window_->session().run({"swing"});
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().study("swing")->status == document::StudyStatus::solved, patience);
    const int frames = static_cast<int>(window_->viewport().clothFrames().size());
    QCOMPARE(exported("a.glb")(context), 1);
    QVERIFY(QFileInfo(folder_.filePath("a.glb")).size() > 1000);
    QCOMPARE(exported("b.obj")(context), frames);
    QCOMPARE(QDir(folder_.path()).entryList({"b_*.obj"}).size(), frames);
    QVERIFY_EXCEPTION_THROWN(exported("c.avi"), base::InputError);
    QCOMPARE(exported("e.png")(context), frames);
    QCOMPARE(QDir(folder_.path()).entryList({"e_*.png"}).size(), frames);
    base::ExecutionContext cancelled;
    cancelled.requestCancel();
    const QStringList before = QDir(folder_.path()).entryList(QDir::AllEntries | QDir::Hidden);
    for (const char* name : {"f.ogv", "f.png", "f.glb", "f.obj"}) QCOMPARE(exported(name)(cancelled), 0);
    QCOMPARE(QDir(folder_.path()).entryList(QDir::AllEntries | QDir::Hidden), before);
    // The frame on show, as a mesh.
    window_->viewport().pause();
    window_->viewport().setTime(0.2);
    shell::exportTo(folder_.filePath("d.ply"), window_->document(), window_->session(), {}, window_->viewport());
    QVERIFY(QFileInfo(folder_.filePath("d.ply")).size() > 500);
  }

  /// In the background, while the window goes on.
  void videosAreExported() {
    QVERIFY(window_->document().open(folder_.filePath("sheet.json")));
    window_->session().run({"swing"});
    QTRY_VERIFY_WITH_TIMEOUT(window_->document().study("swing")->status == document::StudyStatus::solved, patience);
    auto* cancel = window_->findChild<QAction*>("study.cancel");
    QVERIFY(cancel && !cancel->isEnabled());
    const auto said = [&](const char* words) { return window_->messages().sentence().contains(QLatin1String(words)); };
    window_->exportFramesTo(folder_.filePath("sheet.ogv"));
    QTRY_VERIFY(cancel->isEnabled());
    QVERIFY(!QFileInfo::exists(folder_.filePath("sheet.ogv")));
    QTRY_VERIFY_WITH_TIMEOUT(said("Exported to"), patience);
    QFile video(folder_.filePath("sheet.ogv"));
    QVERIFY(video.open(QIODevice::ReadOnly) && video.read(4) == "OggS" && video.size() > 5000);
    QTRY_VERIFY(!cancel->isEnabled());
    // What is cancelled leaves nothing.
    window_->viewport().setClothSpeed(1e-3);  // which takes a thousand pictures
    const QStringList before = QDir(folder_.path()).entryList(QDir::AllEntries | QDir::Hidden);
    window_->exportFramesTo(folder_.filePath("long.ogv"));
    QTRY_VERIFY(cancel->isEnabled());
    cancel->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!cancel->isEnabled(), patience);
    QCOMPARE(QDir(folder_.path()).entryList(QDir::AllEntries | QDir::Hidden), before);
    window_->exportFramesTo(folder_.filePath("nowhere/sheet.ogv"));
    QTRY_VERIFY_WITH_TIMEOUT(said("No such file or directory"), patience);
    window_->exportFramesTo(folder_.filePath("sheet.avi"));
    QVERIFY(said("must end in .ogv, .png"));
  }

 private:
  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

QTEST_MAIN(TestClothWindow)
#include "test_cloth_window.moc"
