#include <QElapsedTimer>
#include <QFloat16>  // comparing JSON asks about every type that Qt can compare
#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "core/interlock/deformation_test.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/linking_number.hpp"
#include "ui/jobs/cell_inspector.hpp"
#include "ui/jobs/cell_session.hpp"

using namespace pliant;
using Eigen::Vector3d;
using jobs::CellSession;

namespace {

constexpr int patience = 60'000;  // milliseconds

std::shared_ptr<const interlock::UnitCell> shared(interlock::UnitCell cell) {
  return std::make_shared<interlock::UnitCell>(std::move(cell));
}

/// The side of the cell's neighbour along x.
interlock::CellGrip sideAlongX() {
  interlock::CellGrip grip;
  grip.shift = {1, 0};
  return grip;
}

const char* const sceneText = R"({
  "schema_version": 1,
  "interlocking_cells": [{"name": "net", "type": "ring_net"}]
})";

}  // namespace

class TestCellSession : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void itLocksWhereTheLimitIs() {
    CellSession session;
    session.open(shared(interlock::threefold()));
    QTRY_VERIFY_WITH_TIMEOUT(session.state().step.smallestGap > 0, patience);
    session.pull(sideAlongX(), Vector3d(10, 0, 0));
    QTRY_VERIFY_WITH_TIMEOUT(session.state().step.locked, patience);
    const double limit = interlock::directionLimit(interlock::CellSolver(interlock::threefold()), 0, false).strain;
    QVERIFY(std::abs(interlock::strainAlong(session.state().state.strain, 0) - limit) < 1e-3);
    QVERIFY(session.state().pulled && !session.state().step.contacts.empty());
    session.letGo();
    QTRY_VERIFY_WITH_TIMEOUT(!session.state().pulled, patience);
    QVERIFY(interlock::strainAlong(session.state().state.strain, 0) > 0.5 * limit);
    session.reset();
    QTRY_VERIFY_WITH_TIMEOUT(session.state().state.strain.norm() == 0, patience);
  }

  /// A large cell takes long; the UI thread is never kept, and the newest place counts.
  void theNewestHandCountsAndNothingWaits() {
    CellSession session;
    session.open(shared(interlock::supercell(interlock::fourInOne(), 3, 3)));
    const double height = 3 * interlock::FourInOne().height;
    QElapsedTimer clock;
    for (int i = 0; i < 40; ++i) {
      clock.start();
      session.pull(sideAlongX(), Vector3d(0.05 + 0.01 * i, 0, 0));
      QVERIFY(clock.elapsed() < 50);
      QTest::qWait(5);
    }
    // Back to almost where it was.
    const double width = 3 * interlock::FourInOne().width;
    session.pull(sideAlongX(), Vector3d(1.02 * width, 0.01 * height, 0));
    QTRY_VERIFY_WITH_TIMEOUT(session.state().pulled && session.state().step.settled, patience);
    QVERIFY(session.state().hand.isApprox(Vector3d(1.02 * width, 0.01 * height, 0)));
    const interlock::CellContact contact(*session.state().cell);
    QVERIFY(contact.smallestGap(session.state().state, 1e-3) > 0);
    QVERIFY(interlock::LinkFinder(contact).linksAt(session.state().state) ==
            interlock::LinkFinder(contact).linksAt(interlock::restState(*session.state().cell)));
  }

  void itEndsInTheMiddleOfAStep() {
    QElapsedTimer clock;
    {
      CellSession session;
      session.open(shared(interlock::supercell(interlock::scaleMail(), 3, 3)));
      session.pull(sideAlongX(), Vector3d(1, 0, 0));
      QTest::qWait(50);
      QSignalSpy changes(&session, &CellSession::stateChanged);
      session.open(nullptr);
      QVERIFY(session.state().cell == nullptr);
      QTest::qWait(50);
      QCOMPARE(changes.size(), 1);  // nothing of the old cell comes any more
      session.open(shared(interlock::supercell(interlock::scaleMail(), 3, 3)));
      session.pull(sideAlongX(), Vector3d(1, 0, 0));
      clock.start();
    }
    QVERIFY(clock.elapsed() < patience);
  }

  void anInspectionAnswersTheNewestRequest() {
    jobs::CellInspector inspector;
    std::vector<jobs::InspectedCell> answers;
    connect(&inspector, &jobs::CellInspector::inspected, this,
            [&](const jobs::InspectedCell& cell) { answers.push_back(cell); });
    const scene::Scene scene = scene::Scene::parse(sceneText, ".", "net.json");
    const auto entry = [](const std::string& spacing) {
      return scene::Json{{"name", "net"}, {"type", "ring_net"}, {"spacing", spacing}};
    };
    for (const char* spacing : {"12 mm", "13 mm", "14 mm", "15 mm"}) inspector.inspect(scene, 0, entry(spacing));
    QTRY_VERIFY_WITH_TIMEOUT(!inspector.isBusy(), patience);
    QVERIFY(answers.size() == 2);
    QCOMPARE(answers.front().entry, entry("12 mm"));
    QVERIFY(answers.front().fault.isEmpty() && answers.front().cell);
    QCOMPARE(answers.back().entry, entry("15 mm"));
    QVERIFY(answers.back().inspection.overlaps());
    QVERIFY(answers.back().fault.contains("overlap by 0.7 mm"));
    QVERIFY(answers.back().cell != nullptr);  // it is seen all the same
    const jobs::InspectedCell refused = jobs::inspectEntry(scene, 0, entry("-1 mm"));
    QVERIFY(!refused.cell && !refused.fault.isEmpty());
  }
};

QTEST_GUILESS_MAIN(TestCellSession)
#include "test_cell_session.moc"
