#include "tests/benchmarks/ui/bench_sheet.hpp"

#include <QApplication>
#include <QMouseEvent>
#include <cmath>

#include "tests/benchmarks/ui/bench_row.hpp"
#include "tests/ui/render/element_bowl.hpp"
#include "ui/render/macro_view.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::bench {

namespace {

void send(viewport::Viewport& viewport, QEvent::Type type, const QPointF& place, Qt::MouseButton button,
          Qt::MouseButtons buttons) {
  QMouseEvent event(type, place, viewport.mapToGlobal(place), button, buttons, Qt::NoModifier);
  QApplication::sendEvent(&viewport, &event);
}

void measureTurn(base::Json& rows, const std::string& name, int size, viewport::Viewport& viewport) {
  const QPointF middle = viewport.rect().center();
  send(viewport, QEvent::MouseButtonPress, middle, Qt::LeftButton, Qt::LeftButton);
  rows.push_back(rowOf(name + "/turn", size, [&](int i) {
    const QPointF place = middle + QPointF(60 * std::sin(0.2 * (i + 1)) + 20, 30 * std::sin(0.1 * (i + 1)));
    send(viewport, QEvent::MouseMove, place, Qt::NoButton, Qt::LeftButton);
  }));
  send(viewport, QEvent::MouseButtonRelease, middle, Qt::LeftButton, Qt::NoButton);
  rows.push_back(rowOf(
      name + "/still", size,
      [&](int) {
        viewport.settle();
        viewport.fit();
        viewport.grabImage();
      },
      3));
}

}  // namespace

void measureSheets(base::Json& rows) {
  viewport::Viewport viewport;
  viewport.resize(900, 560);
  viewport.show();
  const auto view = std::make_shared<render::MacroView>();
  viewport.setGuest(view);
  for (const int count : {300, 2'000, 5'000, 20'000}) {
    const auto made = render::elementBowl(count);
    view->setResult(made);
    view->setElementsVisible(false);
    viewport.setAxisView(render::AxisView::isometric);
    if (count == 20'000) measureTurn(rows, "ui/sheet", static_cast<int>(made->sheet->mesh.triangles.size()), viewport);
    view->setElementsVisible(true);
    viewport.fit();
    measureTurn(rows, "ui/elements", static_cast<int>(made->placed->detail.elements.size()), viewport);
  }
}

}  // namespace pliant::bench
