#include <QFileInfo>
#include <QImage>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>

#include "tests/ui/render/hanging_sheet.hpp"
#include "ui/shell/drape_gallery.hpp"

using namespace pliant;
using shell::DrapeGallery;

namespace {
constexpr int patience = 120'000;  // milliseconds
}

/// Drapes are compared: added, computed, removed, exported.
class TestDrapeGallery : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    studies_ = std::make_unique<jobs::JobRunner>();
    quick_ = std::make_unique<jobs::JobRunner>();
    gallery_ = std::make_unique<DrapeGallery>(*studies_, *quick_);
    gallery_->resize(900, 600);
    gallery_->show();
    QVERIFY(QTest::qWaitForWindowExposed(gallery_.get()));
  }
  void cleanup() {
    gallery_.reset();
    quick_.reset();
    studies_.reset();
  }

  /// The same scenes on coarse meshes, which hang within a second.
  void initTestCase() {
    const QStringList shipped = DrapeGallery::shippedDrapes();
    QCOMPARE(shipped.size(), 3);
    for (const QString& file : shipped) {
      const scene::Scene fine = scene::Scene::load(file.toStdString());
      QVERIFY(fine.normalized()["studies"][0]["type"] == "cloth_drape");
      coarse_ << folder_.filePath(QFileInfo(file).fileName());
      fine.withValue("/geometry/0/length_cells", 6)
          .withValue("/geometry/0/width_cells", 6)
          .save(coarse_.back().toStdString());
    }
  }

  void whatItIsFilledWithIsThereAtFirst() {
    gallery_->fillAtFirst(coarse_);
    QCOMPARE(gallery_->drapes().size(), std::size_t(3));
    QTRY_VERIFY_WITH_TIMEOUT(!gallery_->isComputing(), patience);
    for (const render::Drape& drape : gallery_->drapes()) {
      QVERIFY(drape.problem && drape.frame);
      QVERIFY(QString::fromStdString(drape.title).startsWith("Drape"));
      QVERIFY(drape.frame->stretchRatios.maxCoeff() > 0.999);
    }
    // Once they have been removed they do not come back by themselves.
    for (int i = 0; i < 3; ++i) gallery_->remove(0);
    gallery_->fillAtFirst(coarse_);
    QVERIFY(gallery_->drapes().empty());
  }

  void whatIsShownIsAddedAndRemoved() {
    const QImage empty = gallery_->grab().toImage();
    gallery_->add({"first", sheet_.problem, sheet_.frames[3]});
    gallery_->add({"second", sheet_.problem, sheet_.frames[9]});
    QTRY_VERIFY_WITH_TIMEOUT(quick_->isIdle(), patience);
    const QImage two = gallery_->grab().toImage();
    QVERIFY(two != empty);
    QToolButton* remove = nullptr;
    for (auto* button : gallery_->findChildren<QToolButton*>())
      if (button->accessibleName().contains("first")) remove = button;
    QVERIFY(remove);
    QTest::mouseClick(remove, Qt::LeftButton);
    QCOMPARE(gallery_->drapes().size(), std::size_t(1));
    QCOMPARE(gallery_->drapes()[0].title, std::string("second"));
    QTRY_VERIFY_WITH_TIMEOUT(quick_->isIdle(), patience);
    QVERIFY(gallery_->grab().toImage() != two);
    gallery_->remove(0);
    QTest::qWait(50);
    QVERIFY(gallery_->grab().toImage() == empty);
  }

  void theFigureIsExported() {
    gallery_->add({"first", sheet_.problem, sheet_.frames[3]});
    gallery_->add({"second", sheet_.problem, sheet_.frames[9]});
    QSignalSpy said(gallery_.get(), &DrapeGallery::messageRaised);
    const QString file = folder_.filePath("figure.png");
    gallery_->exportTo(file);
    QTRY_COMPARE_WITH_TIMEOUT(said.count(), 1, patience);
    const QImage figure(file);
    QCOMPARE(figure.height(), 1240);
    QCOMPARE(figure.width(), 2 * 680);
    gallery_->exportTo(folder_.filePath("nowhere/figure.png"));
    QTRY_COMPARE_WITH_TIMEOUT(said.count(), 2, patience);
    QVERIFY(said[1][1].toString().contains("cannot be written"));
  }

  void badScenesAreRefusedWithASentence() {
    QSignalSpy said(gallery_.get(), &DrapeGallery::messageRaised);
    gallery_->addScene(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json"));
    QTRY_COMPARE_WITH_TIMEOUT(said.count(), 1, patience);
    QVERIFY(said[0][1].toString().contains("no study of the type cloth_drape"));
    QTRY_VERIFY(gallery_->drapes().empty());
  }

  void itEndsWhileItComputes() {
    gallery_->fillAtFirst(DrapeGallery::shippedDrapes());
    QTest::qWait(200);
    QVERIFY(gallery_->isComputing());
    gallery_->remove(1);
    gallery_->cancel();
    QTRY_VERIFY_WITH_TIMEOUT(!gallery_->isComputing(), patience);
    gallery_->addScene(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/cloth/drape_curve.json"));
    QTest::qWait(100);
  }

 private:
  render::HangingSheet sheet_;
  QTemporaryDir folder_;
  QStringList coarse_;
  std::unique_ptr<jobs::JobRunner> studies_, quick_;
  std::unique_ptr<DrapeGallery> gallery_;
};

QTEST_MAIN(TestDrapeGallery)
#include "test_drape_gallery.moc"
