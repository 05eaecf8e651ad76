#include <signal.h>

#include <QDir>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <set>

#include "core/scene/json_text.hpp"
#include "tests/cli/cli_process.hpp"
#include "tests/cli/small_cloth.hpp"
#include "tests/ui/render/decoded_video.hpp"

using namespace pliant;
using test::runCli;

/// The command line writes videos and numbered pictures.
class TestCliFilm : public QObject {
  Q_OBJECT

  const QString duffing_ = PLIANT_SOURCE_DIR "/scenes/harmonic/duffing.json";
  QTemporaryDir folder_;

  QString file(const char* name) const { return folder_.filePath(name); }
  QStringList exportOf(const char* study, const char* out, const QStringList& more = {}) const {
    return QStringList{"export", file("cloth.json"), "--result", file("hung"), "--study", study, "--out", file(out)} +
           more;
  }
  QStringList entries() const { return QDir(folder_.path()).entryList(QDir::AllEntries | QDir::Hidden); }

 private slots:
  void initTestCase() {
    scene::writeTextFile(file("cloth.json").toStdString(), test::smallClothScene);
    const auto run = runCli({"run", file("cloth.json"), "--out", file("hung")});
    QVERIFY2(run.status == 0, qPrintable(run.errors));
  }

  void aMotionBecomesAVideo() {
    const auto written = runCli(exportOf("swing", "swing.ogv", {"--size", "322x241"}));
    QVERIFY2(written.status == 0, qPrintable(written.errors));
    QVERIFY2(written.output.contains("11 pictures of 322 x 241 pixels, 100"), qPrintable(written.output));
    const test::DecodedVideo video = test::decodeVideo(file("swing.ogv").toStdString());
    QVERIFY2(video.problem.empty(), video.problem.c_str());
    QCOMPARE(video.rate.num, 100);  // frames are 10 ms apart
    QCOMPARE(video.rate.den, 1);
    QCOMPARE(video.frames.size(), std::size_t(11));
    QCOMPARE(video.frames[0].width, 322);
    QCOMPARE(video.frames[0].height, 241);
    QVERIFY(video.frames[10].differenceTo(video.frames[0]) > 0.5);
    // Resampled and slowed down: a tenth of a second is one second long.
    QCOMPARE(runCli(exportOf("swing", "slow.ogv", {"--size", "160x120", "--fps", "25", "--speed", "0.1"})).status, 0);
    const test::DecodedVideo slow = test::decodeVideo(file("slow.ogv").toStdString());
    QCOMPARE(slow.rate.num, 25);
    QCOMPARE(slow.frames.back().number, 25);
    // Of the eleven frames, shown 0.1 s each, the sixth is seen from 0.5 s on: in the picture of 0.52 s.
    const auto at = [&](int number) {
      const auto after = std::find_if(
          slow.frames.begin(), slow.frames.end(), [&](const auto& frame) { return frame.number > number; });
      return *std::prev(after);
    };
    QVERIFY(at(12).differenceTo(at(10)) < 0.2 * at(13).differenceTo(at(12)));
    // The steps of a drape.
    QCOMPARE(runCli(exportOf("drape", "drape.ogv", {"--size", "160x120"})).status, 0);
    QCOMPARE(test::decodeVideo(file("drape.ogv").toStdString()).rate.num, 5);
  }

  void aMotionBecomesNumberedPictures() {
    const auto written = runCli(exportOf("swing", "swing.png", {"--size", "160x120"}));
    QVERIFY2(written.status == 0, qPrintable(written.errors));
    const QStringList pictures = QDir(folder_.path()).entryList({"swing_*"});
    QCOMPARE(pictures.size(), 11);
    QCOMPARE(pictures.first(), "swing_00000.png");
    QCOMPARE(pictures.last(), "swing_00010.png");
    std::set<std::string> different;
    for (const QString& name : pictures) {
      const std::string bytes = scene::readTextFile(folder_.filePath(name).toStdString());
      QCOMPARE(bytes.substr(0, 24), std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\xa0\0\0\0\x78", 24));
      different.insert(bytes);
    }
    QCOMPARE(different.size(), std::size_t(11));
  }

  void aPeriodicMotionIsRepeated() {
    QCOMPARE(runCli({"run", duffing_, "--out", file("duffing")}).status, 0);
    const auto written = runCli({"export", duffing_, "--result", file("duffing"), "--out", file("duffing.ogv"),
                                 "--size", "160x120", "--periods", "2", "--fps", "10"});
    QVERIFY2(written.status == 0, qPrintable(written.errors));
    const test::DecodedVideo video = test::decodeVideo(file("duffing.ogv").toStdString());
    QCOMPARE(video.rate.num, 10);
    QCOMPARE(video.frames.size(), std::size_t(40));  // a period takes two seconds
    QVERIFY(video.frames[0].differenceTo(video.frames[10]) > 0.01);
    QVERIFY(video.frames[5].differenceTo(video.frames[25]) < 0.2 * video.frames[5].differenceTo(video.frames[15]));
  }

  void badInputIsRefused_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("words");
    const auto row = [&](const char* name, const QStringList& arguments, const char* words) {
      QTest::newRow(name) << arguments << words;
    };
    row("moment", exportOf("swing", "a.ogv", {"--time", "0.05"}), "--time");
    row("no result", {"export", file("cloth.json"), "--out", file("a.ogv")}, "--result");
    row("rate", exportOf("swing", "a.ogv", {"--fps", "0"}), "--fps");
    row("speed", exportOf("swing", "a.ogv", {"--speed", "-1"}), "--speed");
    row("size", exportOf("swing", "a.ogv", {"--size", "large"}), "--size");
    row("no size", exportOf("swing", "a.png", {"--size", "0x10"}), "0x10");
    row("folder", exportOf("swing", "nowhere/a.ogv"), "No such file or directory");
    row("too long", exportOf("swing", "a.png", {"--speed", "1e-9"}), "a million pictures");
  }
  void badInputIsRefused() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, words);
    const QStringList before = entries();
    const auto refused = runCli(arguments);
    QCOMPARE(refused.status, 2);
    QVERIFY2(refused.errors.contains(words) && refused.errors.count('\n') == 1, qPrintable(refused.errors));
    QCOMPARE(entries(), before);
  }

  /// As a disk that fills up would, a limit of the file's size ends writing half way.
  void aFullDiskIsOneSentence() {
    const QStringList before = entries();
    for (const char* name : {"full.ogv", "full.png"}) {
      QProcess shell;
      shell.start("sh", QStringList{"-c", "ulimit -f 4; trap '' XFSZ; exec \"$0\" \"$@\"", PLIANT_CLI} +
                            exportOf("swing", name));
      QVERIFY(shell.waitForFinished(-1));
      QCOMPARE(shell.exitCode(), 2);
      const QStringList lines = QString::fromUtf8(shell.readAllStandardError()).trimmed().split('\n');
      QVERIFY2(lines.last().contains("cannot be written: File too large"), qPrintable(lines.last()));
      QCOMPARE(entries(), before);
    }
  }

  void anInterruptedFilmLeavesNothing_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("video") << "long.ogv";
    QTest::newRow("pictures") << "long.png";
  }
  void anInterruptedFilmLeavesNothing() {
    QFETCH(QString, name);
    const QStringList before = entries();
    QProcess process;
    process.setReadChannel(QProcess::StandardError);
    process.start(
        PLIANT_CLI, exportOf("swing", qPrintable(name), {"--size", "160x120", "--fps", "100", "--speed", "1e-4"}));
    QVERIFY(process.waitForStarted(-1));
    QByteArray progress;
    while (!progress.contains('%') && process.waitForReadyRead(-1)) progress += process.readAllStandardError();
    QVERIFY2(process.state() == QProcess::Running, progress);
    QVERIFY(entries() != before);  // under a temporary name
    ::kill(static_cast<pid_t>(process.processId()), SIGINT);
    QVERIFY(process.waitForFinished(-1));
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.exitCode(), 130);
    QCOMPARE(entries(), before);
  }
};

QTEST_GUILESS_MAIN(TestCliFilm)
#include "test_cli_film.moc"
