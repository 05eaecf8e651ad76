#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/plots/custom_plot.hpp"
#include "ui/plots/response_plot.hpp"

using namespace pliant;
using document::StudyStatus;
using harmonic::PointKind;
using plots::ResponseCurve;
using plots::ResponsePlace;
using plots::ResponsePlot;

namespace {

/// The curve of a hardening Duffing oscillator x'' + 2ζx' + x + γx³ = P cos Ωt with one harmonic, which is known in
/// closed form as Ω(A): up along one side of the backbone and down along the other, with two folds.
ResponseCurve duffingCurve(int pointsASide = 120) {
  const double zeta = 0.03, gamma = 0.5, force = 0.1;
  ResponseCurve curve;
  curve.name = "mass";
  std::vector<double> down;
  const auto frequency = [&](double a, double sign) {
    const double b = 1 + 0.75 * gamma * a * a;
    const double c = b - 2 * zeta * zeta;
    const double root = c * c - (b * b - force * force / (a * a));
    return root >= 0 ? std::sqrt(c + sign * std::sqrt(root)) : NAN;
  };
  double peak = 0.1;
  for (double a = 0.1; a < 3; a += 1e-4)
    if (std::isfinite(frequency(a, -1))) peak = a;
  const double lowest = 0.12;
  for (const double sign : {-1.0, 1.0})
    for (int i = 0; i <= pointsASide; ++i) {
      const double s = sign < 0 ? double(i) / pointsASide : 1 - double(i) / pointsASide;
      const double a = lowest + (peak - lowest) * std::sin(s * std::numbers::pi / 2);
      curve.omega.push_back(frequency(a, sign));
      curve.amplitude.push_back(0.01 * a);  // metres
    }
  curve.kinds.assign(curve.omega.size(), PointKind::regular);
  for (std::size_t i = 1; i + 1 < curve.omega.size(); ++i) {
    const bool turns = (curve.omega[i] - curve.omega[i - 1]) * (curve.omega[i + 1] - curve.omega[i]) < 0;
    const bool top = curve.amplitude[i] > curve.amplitude[i - 1] && curve.amplitude[i] >= curve.amplitude[i + 1];
    if (turns) curve.kinds[i] = PointKind::fold;
    if (top) curve.kinds[i] = PointKind::peak;
  }
  return curve;
}

ResponseCurve firstPoints(const ResponseCurve& whole, int count) {
  ResponseCurve part = whole;
  part.omega.resize(count);
  part.amplitude.resize(count);
  part.kinds.resize(count);
  return part;
}

}  // namespace

class TestResponsePlot : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init();
  void emptyStateOffersTheStudy();
  void axesKeepStillWhileTheCurveGrows();
  void aClickOnTheCurveChoosesItsPoint();
  void aClickBesideTheCurveChoosesNothing();
  void theCursorSnapsAndRequestsTheFrequency();
  void statesAreNamed();
  void theFrequencyUnitChangesNoPlace();
  void aLargePredictionIsStillSeen();
  void aPredictedCurveIsDashedAndNamed();
  void theWheelZoomsAndADoubleClickShowsAll();
  void insetsStandBesideTheirPlaces();
  void leadersOfInsetsCrossNoLabels_data();
  void leadersOfInsetsCrossNoLabels();
  void themesDiffer();

 private:
  QPoint at(const ResponsePlace& place) const { return plot_->positionOf(place).toPoint(); }
  QWidget* canvas() const { return plot_->childAt(plot_->rect().center()); }
  QPoint onCanvas(const ResponsePlace& place) const { return canvas()->mapFrom(plot_.get(), at(place)); }
  /// That can be seen.
  QStringList labels(const QString& beginning) const {
    QStringList found;
    for (int i = 0; i < plot_->plot()->itemCount(); ++i)
      if (const auto* text = qobject_cast<QCPItemText*>(plot_->plot()->item(i));
          text && text->visible() && text->text().startsWith(beginning))
        found += text->text();
    return found;
  }
  void show(const ResponseCurve& curve, StudyStatus status = StudyStatus::solved, bool stale = false);

  std::unique_ptr<ResponsePlot> plot_;
};

void TestResponsePlot::init() {
  plot_ = std::make_unique<ResponsePlot>();
  plot_->resize(960, 320);
  plot_->setFrequencyRange(0.2, 2.0);
  plot_->setAmplitudeLabel("Maximum displacement of mass");
  plot_->show();
  QVERIFY(QTest::qWaitForWindowExposed(plot_.get()));
}

void TestResponsePlot::show(const ResponseCurve& curve, StudyStatus status, bool stale) {
  plot_->setCurves({curve}, 0, status, stale, {});
  QCoreApplication::processEvents();
}

void TestResponsePlot::emptyStateOffersTheStudy() {
  plot_->setEmptyState("The study response fills this plot.", "Run response");
  QSignalSpy triggered(plot_.get(), &ResponsePlot::emptyActionTriggered);
  auto* button = plot_->findChild<QPushButton*>("emptyAction");
  QVERIFY(button && button->isVisible());
  QCOMPARE(button->text(), QString("Run response"));
  QTest::mouseClick(button, Qt::LeftButton);
  QCOMPARE(triggered.count(), 1);
  show(duffingCurve());
  QVERIFY(!button->isVisible());
}

void TestResponsePlot::axesKeepStillWhileTheCurveGrows() {
  const ResponseCurve whole = duffingCurve();
  const int count = static_cast<int>(whole.omega.size());
  int changes = 0;
  double top = 0;
  double right = -1;
  for (int i = 1; i <= count; ++i) {
    show(firstPoints(whole, i), i < count ? StudyStatus::running : StudyStatus::solved);
    QVERIFY(plot_->largestAmplitudeShown() >= top);  // it never shrinks under the eye
    if (plot_->largestAmplitudeShown() > top) ++changes;
    top = plot_->largestAmplitudeShown();
    if (right < 0) right = plot_->largestFrequencyShown();
    QCOMPARE(plot_->largestFrequencyShown(), right);
  }
  QCOMPARE(plot_->pointCount(), count);
  QVERIFY2(changes <= 9, qPrintable(QString::number(changes)));  // the amplitude grew tenfold
  const double largest = *std::max_element(whole.amplitude.begin(), whole.amplitude.end());
  QVERIFY(top > largest && top < 3 * largest);
}

void TestResponsePlot::aClickOnTheCurveChoosesItsPoint() {
  const ResponseCurve curve = duffingCurve();
  show(curve);
  QSignalSpy chosen(plot_.get(), &ResponsePlot::pointChosen);
  for (const int index : {10, 110, 150}) {
    QTest::mouseClick(canvas(), Qt::LeftButton, {}, onCanvas({curve.omega[index], curve.amplitude[index]}));
    QCOMPARE(chosen.count(), 1);
    const int found = chosen.takeFirst()[0].toInt();
    // Points may lie closer together than pixels.
    const QPoint apart =
        at({curve.omega[found], curve.amplitude[found]}) - at({curve.omega[index], curve.amplitude[index]});
    QVERIFY(apart.manhattanLength() <= 2);
  }
}

void TestResponsePlot::aClickBesideTheCurveChoosesNothing() {
  show(duffingCurve());
  QSignalSpy chosen(plot_.get(), &ResponsePlot::pointChosen);
  QTest::mouseClick(canvas(), Qt::LeftButton, {}, onCanvas({0.5, plot_->largestAmplitudeShown() * 0.9}));
  QCOMPARE(chosen.count(), 0);
}

void TestResponsePlot::theCursorSnapsAndRequestsTheFrequency() {
  const ResponseCurve curve = duffingCurve(20);  // sparse: there is room between the points
  show(curve);
  plot_->setShownMotion(ResponsePlace{curve.omega[15], curve.amplitude[15]});
  QSignalSpy chosen(plot_.get(), &ResponsePlot::pointChosen);
  QSignalSpy requested(plot_.get(), &ResponsePlot::frequencyRequested);
  connect(plot_.get(), &ResponsePlot::pointChosen, plot_.get(), [&](int i) {
    plot_->setShownMotion(ResponsePlace{curve.omega[i], curve.amplitude[i]});
  });
  const QPoint start = onCanvas({curve.omega[15], 0.5 * curve.amplitude[15]});
  const double target = 0.6 * curve.omega[1] + 0.4 * curve.omega[2];
  const QPoint end = onCanvas({target, curve.amplitude[1]});
  QVERIFY(start.x() - end.x() > 100);
  QTest::mousePress(canvas(), Qt::LeftButton, {}, start);
  for (int i = 1; i <= 10; ++i) QTest::mouseMove(canvas(), start + (end - start) * i / 10);
  QTest::mouseRelease(canvas(), Qt::LeftButton, {}, end);
  QVERIFY(chosen.count() >= 2);
  QCOMPARE(chosen.last()[0].toInt(), 1);
  QCOMPARE(requested.count(), 1);
  QCOMPARE(requested[0][1].toInt(), 1);
  const double pixel = (curve.omega[15] - target) / (start.x() - end.x());
  QVERIFY(std::abs(requested[0][0].toDouble() - target) < 2 * pixel);
}

void TestResponsePlot::statesAreNamed() {
  const ResponseCurve curve = duffingCurve();
  show(curve);
  QCOMPARE(plot_->statusText(), QString());
  const QImage solved = plot_->grab().toImage();
  show(curve, StudyStatus::stale, true);
  QVERIFY(plot_->statusText().contains("Stale"));
  QVERIFY(plot_->grab().toImage() != solved);
  show(firstPoints(curve, 100), StudyStatus::cancelled);
  QVERIFY(plot_->statusText().contains("Cancelled"));
  show(firstPoints(curve, 100), StudyStatus::failed);
  QVERIFY(plot_->statusText().contains("Stopped"));
  show(firstPoints(curve, 100), StudyStatus::running);
  QVERIFY(plot_->statusText().contains("Tracing"));
  QSignalSpy update(plot_.get(), &ResponsePlot::updateRequested);
  show(curve, StudyStatus::stale, true);
  QTest::mouseClick(plot_->findChild<QPushButton*>("chip"), Qt::LeftButton);
  QCOMPARE(update.count(), 1);
}

void TestResponsePlot::theFrequencyUnitChangesNoPlace() {
  const ResponseCurve curve = duffingCurve();
  show(curve);
  const QPointF before = plot_->positionOf({curve.omega[50], curve.amplitude[50]});
  plot_->setHertz(true);
  const QPointF after = plot_->positionOf({curve.omega[50], curve.amplitude[50]});
  QVERIFY((before - after).manhattanLength() < 1e-6);
}

void TestResponsePlot::aLargePredictionIsStillSeen() {
  const ResponseCurve curve = duffingCurve();
  show(curve);
  plot_->setShownMotion(ResponsePlace{curve.omega[60], curve.amplitude[60]});
  plot_->setPrediction(ResponsePlace{curve.omega[60], 5 * plot_->largestAmplitudeShown()});
  QVERIFY(plot_->largestAmplitudeShown() > plot_->prediction()->amplitude);
  QVERIFY(plot_->rect().contains(at(*plot_->prediction())));
}

/// Over the solved one, with its peak said; far away it does not shrink what is solved.
void TestResponsePlot::aPredictedCurveIsDashedAndNamed() {
  const ResponseCurve curve = duffingCurve();
  show(curve);
  QCoreApplication::processEvents();
  const QImage without = canvas()->grab().toImage();
  const double top = plot_->largestAmplitudeShown();
  plots::PredictedResponse predicted{curve, {}};
  for (double& omega : predicted.curve.omega) omega *= 0.8;
  const auto highest = std::max_element(curve.amplitude.begin(), curve.amplitude.end());
  predicted.peaks = {{predicted.curve.omega[static_cast<std::size_t>(highest - curve.amplitude.begin())], *highest}};
  plot_->setPredictedCurve(predicted);
  QCOMPARE(plot_->largestAmplitudeShown(), top);
  QTRY_COMPARE(labels("predicted peak").size(), 1);
  QVERIFY(plot_->rect().contains(at(predicted.peaks[0])));
  QTRY_VERIFY(canvas()->grab().toImage() != without);
  // Without a peak the dashes are named at their highest point.
  predicted.peaks.clear();
  plot_->setPredictedCurve(predicted);
  QTRY_COMPARE(labels("predicted"), QStringList("predicted"));
  for (double& amplitude : predicted.curve.amplitude) amplitude *= 100;
  plot_->setPredictedCurve(predicted);
  QVERIFY(plot_->largestAmplitudeShown() > 1.5 * top && plot_->largestAmplitudeShown() < 4 * top);
  plot_->setPredictedCurve(std::nullopt);
  QTRY_COMPARE(labels("predicted").size(), 0);
  plot_->fit();
  QTRY_COMPARE(canvas()->grab().toImage(), without);
}

void TestResponsePlot::theWheelZoomsAndADoubleClickShowsAll() {
  show(duffingCurve());
  const double all = plot_->largestFrequencyShown();
  const QPoint middle = canvas()->rect().center();
  QWheelEvent wheel(
      middle, canvas()->mapToGlobal(middle), {}, {0, 240}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(canvas(), &wheel);
  QVERIFY(plot_->largestFrequencyShown() < all);
  QTest::mouseDClick(canvas(), Qt::LeftButton, {}, middle);
  QCOMPARE(plot_->largestFrequencyShown(), all);
}

/// As many as there is room for, and none of a place that is not shown.
void TestResponsePlot::insetsStandBesideTheirPlaces() {
  const ResponseCurve curve = duffingCurve();
  show(curve);
  QCOMPARE(plot_->visibleInsets(), 0);
  const ResponsePlace peak{1.2, 0.009}, beyond{9.0, 0.009};
  QImage image(90, 60, QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::red);
  plot_->setInsets({{peak, image}, {peak, image}, {beyond, image}});
  QCoreApplication::processEvents();
  const QImage picture = plot_->grab().toImage();
  QCOMPARE(plot_->visibleInsets(), 2);
  int red = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) red += picture.pixelColor(x, y) == QColor(Qt::red);
  QVERIFY2(red > 2 * 85 * 55, qPrintable(QString::number(red)));
  plot_->setInsets({});
  QCOMPARE(plot_->visibleInsets(), 0);
}

void TestResponsePlot::leadersOfInsetsCrossNoLabels_data() {
  QTest::addColumn<double>("omega");
  for (const double omega : {0.85, 0.95, 1.05, 1.15, 1.25}) QTest::addRow("%g", omega) << omega;
}

/// Two peaks side by side, whose labels stand in each other's way, and an inset at each.
void TestResponsePlot::leadersOfInsetsCrossNoLabels() {
  QFETCH(double, omega);
  ResponseCurve curve = duffingCurve();
  curve.kinds.assign(curve.omega.size(), PointKind::regular);
  std::vector<ResponsePlace> places;
  const auto mark = [&](double at, PointKind kind) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < curve.omega.size() / 2; ++i)
      if (std::abs(curve.omega[i] - at) < std::abs(curve.omega[nearest] - at)) nearest = i;
    curve.kinds[nearest] = kind;
    if (kind == PointKind::peak) places.push_back({curve.omega[nearest], curve.amplitude[nearest]});
  };
  mark(omega, PointKind::peak);
  for (const double step : {0.01, 0.03, 0.06}) mark(omega + step, PointKind::fold);
  mark(omega + 0.1, PointKind::peak);
  show(curve);
  QImage image(90, 60, QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::red);
  std::vector<plots::ResponseInset> insets;
  for (const ResponsePlace& place : places) insets.push_back({place, image});
  plot_->setInsets(insets);
  QCoreApplication::processEvents();
  plot_->grab();
  QCOMPARE(plot_->visibleInsets(), static_cast<int>(places.size()));
  auto* plot = plot_->findChild<QCustomPlot*>();
  QVERIFY(plot);
  int labels = 0, leaders = 0;
  for (int i = 0; i < plot->itemCount(); ++i) {
    const auto* label = qobject_cast<QCPItemText*>(plot->item(i));
    if (!label || !label->visible() || label->text().isEmpty()) continue;
    ++labels;
    const QRectF text(label->topLeft->pixelPosition(), label->bottomRight->pixelPosition());
    for (int j = 0; j < plot->itemCount(); ++j) {
      const auto* leader = qobject_cast<QCPItemLine*>(plot->item(j));
      if (!leader || !leader->visible()) continue;
      ++leaders;
      const QPointF from = leader->start->pixelPosition(), to = leader->end->pixelPosition();
      for (int step = 0; step <= 1000; ++step)
        QVERIFY2(!text.contains(from + step / 1000.0 * (to - from)), qPrintable(label->text()));
    }
  }
  QVERIFY(labels >= 2);
  QCOMPARE(leaders, labels * static_cast<int>(places.size()));
}

void TestResponsePlot::themesDiffer() {
  const ResponseCurve curve = duffingCurve();
  show(curve);
  plot_->setShownMotion(ResponsePlace{curve.omega[60], curve.amplitude[60]});
  plot_->setPrediction(ResponsePlace{curve.omega[60], 1.3 * curve.amplitude[60]});
  QCoreApplication::processEvents();
  const QImage light = plot_->grab().toImage();
  QPalette dark;
  dark.setColor(QPalette::Base, QColor(30, 32, 36));
  dark.setColor(QPalette::Text, Qt::white);
  plot_->setPalette(dark);
  QCoreApplication::processEvents();
  const QImage night = plot_->grab().toImage();
  QVERIFY(qGray(light.pixel(4, 4)) > 200);
  QVERIFY(qGray(night.pixel(4, 4)) < 60);
  if (qEnvironmentVariableIsSet("PLIANT_PICTURES")) {
    light.save(qEnvironmentVariable("PLIANT_PICTURES") + "/plot_light.png");
    night.save(qEnvironmentVariable("PLIANT_PICTURES") + "/plot_dark.png");
  }
}

QTEST_MAIN(TestResponsePlot)
#include "test_response_plot.moc"
