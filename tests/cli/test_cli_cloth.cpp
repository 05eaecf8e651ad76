#include <QTemporaryDir>
#include <QTest>

#include "core/scene/json_text.hpp"
#include "tests/cli/cli_process.hpp"
#include "tests/cli/small_cloth.hpp"

using namespace pliant;
using test::runCli;

/// What the command line draws of cloth.
class TestCliCloth : public QObject {
  Q_OBJECT

  const QString duffing_ = PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json";
  QTemporaryDir folder_;

  QString file(const char* name) const { return folder_.filePath(name); }

 private slots:
  void initTestCase() { scene::writeTextFile(file("cloth.json").toStdString(), test::smallClothScene); }

  void drapesStandSideBySide() {
    const QStringList drapes{
        "drapes", file("cloth.json"), file("cloth.json"), "--out", file("drapes.png"), "--size", "640x480"};
#ifdef PLIANT_HAS_RENDERER
    const auto computed = runCli(drapes);
    QVERIFY2(computed.status == 0, qPrintable(computed.errors));
    const std::string picture = scene::readTextFile(file("drapes.png").toStdString());
    QVERIFY(picture.starts_with("\x89PNG"));
    // The same from results.
    QCOMPARE(runCli({"run", file("cloth.json"), "--out", file("hung"), "--study", "drape"}).status, 0);
    const QStringList results{"--result", file("hung"), "--result", file("hung")};
    const auto read = runCli(drapes + results);
    QVERIFY2(read.status == 0, qPrintable(read.errors));
    QVERIFY(scene::readTextFile(file("drapes.png").toStdString()) == picture);
    const auto few = runCli(drapes + results.first(2));
    QCOMPARE(few.status, 2);
    QVERIFY2(few.errors.contains("each of the 2 scenes"), qPrintable(few.errors));
    const auto none = runCli({"drapes", duffing_, "--out", file("none.png")});
    QCOMPARE(none.status, 2);
    QVERIFY2(none.errors.contains("no study of the type cloth_drape"), qPrintable(none.errors));
#else
    QVERIFY(runCli(drapes).errors.contains("no renderer"));
#endif
  }
};

QTEST_GUILESS_MAIN(TestCliCloth)
#include "test_cli_cloth.moc"
