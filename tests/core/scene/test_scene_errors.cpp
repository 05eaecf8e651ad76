#include <QTest>

#include "core/base/error.hpp"
#include "core/scene/scene.hpp"
#include "tests/core/scene/scene_text.hpp"

using namespace pliant;

/// Edits of a good scene, each of which must be refused at the right place.
class TestSceneErrors : public QObject {
  Q_OBJECT

 private slots:
  void namesThePlace_data() {
    QTest::addColumn<QString>("replace");
    QTest::addColumn<QString>("by");
    QTest::addColumn<QString>("pointer");
    QTest::addColumn<QString>("says");
    const auto row = [](const char* name, const char* replace, const char* by, const char* pointer, const char* says) {
      QTest::newRow(name) << replace << by << pointer << says;
    };
    row("misspelt key", "\"thickness\"", "\"thicknes\"", "/elements/0/thicknes", "did you mean \"thickness\"?");
    row("missing key", ", \"thickness\": \"0.2 mm\"", "", "/elements/0/thickness", "missing");
    row("negative mass", "\"2 g\"", "\"-2 g\"", "/point_masses/0/mass", "at least 0 kg");
    row("negative number", "\"2 g\"", "-2e-3", "/point_masses/0/mass", "at least 0 kg");
    row("wrong unit", "\"2 g\"", "\"2 mm\"", "/point_masses/0/mass", "expected a value in kg");
    row("unknown unit", "\"2 g\"", "\"2 stone\"", "/point_masses/0/mass", "\"stone\" is not known");
    row("list for number", "\"2 g\"", "[2]", "/point_masses/0/mass", "found a list");
    row("null", "\"2 g\"", "null", "/point_masses/0/mass", "found null");
    row("NaN as text", "\"2 g\"", "\"nan g\"", "/point_masses/0/mass", "no finite number");
    row("NaN", "\"2 g\"", "NaN", "/point_masses/0/mass", "line");
    row("too large", "\"2 g\"", "1e999", "/point_masses/0/mass", "finite");
    row("mass above its bound", "\"2 g\"", "\"2 g\", \"maximum\": \"1 g\"", "/point_masses/0/mass", "bounds");
    row("bounds crossed", "\"2 g\"", "\"2 g\", \"minimum\": 1, \"maximum\": 1", "/point_masses/0/maximum", "not above");
    row("zero mass without bound", "\"2 g\"", "0", "/point_masses/0/maximum", "missing");
    row("ten million harmonics", "\"2.5 Hz\"", "\"2.5 Hz\", \"harmonics\": 10000000", "/studies/0/harmonics",
        "1 to 200");
    row("half a harmonic", "\"2.5 Hz\"", "\"2.5 Hz\", \"harmonics\": 2.5", "/studies/0/harmonics", "whole number");
    row("too few samples", "\"2.5 Hz\"", "\"2.5 Hz\", \"samples\": 10", "/studies/0/samples", "at least 11");
    row("zero frequency", "\"2.5 Hz\"", "0", "/studies/0/frequency", "greater than 0 rad/s");
    row("empty range", "\"to\": 14", "\"to\": 8", "/studies/1/to", "another frequency");
    row("vector too short", "[0, 0, -9.81]", "[0, -9.81]", "/loads/0/acceleration", "list of 3");
    row("zero direction", "\"direction\": [0, 0, 2]", "\"direction\": [0, 0, 0]", "/springs/2/direction", "zero");
    row("zero axis", "\"axis\": [0, 1, 0],", "\"axis\": [0, 0, 0],", "/geometry/0/rotation/axis", "zero");
    row("unknown geometry", "\"skin\", \"type\": \"shell\", \"geometry\": \"sheet\"",
        "\"skin\", \"type\": \"shell\", \"geometry\": \"shet\"", "/elements/0/geometry", "did you mean \"sheet\"?");
    row("geometry left out", "\"skin\", \"type\": \"shell\", \"geometry\": \"sheet\",",
        "\"skin\", \"type\": \"shell\",", "/elements/0/geometry", "2 entries");
    row("unknown study", "\"study\": \"motion\"", "\"study\": \"notion\"", "/expected/0/study",
        "did you mean \"motion\"?");
    row("unknown type", "\"type\": \"shell\"", "\"type\": \"shall\"", "/elements/0/type", "\"shall\"");
    row("type left out", "\"type\": \"grounded\", ", "", "/springs/2/type", "missing");
    row("type no text", "\"type\": \"grounded\"", "\"type\": 3", "/springs/2/type", "found the number 3");
    row("name twice", "\"hooks\", \"type\"", "\"sheet\", \"type\"", "/geometry/1/name", "twice");
    row("name is a path", "\"name\": \"motion\"", "\"name\": \"../motion\"", "/studies/0/name", "letters");
    row("two selections", "\"group\": \"end\"", "\"group\": \"end\", \"nodes\": [1]", "/point_masses/0/at",
        "exactly one");
    row("no selection", ", \"group\": \"end\"", "", "/point_masses/0/at", "exactly one");
    row("empty selection", "\"group\": \"end\"", "\"nodes\": []", "/point_masses/0/at/nodes", "1 to");
    row("negative node", "\"nodes\": [3]", "\"nodes\": [-3]", "/springs/0/from/nodes/0", "from 0");
    row("two tolerances", "\"relative_tolerance\": 1e-6", "\"relative_tolerance\": 1e-6, \"tolerance\": 1",
        "/expected/0", "exactly one");
    row("pointer", "\"/frequency\"", "\"frequency\"", "/expected/0/pointer", "pointer");
    row("third spring coefficient", "\"5 N/m^3\"", "\"5 N/m\"", "/springs/0/coefficients/2", "N/m^3");
    row("dimension", "\"title\"", "\"dimension\": 4, \"title\"", "/dimension", "1 to 3");
    row("mesh on a line", "\"title\"", "\"dimension\": 1, \"title\"", "/geometry/0/position", "list of 1");
    row("choice", "\"title\"", "\"mass_matrix\": \"lump\", \"title\"", "/mass_matrix", "did you mean \"lumped\"?");
    row("not an object", "{\"name\": \"pet\", \"type\"", "3, {\"name\": \"pet\", \"type\"", "/materials/0",
        "an object");
    row("Poisson's ratio", "0.36", "0.7", "/materials/0/poisson_ratio", "-0.99 to 0.5");
    row("version", "\"schema_version\": 1", "\"schema_version\": 2", "/schema_version", "newer");
    row("cut", "\"expected\": [{", "", "", "line");
  }
  void namesThePlace() {
    QFETCH(QString, replace);
    QFETCH(QString, by);
    QFETCH(QString, pointer);
    QFETCH(QString, says);
    QString text = QString::fromStdString(test::fullScene);
    const auto place = text.indexOf(replace);
    QVERIFY(place >= 0);
    text.replace(place, replace.size(), by);
    if (replace.startsWith("\"expected")) text.truncate(place);
    try {
      test::parse(text.toStdString());
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      const QString location = pointer.isEmpty() ? QString("test.json") : "test.json: " + pointer;
      QVERIFY2(QString::fromStdString(error.location()) == location, error.what());
      QVERIFY2(QString::fromStdString(error.problem()).contains(says), error.what());
      QVERIFY2(!QString(error.what()).contains('\n'), error.what());
    }
  }

  void theSceneItselfIsGood() { test::parse(test::fullScene); }
};

QTEST_GUILESS_MAIN(TestSceneErrors)
#include "test_scene_errors.moc"
