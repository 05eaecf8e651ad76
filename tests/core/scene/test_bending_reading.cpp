#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/scene/bending_chart.hpp"
#include "core/scene/bending_reading.hpp"
#include "core/scene/boundary_surface.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/model_builder.hpp"
#include "core/scene/polar_curves.hpp"
#include "core/scene/resumable_study.hpp"

using namespace pliant;

namespace {

constexpr const char* thickText = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "thick", "type": "threefold", "ring_radius": "5.2 mm", "wire_radius": "1.6 mm",
                          "distance": "5 mm", "lean": "50 deg", "spacing": "13.5 mm"}],
  "studies": [
    {"name": "bend", "type": "bending_test", "radius": "14 mm", "bend": "down", "trials": 1},
    {"name": "limits", "type": "curvature_limits", "radius": "14 mm", "directions": 2, "trials": 1},
    {"name": "size", "type": "bending_size", "radii": ["14 mm"], "trials": 1},
    {"name": "boundary", "type": "bending_boundary", "radius": "14 mm", "subdivisions": 0, "trials": 1,
     "test_star_shape": false, "final_gap": 0.01},
    {"name": "hang", "type": "gravity_bending", "size": ["60 mm", "5 mm"]}
  ]
})";

const scene::Scene& thick() {
  static const scene::Scene scene = scene::Scene::parse(thickText, ".", "thick.json");
  return scene;
}

std::unique_ptr<scene::Study> studyOf(const std::string& name) {
  return scene::StudyRegistry::instance().make(thick(), scene::buildModel(thick()), name);
}

template <class AnyResult>
std::shared_ptr<const AnyResult> resultOf(const std::string& name) {
  base::ExecutionContext context;
  return std::dynamic_pointer_cast<const AnyResult>(studyOf(name)->run(context));
}

void requireSameState(const interlock::CellEquilibrium& found, const interlock::CellEquilibrium& expected) {
  QCOMPARE(found.state.rotations.size(), expected.state.rotations.size());
  QVERIFY(found.state.positions == expected.state.positions);
  for (std::size_t i = 0; i < found.state.rotations.size(); ++i)
    QVERIFY(found.state.rotations[i] == expected.state.rotations[i]);
  QVERIFY((found.state.strain - expected.state.strain).norm() <= 1e-15 * (1 + expected.state.strain.norm()));
  QCOMPARE(found.contacts.size(), expected.contacts.size());
  for (std::size_t i = 0; i < found.contacts.size(); ++i) {
    QVERIFY(found.contacts[i].place == expected.contacts[i].place && found.contacts[i].gap == expected.contacts[i].gap);
    QCOMPARE(found.contacts[i].pair.b, expected.contacts[i].pair.b);
  }
  QCOMPARE(found.meanGap, expected.meanGap);
  QVERIFY(found.termination == expected.termination);
}

}  // namespace

/// Results of patches read back from disk, as charts, and while they grow.
class TestBendingReading : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  std::filesystem::path folder(const char* name) const {
    return std::filesystem::path(temporary_.path().toStdString()) / name;
  }

 private Q_SLOTS:
  /// The same summary, configuration and contacts come back.
  void configurations() {
    const auto bend = resultOf<scene::BendingTestResult>("bend");
    bend->write(folder("bend"));
    const auto bent = scene::readBendingTest(thick(), folder("bend"));
    QVERIFY(bent->summary() == bend->summary());
    requireSameState(bent->limit.equilibrium, bend->limit.equilibrium);
    const auto hang = resultOf<scene::GravityBendingResult>("hang");
    hang->write(folder("hang"));
    const auto hung = scene::readGravityBending(thick(), folder("hang"));
    QVERIFY(hung->summary() == hang->summary());
    QVERIFY(hung->clamped == hang->clamped && hung->gravity == hang->gravity);
    requireSameState(hung->rest, hang->rest);
    // Of another study, of nothing.
    for (const char* wrong : {"hang", "none"}) {
      try {
        scene::readBendingTest(thick(), folder(wrong));
        QFAIL("a wrong folder is read");
      } catch (const base::InputError& error) {
        QVERIFY(!error.problem().empty());
      }
    }
  }

  void limits() {
    const auto limits = resultOf<scene::CurvatureLimitsResult>("limits");
    limits->write(folder("limits"));
    const auto read = scene::readCurvatureLimits(thick(), folder("limits"));
    const scene::PolarCurves before = scene::curvatureLimitCurves(*limits), after = scene::curvatureLimitCurves(*read);
    QCOMPARE(after.curves.size(), before.curves.size());
    for (std::size_t i = 0; i < before.curves.size(); ++i) {
      QVERIFY(after.curves[i].angles == before.curves[i].angles && after.curves[i].values == before.curves[i].values);
      QVERIFY(after.curves[i].uncertain == before.curves[i].uncertain);
    }
  }

  /// A line for each kind of curvature over the sizes, absolute; a fold leaves a gap.
  void sizes() {
    const auto sizes = resultOf<scene::BendingSizeResult>("size");
    sizes->write(folder("size"));
    auto read = scene::readBendingSize(thick(), folder("size"));
    QCOMPARE(read->sizes.size(), std::size_t(1));
    QCOMPARE(read->sizes[0].elements, sizes->sizes[0].elements);
    for (std::size_t k = 0; k < 5; ++k) {
      QCOMPARE(read->sizes[0].limits[k].curvature, sizes->sizes[0].limits[k].curvature);
      QVERIFY(read->sizes[0].limits[k].kind == sizes->sizes[0].limits[k].kind);
      read->sizes[0].limits[k].kind = interlock::BendingKind::locked;
      read->sizes[0].limits[k].curvature = (k == 2 ? -10.0 : 10.0) * static_cast<double>(k);
    }
    for (const double radius : {0.016, 0.02}) {
      read->sizes.push_back(read->sizes[0]);
      read->sizes.back().radius = radius;
      read->sizes.back().limits[2].curvature = -1000 * radius;
    }
    read->sizes[1].limits[2].kind = interlock::BendingKind::folded;
    const scene::ResultChart chart = scene::bendingSizeChart(*read);
    QVERIFY(chart.xLabel.find("[mm]") != std::string::npos && chart.yLabel.find("[1/m]") != std::string::npos);
    std::vector<scene::ResultSeries> domesDown;
    for (const scene::ResultSeries& series : chart.series)
      if (series.group == 2 && series.mark == scene::ResultSeries::Mark::dashedLine) domesDown.push_back(series);
    QCOMPARE(domesDown.size(), std::size_t(2));
    QVERIFY(domesDown[0].x == std::vector<double>{14} && domesDown[0].y == std::vector<double>{20});
    QVERIFY(domesDown[1].x == std::vector<double>{20} && domesDown[1].y == std::vector<double>{20});
    QVERIFY(domesDown[0].name == "dome, down" && domesDown[1].name.empty());
  }

  /// While it runs limits come in, each stays; cancelled, it keeps them; the boundary goes on from there.
  void resultsGrow() {
    base::ExecutionContext context;
    int looks = 0, most = 0;
    const auto known = [](const scene::CurvatureLimitsResult& result) {
      int count = 0;
      for (const auto& each : result.directions)
        count += each.up.equilibrium.converged() + each.down.equilibrium.converged();
      return count;
    };
    const auto half = studyOf("limits")->run(context, [&](std::shared_ptr<const scene::Result> soFar) {
      const int now = known(dynamic_cast<const scene::CurvatureLimitsResult&>(*soFar));
      QVERIFY(now >= most);
      most = now;
      ++looks;
      context.requestCancel();
    });
    QVERIFY(looks >= 1 && most >= 1);
    QVERIFY(half->termination == base::TerminationType::cancelled);
    const auto& kept = dynamic_cast<const scene::CurvatureLimitsResult&>(*half);
    QVERIFY(known(kept) >= 1 && known(kept) < 4);
    QCOMPARE(kept.directions[1].down.angle, std::acos(-1.0) / 2);
  }

  /// In curvature, from the result and from its files; cancelled, it goes on to the same bytes.
  void boundaries() {
    const auto whole = resultOf<scene::BendingBoundaryResult>("boundary");
    whole->write(folder("boundary"));
    const scene::BoundarySurface surface = scene::boundarySurface(*whole, "boundary");
    const scene::BoundarySurface read = scene::readBoundarySurface(folder("boundary"));
    QCOMPARE(surface.space.unit, std::string("1/m"));
    QCOMPARE(read.space.axes[2], std::string("k_xy"));
    QVERIFY(read.points == surface.points && read.known == surface.known);
    QCOMPARE(surface.knownCount(), 12);
    for (std::size_t i = 0; i < surface.quantities.size(); ++i)
      QVERIFY(surface.quantities[i].values.isApprox(read.quantities[i].values, 1e-12));
    // Along k_xx the patch reaches what its summary says.
    const double reach = whole->summary()["curvature_tensor"]["largest"][0];
    QCOMPARE(surface.points.row(0).maxCoeff(), reach);

    base::ExecutionContext context;
    const auto half = studyOf("boundary")->run(context, [&](std::shared_ptr<const scene::Result> soFar) {
      const auto& now = dynamic_cast<const scene::BendingBoundaryResult&>(*soFar);
      if (scene::boundarySurface(now, "").knownCount() >= 3) context.requestCancel();
    });
    QVERIFY(half->termination == base::TerminationType::cancelled);
    auto again = studyOf("boundary");
    dynamic_cast<scene::ResumableStudy&>(*again).goOnFrom(*half);
    base::ExecutionContext other;
    const auto resumed = std::dynamic_pointer_cast<const scene::BendingBoundaryResult>(again->run(other));
    QVERIFY(resumed->recalled >= 3);
    QVERIFY(resumed->table() == whole->table());
  }
};

QTEST_GUILESS_MAIN(TestBendingReading)
#include "test_bending_reading.moc"
