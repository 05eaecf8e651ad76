#include <QTest>
#include <algorithm>

#include "core/scene/plate_layers.hpp"

using pliant::scene::assignLayers;
using pliant::scene::LayerRules;

namespace {

LayerRules rules(int plates, const std::vector<std::array<int, 2>>& apart, std::vector<LayerRules::Pin> pins = {}) {
  LayerRules result;
  result.apart.assign(plates, std::vector<char>(plates, 0));
  for (const auto& [a, b] : apart) result.apart[a][b] = result.apart[b][a] = 1;
  result.pins = std::move(pins);
  return result;
}

int countOf(const std::vector<int>& layers) { return *std::max_element(layers.begin(), layers.end()) + 1; }

}  // namespace

class TestPlateLayers : public QObject {
  Q_OBJECT

 private slots:
  /// The least number of colours of a path, an odd ring and a complete graph.
  void fewestLayers() {
    QCOMPARE(countOf(*assignLayers(rules(3, {}))), 1);
    const auto path = *assignLayers(rules(4, {{0, 1}, {1, 2}, {2, 3}}));
    QCOMPARE(countOf(path), 2);
    for (int i = 0; i < 3; ++i) QVERIFY(path[i] != path[i + 1]);
    QCOMPARE(countOf(*assignLayers(rules(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}))), 3);
    QCOMPARE(countOf(*assignLayers(rules(4, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}))), 4);
  }

  /// Three plates that all meet, 0 and 1 joined by a pin that 2 must not be pierced by.
  void pinsAreKeptClear() {
    const auto layers = *assignLayers(rules(3, {{0, 1}, {1, 2}, {0, 2}}, {{{0, 1}, {2}}}));
    QCOMPARE(countOf(layers), 3);
    QVERIFY(layers[2] != 1);
  }

  /// Each in the way of the pin through the other two: one of three must lie between.
  void impossiblePins() {
    const std::vector<LayerRules::Pin> pins{{{0, 1}, {2}}, {{1, 2}, {0}}, {{0, 2}, {1}}};
    QVERIFY(!assignLayers(rules(3, {{0, 1}, {1, 2}, {0, 2}}, pins)));
  }
};

QTEST_GUILESS_MAIN(TestPlateLayers)
#include "test_plate_layers.moc"
