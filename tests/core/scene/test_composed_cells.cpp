#include <Eigen/Geometry>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/interlock/element_families.hpp"
#include "core/scene/interlock_builder.hpp"
#include "core/scene/interlock_result.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/study.hpp"

using namespace pliant;
using scene::Json;

namespace {

/// Flat circles joined by upright ellipses of half axes 3.6 mm (along the plane) and 2.8 mm.
constexpr const char* netText = R"({
  "schema_version": 1,
  "interlocking_cells": [{
    "name": "net", "type": "composed",
    "lattice": [["12 mm", 0], [0, "12 mm"]],
    "shapes": [
      {"name": "ring", "pieces": [{"type": "circle", "ring_radius": "4 mm", "radius": "0.6 mm"}]},
      {"name": "link", "pieces": [{"type": "ellipse", "first": ["3.6 mm", 0, 0], "second": [0, 0, "2.8 mm"],
                                   "radius": "0.5 mm"}]}
    ],
    "elements": [
      {"shape": "ring"},
      {"shape": "link", "position": ["6 mm", 0, 0]},
      {"shape": "link", "position": [0, "6 mm", 0], "rotation": {"angle": "90 deg"}}
    ],
    "links": [
      {"a": 0, "b": 1, "number": -1}, {"a": 0, "b": 1, "shift": [-1, 0], "number": 1},
      {"a": 0, "b": 2, "number": -1}, {"a": 0, "b": 2, "shift": [0, -1], "number": 1}
    ]
  }],
  "studies": [{"name": "x", "type": "cell_test"}, {"name": "y", "type": "cell_test", "direction": "90 deg"}]
})";

scene::Scene parsed(const std::string& text) { return scene::Scene::parse(text, ".", "net.json"); }

Json summaryOf(const std::string& text, const std::string& study) {
  const scene::Scene scene = parsed(text);
  base::ExecutionContext context;
  return scene::StudyRegistry::instance().make(scene, scene::buildModel(scene), study)->run(context)->summary();
}

/// A scene of one cell, whose pieces may be anything.
interlock::UnitCell cellOf(const Json& cell) {
  const Json text = {{"schema_version", 1}, {"interlocking_cells", Json::array({cell})}};
  return scene::buildCell(parsed(text.dump()), cell["name"]);
}

Json vectorOf(const Eigen::Vector3d& vector) { return {vector[0], vector[1], vector[2]}; }

/// What a scene file has to say for a cell of curves, each as a series.
Json composedFrom(const interlock::UnitCell& cell) {
  Json shapes = Json::array(), elements = Json::array(), links = Json::array();
  for (const interlock::ElementShape& shape : cell.shapes) {
    Json pieces = Json::array();
    for (const interlock::DilatedPiece& piece : shape.pieces) {
      const auto& curve = std::get<interlock::ClosedCurve>(piece.core);
      Json terms = Json::array();
      for (const auto& [order, cosine, sine] : curve.harmonics())
        terms.push_back({{"order", order}, {"cosine", vectorOf(cosine)}, {"sine", vectorOf(sine)}});
      pieces.push_back(
          {{"type", "series"}, {"center", vectorOf(curve.centre())}, {"terms", terms}, {"radius", piece.radius}});
    }
    shapes.push_back({{"name", shape.name}, {"pieces", pieces}});
  }
  for (const interlock::InterlockingElement& element : cell.elements) {
    const Eigen::AngleAxisd turn(element.rotation);
    elements.push_back({{"shape", cell.shapes[element.shape].name},
                        {"position", vectorOf(element.position)},
                        {"rotation", {{"axis", vectorOf(turn.axis())}, {"angle", turn.angle()}}}});
  }
  for (const interlock::Link& link : cell.links)
    links.push_back({{"a", link.a},
                     {"piece_a", link.pieceA},
                     {"b", link.b},
                     {"piece_b", link.pieceB},
                     {"shift", link.shift},
                     {"number", link.number}});
  const Eigen::Matrix2d& lattice = cell.lattice;
  return {{"name", "cell"},
          {"type", "composed"},
          {"lattice", {{lattice(0, 0), lattice(1, 0)}, {lattice(0, 1), lattice(1, 1)}}},
          {"shapes", shapes},
          {"elements", elements},
          {"links", links}};
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t place = text.find(what);
  if (place == std::string::npos) qFatal("nothing to replace");
  return text.replace(place, what.size(), with);
}

}  // namespace

class TestComposedCells : public QObject {
  Q_OBJECT

 private slots:
  /// Taut, the inner rims of a circle and of the ellipses on its sides touch at their vertices.
  void limitOfCirclesAndEllipses() {
    const double taut = 2 * (4 - 0.6) + 2 * (3.6 - 0.5);
    for (const char* study : {"x", "y"}) {
      const Json summary = summaryOf(netText, study);
      QCOMPARE(summary["rest"].get<std::string>(), std::string("locked"));
      QVERIFY2(std::abs(summary["strain"].get<double>() - (taut / 12 - 1)) < 2e-5,
               qPrintable(QString::number(summary["strain"].get<double>(), 'g', 9)));
    }
  }

  /// Families written out as series are the families.
  void familiesAsSeries() {
    for (const interlock::UnitCell& family :
         {interlock::fourInOne(), interlock::threefold(), interlock::torusKnot(), interlock::squareRosette()}) {
      const interlock::UnitCell cell = cellOf(composedFrom(family));
      QCOMPARE(cell.elements.size(), family.elements.size());
      QVERIFY(cell.lattice == family.lattice);
      for (std::size_t i = 0; i < cell.elements.size(); ++i) {
        QVERIFY(cell.elements[i].position == family.elements[i].position);
        QVERIFY((cell.elements[i].rotation - family.elements[i].rotation).norm() < 1e-14);
      }
      for (std::size_t s = 0; s < cell.shapes.size(); ++s)
        for (std::size_t p = 0; p < cell.shapes[s].pieces.size(); ++p) {
          const auto &made = cell.shapes[s].pieces[p], &wanted = family.shapes[s].pieces[p];
          QCOMPARE(made.radius, wanted.radius);
          for (double t = 0; t < 6.3; t += 0.37)
            QVERIFY((std::get<interlock::ClosedCurve>(made.core).placeAt(t) -
                     std::get<interlock::ClosedCurve>(wanted.core).placeAt(t))
                        .norm() < 1e-17);
        }
    }
  }

  /// A torus curve that is turned and moved, against its formula.
  void torusCurve() {
    Json cell = composedFrom(interlock::torusKnot());
    cell["links"] = Json::array();
    cell["lattice"] = {{"40 mm", 0}, {0, "40 mm"}};
    cell["shapes"][0]["pieces"][0] = {{"type", "torus_curve"},
                                      {"p", 3},
                                      {"q", 4},
                                      {"a", "4.4 mm"},
                                      {"b", "2.2 mm"},
                                      {"c", "3.5 mm"},
                                      {"radius", "0.6 mm"},
                                      {"center", {"1 mm", "2 mm", "3 mm"}},
                                      {"rotation", {{"axis", {2, 0, 0}}, {"angle", "90 deg"}}}};
    const auto made = cellOf(cell);
    const auto& curve = std::get<interlock::ClosedCurve>(made.shapes[0].pieces[0].core);
    for (double t = 0; t < 6.3; t += 0.41) {
      const double across = 4.4e-3 + 2.2e-3 * std::cos(4 * t), up = 3.5e-3 * std::sin(4 * t);
      const Eigen::Vector3d expected(1e-3 + across * std::cos(3 * t), 2e-3 - up, 3e-3 + across * std::sin(3 * t));
      QVERIFY((curve.placeAt(t) - expected).norm() < 1e-16);
    }
  }

  /// Diamonds of rods, 8 mm by 4 mm, flat and upright in turn: closed chains that hold each other with their tips.
  void chainsOfRods() {
    const auto chain = [](bool upright) {
      const auto corner = [&](double x, double across) { return upright ? Json{x, 0, across} : Json{x, across, 0}; };
      return Json{{"type", "simplices"},
                  {"corners", {corner(-4e-3, 0), corner(0, -2e-3), corner(4e-3, 0), corner(0, 2e-3)}},
                  {"segments", {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
                  {"closed", true},
                  {"radius", "0.5 mm"}};
    };
    const Json shapes = Json::array({{{"name", "flat"}, {"pieces", Json::array({chain(false)})}},
                                     {{"name", "upright"}, {"pieces", Json::array({chain(true)})}}});
    const Json upright = {{"shape", "upright"}, {"position", {"4.8 mm", 0, 0}}};
    const Json elements = Json::array({{{"shape", "flat"}}, upright});
    const Json links = Json::array({{{"a", 0}, {"b", 1}, {"number", -1}}, {{"a", 0}, {"b", 1}, {"shift", {-1, 0}}}});
    const Json cell = {{"name", "rods"},   {"type", "composed"},   {"lattice", {{"9.6 mm", 0}, {0, "10 mm"}}},
                       {"shapes", shapes}, {"elements", elements}, {"links", links}};
    const Json text = {{"schema_version", 1},
                       {"interlocking_cells", Json::array({cell})},
                       {"studies", Json::array({{{"name", "x"}, {"type", "cell_test"}, {"lateral", "held"}}})}};
    // Tips that overlap by g have the points (-4s, 2s, 0) and (4t - g, 0, 2t) on their rods: these are g/3 from one
    // another at least, at s = t = g/9. Taut, that is the wires' thickness, and neighbours are 8 mm - g apart.
    const Json summary = summaryOf(text.dump(), "x");
    const double strain = summary["strain"], exact = 2 * (8 - 3.0) / 9.6 - 1;
    QVERIFY2(strain < exact && exact - strain < 1.1 * summary["remaining"].get<double>(),
             qPrintable(QString::number(strain, 'g', 9)));
    QVERIFY(exact - strain < 5e-5);
  }

  void badInput_data() {
    QTest::addColumn<QString>("what");
    QTest::addColumn<QString>("with");
    QTest::addColumn<QString>("error");
    const auto row = [](const char* what, const char* with, const char* error) {
      QTest::addRow("%s", error) << what << with << error;
    };
    row("\"radius\": \"0.5 mm\"", "\"radius\": \"2.5 mm\"",
        "net.json: /interlocking_cells/0: Element 1 and element 2 moved by (0, -1) lattice vectors overlap by");
    row("\"radius\": \"0.5 mm\"", "\"radius\": 0", "/interlocking_cells/0/shapes/1/pieces/0/radius: ");
    row("{\"shape\": \"ring\"}", "{\"shape\": \"rung\"}",
        "/interlocking_cells/0/elements/0/shape: There is no shape named \"rung\" in this cell.");
    row("\"angle\": \"90 deg\"", "\"angle\": \"90 deg\", \"axis\": [0, 0, 0]",
        "/interlocking_cells/0/elements/2/rotation/axis: A direction must not be zero.");
    row("[0, \"12 mm\"]", "[\"12 mm\", 0]", "/interlocking_cells/0: The lattice vectors are parallel");
    row("{\"a\": 0, \"b\": 1, \"number\": -1}, ", "", "linked -1 times at rest, but this is not declared");
    row("\"b\": 1, \"number\": -1", "\"b\": 1, \"number\": 1", "linked -1 times at rest, but declared are 1");
    row("\"b\": 1, \"number\": -1", "\"b\": 3, \"number\": 1", "A link names element 3, but the cell has 3");
    row("\"first\": [\"3.6 mm\", 0, 0]", "\"first\": [0, 0, 0]", "/interlocking_cells/0/shapes/1: Piece 0 of element");
    row("\"type\": \"ellipse\", \"first\": [\"3.6 mm\", 0, 0], \"second\": [0, 0, \"2.8 mm\"]",
        "\"type\": \"simplices\", \"corners\": [[0, 0, 0], [0.001, 0, 0], [0.001, 0, 0.001]], \"segments\": [[0, 1], "
        "[1, 2]], \"closed\": true",
        "its chain is open at corner 0");
    row("\"type\": \"ellipse\", \"first\": [\"3.6 mm\", 0, 0], \"second\": [0, 0, \"2.8 mm\"]",
        "\"type\": \"simplices\", \"corners\": [[0, 0, 0], [0.001, 0, 0], [0.002, 0, 0]], \"triangles\": [[0, 1, 2]]",
        "has a triangle of no area");
    row("\"type\": \"ellipse\", \"first\": [\"3.6 mm\", 0, 0], \"second\": [0, 0, \"2.8 mm\"]",
        "\"type\": \"simplices\", \"corners\": [[0, 0, 0]], \"points\": [1]", "names corner 1, but has 1 corners");
  }

  void badInput() {
    QFETCH(QString, what);
    QFETCH(QString, with);
    QFETCH(QString, error);
    QString found;
    try {
      scene::buildCell(parsed(replaced(netText, what.toStdString(), with.toStdString())), "net");
    } catch (const base::InputError& thrown) {
      found = thrown.what();
    }
    QVERIFY2(found.contains(error), qPrintable(found));
    QVERIFY(!found.contains('\n'));
  }
};

QTEST_GUILESS_MAIN(TestComposedCells)
#include "test_composed_cells.moc"
