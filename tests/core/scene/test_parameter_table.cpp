#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/parameter_table.hpp"

using namespace pliant;

namespace {

std::shared_ptr<const mechanics::Model> model(const char* more) {
  const std::string text = std::string(R"({"schema_version": 1, "dimension": 1,
      "geometry": [{"name": "g", "type": "points", "points": [[0], [1]]}], "springs": [{"name": "s", "type": "grounded",
      "at": {"nodes": [0, 1]}, "direction": [1], "coefficients": ["2 N/m"]}])") +
                           more + "}";
  return scene::buildModel(scene::Scene::parse(text, ".", "scene.json"));
}

}  // namespace

class TestParameterTable : public QObject {
  Q_OBJECT

 private slots:
  void rows() {
    const auto made = model(R"(, "point_masses": [{"name": "both ends", "at": {"nodes": [0, 1]}, "mass": "2 g",
      "minimum": "1 g", "maximum": "5 g"}],
      "parameters": [{"name": "stiffness", "pointer": "/springs/0/coefficients/0", "minimum": 1, "maximum": 3}])");
    scene::PartsRequest request;
    const std::string text = parameterTable(*made, request);
    QVERIFY(
        text.starts_with("name,pointer,value,unit,minimum,maximum,pieces,ball diameter [mm],cylinder diameter "
                         "[mm],cylinder height [mm]\n"));
    const auto rows = scene::readCsv(text);
    QCOMPARE(rows.size(), std::size_t(2));
    QCOMPARE(rows[0][0], std::string_view("both ends"));
    QCOMPARE(rows[0][1], std::string_view("/point_masses/0/mass"));
    QCOMPARE(rows[0][2], std::string_view("0.002"));
    QCOMPARE(rows[0][3], std::string_view("kg"));
    QCOMPARE(rows[0][6], std::string_view("2"));
    // Each weighs 2 g: volume times density.
    const double ball = 1e-3 * scene::csvNumber(rows[0][7]), across = 1e-3 * scene::csvNumber(rows[0][8]);
    QVERIFY(std::abs(std::numbers::pi / 6 * ball * ball * ball * 8500 - 2e-3) < 1e-15);
    QVERIFY(std::abs(std::numbers::pi / 4 * across * across * 0.01 * 8500 - 2e-3) < 1e-15);
    QCOMPARE(scene::csvNumber(rows[0][9]), 10.0);
    QCOMPARE(rows[1][0], std::string_view("stiffness"));
    QCOMPARE(rows[1][3], std::string_view("N/m"));
    for (int column = 6; column < 10; ++column) QVERIFY(rows[1][column].empty());
    request.density = 1000;
    request.cylinderHeight = 0.02;
    const auto light = parameterTable(*made, request);
    const double wide = 1e-3 * scene::csvNumber(scene::readCsv(light)[0][8]);
    QVERIFY(std::abs(std::numbers::pi / 4 * wide * wide * 0.02 * 1000 - 2e-3) < 1e-15);
  }

  void nothingToWrite() {
    QVERIFY_THROWS_EXCEPTION(base::InputError, scene::writeParameterTable(*model(""), {}, "/nowhere/table.csv"));
  }
};

QTEST_GUILESS_MAIN(TestParameterTable)
#include "test_parameter_table.moc"
