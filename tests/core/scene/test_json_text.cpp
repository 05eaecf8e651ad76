#include <QFloat16>  // comparing JSON asks about every type that Qt can compare
#include <QTemporaryDir>
#include <QTest>
#include <random>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"

using namespace pliant;
using scene::Json;

class TestJsonText : public QObject {
  Q_OBJECT

  static Json randomValue(std::mt19937& random, int depth) {
    const int kind = static_cast<int>(random() % (depth > 0 ? 6 : 4));
    if (kind == 0) return std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 80) - 60);
    if (kind == 1) return static_cast<int>(random() % 1000) - 500;
    if (kind == 2) return random() % 2 == 0;
    if (kind == 3) return std::string(random() % 60, 'a') + "\"\\\né/~";
    Json result = kind == 4 ? Json::array() : Json::object();
    for (unsigned i = 0; i < random() % 8; ++i) {
      if (kind == 4)
        result.push_back(randomValue(random, depth - 1));
      else
        result["key " + std::to_string(i)] = randomValue(random, depth - 1);
    }
    return result;
  }

 private slots:
  void whatIsFormattedIsReadBack() {
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
      const Json json = randomValue(random, 5);
      const std::string text = scene::formatJson(json);
      QCOMPARE(scene::parseJson(text), json);
      QCOMPARE(scene::formatJson(scene::parseJson(text)), text);
    }
  }

  void shortThingsStayOnOneLine() {
    const Json json{{"at", {{"nodes", {0, 1, 2}}}}, {"text", std::string(100, 'x')}};
    QCOMPARE(scene::formatJson(json),
             "{\n  \"at\": {\"nodes\": [0, 1, 2]},\n  \"text\": \"" + std::string(100, 'x') + "\"\n}\n");
  }

  void errorsSayWhere_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("location");
    QTest::addColumn<QString>("says");
    const auto row = [](const char* name, QByteArray text, const char* location, const char* says) {
      QTest::newRow(name) << text << location << says;
    };
    row("empty", "", "", "empty");
    row("blank", " \n\t ", "", "empty");
    row("cut", "{\"a\": [1, {\"b\": 2, ", "/a/1", "line 1, column 20");
    row("NaN", "{\n  \"a\": NaN}", "/a", "line 2, column 8");
    row("infinity", "{\"a\": [0, Infinity]}", "/a/1", "line 1");
    row("too large", "{\"a\": {\"b\": 1e999}}", "/a/b", "finite");
    row("twice", "{\"a\": 1, \"a\": 2}", "/a", "twice");
    row("trailing", "{} x", "", "line 1, column 4");
    row("slash in key", "{\"a/b\": x}", "/a~1b", "line 1");
    row("bytes",
        QByteArray("\x7f"
                   "ELF\0\x01\xff\xfe",
                   8),
        "", "line 1, column 1");
    row("bad UTF-8", "{\"a\": \"\xff\"}", "/a", "UTF-8");
    row("deep", QByteArray(100000, '['), QByteArray("/0").repeated(65), "nested");
  }
  void errorsSayWhere() {
    QFETCH(QByteArray, text);
    QFETCH(QString, location);
    QFETCH(QString, says);
    try {
      scene::parseJson({text.constData(), static_cast<std::size_t>(text.size())});
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QCOMPARE(QString::fromStdString(error.location()), location);
      const QString problem = QString::fromStdString(error.problem());
      QVERIFY2(problem.contains(says), qPrintable(problem));
      QVERIFY2(!problem.contains('\n') && problem.endsWith('.'), qPrintable(problem));
    }
  }

  void filesAreReplacedWhole() {
    const QTemporaryDir folder;
    const std::filesystem::path file = std::filesystem::path(folder.path().toStdString()) / "a.json";
    scene::writeTextFile(file, "one");
    scene::writeTextFile(file, "two");
    QCOMPARE(scene::readTextFile(file), std::string("two"));
    QCOMPARE(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}), 1);
    QVERIFY_EXCEPTION_THROWN(scene::readTextFile(file.parent_path()), base::InputError);
    QVERIFY_EXCEPTION_THROWN(scene::readTextFile(file.parent_path() / "b"), base::InputError);
    QVERIFY_EXCEPTION_THROWN(scene::writeTextFile(file.parent_path() / "no" / "b", ""), base::InputError);
  }
};

QTEST_GUILESS_MAIN(TestJsonText)
#include "test_json_text.moc"
