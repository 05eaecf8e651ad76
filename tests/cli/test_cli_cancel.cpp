#include <signal.h>

#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include "core/scene/json_text.hpp"
#include "core/scene/study.hpp"
#include "tests/cli/cli_process.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
namespace fs = std::filesystem;

class TestCliCancel : public QObject {
  Q_OBJECT

 private slots:
  void anInterruptedCurveIsKeptAndMarked_data() {
    QTest::addColumn<int>("signal");
    QTest::newRow("Ctrl-C") << SIGINT;
    QTest::newRow("terminate") << SIGTERM;
  }
  void anInterruptedCurveIsKeptAndMarked() {
    QFETCH(int, signal);
    const QTemporaryDir folder;
    const QString file = folder.filePath("scene.json"), out = folder.filePath("results");
    // Steps so small that the curve would take far longer than the test.
    const scene::Scene scene = test::parse(test::fullScene)
                                   .withValue("/studies/1/maximum_step", 1e-6)
                                   .withValue("/studies/1/initial_step", 1e-6)
                                   .withValue("/studies/1/maximum_points", 100000);
    scene.save(file.toStdString());
    QProcess process;
    process.setReadChannel(QProcess::StandardError);
    process.start(PLIANT_CLI, {"run", file, "--out", out, "--study", "response"});
    QVERIFY(process.waitForStarted(-1));
    QByteArray progress;
    while (!progress.contains('%') && process.waitForReadyRead(-1)) progress += process.readAllStandardError();
    QTest::qWait(300);
    QVERIFY2(process.state() == QProcess::Running, progress);
    ::kill(static_cast<pid_t>(process.processId()), signal);
    QVERIFY(process.waitForFinished(-1));
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.exitCode(), 130);
    const auto result = scene::HarmonicResult::read(scene, fs::path(out.toStdString()) / "response");
    QVERIFY(result->termination == base::TerminationType::cancelled);
    QVERIFY(!result->points.empty());
    QVERIFY(process.readAllStandardOutput().contains("cancelled"));
    QCOMPARE(std::distance(fs::directory_iterator(out.toStdString()), {}), 1);
  }
};

QTEST_GUILESS_MAIN(TestCliCancel)
#include "test_cli_cancel.moc"
