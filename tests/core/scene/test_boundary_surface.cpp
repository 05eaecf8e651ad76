#include <Eigen/Eigenvalues>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/interlock/holding_contacts.hpp"
#include "core/scene/boundary_surface.hpp"
#include "core/scene/interlock_reading.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/polar_curves.hpp"
#include "core/scene/resumable_study.hpp"

using namespace pliant;

namespace {

constexpr const char* netText = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "net", "type": "ring_net", "ring_radius": "4 mm", "wire_radius": "0.6 mm",
                          "spacing": "12 mm"}],
  "studies": [
    {"name": "stretch", "type": "cell_test", "direction": "90 deg"},
    {"name": "travel", "type": "free_travel", "directions": 4},
    {"name": "boundary", "type": "stretch_boundary", "subdivisions": 1, "test_star_shape": false}
  ]
})";

const scene::Scene& net() {
  static const scene::Scene scene = scene::Scene::parse(netText, ".", "net.json");
  return scene;
}

std::unique_ptr<scene::Study> studyOf(const std::string& name) {
  return scene::StudyRegistry::instance().make(net(), scene::buildModel(net()), name);
}

template <class AnyResult>
std::shared_ptr<const AnyResult> resultOf(const std::string& name) {
  base::ExecutionContext context;
  return std::dynamic_pointer_cast<const AnyResult>(studyOf(name)->run(context));
}

std::shared_ptr<const scene::StretchBoundaryResult> boundary() {
  static const auto result = resultOf<scene::StretchBoundaryResult>("boundary");
  return result;
}

QString problemOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const base::InputError& error) {
    return QString::fromStdString(error.problem());
  }
  return {};
}

}  // namespace

/// Boundaries as they are looked at, while they grow, and read back.
class TestBoundarySurface : public QObject {
  Q_OBJECT

 private slots:
  void principalStretchesAreThoseOfTheMetric() {
    for (const Eigen::Vector3d& green :
         {Eigen::Vector3d(0.1, -0.05, 0.03), Eigen::Vector3d(-0.2, 0.3, -0.1), Eigen::Vector3d(0.05, 0.05, 0)}) {
      Eigen::Matrix2d metric;
      metric << 1 + 2 * green[0], 2 * green[2], 2 * green[2], 1 + 2 * green[1];
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(metric);
      const scene::PrincipalStretch stretch = scene::principalStretch(green);
      QVERIFY(std::abs(stretch.larger - std::sqrt(solver.eigenvalues()[1])) < 1e-14);
      QVERIFY(std::abs(stretch.smaller - std::sqrt(solver.eigenvalues()[0])) < 1e-14);
      const Eigen::Vector2d direction(std::cos(stretch.angle), std::sin(stretch.angle));
      QVERIFY(std::abs(direction.dot(metric * direction) - solver.eigenvalues()[1]) < 1e-14);
    }
  }

  void aSurfaceHasAllOfItsLimits() {
    const scene::BoundarySurface surface = scene::boundarySurface(*boundary(), "boundary");
    QCOMPARE(surface.points.cols(), 42);
    QCOMPARE(surface.knownCount(), 42);
    QCOMPARE(surface.triangles.size(), std::size_t(80));
    for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
      // E = (FᵀF - I) / 2 of the state itself.
      const Eigen::Matrix2d stretch =
          interlock::stretchOf(boundary()->boundary.states[static_cast<std::size_t>(i)].cell.strain);
      const Eigen::Matrix2d green = 0.5 * (stretch.transpose() * stretch - Eigen::Matrix2d::Identity());
      QVERIFY((surface.points.col(i) - Eigen::Vector3d(green(0, 0), green(1, 1), green(0, 1))).norm() < 1e-9);
    }
    QCOMPARE(surface.quantity("contacts")->values[7], double(boundary()->boundary.states[7].contacts));
    QVERIFY(surface.quantity("gap")->values.maxCoeff() < 1e-3);
    QVERIFY(!surface.quantity("nothing"));
  }

  /// What is observed only grows, and ends with the result; places not known yet lie in the middle of their parents.
  void aRunningStudyFillsInTheSurface() {
    base::ExecutionContext context;
    std::vector<std::shared_ptr<const scene::StretchBoundaryResult>> seen;
    const auto result = studyOf("boundary")->run(context, [&](std::shared_ptr<const scene::Result> partial) {
      seen.push_back(std::dynamic_pointer_cast<const scene::StretchBoundaryResult>(partial));
    });
    QVERIFY(seen.size() >= 2);
    QVERIFY(seen.back() == result);
    int before = 0, halfKnown = 0;
    for (const auto& each : seen) {
      const scene::BoundarySurface surface = scene::boundarySurface(*each, "");
      QVERIFY(surface.knownCount() >= before);
      before = surface.knownCount();
      halfKnown += before > 0 && before < 42;
      for (const auto& triangle : surface.triangles)
        for (const int corner : triangle) {
          const auto& [a, b] = each->boundary.mesh.parents[static_cast<std::size_t>(corner)];
          const auto known = [&](int i) { return surface.known[static_cast<std::size_t>(i)]; };
          if (known(corner) || !known(a) || !known(b)) continue;
          const Eigen::Vector3d middle = 0.5 * (each->boundary.strainAt(a) + each->boundary.strainAt(b));
          QVERIFY((interlock::greenStrain(middle) - surface.points.col(corner)).norm() < 1e-14);
        }
    }
    QVERIFY(halfKnown > 0);
    QCOMPARE(before, 42);
  }

  /// A cancelled study keeps what it has, and goes on from there to the same bytes.
  void aCancelledStudyGoesOn() {
    base::ExecutionContext context;
    const auto stopped = studyOf("boundary")->run(context, [&](std::shared_ptr<const scene::Result> partial) {
      const auto& known = dynamic_cast<const scene::StretchBoundaryResult&>(*partial);
      if (scene::boundarySurface(known, "").knownCount() >= 8) context.requestCancel();
    });
    QVERIFY(stopped->termination == base::TerminationType::cancelled);
    const auto half = std::dynamic_pointer_cast<const scene::StretchBoundaryResult>(stopped);
    const int kept = scene::boundarySurface(*half, "").knownCount();
    QVERIFY(kept >= 8 && kept < 42);
    const auto study = studyOf("boundary");
    dynamic_cast<scene::ResumableStudy&>(*study).goOnFrom(*half);
    base::ExecutionContext again;
    const auto result = std::dynamic_pointer_cast<const scene::StretchBoundaryResult>(study->run(again));
    QVERIFY(result->recalled >= kept);
    QVERIFY(result->table() == boundary()->table());
    // Nothing is taken from what is whole, or from other studies.
    const auto whole = boundary();
    const auto test = resultOf<scene::CellTestResult>("stretch");
    for (const scene::Result* other :
         {static_cast<const scene::Result*>(whole.get()), static_cast<const scene::Result*>(test.get())}) {
      const auto fresh = studyOf("boundary");
      dynamic_cast<scene::ResumableStudy&>(*fresh).goOnFrom(*other);
      base::ExecutionContext cancelled;
      cancelled.requestCancel();
      const auto nothing = std::dynamic_pointer_cast<const scene::StretchBoundaryResult>(fresh->run(cancelled));
      QCOMPARE(nothing->recalled, 0);
    }
  }

  void boundariesAreReadBack() {
    QTemporaryDir folder;
    const auto place = std::filesystem::path(folder.filePath("boundary").toStdString());
    boundary()->write(place);
    const scene::BoundarySurface written = scene::boundarySurface(*boundary(), "boundary");
    for (const auto& from : {place, place / "boundary.ply"}) {
      const scene::BoundarySurface read = scene::readBoundarySurface(from);
      QVERIFY((read.points - written.points).cwiseAbs().maxCoeff() < 1e-15);
      QVERIFY(read.triangles == written.triangles);
      QCOMPARE(read.name, std::string("boundary of net"));
      for (const scene::BoundaryQuantity& quantity : written.quantities)
        QVERIFY((read.quantity(quantity.key)->values - quantity.values).cwiseAbs().maxCoeff() <=
                1e-14 * quantity.values.cwiseAbs().maxCoeff());
    }
    // The surface alone.
    const auto alone = std::filesystem::path(folder.filePath("alone.ply").toStdString());
    std::filesystem::copy_file(place / "boundary.ply", alone);
    const scene::BoundarySurface bare = scene::readBoundarySurface(alone);
    for (const auto& point : written.points.colwise())  // in whatever order
      QVERIFY((bare.points.colwise() - point).colwise().norm().minCoeff() < 1e-7);
    QVERIFY(bare.quantities.empty());
    QCOMPARE(bare.knownCount(), 42);
    QVERIFY(problemOf([&] { scene::readBoundarySurface(folder.path().toStdString()); }).contains("no boundary.ply"));
    QVERIFY(problemOf([&] { scene::readBoundarySurface("/nowhere/boundary.ply"); }).contains("no such file"));
  }

  void limitsOfDirectionsAreReadBack() {
    QTemporaryDir folder;
    const auto test = resultOf<scene::CellTestResult>("stretch");
    const auto place = std::filesystem::path(folder.filePath("stretch").toStdString());
    test->write(place);
    const auto read = scene::readCellTest(net(), place);
    QCOMPARE(read->limit.strain, test->limit.strain);
    QCOMPARE(read->limit.equilibrium.contacts.size(), test->limit.equilibrium.contacts.size());
    QVERIFY((read->limit.equilibrium.state.strain - test->limit.equilibrium.state.strain).norm() < 1e-14);
    QVERIFY(read->limit.equilibrium.state.positions == test->limit.equilibrium.state.positions);
    QVERIFY(read->limit.equilibrium.state.rotations == test->limit.equilibrium.state.rotations);
    QCOMPARE(read->provenance.study, std::string("stretch"));

    const auto travel = resultOf<scene::FreeTravelResult>("travel");
    const auto other = std::filesystem::path(folder.filePath("travel").toStdString());
    travel->write(other);
    const scene::PolarCurves curves = scene::freeTravelCurves(*scene::readFreeTravel(net(), other));
    QCOMPARE(curves.curves.size(), std::size_t(3));
    for (std::size_t i = 0; i < 4; ++i) {
      QCOMPARE(curves.curves[0].angles[i], M_PI * double(i) / 4);
      QCOMPARE(curves.curves[0].values[i], travel->directions[i].stretch.strain);
      QCOMPARE(curves.curves[1].values[i], travel->directions[i].compression.strain);
      QCOMPARE(curves.curves[2].values[i], travel->directions[i].travel());
      QVERIFY(curves.curves[2].uncertain[i] >= curves.curves[0].uncertain[i]);
    }
    QVERIFY(problemOf([&] { scene::readFreeTravel(net(), place); }).contains("no result of a free_travel study"));
    QVERIFY(problemOf([&] { scene::readCellTest(net(), other); }).contains("no result of a cell_test study"));
  }

  /// Of a state alone the contacts are found that held it; where the net is taut, each pair of rings touches once.
  void whatHoldsAStateIsFoundAgain() {
    const auto test = resultOf<scene::CellTestResult>("stretch");
    const double radius = test->cell->smallestRadius();
    const auto solved = interlock::distinctContacts(test->limit.equilibrium.contacts, 0.5 * radius);
    const auto found = interlock::distinctContacts(
        interlock::holdingContacts(interlock::CellContact(*test->cell), test->limit.equilibrium.state, 1e-3 * radius),
        0.5 * radius);
    QVERIFY(!solved.empty());
    QCOMPARE(found.size(), solved.size());
    for (std::size_t i = 0; i < solved.size(); ++i) {
      QVERIFY(std::any_of(found.begin(), found.end(), [&](const interlock::CellContactForce& each) {
        return (each.place - solved[i].place).norm() < 0.1 * radius &&
               std::abs(each.gap - solved[i].gap) < 1e-6 * radius;
      }));
      for (std::size_t k = 0; k < i; ++k)
        QVERIFY(solved[i].pair.a != solved[k].pair.a || solved[i].pair.b != solved[k].pair.b ||
                solved[i].pair.shift != solved[k].pair.shift ||
                (solved[i].place - solved[k].place).norm() > 0.5 * radius);
    }
  }
};

QTEST_GUILESS_MAIN(TestBoundarySurface)
#include "test_boundary_surface.moc"
