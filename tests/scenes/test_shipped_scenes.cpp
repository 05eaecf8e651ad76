#include <QtTest>
#include <algorithm>
#include <filesystem>

#include "core/scene/expected_values.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"

using namespace pliant;
namespace fs = std::filesystem;

/// Every study of every shipped scene converges to the values that the scene says it expects. Those were computed with
/// more harmonics and samples than the scene asks for, so this also bounds the error of what is shipped.
class TestShippedScenes : public QObject {
  Q_OBJECT

 private slots:
  void meetsItsExpectedValues_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("study");
    const fs::path folder = fs::path(PLIANT_SOURCE_DIR) / "scenes";
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
      for (const std::string& study : scene::studyNames(scene::Scene::load(file)))
        QTest::addRow("%s %s", file.stem().c_str(), study.c_str()) << QString::fromStdString(file.string())
                                                                   << QString::fromStdString(study);
  }
  void meetsItsExpectedValues() {
    QFETCH(QString, file);
    QFETCH(QString, study);
    const auto scene = scene::Scene::load(file.toStdString());
    base::ExecutionContext context;
    const auto result =
        scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study.toStdString())->run(context);
    QVERIFY2(result->termination == base::TerminationType::converged, result->message.c_str());
    const auto values = scene::compareWithExpected(scene, study.toStdString(), result->summary());
    QVERIFY2(!values.empty(), "A shipped scene must say what it expects of each study.");
    for (const scene::ExpectedValue& value : values)
      QVERIFY2(value.holds(), qPrintable(QString("%1 is %2, expected %3 within %4")
                                             .arg(QString::fromStdString(value.pointer))
                                             .arg(value.found, 0, 'g', 12)
                                             .arg(value.expected, 0, 'g', 12)
                                             .arg(value.tolerance)));
  }
};

QTEST_GUILESS_MAIN(TestShippedScenes)
#include "test_shipped_scenes.moc"
