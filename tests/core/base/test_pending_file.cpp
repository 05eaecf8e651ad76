#include "core/base/pending_file.hpp"

#include <signal.h>
#include <sys/resource.h>

#include <QDir>
#include <QFile>
#include <QIODevice>
#include <QTemporaryDir>
#include <QTest>
#include <vector>

#include "core/base/error.hpp"

using namespace pliant;
using base::PendingFile;

class TestPendingFile : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> folder_;

  std::string place(const char* name) const { return folder_->filePath(name).toStdString(); }
  QStringList entries() const {
    return QDir(folder_->path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
  }
  QByteArray contents(const char* name) const {
    QFile file(folder_->filePath(name));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray("none");
  }
  template <class Action>
  static QString sentenceOf(const Action& action) {
    try {
      action();
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void filesAppearWhole() {
    base::writeFile(place("a"), "old");
    PendingFile file(place("a"));
    file.write("ne");
    file.write(std::string_view("w\0", 2));
    QCOMPARE(contents("a"), QByteArray("old"));
    file.commit();
    QCOMPARE(contents("a"), QByteArray("new\0", 4));
    QCOMPARE(entries(), QStringList("a"));
  }

  void whatIsNotCommittedGoes() {
    base::writeFile(place("b"), "old");
    {
      std::vector<PendingFile> files;  // which move as the vector grows
      for (const char* name : {"a", "b", "c"}) {
        files.emplace_back(place(name)).write(name);
        files.back().finish();
      }
      QCOMPARE(entries().size(), 4);
      files[2].commit();
    }
    QCOMPARE(entries(), QStringList({"b", "c"}));
    QCOMPARE(contents("b"), QByteArray("old"));
  }

  void whyItCannotBeIsSaid() {
    const QString nowhere = sentenceOf([&] { PendingFile(place("nowhere/a")); });
    QVERIFY2(nowhere.contains("nowhere/a") && nowhere.contains("No such file or directory"), qPrintable(nowhere));
    QVERIFY(QDir(folder_->path()).mkpath("folder/inner"));
    const QString folder = sentenceOf([&] { base::writeFile(place("folder"), "text"); });
    QVERIFY2(folder.contains("Is a directory"), qPrintable(folder));
    QCOMPARE(entries(), QStringList("folder"));
  }

  /// As a disk that fills up would, a limit of the file's size ends writing.
  void aFullDiskIsNoticed_data() {
    QTest::addColumn<int>("bytes");
    QTest::newRow("when it is closed") << 3000;
    QTest::newRow("while it is written") << 300'000;
  }
  void aFullDiskIsNoticed() {
    QFETCH(int, bytes);
    rlimit usual{};
    QCOMPARE(::getrlimit(RLIMIT_FSIZE, &usual), 0);
    const auto usualHandler = ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, usual.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    const QString sentence =
        sentenceOf([&] { base::writeFile(place("a"), std::string(static_cast<std::size_t>(bytes), 'x')); });
    ::setrlimit(RLIMIT_FSIZE, &usual);
    ::signal(SIGXFSZ, usualHandler);
    QVERIFY2(sentence.contains("File too large"), qPrintable(sentence));
    QVERIFY(entries().isEmpty());
  }
};

QTEST_GUILESS_MAIN(TestPendingFile)
#include "test_pending_file.moc"
