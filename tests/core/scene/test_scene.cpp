#include <QFloat16>  // comparing JSON asks about every type that Qt can compare
#include <QTemporaryDir>
#include <QTest>
#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/scene.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;
using scene::Json;
using scene::Scene;

class TestScene : public QObject {
  Q_OBJECT

  static double number(const Scene& scene, const char* pointer) {
    return scene.normalized()[Json::json_pointer(pointer)].get<double>();
  }

 private slots:
  void convertsUnitsToSi() {
    const Scene scene = test::parse(test::fullScene);
    QCOMPARE(number(scene, "/geometry/0/length"), 0.1);
    QCOMPARE(number(scene, "/geometry/0/position/1"), 0.01);
    QCOMPARE(number(scene, "/geometry/1/points/1/0"), 0.001);
    QCOMPARE(number(scene, "/materials/0/density"), 1380.0);
    QCOMPARE(number(scene, "/materials/0/young_modulus"), 3.3e9);
    QCOMPARE(number(scene, "/springs/0/coefficients/2"), 5.0);
    QCOMPARE(number(scene, "/drives/0/harmonics/0/amplitude"), std::numbers::pi / 180);
    QCOMPARE(number(scene, "/damping/stiffness_proportional"), 5e-5);
    QCOMPARE(number(scene, "/studies/0/frequency"), 5 * std::numbers::pi);
  }

  void fillsInDefaults() {
    const Scene scene = test::parse(test::fullScene);
    QCOMPARE(number(scene, "/dimension"), 3.0);
    QCOMPARE(scene.normalized()["mass_matrix"], Json("lumped"));
    QCOMPARE(scene.normalized()["elements"][0]["material"], Json("pet"));
    QCOMPARE(number(scene, "/point_masses/0/minimum"), 0.0);
    QCOMPARE(number(scene, "/point_masses/0/maximum"), 0.01);
    QCOMPARE(number(scene, "/drives/0/harmonics/0/order"), 1.0);
    QCOMPARE(scene.normalized()["geometry"][1]["position"], Json({0.0, 0.0, 0.0}));
    QCOMPARE(number(scene, "/studies/0/harmonics"), 5.0);
    QCOMPARE(number(scene, "/studies/1/samples"), 64.0);
  }

  void vectorsFollowTheDimension() {
    const Scene scene = test::parse(R"({"schema_version": 1, "dimension": 2,
      "geometry": [{"name": "a", "type": "points", "points": [[1, 2]]}]})");
    QCOMPARE(scene.normalized()["geometry"][0]["position"], Json({0.0, 0.0}));
  }

  void keepsWhatThePersonWrote() {
    const Scene scene = test::parse(test::fullScene);
    QCOMPARE(scene.json()["geometry"][0]["length"], Json("100 mm"));
    QCOMPARE(scene.json().begin().key(), std::string("schema_version"));
    QVERIFY(!scene.json().contains("dimension"));
  }

  void anEditMakesANewScene() {
    const Scene scene = test::parse(test::fullScene);
    const Scene edited = scene.withValue("/point_masses/0/mass", "3 g");
    QCOMPARE(number(edited, "/point_masses/0/mass"), 0.003);
    QCOMPARE(number(scene, "/point_masses/0/mass"), 0.002);
    QCOMPARE(edited.json()["point_masses"][0]["mass"], Json("3 g"));
    const Scene created = test::parse(R"({"schema_version": 1})").withValue("/damping/mass_proportional", 2);
    QCOMPARE(number(created, "/damping/mass_proportional"), 2.0);
  }

  void aWrongEditChangesNothing_data() {
    QTest::addColumn<QString>("pointer");
    QTest::addColumn<QString>("value");
    QTest::newRow("negative") << "/point_masses/0/mass"
                              << "-1";
    QTest::newRow("unknown key") << "/point_masses/0/mas"
                                 << "1";
    QTest::newRow("beyond the list") << "/point_masses/7/mass"
                                     << "1";
    QTest::newRow("below a number") << "/point_masses/0/mass/0"
                                    << "1";
    QTest::newRow("no pointer") << "mass"
                                << "1";
    QTest::newRow("bad escape") << "/a~7"
                                << "1";
    QTest::newRow("everything") << ""
                                << "3";
  }
  void aWrongEditChangesNothing() {
    QFETCH(QString, pointer);
    QFETCH(QString, value);
    const Scene scene = test::parse(test::fullScene);
    const Json before = scene.json();
    QVERIFY_EXCEPTION_THROWN(
        scene.withValue(pointer.toStdString(), Json::parse(value.toStdString())), base::InputError);
    QCOMPARE(scene.json(), before);
  }

  void savesAndLoads() {
    const QTemporaryDir folder;
    const std::filesystem::path file = std::filesystem::path(folder.path().toStdString()) / "scene.json";
    const Scene scene = test::parse(test::fullScene);
    scene.save(file);
    const Scene loaded = Scene::load(file);
    QCOMPARE(loaded.json().dump(), scene.json().dump());
    QCOMPARE(loaded.normalized().dump(), scene.normalized().dump());
    QCOMPARE(loaded.directory().string(), folder.path().toStdString());
  }

  void findsTheSpecOfAValue() {
    const Scene scene = test::parse(test::fullScene);
    const base::ParameterSpec* mass = scene::specAt(scene, "/point_masses/0/mass");
    QVERIFY(mass && mass->dimension == base::dimensions::mass && mass->minimum == 0);
    const base::ParameterSpec* cubic = scene::specAt(scene, "/springs/0/coefficients/2");
    QVERIFY(cubic && base::siUnit(cubic->dimension) == "N/m^3");
    const base::ParameterSpec* angle = scene::specAt(scene, "/drives/0/harmonics/1/amplitude");
    QVERIFY(angle && angle->dimension == base::dimensions::angle);
    QCOMPARE(scene::specAt(scene, "/geometry/0")->key, std::string("grid"));
    QCOMPARE(scene::specAt(scene, "")->key, std::string("scene"));
    for (const char* wrong : {"/mass", "/geometry/9", "/geometry/0/points", "/title/x", "/geometry/x/name"})
      QVERIFY2(!scene::specAt(scene, wrong), wrong);
  }
};

QTEST_GUILESS_MAIN(TestScene)
#include "test_scene.moc"
