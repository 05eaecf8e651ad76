#include <QApplication>
#include <QFile>
#include <QFontDatabase>
#include <QTest>

#include "core/interlock/element_families.hpp"
#include "tests/screenshots/screenshot.hpp"
#include "ui/shell/theme.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::screenshots {
namespace {

/// 4-in-1 chain mail, strained, with contacts that are marked, a hand that pulls, and an overlap; nothing is computed,
/// so that the picture is the same everywhere.
QImage drawCell(double strain, bool dark) {
  shell::applyTheme(dark ? shell::Theme::dark : shell::Theme::light);
  const auto cell = std::make_shared<interlock::UnitCell>(interlock::fourInOne());
  viewport::Viewport widget;
  widget.resize(720, 480);
  widget.setCell(cell);
  interlock::CellState state = interlock::restState(*cell);
  state.strain = {strain, 0.02, 0.01};
  interlock::LiveContact contact;
  contact.b = 1;
  contact.place = {3e-3, 2e-3, 0};
  widget.showCellState(state, {contact});
  const render::CellPick corner = widget.cellView().handles()[4];
  widget.cellView().setHand(std::pair(corner.place, Eigen::Vector3d(corner.place + Eigen::Vector3d(3e-3, 2e-3, 0))));
  interlock::NearestElements overlap;
  overlap.place = {-3e-3, -2e-3, 0};
  widget.cellView().setOverlap(overlap);
  widget.setCaption(QStringLiteral("4-in-1 chain mail\nx +7.00 %   y +3.00 %   shear +2.00 %\nlocked: 1 contact"));
  widget.fit();
  widget.show();
  const QImage picture = QTest::qWaitForWindowExposed(&widget) ? widget.grabImage() : QImage();
  shell::applyTheme(shell::Theme::light);
  return picture;
}

}  // namespace

/// Pictures of interlocking materials.
class TestCellScreenshots : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    QVERIFY2(QFontDatabase::families().contains("DejaVu Sans"), "the package fonts-dejavu-core is not installed");
    QApplication::setFont(QFont("DejaVu Sans", 9));
    shell::applyTheme(shell::Theme::light);
  }

  void theCellInTheViewport() {
    constexpr int allowed = 100;
    const QString problem = compareWithBaseline(drawCell(0.05, false), "cell", allowed);
    QVERIFY2(problem.isEmpty(), qPrintable(problem));
    const QString dark = compareWithBaseline(drawCell(0.05, true), "cell_dark", allowed);
    QVERIFY2(dark.isEmpty(), qPrintable(dark));
    if (qEnvironmentVariableIntValue("PLIANT_RECORD_SCREENSHOTS")) return;
    const QString noticed = compareWithBaseline(drawCell(0.03, false), "cell", allowed);
    QVERIFY2(noticed.contains("pixels differ"), qPrintable(noticed));
    for (const char* kind : {".actual.png", ".difference.png"})
      QVERIFY(QFile::remove(QStringLiteral(PLIANT_BINARY_DIR "/screenshots/cell") + kind));
  }
};

}  // namespace pliant::screenshots

QTEST_MAIN(pliant::screenshots::TestCellScreenshots)
#include "test_cell_screenshots.moc"
