#include <QTest>
#include <cmath>

#include "ui/render/color_map.hpp"
#include "ui/render/round_numbers.hpp"

namespace pliant::render {

class TestLegend : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void numbersAreRound_data();
  void numbersAreRound();
  void viridisBrightensSteadily();
};

void TestLegend::numbersAreRound_data() {
  QTest::addColumn<double>("minimum");
  QTest::addColumn<double>("maximum");
  QTest::addColumn<QList<double>>("numbers");
  QTest::newRow("percent") << 0.0 << 0.503 << QList<double>{0, 0.2, 0.4};
  QTest::newRow("both signs") << -0.0012 << 0.0031 << QList<double>{-0.001, 0, 0.001, 0.002, 0.003};
  QTest::newRow("ends included") << 0.0 << 1.0 << QList<double>{0, 0.2, 0.4, 0.6, 0.8, 1.0};
  QTest::newRow("no span") << 3.0 << 3.0 << QList<double>{3.0};
}

void TestLegend::numbersAreRound() {
  QFETCH(double, minimum);
  QFETCH(double, maximum);
  QFETCH(QList<double>, numbers);
  const std::vector<double> found = roundNumbers(minimum, maximum, 5);
  QCOMPARE(static_cast<qsizetype>(found.size()), numbers.size());
  for (qsizetype i = 0; i < numbers.size(); ++i) QVERIFY(std::abs(found[i] - numbers[i]) <= 1e-12);
}

void TestLegend::viridisBrightensSteadily() {
  const auto lightness = [](const Color& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
  for (int i = 1; i <= 200; ++i) QVERIFY(lightness(viridis(i / 200.0)) > lightness(viridis((i - 1) / 200.0)));
  const Color first = viridis(0.0), last = viridis(1.0);
  QCOMPARE(std::lround(255 * first[0]), 0x44L);
  QCOMPARE(std::lround(255 * last[0]), 0xfdL);
  QVERIFY(viridis(-1.0) == first && viridis(2.0) == last);
}

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestLegend)
#include "test_legend.moc"
