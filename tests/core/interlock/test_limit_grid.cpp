#include <QTest>
#include <cmath>
#include <numbers>

#include "core/interlock/element_families.hpp"
#include "core/interlock/limit_grid.hpp"
#include "core/math/parallel.hpp"

using namespace pliant::interlock;

namespace {

LimitGrid gridOf(const UnitCell& cell, int directions, int steps) {
  LimitGridOptions options;
  options.directions = directions;
  options.steps = steps;
  pliant::base::ExecutionContext context;
  return computeLimitGrid(CellSolver(cell), options, context);
}

std::vector<double> numbersOf(const LimitGrid& grid) {
  std::vector<double> numbers;
  for (const GridSlice& slice : grid.slices)
    numbers.insert(numbers.end(), {slice.angle, slice.wanted, slice.principal, slice.stretched.strain,
                                   slice.compressed.strain, slice.stretched.equilibrium.remaining});
  return numbers;
}

}  // namespace

class TestLimitGrid : public QObject {
  Q_OBJECT

 private slots:
  /// A ring net in tension is limited by the longer of |F e1| and |F e2|, which is then 4 (R - r) / spacing.
  void ringNetInTension() {
    const RingNet parameters;
    const double largest = 4 * (parameters.ring - parameters.wire) / parameters.spacing;
    const LimitGrid grid = gridOf(ringNet(), 4, 16);
    QVERIFY2(grid.termination == pliant::base::TerminationType::converged, grid.message.c_str());
    QCOMPARE(grid.slices.size(), std::size_t(64));
    int compared = 0;
    for (const GridSlice& slice : grid.slices) {
      QVERIFY(slice.compressed.strain < slice.stretched.strain);
      const double along = 1 + slice.principal, across = 1 + slice.stretched.strain;
      if (along < 1 || across < 1) continue;  // others may be held by compression
      const double c = std::cos(slice.angle), s = std::sin(slice.angle);
      const double longest = std::max(std::hypot(along * c, across * s), std::hypot(along * s, across * c));
      QVERIFY2(std::abs(longest / largest - 1) < 2e-5, qPrintable(QString::number(longest / largest, 'g', 9)));
      ++compared;
    }
    QVERIFY2(compared >= 12, qPrintable(QString::number(compared)));
    QVERIFY(grid.largestGap() <= 1e-4 * parameters.wire);
  }

  /// Turning a torus knot's material by 90 degrees exchanges the principal directions. Nothing of the computation knows
  /// that.
  void stretchLimitsOfATorusKnotAreFourfold() {
    const LimitGrid grid = gridOf(torusKnot(), 2, 5);
    QVERIFY2(grid.termination == pliant::base::TerminationType::converged, grid.message.c_str());
    double range = 0, difference = 0;
    for (int k = 0; k < 5; ++k) {
      const GridSlice &first = grid.slices[k], &second = grid.slices[5 + k];
      range = std::max(range, first.stretched.strain - first.compressed.strain);
      if (std::abs(first.principal - second.principal) < 1e-3)
        difference = std::max(difference, std::abs(first.stretched.strain - second.stretched.strain));
    }
    QVERIFY(range > 0.02);
    QVERIFY2(difference < 0.02 * range, qPrintable(QString::number(difference / range)));
  }

  void sameNumbersForAnyNumberOfThreads() {
    std::vector<double> first;
    for (const int threads : {1, 3}) {
      pliant::math::setThreadCount(threads);
      const auto numbers = numbersOf(gridOf(fourInOne(), 3, 3));
      if (first.empty()) first = numbers;
      QCOMPARE(numbers, first);
    }
    pliant::math::setThreadCount(0);
  }

  /// Pulled alike in both directions a ring net gives at once in both.
  void biaxialLimits() {
    const RingNet parameters;
    const double largest = 4 * (parameters.ring - parameters.wire) / parameters.spacing - 1;
    const CellSolver solver(ringNet());
    LimitOptions options;
    options.lateral = Lateral::biaxial;
    for (const double ratio : {1.0, 0.5, 0.0}) {
      options.ratio = ratio;
      const DirectionLimit limit = directionLimit(solver, 0, false, options);
      QVERIFY2(limit.equilibrium.converged(), limit.equilibrium.message.c_str());
      QVERIFY(std::abs(limit.strain - largest) < 2e-5);
      QVERIFY(std::abs(strainAlong(limit.equilibrium.state.strain, std::numbers::pi / 2) - ratio * largest) < 2e-5);
    }
  }
};

QTEST_GUILESS_MAIN(TestLimitGrid)
#include "test_limit_grid.moc"
