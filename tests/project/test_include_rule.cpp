#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QIODevice>
#include <QLibraryInfo>
#include <QMap>
#include <QRegularExpression>
#include <QTest>

namespace {

/// A folder may include itself and the folders above it, except that the three areas stand side by side.
const QStringList folders = {"core/base",     "core/math",  "core/geometry",  "core/mechanics", "core/solvers",
                             "core/harmonic", "core/cloth", "core/interlock", "core/scene",     "ui/document",
                             "ui/jobs",       "ui/render",  "ui/viewport",    "ui/plots",       "ui/panels",
                             "ui/shell",      "app/cli",    "app/gui"};
const QStringList areas = {"core/harmonic", "core/cloth", "core/interlock"};
/// What these include of `ui` and `app`; both stay free of Qt Widgets, so that pliant-cli needs no window system.
const QMap<QString, QStringList> restricted = {{"app/cli", {"app/cli", "ui/render"}}, {"ui/render", {"ui/render"}}};

QString folderOf(const QString& path) { return path.section('/', 0, 1); }

bool isQtWidgetsHeader(const QString& header) {
  return header.startsWith("QtWidgets") ||
         QFile::exists(QLibraryInfo::path(QLibraryInfo::HeadersPath) + "/QtWidgets/" + header);
}

/// Why `file` must not have `#include "header"`; empty if it may.
QString problemWithOwn(const QString& file, const QString& header) {
  const QString from = folderOf(file);
  const QString to = folderOf(header);
  if (header.startsWith("ui_") || header.endsWith(".moc") || header.startsWith("moc_")) return {};
  if (!folders.contains(to)) return "is not a path from the root of the repository to a known folder";
  if (from == to) return {};
  if (areas.contains(from) && areas.contains(to)) return "is another area; what two areas share goes down";
  if (restricted.contains(from) && !to.startsWith("core/") && !restricted[from].contains(to))
    return "is not among what this folder may include";
  if (folders.indexOf(to) > folders.indexOf(from)) return "stands below this folder in the include rule";
  if (from.startsWith("app/") && to.startsWith("app/")) return "is another program";
  return {};
}

/// Why `file` must not have `#include <header>`; empty if it may.
QString problemWithSystem(const QString& file, const QString& header) {
  static const QRegularExpression qt("^Q[A-Z]|^Qt[A-Z]|^q[a-z]+\\.h$");
  if (file.startsWith("core/") && (qt.match(header).hasMatch() || header.startsWith("vtk")))
    return "is Qt or VTK, which core does not know";
  if (restricted.contains(folderOf(file)) && isQtWidgetsHeader(header)) return "is Qt Widgets";
  return {};
}

QStringList violations(const QString& file, const QString& text) {
  static const QRegularExpression include(
      R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])", QRegularExpression::MultilineOption);
  QStringList found;
  for (auto each = include.globalMatch(text); each.hasNext();) {
    const auto match = each.next();
    const QString header = match.captured(2);
    const QString problem = match.captured(1) == "\"" ? problemWithOwn(file, header) : problemWithSystem(file, header);
    if (!problem.isEmpty()) found += QString("%1 includes %2, which %3").arg(file, header, problem);
  }
  return found;
}

/// Paths from the root of the repository of the C++ files in `places`, with their texts.
QMap<QString, QString> sources(const QStringList& places) {
  QMap<QString, QString> texts;
  const QDir root(PLIANT_SOURCE_DIR);
  for (const QString& place : places) {
    QDirIterator each(root.filePath(place), {"*.cpp", "*.hpp"}, QDir::Files, QDirIterator::Subdirectories);
    while (each.hasNext()) {
      QFile file(each.next());
      if (file.open(QIODevice::ReadOnly)) texts[root.relativeFilePath(file.fileName())] = file.readAll();
    }
  }
  return texts;
}

}  // namespace

class TestIncludeRule : public QObject {
  Q_OBJECT

 private slots:
  void plantedIncludes_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("line");
    QTest::addColumn<bool>("allowed");
    const auto row = [](const char* file, const char* line, bool allowed) {
      QTest::addRow("%s: %s", file, line) << file << line << allowed;
    };
    row("core/math/a.cpp", "#include \"core/math/b.hpp\"", true);
    row("core/math/a.cpp", "#include \"core/base/error.hpp\"", true);
    row("core/base/a.cpp", "#include \"core/math/b.hpp\"", false);
    row("core/base/a.cpp", "  #  include \"core/math/b.hpp\"", false);
    row("core/solvers/a.cpp", "#include \"core/harmonic/b.hpp\"", false);
    row("core/cloth/a.cpp", "#include \"core/harmonic/b.hpp\"", false);
    row("core/harmonic/a.cpp", "#include \"core/interlock/b.hpp\"", false);
    row("core/scene/a.cpp", "#include \"core/cloth/b.hpp\"", true);
    row("core/scene/a.cpp", "#include \"ui/document/b.hpp\"", false);
    row("core/scene/a.cpp", "#include <QString>", false);
    row("core/scene/a.cpp", "#include <QtCore/QString>", false);
    row("core/scene/a.cpp", "#include <vtkSmartPointer.h>", false);
    row("core/scene/a.cpp", "#include <queue>", true);
    row("core/scene/a.cpp", "#include \"error.hpp\"", false);
    row("ui/jobs/a.cpp", "#include \"core/scene/study.hpp\"", true);
    row("ui/jobs/a.cpp", "#include \"ui/document/b.hpp\"", true);
    row("ui/jobs/a.cpp", "#include \"ui/panels/b.hpp\"", false);
    row("ui/shell/a.cpp", "#include \"app/gui/b.hpp\"", false);
    row("ui/render/a.cpp", "#include \"ui/document/b.hpp\"", false);
    row("ui/render/a.cpp", "#include <QWidget>", false);
    row("ui/render/a.cpp", "#include <QImage>", true);
    row("app/gui/a.cpp", "#include \"ui/shell/b.hpp\"", true);
    row("app/gui/a.cpp", "#include \"app/cli/b.hpp\"", false);
    row("app/cli/a.cpp", "#include \"ui/render/b.hpp\"", true);
    row("app/cli/a.cpp", "#include \"ui/shell/b.hpp\"", false);
    row("app/cli/a.cpp", "#include <QApplication>", false);
    row("app/cli/a.cpp", "#include <QtWidgets/QWidget>", false);
  }

  void plantedIncludes() {
    QFETCH(QString, file);
    QFETCH(QString, line);
    QFETCH(bool, allowed);
    QCOMPARE(violations(file, "#pragma once\n" + line + "\nint x;\n").isEmpty(), allowed);
  }

  void everyIncludeIsAllowed() {
    const auto texts = sources({"core", "ui", "app"});
    QVERIFY(texts.size() > 30);
    QStringList found;
    for (auto each = texts.begin(); each != texts.end(); ++each) found += violations(each.key(), each.value());
    QVERIFY2(found.isEmpty(), qPrintable(found.join('\n')));
  }

  void noFileIsLong() {
    const auto texts = sources({"core", "ui", "app", "tests"});
    QStringList found;
    for (auto each = texts.begin(); each != texts.end(); ++each) {
      const auto lines = each.value().count('\n');
      if (lines > 600) found += QString("%1 has %2 lines; split it, 600 are the most").arg(each.key()).arg(lines);
    }
    QVERIFY2(found.isEmpty(), qPrintable(found.join('\n')));
  }
};

QTEST_GUILESS_MAIN(TestIncludeRule)
#include "test_include_rule.moc"
