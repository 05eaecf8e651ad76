#include <QTest>
#include <cmath>

#include "core/interlock/element_families.hpp"
#include "ui/render/cell_patch.hpp"

using namespace pliant;
using Eigen::Vector3d;
using render::CellPatch;
using render::CellPick;

namespace {

std::shared_ptr<const interlock::UnitCell> shared(interlock::UnitCell cell) {
  return std::make_shared<interlock::UnitCell>(std::move(cell));
}

}  // namespace

class TestCellPatch : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// Three by three cells of a ring net of 12 mm, whose three elements have their middle at (2, 2) mm.
  void handlesAreAroundThePatch() {
    CellPatch patch;
    QVERIFY(patch.handles().empty());
    patch.setCell(shared(interlock::ringNet()));
    const std::vector<CellPick> handles = patch.handles();
    QCOMPARE(handles.size(), std::size_t(8));
    const double low = -16e-3, middle = 2e-3, high = 20e-3;
    const std::vector<Vector3d> wanted = {{low, low, 0},   {middle, low, 0},  {high, low, 0}, {high, middle, 0},
                                          {high, high, 0}, {middle, high, 0}, {low, high, 0}, {low, middle, 0}};
    for (std::size_t i = 0; i < 8; ++i) QVERIFY((handles[i].place - wanted[i]).norm() < 1e-12);
    QVERIFY(std::abs(patch.extent() - std::sqrt(2.0) * 36e-3) < 1e-12);
    // They are where the live cell has the grips that they stand for.
    interlock::LiveCell live(interlock::ringNet());
    for (const CellPick& handle : handles) QVERIFY((live.placeOf(handle.grip) - handle.place).norm() < 1e-12);
    interlock::CellState state = patch.state();
    state.strain = {0.1, 0.02, 0.05};
    patch.setState(state);
    QVERIFY((patch.handles()[4].place - Vector3d(1.12 * high + 0.05 * high, 0.05 * high + 1.08 * high, 0)).norm() <
            1e-12);
  }

  /// A contact with a neighbour is seen wherever both elements are drawn: in six of nine cells for the neighbour along
  /// one lattice vector, in four for that along both.
  void contactsAreRepeatedWithTheCells() {
    CellPatch patch;
    patch.setCell(shared(interlock::threefold()));
    interlock::LiveContact contact;
    contact.place = {1e-3, 2e-3, 3e-3};
    for (const auto& [shift, count] :
         std::vector<std::pair<std::array<int, 2>, std::size_t>>{{{0, 0}, 9}, {{1, 0}, 6}, {{-1, 1}, 4}, {{2, 0}, 3}}) {
      contact.shift = shift;
      const auto places = patch.places({contact});
      QCOMPARE(places.size(), count);
      int own = 0;
      for (const Vector3d& place : places) own += (place - contact.place).norm() < 1e-12;
      QCOMPARE(own, std::abs(shift[0]) > 1 ? 0 : 1);
    }
  }

  void aVeryLargeCellStandsAlone() {
    CellPatch patch;
    patch.setCell(shared(interlock::supercell(interlock::fourInOne(), 8, 8)));
    QCOMPARE(patch.neighbours(), 0);
    patch.setCell(shared(interlock::supercell(interlock::fourInOne(), 2, 2)));
    QCOMPARE(patch.neighbours(), 1);
  }
};

QTEST_GUILESS_MAIN(TestCellPatch)
#include "test_cell_patch.moc"
