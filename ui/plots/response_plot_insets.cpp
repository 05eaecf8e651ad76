#include <algorithm>
#include <array>

#include "ui/plots/response_plot_parts.hpp"

namespace pliant::plots {

namespace {

constexpr double gapToPlace = 24;  // pixels
constexpr double margin = 4;
constexpr double clearance = 3;  // of a leader from what it passes

bool crosses(const QLineF& line, const QRectF& rect) {
  if (rect.contains(line.p1()) || rect.contains(line.p2())) return true;
  const std::array<QLineF, 2> diagonals{
      QLineF(rect.topLeft(), rect.bottomRight()), QLineF(rect.topRight(), rect.bottomLeft())};
  return std::any_of(diagonals.begin(), diagonals.end(), [&](const QLineF& diagonal) {
    return line.intersects(diagonal, nullptr) == QLineF::BoundedIntersection;
  });
}

/// From a place to the near side of its inset.
QLineF leaderTo(const QRectF& inset, const QPointF& at) {
  return {at, {inset.left() > at.x() ? inset.left() : inset.right(), std::clamp(at.y(), inset.top(), inset.bottom())}};
}

}  // namespace

void ResponsePlot::setInsets(std::vector<ResponseInset> insets) {
  Parts& p = *parts_;
  for (const InsetItem& item : p.insets) {
    p.plot->removeItem(item.picture);
    p.plot->removeItem(item.leader);
  }
  p.insets.clear();
  for (const ResponseInset& inset : insets) {
    auto* leader = new QCPItemLine(p.plot);
    auto* picture = new QCPItemPixmap(p.plot);
    for (QCPAbstractItem* item : {static_cast<QCPAbstractItem*>(leader), static_cast<QCPAbstractItem*>(picture)}) {
      item->setSelectable(false);
      item->setLayer(p.markers);
      item->setVisible(false);  // until there is a place for it
    }
    for (QCPItemPosition* position : {leader->start, leader->end, picture->topLeft})
      position->setType(QCPItemPosition::ptAbsolute);
    picture->setPixmap(QPixmap::fromImage(inset.image));
    picture->setScaled(false);
    p.insets.push_back({inset.place, picture, leader});
  }
  replotMarkers();
}

int ResponsePlot::visibleInsets() const {
  return static_cast<int>(std::count_if(
      parts_->insets.begin(), parts_->insets.end(), [](const InsetItem& item) { return item.picture->visible(); }));
}

/// Beside its place or as near above and below as there is room: where an inset hides least of the curves, and neither
/// what is `taken` nor another inset, and where no leader crosses any of them but the marker that it begins at.
void ResponsePlot::placeInsets(const std::vector<QRectF>& taken) {
  Parts& p = *parts_;
  const auto pixelOf = [&](double omega, double amplitude) {
    return QPointF(p.plot->xAxis->coordToPixel(omega * frequencyFactor()),
                   p.plot->yAxis->coordToPixel(amplitude * p.unit.perMetre));
  };
  const QRectF frame = QRectF(p.plot->axisRect()->rect()).adjusted(margin, margin, -margin, -margin);
  std::vector<QRectF> occupied = taken;
  std::vector<QLineF> leaders;
  for (const InsetItem& item : p.insets) {
    const QPointF at = pixelOf(item.place.omega, item.place.amplitude);
    const QSizeF size = item.picture->pixmap().deviceIndependentSize();
    std::optional<QRectF> best;
    double least = 0;
    for (const double away : {0.0, 1.0, 2.0, -1.0, -2.0, -3.0}) {  // widths to the right, or to the left
      for (const double slide : {0.0, 0.5, -0.5, 1.0, -1.0, 1.5, -1.5, 2.0, -2.0}) {
        const double gap = away < 0 ? -gapToPlace : gapToPlace;
        const QRectF rect(at + QPointF(gap + away * size.width(), (slide - 0.5) * size.height()), size);
        const auto hides = [&](const QRectF& other) { return other.intersects(rect); };
        if (!frame.contains(rect) || std::any_of(occupied.begin(), occupied.end(), hides)) continue;
        const auto isCrossed = [&](const QRectF& other) {
          return !other.contains(at) &&
                 crosses(leaderTo(rect, at), other.adjusted(-clearance, -clearance, clearance, clearance));
        };
        const auto cutsOff = [&](const QLineF& leader) { return crosses(leader, rect); };
        if (std::any_of(occupied.begin(), occupied.end(), isCrossed) ||
            std::any_of(leaders.begin(), leaders.end(), cutsOff))
          continue;
        double hidden = std::abs(slide) + std::abs(away + (away < 0));
        for (const ResponseCurve& curve : p.curves)
          for (std::size_t i = 0; i < curve.omega.size(); ++i)
            hidden += rect.contains(pixelOf(curve.omega[i], curve.amplitude[i]));
        if (best && hidden >= least) continue;
        best = rect;
        least = hidden;
      }
    }
    const bool visible = best && frame.contains(at);
    item.picture->setVisible(visible);
    item.leader->setVisible(visible);
    if (!visible) continue;
    occupied.push_back(*best);
    item.picture->topLeft->setCoords(best->topLeft());
    item.picture->setPen(QPen(p.style.grid, 1));
    item.leader->setPen(QPen(p.style.mutedText, 1));
    leaders.push_back(leaderTo(*best, at));
    item.leader->start->setCoords(leaders.back().p1());
    item.leader->end->setCoords(leaders.back().p2());
  }
}

}  // namespace pliant::plots
