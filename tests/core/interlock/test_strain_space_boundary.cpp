#include <Eigen/Geometry>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <set>

#include "core/base/error.hpp"
#include "core/interlock/boundary_file.hpp"
#include "core/interlock/element_families.hpp"
#include "core/math/parallel.hpp"

using namespace pliant::interlock;
using Eigen::Vector3d;

namespace {

StrainSpaceBoundary boundaryOf(const UnitCell& cell, const BoundaryOptions& options, BoundaryMemory* memory = nullptr,
                               pliant::base::ExecutionContext* context = nullptr) {
  pliant::base::ExecutionContext own;
  const CellSolver solver(cell);
  return computeBoundary(solver, options, context ? *context : own, memory);
}

/// All numbers of a boundary, to be compared to the last bit.
std::vector<double> numbersOf(const StrainSpaceBoundary& boundary) {
  std::vector<double> numbers(boundary.middle.data(), boundary.middle.data() + 3);
  for (std::size_t i = 0; i < boundary.states.size(); ++i) {
    const BoundaryState& state = boundary.states[i];
    numbers.insert(numbers.end(), boundary.mesh.directions[i].data(), boundary.mesh.directions[i].data() + 3);
    numbers.insert(numbers.end(), {state.distance, state.remaining, state.meanGap, double(state.iterations)});
    for (const Eigen::Matrix3d& rotation : state.cell.rotations)
      numbers.insert(numbers.end(), rotation.data(), rotation.data() + 9);
    numbers.insert(
        numbers.end(), state.cell.positions.data(), state.cell.positions.data() + state.cell.positions.size());
  }
  numbers.insert(numbers.end(), {boundary.largestError, boundary.meanError});
  return numbers;
}

/// Forgets that anything happened after a number of states, as a process that was killed.
class KilledMemory final : public BoundaryMemory {
 public:
  KilledMemory(BoundaryFile& file, int after, pliant::base::ExecutionContext& context)
      : file_(file), left_(after), context_(context) {}
  bool recall(const std::string& name, BoundaryState& state) override { return file_.recall(name, state); }
  void keep(const std::string& name, const BoundaryState& state) override {
    const int left = --left_;  // of one thread among several
    if (left >= 0) file_.keep(name, state);
    if (left <= 0) context_.requestCancel();
  }

 private:
  BoundaryFile& file_;
  std::atomic<int> left_;
  pliant::base::ExecutionContext& context_;
};

}  // namespace

class TestStrainSpaceBoundary : public QObject {
  Q_OBJECT

 private slots:
  void icospheresAreClosed() {
    for (int level = 0; level < 5; ++level) {
      const SphereMesh mesh = icosphere(level);
      const std::size_t count = 10 * (1u << (2 * level)) + 2;
      QCOMPARE(mesh.directions.size(), count);
      QCOMPARE(edgesOf(mesh).size(), 3 * (count - 2));  // Euler
      QCOMPARE(mesh.triangles.size(), 2 * (count - 2));
      double angle = 0;  // solid angles add up to the sphere: no triangle overlaps another, all face outwards
      for (const auto& [a, b, c] : mesh.triangles) {
        const Vector3d &x = mesh.directions[a], &y = mesh.directions[b], &z = mesh.directions[c];
        angle += 2 * std::atan2(x.dot(y.cross(z)), 1 + x.dot(y) + y.dot(z) + z.dot(x));
      }
      QVERIFY(std::abs(angle - 4 * M_PI) < 1e-9);
    }
  }

  /// Cutting any set of edges leaves a closed surface.
  void refinedMeshesStayClosed() {
    SphereMesh mesh = icosphere(1);
    for (int round = 0; round < 5; ++round) {
      std::vector<std::array<int, 2>> some;
      const auto edges = edgesOf(mesh);
      for (std::size_t i = 0; i < edges.size(); ++i)
        if ((i * 7 + round) % 5 < 2) some.push_back(edges[i]);
      const SphereMesh next = refined(mesh, some);
      QCOMPARE(next.directions.size(), mesh.directions.size() + some.size());
      QCOMPARE(edgesOf(next).size(), 3 * (next.directions.size() - 2));
      std::map<std::array<int, 2>, int> passes;
      for (const auto& [a, b, c] : next.triangles) ++passes[{a, b}], ++passes[{b, c}], ++passes[{c, a}];
      for (const auto& [edge, count] : passes) QVERIFY(count == 1 && passes.count({edge[1], edge[0]}) == 1);
      mesh = next;
    }
  }

  /// Where a ring net is held by tension its boundary is known: the longer of |F e1|, |F e2| is 4 (R - r) / spacing.
  void ringNetBoundary() {
    BoundaryOptions options;
    options.subdivisions = 2;
    const RingNet parameters;
    const StrainSpaceBoundary boundary = boundaryOf(ringNet(), options);
    QVERIFY2(boundary.isClosed(), boundary.message.c_str());
    QCOMPARE(boundary.states.size(), std::size_t(162));
    const double largest = 4 * (parameters.ring - parameters.wire) / parameters.spacing;
    int onFaces = 0;
    for (int i = 0; i < 162; ++i) {
      const Eigen::Matrix2d stretch = stretchOf(boundary.strainAt(i));
      const double longest = std::max(stretch.col(0).norm(), stretch.col(1).norm());
      QVERIFY(longest < largest);
      if (boundary.mesh.directions[i][0] < 0.3) continue;  // others may be held by compression
      QVERIFY2(longest > largest * (1 - 2e-5), qPrintable(QString::number(longest / largest, 'g', 9)));
      ++onFaces;
    }
    QVERIFY(onFaces > 40);
    QVERIFY(boundary.largestGap() <= 1e-4 * parameters.wire);
    QVERIFY(boundary.volume() > 0);
  }

  /// A torus knot's material is the same turned by 90 degrees, which turns (mean, a, b) into (mean, -a, -b). Nothing of
  /// the computation knows that.
  void torusKnotIsFourfold() {
    BoundaryOptions options;
    options.subdivisions = 2;
    options.perturbation = 0;
    options.useSymmetries = false;
    const StrainSpaceBoundary boundary = boundaryOf(torusKnot(), options);
    QVERIFY2(boundary.isClosed(), boundary.message.c_str());
    QVERIFY(boundary.middle.tail<2>().norm() < 1e-3);
    int compared = 0, same = 0;
    for (std::size_t i = 0; i < boundary.states.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Vector3d &d = boundary.mesh.directions[i], &e = boundary.mesh.directions[j];
        if ((d - Vector3d(e[0], -e[1], -e[2])).norm() > 1e-9) continue;
        ++compared;
        same += std::abs(boundary.states[i].distance - boundary.states[j].distance) < 1e-3 * boundary.meanDistance();
      }
    QVERIFY(compared > 60);
    QVERIFY2(same > 0.95 * compared, qPrintable(QString("%1 of %2").arg(same).arg(compared)));
  }

  /// What symmetries make is what is computed, where no way to fold is chosen: under tension.
  void symmetriesChangeNoStretchLimit() {
    BoundaryOptions options;
    options.subdivisions = 2;
    for (const UnitCell& cell : {threefold(), fourInOne()}) {
      options.useSymmetries = true;
      const StrainSpaceBoundary made = boundaryOf(cell, options);
      QVERIFY2(made.isClosed(), made.message.c_str());
      QVERIFY(made.symmetries > 1 && made.checkedRays == 12);
      const CellSolver solver(cell);
      const double reach = 2 * cell.smallestRadius();
      int compared = 0;
      for (int i = 0; i < 162; ++i) {
        const Vector3d& direction = made.mesh.directions[i];
        QVERIFY(solver.contact().smallestGap(made.states[i].cell, reach) > 0);
        QVERIFY((made.states[i].cell.strain - made.strainAt(i)).norm() < 1e-9);
        if (direction[0] < 0.6) continue;
        const CellEquilibrium own = solver.solve(made.middleState, rayDrive(direction));
        QVERIFY(own.converged());
        const double distance = direction.dot(own.state.strain - made.middle);
        QVERIFY2(std::abs(distance - made.states[i].distance) < 1e-3 * made.meanDistance(),
                 qPrintable(QString("%1: %2 %3").arg(i).arg(distance).arg(made.states[i].distance)));
        ++compared;
      }
      QVERIFY(compared > 20);
      // Chain mail folds in different ways in symmetric directions.
      QVERIFY2((made.computedRays < 162) == (made.symmetryDifference < 1e-3),
               qPrintable(QString::number(made.computedRays)));
      QCOMPARE(made.computedRays < 162, cell.name == threefold().name);
    }
  }

  void sameBytesForAnyNumberOfThreads() {
    BoundaryOptions options;
    options.subdivisions = 1;
    options.tolerance = 0.05;
    options.maximumStates = 100;
    std::vector<double> first;
    for (const int threads : {1, 2, 5}) {
      pliant::math::setThreadCount(threads);
      const auto numbers = numbersOf(boundaryOf(fourInOne(), options));
      if (first.empty()) first = numbers;
      QVERIFY(numbers == first);
    }
    pliant::math::setThreadCount(0);
  }

  /// A computation that was stopped goes on where it was, and gives the same bytes.
  void goesOnAfterAStop() {
    BoundaryOptions options;
    options.subdivisions = 2;
    const StrainSpaceBoundary whole = boundaryOf(threefold(), options);
    QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("states.txt").toStdString();
    {
      BoundaryFile memory(file, "threefold");
      pliant::base::ExecutionContext context;
      KilledMemory killed(memory, 30, context);
      const StrainSpaceBoundary part = boundaryOf(threefold(), options, &killed, &context);
      QVERIFY(part.termination == pliant::base::TerminationType::cancelled);
      QVERIFY(!part.isClosed());
    }
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 40);  // the last line was cut short
    BoundaryFile memory(file, "threefold");
    QCOMPARE(memory.recalledCount(), 29);
    const StrainSpaceBoundary rest = boundaryOf(threefold(), options, &memory);
    QVERIFY(numbersOf(rest) == numbersOf(whole));
    QCOMPARE(BoundaryFile(file, "another").recalledCount(), 0);
    QFile other(folder.filePath("other.txt"));
    QVERIFY(other.open(QIODevice::WriteOnly) && other.write("something else\n") > 0);
    other.close();
    QVERIFY_THROWS_EXCEPTION(pliant::base::InputError, BoundaryFile(folder.filePath("other.txt").toStdString(), "k"));
  }

  /// More rays bring the surface nearer to the limit, as estimated.
  void refinementFollowsItsEstimate() {
    const UnitCell cell = threefold();
    BoundaryOptions options;
    options.testStarShape = false;
    options.subdivisions = 2;
    const StrainSpaceBoundary coarse = boundaryOf(cell, options);
    options.subdivisions = 3;
    const StrainSpaceBoundary fine = boundaryOf(cell, options);
    QVERIFY(fine.meanError < 0.7 * coarse.meanError);
    // The finer rays measure the coarse surface's error.
    double sum = 0;
    for (std::size_t i = coarse.states.size(); i < fine.states.size(); ++i) {
      const auto& [a, b] = fine.mesh.parents[i];
      const double first = fine.states[a].distance, second = fine.states[b].distance;
      const double chord = 2 * first * second / (first + second) * fine.mesh.directions[a].dot(fine.mesh.directions[i]);
      sum += std::abs(fine.states[i].distance - chord);
    }
    const double measured = sum / double(fine.states.size() - coarse.states.size()) / fine.meanDistance();
    QVERIFY2(measured < 1.5 * coarse.meanError && measured > 0.3 * coarse.meanError,
             qPrintable(QString("%1 %2").arg(measured).arg(coarse.meanError)));
    options.subdivisions = 2;
    options.tolerance = 0.03;
    const StrainSpaceBoundary adaptive = boundaryOf(cell, options);
    QVERIFY(adaptive.isClosed());
    QVERIFY(adaptive.largestError <= 0.03);
    QVERIFY(adaptive.states.size() > coarse.states.size());
    QVERIFY(adaptive.states.size() < fine.states.size());  // cut where it bends alone
  }

  void greenStrainOfPrincipalStates() {
    // 10 % along the first axis, -5 % across: E = (λ² - 1)/2.
    const Vector3d green = greenStrain({0.025, 0.075, 0});
    QVERIFY((green - Vector3d(0.5 * (1.21 - 1), 0.5 * (0.95 * 0.95 - 1), 0)).norm() < 1e-15);
  }
};

QTEST_GUILESS_MAIN(TestStrainSpaceBoundary)
#include "test_strain_space_boundary.moc"
