#include <QApplication>
#include <QImage>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "ui/plots/plot_style.hpp"
#include "ui/plots/polar_editor.hpp"

using namespace pliant;
using plots::LimitShape;
using plots::PolarEditor;

namespace {

constexpr double degree = std::numbers::pi / 180;

cloth::StretchLimit freeLimit() {
  return cloth::LimitCurve({{0, 1.05}, {45 * degree, 1.17}, {100 * degree, 1.04}, {140 * degree, 1.12}});
}

QPoint pixel(const PolarEditor& editor, double angle, double stretch) {
  return editor.axis().point(angle, stretch).toPoint();
}

double limitAt(const PolarEditor& editor, double angle) { return cloth::stretchAt(editor.shape()->limit(), angle); }

}  // namespace

/// The polar editor as a hand meets it.
class TestPolarEditor : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    editor_ = std::make_unique<PolarEditor>();
    editor_->resize(320, 360);
    editor_->setLimit(freeLimit(), true);
    editor_->show();
    QVERIFY(QTest::qWaitForWindowExposed(editor_.get()));
  }
  void cleanup() { editor_.reset(); }

  void oneDragHasOneMergeId() {
    QSignalSpy edited(editor_.get(), &PolarEditor::edited);
    const auto drag = [&](double from, double to) {
      QTest::mousePress(editor_.get(), Qt::LeftButton, {}, pixel(*editor_, 45 * degree, from));
      QVERIFY(editor_->isDragging());
      for (int i = 1; i <= 4; ++i)
        QTest::mouseMove(editor_.get(), pixel(*editor_, 45 * degree, from + (to - from) * i / 4));
      QTest::mouseRelease(editor_.get(), Qt::LeftButton, {}, pixel(*editor_, 45 * degree, to));
      QVERIFY(!editor_->isDragging());
    };
    drag(1.17, 1.10);
    QCOMPARE(edited.count(), 4);
    for (const auto& signal : edited) QCOMPARE(signal[1].toInt(), edited[0][1].toInt());
    QVERIFY(std::abs(limitAt(*editor_, 45 * degree) - 1.10) < 0.003);  // a pixel
    const int first = edited[0][1].toInt();
    drag(limitAt(*editor_, 45 * degree), 1.15);
    QVERIFY(edited.last()[1].toInt() != first);
  }

  void whatTheHandSeizesDoesNotJump() {
    const QPoint beside = pixel(*editor_, 45 * degree, 1.17) + QPoint(5, 3);
    QSignalSpy edited(editor_.get(), &PolarEditor::edited);
    QTest::mousePress(editor_.get(), Qt::LeftButton, {}, beside);
    QTest::mouseMove(editor_.get(), beside);
    QTest::mouseRelease(editor_.get(), Qt::LeftButton, {}, beside);
    QCOMPARE(edited.count(), 0);
    QVERIFY(plots::sameLimit(editor_->shape()->limit(), freeLimit()));
  }

  void escapeTakesADragBack() {
    QSignalSpy edited(editor_.get(), &PolarEditor::edited);
    QTest::mousePress(editor_.get(), Qt::LeftButton, {}, pixel(*editor_, 45 * degree, 1.17));
    QTest::mouseMove(editor_.get(), pixel(*editor_, 45 * degree, 1.12));
    QVERIFY(!plots::sameLimit(editor_->shape()->limit(), freeLimit()));
    // Meanwhile the scene's limit comes back late: the hand keeps what it holds.
    editor_->setLimit(freeLimit());
    QVERIFY(!plots::sameLimit(editor_->shape()->limit(), freeLimit()));
    QTest::keyClick(editor_.get(), Qt::Key_Escape);
    QVERIFY(plots::sameLimit(editor_->shape()->limit(), freeLimit()));
    QCOMPARE(edited.last()[1].toInt(), edited.first()[1].toInt());
  }

  void belowOneItStopsAndSaysWhyOnce() {
    QSignalSpy refused(editor_.get(), &PolarEditor::refused);
    QTest::mousePress(editor_.get(), Qt::LeftButton, {}, pixel(*editor_, 45 * degree, 1.17));
    for (const double stretch : {0.99, 0.97, 0.95})
      QTest::mouseMove(editor_.get(), pixel(*editor_, 45 * degree, stretch));
    QTest::mouseRelease(editor_.get(), Qt::LeftButton, {}, pixel(*editor_, 45 * degree, 0.95));
    QCOMPARE(refused.count(), 1);
    QCOMPARE(limitAt(*editor_, 45 * degree), 1.0);
  }

  void pointsComeAndGo() {
    const double angle = 70 * degree;
    QTest::mouseDClick(editor_.get(), Qt::LeftButton, {}, pixel(*editor_, angle, limitAt(*editor_, angle)));
    QCOMPARE(editor_->shape()->handleCount(), 5);
    QCOMPARE(editor_->selected(), 2);
    QVERIFY(std::abs(editor_->shape()->handles()[2].angle - angle) < 1.5 * degree);
    QTest::keyClick(editor_.get(), Qt::Key_Delete);
    QCOMPARE(editor_->shape()->handleCount(), 4);
    QCOMPARE(editor_->selected(), -1);
    QVERIFY(plots::sameLimit(editor_->shape()->limit(), freeLimit()));
    // A double click on a handle asks for its numbers instead.
    QSignalSpy activated(editor_.get(), &PolarEditor::activated);
    QTest::mouseDClick(editor_.get(), Qt::LeftButton, {}, pixel(*editor_, 45 * degree, 1.17));
    QCOMPARE(activated.count(), 1);
    QCOMPARE(editor_->shape()->handleCount(), 4);
  }

  void arrowsNudgeTheSelectedPoint() {
    QSignalSpy edited(editor_.get(), &PolarEditor::edited);
    QTest::keyClick(editor_.get(), Qt::Key_Up);
    QCOMPARE(edited.count(), 0);  // nothing is selected
    QTest::keyClick(editor_.get(), Qt::Key_PageDown);
    QTest::keyClick(editor_.get(), Qt::Key_PageDown);
    QCOMPARE(editor_->selected(), 1);
    QTest::keyClick(editor_.get(), Qt::Key_Up);
    QTest::keyClick(editor_.get(), Qt::Key_Up, Qt::ShiftModifier);
    QTest::keyClick(editor_.get(), Qt::Key_Left);
    QVERIFY(std::abs(editor_->shape()->handles()[1].stretch - 1.1755) < 1e-9);
    QVERIFY(std::abs(editor_->shape()->handles()[1].angle - 46 * degree) < 1e-9);
    QCOMPARE(edited.count(), 3);
    QCOMPARE(edited[0][1].toInt(), edited[2][1].toInt());
    QTest::keyClick(editor_.get(), Qt::Key_PageDown);
    QTest::keyClick(editor_.get(), Qt::Key_Down);
    QVERIFY(edited.last()[1].toInt() != edited[0][1].toInt());
  }

  void anIsotropicRingIsSeizedAnywhere() {
    editor_->setLimit(cloth::IsotropicLimit{1.05}, true);
    QTest::mousePress(editor_.get(), Qt::LeftButton, {}, pixel(*editor_, 130 * degree, 1.05));
    QTest::mouseMove(editor_.get(), pixel(*editor_, 130 * degree, 1.03));
    QTest::mouseRelease(editor_.get(), Qt::LeftButton, {}, pixel(*editor_, 130 * degree, 1.03));
    QVERIFY(std::abs(limitAt(*editor_, 0) - 1.03) < 0.002);
  }

  void theRotationHandleTurns() {
    editor_->setLimit(cloth::OrthotropicLimit{1.15, 1.05, 0}, true);
    const auto places = editor_->shape()->places();
    QCOMPARE(places.back().handle, LimitShape::rotationHandle);
    const QPoint from = handlePoint(editor_->axis(), *editor_->shape(), places.back()).toPoint();
    QTest::mousePress(editor_.get(), Qt::LeftButton, {}, from);
    QTest::mouseMove(editor_.get(), pixel(*editor_, 30 * degree, editor_->axis().outer()));
    QTest::mouseRelease(editor_.get(), Qt::LeftButton, {}, from);
    const auto limit = std::get<cloth::OrthotropicLimit>(editor_->shape()->limit());
    QVERIFY(std::abs(limit.angle - 30 * degree) < 2 * degree);
    QCOMPARE(limit.first, 1.15);
  }

  void everythingIsDrawnAndExported() {
    QTemporaryDir folder;
    editor_->setConstraints(cloth::ellipseConstraints(editor_->shape()->limit(), 12));
    editor_->setMeasured({{0.5, 1.1, 1.08, 1.13}});
    const QImage without = editor_->grab().toImage();
    editor_->setReached(Eigen::VectorXd::Constant(90, 1.03), "the worst triangle");
    QVERIFY(editor_->grab().toImage() != without);
    for (const char* type : {"png", "svg", "pdf", "csv"}) {
      const QString name = folder.filePath(QStringLiteral("limit.") + type);
      editor_->exportTo(name);
      QVERIFY(QFileInfo(name).size() > 500);
    }
    QCOMPARE(QImage(folder.filePath("limit.png")).size(), editor_->size() * 2);
    QFile csv(folder.filePath("limit.csv"));
    QVERIFY(csv.open(QIODevice::ReadOnly));
    const QList<QByteArray> lines = csv.readAll().trimmed().split('\n');
    QCOMPARE(lines.size(), 91);
    QCOMPARE(lines[0], QByteArray("angle [deg],limit,enforced,reached"));
    const QList<QByteArray> first = lines[1].split(',');
    QVERIFY(std::abs(first[1].toDouble() - 1.05) < 1e-12 && first[2].toDouble() >= 1.05 && first[3].toDouble() == 1.03);
    QVERIFY_EXCEPTION_THROWN(editor_->exportTo(folder.filePath("limit.txt")), base::InputError);
    QVERIFY_EXCEPTION_THROWN(editor_->exportTo("/nonexistent/limit.png"), base::InputError);
  }

  void withoutALimitItSaysWhatToDo() {
    editor_->setEmptyText("Add a limit.");
    editor_->setLimit(std::nullopt);
    QVERIFY(!editor_->shape());
    QSignalSpy edited(editor_.get(), &PolarEditor::edited);
    QTest::mouseClick(editor_.get(), Qt::LeftButton, {}, {160, 160});
    QTest::keyClick(editor_.get(), Qt::Key_Delete);
    QCOMPARE(edited.count(), 0);
    editor_->takePreset(plots::limitPresets()[1]);
    QCOMPARE(edited.count(), 1);
    QVERIFY(editor_->shape());
  }

 private:
  std::unique_ptr<PolarEditor> editor_;
};

QTEST_MAIN(TestPolarEditor)
#include "test_polar_editor.moc"
