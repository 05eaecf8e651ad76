#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>

#include "core/scene/format_tables.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/scene.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;

/// The documents that are made from the declaration of the format: the committed ones must be what would be made now.
class TestFormat : public QObject {
  Q_OBJECT

  const std::filesystem::path root_ = PLIANT_SOURCE_DIR;

  std::vector<std::filesystem::path> shippedScenes() const {
    std::vector<std::filesystem::path> scenes;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root_ / "scenes"))
      if (entry.path().extension() == ".json") scenes.push_back(entry.path());
    return scenes;
  }

  /// For each scene "1" if it satisfies the committed schema by Python's jsonschema, "0" if not.
  QStringList validate(const std::vector<std::filesystem::path>& scenes) const {
    const QString program =
        "import json, sys, jsonschema\n"
        "schema = json.load(open(sys.argv[1]))\n"
        "jsonschema.Draft202012Validator.check_schema(schema)\n"
        "validator = jsonschema.Draft202012Validator(schema)\n"
        "print(' '.join(str(int(validator.is_valid(json.load(open(file))))) for file in sys.argv[2:]))\n";
    QStringList arguments{
        "-c", program, QString::fromStdString((root_ / "resources/pliant-scene.schema.json").string())};
    for (const auto& scene : scenes) arguments << QString::fromStdString(scene.string());
    QProcess process;
    process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    process.start("python3", arguments);
    process.waitForFinished(-1);
    return QString::fromUtf8(process.readAllStandardOutput()).simplified().split(' ');
  }

 private slots:
  void theSchemaIsCurrent() {
    QVERIFY2(
        scene::readTextFile(root_ / "resources/pliant-scene.schema.json") == scene::formatJson(scene::jsonSchema()),
        "Run: build/bin/pliant-cli schema > resources/pliant-scene.schema.json");
  }

  void theTablesAreCurrent() {
    const std::string readme = scene::readTextFile(root_ / "scenes/README.md");
    const std::string begin = "<!-- generated: pliant-cli schema --tables -->\n", end = "<!-- end -->";
    const auto from = readme.find(begin), to = readme.find(end);
    QVERIFY(from != std::string::npos && to != std::string::npos);
    QVERIFY2(readme.substr(from + begin.size(), to - from - begin.size()) == scene::formatTables(),
             "Put the output of `build/bin/pliant-cli schema --tables` between the markers in scenes/README.md");
  }

  void theExampleInTheReadmeIsTheShippedScene() {
    const std::string readme = scene::readTextFile(root_ / "scenes/README.md");
    const auto from = readme.find("```json\n") + 8;
    const scene::Json example = scene::parseJson(readme.substr(from, readme.find("```", from) - from));
    scene::Json shipped = scene::Scene::load(root_ / "scenes/harmonic/duffing.json").json();
    shipped.erase("expected");
    QCOMPARE(example.dump(), shipped.dump());
  }

  void everySceneSatisfiesTheSchema() {
    if (QStandardPaths::findExecutable("python3").isEmpty()) QSKIP("python3 is not installed");
    const auto scenes = shippedScenes();
    QCOMPARE(validate(scenes), QStringList(static_cast<int>(scenes.size()), "1"));
  }

  void theSchemaRefusesWhatWeRefuse() {
    if (QStandardPaths::findExecutable("python3").isEmpty()) QSKIP("python3 is not installed");
    struct Edit {
      const char *replace, *by, *valid;
    };
    const std::vector<Edit> edits{{"\"2 g\"", "\"2 g\"", "1"},
                                  {"\"2 g\"", "2", "1"},
                                  {"\"2 g\"", "\"-2 g\"", "0"},
                                  {"\"2 g\"", "-2", "0"},
                                  {"\"2 g\"", "\"heavy\"", "0"},
                                  {"\"thickness\"", "\"thicknes\"", "0"},
                                  {", \"thickness\": \"0.2 mm\"", "", "0"},
                                  {"\"type\": \"shell\"", "\"type\": \"solid\"", "0"},
                                  {"\"2.5 Hz\"", "\"2.5 Hz\", \"harmonics\": 10000000", "0"},
                                  {", \"group\": \"end\"", "", "0"},
                                  {"\"group\": \"end\"", "\"group\": \"end\", \"nodes\": [1]", "0"},
                                  {"\"name\": \"motion\"", "\"name\": \"../motion\"", "0"},
                                  {"\"schema_version\": 1", "\"schema_version\": 2", "0"}};
    const QTemporaryDir folder;
    std::vector<std::filesystem::path> files;
    for (const Edit& edit : edits) {
      QString text = QString::fromStdString(test::fullScene);
      text.replace(text.indexOf(edit.replace), static_cast<int>(qstrlen(edit.replace)), edit.by);
      files.emplace_back(folder.filePath(QString::number(files.size()) + ".json").toStdString());
      scene::writeTextFile(files.back(), text.toStdString());
    }
    const QStringList found = validate(files);
    QCOMPARE(found.size(), static_cast<int>(edits.size()));
    for (std::size_t i = 0; i < edits.size(); ++i) QVERIFY2(found[static_cast<int>(i)] == edits[i].valid, edits[i].by);
  }
};

QTEST_GUILESS_MAIN(TestFormat)
#include "test_format.moc"
