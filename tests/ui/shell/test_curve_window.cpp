#include <QTest>
#include <cmath>

#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/response_panel.hpp"
#include "ui/shell/main_window.hpp"

using namespace pliant;
using shell::MainWindow;

namespace {

constexpr int patience = 60'000;  // milliseconds
const std::string mass = "/point_masses/0/mass";

}  // namespace

/// The response curve that is foretold while a slider is dragged, in the window.
class TestCurveWindow : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    window_ = std::make_unique<MainWindow>(false);
    window_->resize(1280, 800);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    QVERIFY(window_->document().open(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json")));
    window_->session().runAll();
    QTRY_VERIFY_WITH_TIMEOUT(window_->response().predictor().isComplete(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(!window_->session().isBusy(), patience);
  }
  void cleanup() { window_.reset(); }

  /// A drag bends the curve as the mouse moves; dropped, it stays until the response is solved anew, and its peak is
  /// then nearer to the new one than the old one was.
  void aDragBendsTheCurve() {
    plots::ResponsePlot& plot = *window_->response().plot();
    QVERIFY(!plot.predictedCurve());
    const double before = peak();
    panels::ParameterSlider& slider = *window_->parameters().row(mass)->slider();
    const QPoint from = slider.handlePosition(), to = from + QPoint(4, 0);
    QTest::mousePress(&slider, Qt::LeftButton, {}, from);
    QTest::mouseMove(&slider, to - QPoint(2, 0));
    QVERIFY(plot.predictedCurve());
    const plots::PredictedResponse halfway = *plot.predictedCurve();
    QTest::mouseMove(&slider, to);
    QVERIFY(plot.predictedCurve()->curve.omega != halfway.curve.omega);
    QTest::mouseRelease(&slider, Qt::LeftButton, {}, to);
    QVERIFY(window_->session().isStale());
    QVERIFY(plot.predictedCurve());
    QCOMPARE(plot.predictedCurve()->peaks.size(), std::size_t(1));
    const double predicted = plot.predictedCurve()->peaks[0].omega;

    window_->session().update();
    QTRY_VERIFY_WITH_TIMEOUT(!window_->session().isBusy() && !window_->document().study("response")->stale, patience);
    QVERIFY(!plot.predictedCurve());
    const double solved = peak();
    qInfo("peak at %.4f, predicted %.4f, solved %.4f", before, predicted, solved);
    QVERIFY(std::abs(predicted - solved) < 0.25 * std::abs(before - solved));
  }

  /// Escape takes the drag back, and the curve with it; other amplitudes than path lengths are not foretold.
  void whatIsTakenBackIsGone() {
    plots::ResponsePlot& plot = *window_->response().plot();
    panels::ParameterSlider& slider = *window_->parameters().row(mass)->slider();
    QTest::mousePress(&slider, Qt::LeftButton, {}, slider.handlePosition());
    QTest::mouseMove(&slider, slider.handlePosition() + QPoint(6, 0));
    QVERIFY(plot.predictedCurve());
    window_->session().setMeasure(jobs::AmplitudeMeasure::maximumDisplacement);
    QVERIFY(!plot.predictedCurve());
    window_->session().setMeasure(jobs::AmplitudeMeasure::pathLength);
    QVERIFY(plot.predictedCurve());
    QTest::keyClick(&slider, Qt::Key_Escape);
    QVERIFY(!plot.predictedCurve());
  }

 private:
  double peak() const {
    const auto result =
        std::dynamic_pointer_cast<const scene::HarmonicResult>(window_->document().study("response")->result);
    for (const harmonic::ResponsePoint& point : result->points)
      if (point.kind == harmonic::PointKind::peak) return point.omega;
    return NAN;
  }

  std::unique_ptr<MainWindow> window_;
};

QTEST_MAIN(TestCurveWindow)
#include "test_curve_window.moc"
