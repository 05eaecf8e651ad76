#include <QTemporaryDir>
#include <QTest>
#include <random>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "tests/cli/cli_process.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using scene::Json;
namespace fs = std::filesystem;

/// Whatever the program is given, it ends with status 2 and one line that names the file and the place in it.
class TestCliBadInput : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

  static QByteArray edited(const char* replace, const char* by) {
    QByteArray text = QByteArray::fromStdString(test::fullScene);
    const auto place = text.indexOf(replace);
    if (place < 0) qFatal("not found: %s", replace);
    return text.replace(place, static_cast<int>(qstrlen(replace)), by);
  }

  static QByteArray withMesh(const char* path) {
    const QByteArray geometry = QByteArray("\"type\": \"file\", \"path\": \"") + path + "\"";
    return edited("\"type\": \"points\", \"points\": [[0, 0, 0.3], [\"1 mm\", 0, 0.4]]", geometry);
  }

 private slots:
  void initTestCase() {
    const auto write = [&](const char* name, const std::string& text) {
      scene::writeTextFile(folder_.filePath(name).toStdString(), text);
    };
    write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    write("empty.stl", "solid nothing\nendsolid nothing\n");
    write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 4\nf 1 2 3\n");
    write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
    write("book.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
    write("garbage.stl", std::string("\x7f"
                                     "ELF\0\1\2\3",
                                     8));
    write("cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nver");
    write("empty.ply", "");
    fs::create_directory(folder_.filePath("folder.stl").toStdString());
  }

  void saysWhere_data() {
    QTest::addColumn<QByteArray>("scene");
    QTest::addColumn<QString>("pointer");
    const auto row = [](const char* name, QByteArray scene, const char* pointer) {
      QTest::newRow(name) << scene << pointer;
    };
    const QByteArray full = QByteArray::fromStdString(test::fullScene);
    row("empty", "", "");
    row("cut in half", full.left(full.indexOf("\"wall\"")), "/springs/1/name");
    row("binary",
        QByteArray("\x7f"
                   "ELF\0\1\2\3\xff\xfe",
                   10),
        "");
    row("no scene", "[1, 2, 3]", "");
    row("misspelt key", edited("\"thickness\"", "\"thicknes\""), "/elements/0/thicknes");
    row("negative mass", edited("\"2 g\"", "\"-2 g\""), "/point_masses/0/mass");
    row("NaN", edited("\"2 g\"", "NaN"), "/point_masses/0/mass");
    row("1e999", edited("\"2 g\"", "1e999"), "/point_masses/0/mass");
    row("1e999 g", edited("\"2 g\"", "\"1e999 g\""), "/point_masses/0/mass");
    row("wrong unit", edited("\"2 g\"", "\"2 mm\""), "/point_masses/0/mass");
    row("harmonics", edited("\"2.5 Hz\"", "\"2.5 Hz\", \"harmonics\": 10000000"), "/studies/0/harmonics");
    row("harmonics for this model",
        edited("\"2.5 Hz\"", "\"2.5 Hz\", \"harmonics\": 200, \"samples\": 401")
            .replace("\"length_cells\": 4", "\"length_cells\": 400"),
        "/studies/0/harmonics");
    row("unknown node", edited("\"nodes\": [3]", "\"nodes\": [99]"), "/springs/0/from/nodes/0");
    row("selection outside", edited("\"group\": \"end\"", "\"box\": {\"minimum\": [5, 5, 5], \"maximum\": [6, 6, 6]}"),
        "/point_masses/0/at/box");
    row("mesh of no triangles", edited("\"points\", \"points\"", "\"mesh\", \"triangles\": [], \"points\""),
        "/geometry/1");
    row("degenerate triangle", edited("\"points\", \"points\"", "\"mesh\", \"triangles\": [[0, 1, 0]], \"points\""),
        "/geometry/1");
    row("missing file", withMesh("nowhere.stl"), "/geometry/1/path");
    for (const char* name : {"points.obj", "empty.stl", "line.obj", "nan.obj", "book.obj", "garbage.stl", "cut.stl",
                             "empty.ply", "folder.stl", "nowhere.docx", ""})
      QTest::addRow("mesh <%s>", name) << withMesh(name) << "/geometry/1/path";
  }
  void saysWhere() {
    QFETCH(QByteArray, scene);
    QFETCH(QString, pointer);
    const QString file = folder_.filePath("scene.json");
    scene::writeTextFile(file.toStdString(), {scene.constData(), static_cast<std::size_t>(scene.size())});
    for (const QStringList& arguments :
         {QStringList{"validate", file}, QStringList{"run", file, "--out", folder_.filePath("results")}}) {
      const auto outcome = test::runCli(arguments);
      QVERIFY2(
          outcome.status == 2, qPrintable(QString::number(outcome.status) + ": " + outcome.output + outcome.errors));
      QVERIFY2(outcome.errors.count('\n') == 1, qPrintable(outcome.errors));
      const QString start = pointer.isEmpty() ? file + ": " : file + ": " + pointer + ": ";
      QVERIFY2(outcome.errors.startsWith(start), qPrintable(outcome.errors));
    }
    QVERIFY(!fs::exists(folder_.filePath("results/motion").toStdString()));
  }

  void filesThatAreNone() {
    for (const QString& path : {folder_.filePath("nowhere.json"), folder_.path()}) {
      const auto outcome = test::runCli({"validate", path});
      QCOMPARE(outcome.status, 2);
      QVERIFY2(outcome.errors.startsWith(path + ": ") && outcome.errors.count('\n') == 1, qPrintable(outcome.errors));
    }
  }

  /// Values of a good scene deleted or replaced at random: each result is either a model or an InputError.
  void randomEditsEitherLoadOrAreRefused() {
    const std::vector<Json> replacements{nullptr,
                                         true,
                                         0,
                                         -1,
                                         1e300,
                                         -2.5,
                                         7,
                                         "",
                                         "3 kg",
                                         "x",
                                         "2 mm",
                                         Json::array(),
                                         Json::object(),
                                         {1, 2, 3},
                                         {{"nodes", {0}}},
                                         {0.0, 0.0, 0.0}};
    std::vector<std::string> pointers;
    const Json original = Json::parse(test::fullScene);
    const Json flat = original.flatten();
    for (const auto& [pointer, value] : flat.items())
      for (Json::json_pointer p(pointer); !p.empty(); p.pop_back()) pointers.push_back(p.to_string());
    std::mt19937 random(2024);
    int loaded = 0, refused = 0;
    for (int i = 0; i < 2000; ++i) {
      Json json = original;
      for (unsigned edits = 1 + random() % 2; edits > 0; --edits) {
        const Json::json_pointer place(pointers[random() % pointers.size()]);
        if (!json.contains(place)) continue;
        if (random() % 3 > 0)
          json[place] = replacements[random() % replacements.size()];
        else if (json[place.parent_pointer()].is_object())
          json[place.parent_pointer()].erase(place.back());
        else
          json[place.parent_pointer()].erase(std::stoul(place.back()));
      }
      try {
        scene::buildModel(test::parse(json.dump()));
        ++loaded;
      } catch (const base::InputError& error) {
        ++refused;
        QVERIFY2(!error.problem().empty() && error.location().starts_with("test.json"), error.what());
        QVERIFY2(!QString(error.what()).contains('\n'), error.what());
      }
    }
    QVERIFY(loaded > 20);
    QVERIFY(refused > 500);
  }

  /// Bytes of the text changed at random.
  void randomBytesEitherLoadOrAreRefused() {
    std::mt19937 random(7);
    int refused = 0;
    for (int i = 0; i < 2000; ++i) {
      std::string text = test::fullScene;
      for (unsigned edits = 1 + random() % 4; edits > 0; --edits)
        text[random() % text.size()] = static_cast<char>(random() % 256);
      try {
        scene::buildModel(test::parse(text));
      } catch (const base::InputError& error) {
        ++refused;
        QVERIFY2(!QString(error.what()).contains('\n'), error.what());
      }
    }
    QVERIFY(refused > 500);
  }
};

QTEST_GUILESS_MAIN(TestCliBadInput)
#include "test_cli_bad_input.moc"
