#include <QSignalSpy>
#include <QTest>

#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/value_field.hpp"

using namespace pliant::panels;

class TestParameterSlider : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    slider_ = std::make_unique<ParameterSlider>();
    slider_->resize(240, 24);
    slider_->setBounds(1, 3);
    slider_->setRealValue(2);
    slider_->setReference(2);
    slider_->show();
    QVERIFY(QTest::qWaitForWindowExposed(slider_.get()));
  }

  void draggingTellsEachPlaceAndCommitsOnce() {
    QSignalSpy dragged(slider_.get(), &ParameterSlider::dragged);
    QSignalSpy committed(slider_.get(), &ParameterSlider::committed);
    const QPoint start = slider_->handlePosition();
    QTest::mousePress(slider_.get(), Qt::LeftButton, {}, start);
    QCOMPARE(dragged.count(), 0);  // seized, not moved
    for (int i = 1; i <= 5; ++i) QTest::mouseMove(slider_.get(), start + QPoint(8 * i, 0));
    QCOMPARE(committed.count(), 0);
    QTest::mouseRelease(slider_.get(), Qt::LeftButton, {}, start + QPoint(40, 0));
    QVERIFY(dragged.count() >= 5);
    QCOMPARE(committed.count(), 1);
    const double expected = 2 + 2.0 * 40 / (240 - 16);  // the handle travels the width less its own
    QVERIFY(std::abs(committed[0][0].toDouble() - expected) < 0.02);
    QCOMPARE(committed[0][1].toBool(), false);
  }

  /// Full within the trusted range, fainter beyond it, and as ever where nothing is known.
  void theTrackFadesWhereItCannotBeTrusted() {
    const auto contrastAt = [&](double value) {
      const QImage picture = slider_->grab().toImage();
      const double x = 8 + (value - 1) / 2 * (240 - 16);
      const QColor track = picture.pixelColor(static_cast<int>(x), 12),
                   beside = picture.pixelColor(static_cast<int>(x), 2);
      return std::abs(track.lightness() - beside.lightness());
    };
    const int known = contrastAt(2.9);
    QVERIFY(known > 10);
    slider_->setTrusted(1.9, 2.2);
    QCOMPARE(slider_->trustAt(2.1), 1.0);
    QVERIFY(slider_->trustAt(2.25) < 1 && slider_->trustAt(2.25) > slider_->trustAt(2.3));
    QCOMPARE(slider_->trustAt(2.9), 0.0);
    QVERIFY(std::abs(contrastAt(2.15) - known) <= 2);
    QVERIFY(contrastAt(2.9) < known / 2);
    slider_->clearTrusted();
    QCOMPARE(contrastAt(2.9), known);
    QCOMPARE(slider_->trustAt(2.9), 1.0);
  }

  void anArrowShowsWhereItWouldGo() {
    const QImage before = slider_->grab().toImage();
    slider_->setPlannedStep(0.2);
    const QImage planned = slider_->grab().toImage();
    int left = 0, right = 0;
    for (int x = 0; x < 240; ++x)
      for (int y = 0; y < 24; ++y)
        if (before.pixel(x, y) != planned.pixel(x, y)) ++(x < 120 ? left : right);
    QVERIFY(right > 20);
    QCOMPARE(left, 0);
    slider_->setPlannedStep(0);
    QVERIFY(slider_->grab().toImage() == before);
  }

  void draggingEndsAtTheBounds() {
    QSignalSpy committed(slider_.get(), &ParameterSlider::committed);
    QTest::mousePress(slider_.get(), Qt::LeftButton, {}, slider_->handlePosition());
    QTest::mouseMove(slider_.get(), QPoint(900, 12));
    QTest::mouseRelease(slider_.get(), Qt::LeftButton, {}, QPoint(900, 12));
    QCOMPARE(committed[0][0].toDouble(), 3.0);
  }

  void escapeTakesADragBack() {
    QSignalSpy committed(slider_.get(), &ParameterSlider::committed);
    QSignalSpy cancelled(slider_.get(), &ParameterSlider::dragCancelled);
    QTest::mousePress(slider_.get(), Qt::LeftButton, {}, slider_->handlePosition());
    QTest::mouseMove(slider_.get(), QPoint(200, 12));
    QTest::keyClick(slider_.get(), Qt::Key_Escape);
    QTest::mouseRelease(slider_.get(), Qt::LeftButton, {}, QPoint(200, 12));
    QCOMPARE(cancelled.count(), 1);
    QCOMPARE(committed.count(), 0);
    QCOMPARE(slider_->realValue(), 2.0);
  }

  void arrowKeysNudgeAndShiftIsFiner() {
    QSignalSpy committed(slider_.get(), &ParameterSlider::committed);
    QTest::keyClick(slider_.get(), Qt::Key_Right);
    QCOMPARE(slider_->realValue(), 2.02);
    QTest::keyClick(slider_.get(), Qt::Key_Left, Qt::ShiftModifier);
    QCOMPARE(slider_->realValue(), 2.018);
    QTest::keyClick(slider_.get(), Qt::Key_End);
    QCOMPARE(slider_->realValue(), 3.0);
    QCOMPARE(committed.count(), 3);
    QVERIFY(committed[0][1].toBool());
  }

  void aFieldIsALabelUntilItIsDoubleClicked() {
    ValueField field;
    field.setTexts("12.40 g", "12.400001 g");
    field.show();
    QSignalSpy typed(&field, &ValueField::typed);
    QVERIFY(field.isReadOnly());
    QTest::mouseDClick(&field, Qt::LeftButton, {}, field.rect().center());
    QVERIFY(!field.isReadOnly());
    QCOMPARE(field.text(), QString("12.400001 g"));
    QTest::keyClick(&field, Qt::Key_Escape);
    QVERIFY(field.isReadOnly());
    QCOMPARE(field.text(), QString("12.40 g"));
    QTest::mouseDClick(&field, Qt::LeftButton, {}, field.rect().center());
    QTest::keyClicks(&field, "15 g");
    QTest::keyClick(&field, Qt::Key_Return);
    QCOMPARE(typed.count(), 1);
    QCOMPARE(typed[0][0].toString(), QString("15 g"));
  }

 private:
  std::unique_ptr<ParameterSlider> slider_;
};

QTEST_MAIN(TestParameterSlider)
#include "test_parameter_slider.moc"
