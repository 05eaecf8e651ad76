#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include "core/scene/json_text.hpp"
#include "tests/cli/cli_process.hpp"

using namespace pliant;
namespace fs = std::filesystem;

namespace {

constexpr const char* netText = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "net", "type": "ring_net"}],
  "studies": [
    {"name": "stretch", "type": "cell_test"},
    {"name": "boundary", "type": "stretch_boundary", "subdivisions": 0}
  ]
})";

class Folder {
 public:
  Folder() { scene::writeTextFile(fs::path(scene().toStdString()), netText); }
  QString scene() const { return folder_.filePath("net.json"); }
  QString path(const char* name) const { return folder_.filePath(name); }
  std::string read(const char* name) const { return scene::readTextFile(fs::path(path(name).toStdString())); }
  test::CliOutcome shard(const char* which, const char* study = "boundary") const {
    return test::runCli({"run", scene(), "--out", path("out"), "--study", study, "--shard", which});
  }
  test::CliOutcome merge(const QStringList& more = {}) const {
    return test::runCli(QStringList{"merge", scene(), "--out", path("out")} + more);
  }

 private:
  QTemporaryDir folder_;
};

}  // namespace

class TestCliShards : public QObject {
  Q_OBJECT

 private slots:
  /// What shards compute together is what one process computes, to the last bit.
  void shardsGiveTheSameResult() {
    const Folder folder;
    for (const char* which : {"2/3", "3/3", "1/3"}) {
      const auto outcome = folder.shard(which);
      QVERIFY2(outcome.status == 0, qPrintable(outcome.errors));
    }
    const auto merged = folder.merge();
    QVERIFY2(merged.status == 0, qPrintable(merged.errors));
    QVERIFY(merged.output.contains("boundary: converged"));
    QCOMPARE(test::runCli({"run", folder.scene(), "--out", folder.path("whole"), "--study", "boundary"}).status, 0);
    for (const char* file : {"boundary.csv", "boundary.ply"}) {
      const std::string name = file;
      const std::string ours = folder.read(("out/boundary/" + name).c_str());
      QVERIFY(ours.size() > 300);
      QVERIFY(ours == folder.read(("whole/boundary/" + name).c_str()));
    }
    QVERIFY(!fs::exists(fs::path(folder.path("out/stretch").toStdString())));
  }

  void shardsThatAreNotThere() {
    const Folder folder;
    auto outcome = folder.merge();
    QCOMPARE(outcome.status, 2);
    QVERIFY2(outcome.errors.contains("There are no shards of this scene"), qPrintable(outcome.errors));
    QCOMPARE(folder.shard("1/2").status, 0);
    outcome = folder.merge();
    QCOMPARE(outcome.status, 2);
    QVERIFY2(outcome.errors.contains("Shard 2 of 2 is missing"), qPrintable(outcome.errors));
    QCOMPARE(folder.shard("2/3").status, 0);
    outcome = folder.merge();
    QCOMPARE(outcome.status, 2);
    QVERIFY2(outcome.errors.contains("shards of 2 and of 3"), qPrintable(outcome.errors));
  }

  /// A shard that was killed is missed, and goes on where it was.
  void unfinishedShards() {
    const Folder folder;
    QCOMPARE(folder.shard("1/2").status, 0);
    QCOMPARE(folder.shard("2/2").status, 0);
    const char* file = "out/boundary.shards/2_of_2.states";
    const std::string whole = folder.read(file);
    scene::writeTextFile(fs::path(folder.path(file).toStdString()), whole.substr(0, whole.size() / 2));
    auto outcome = folder.merge();
    QCOMPARE(outcome.status, 2);
    QVERIFY2(outcome.errors.contains("2_of_2.states") && outcome.errors.contains("not finished"),
             qPrintable(outcome.errors));
    QCOMPARE(folder.shard("2/2").status, 0);
    QVERIFY(folder.merge().status == 0);
  }

  void shardsOfAnotherScene() {
    const Folder folder;
    for (const char* which : {"1/2", "2/2"}) QCOMPARE(folder.shard(which).status, 0);
    const auto outcome = folder.merge({"--set", "/interlocking_cells/0/wire_radius=\"0.5 mm\""});
    QCOMPARE(outcome.status, 2);
    QVERIFY2(outcome.errors.contains("not of the scene and study as they are now"), qPrintable(outcome.errors));
  }

  void badInput_data() {
    QTest::addColumn<QString>("shard");
    QTest::addColumn<QString>("study");
    QTest::addColumn<QString>("sentence");
    for (const char* text : {"0/3", "4/3", "1", "1/", "/3", "1/3x", "a/b", "1/999999999"})
      QTest::newRow(text) << text << "boundary"
                          << "Expected a number and the count of shards, such as 3/8.";
    QTest::newRow("study") << "1/2"
                           << "stretch"
                           << "A cell_test cannot be split into shards";
  }
  void badInput() {
    QFETCH(QString, shard);
    QFETCH(QString, study);
    QFETCH(QString, sentence);
    const Folder folder;
    const auto outcome = folder.shard(qPrintable(shard), qPrintable(study));
    QCOMPARE(outcome.status, 2);
    QVERIFY2(outcome.errors.contains(sentence), qPrintable(outcome.errors));
    QVERIFY(!fs::exists(fs::path(folder.path("out").toStdString())));
  }
};

QTEST_GUILESS_MAIN(TestCliShards)
#include "test_cli_shards.moc"
