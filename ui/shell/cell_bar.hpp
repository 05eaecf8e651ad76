#pragma once

#include <QWidget>

class QAction;

namespace pliant::jobs {
struct LiveCellState;
}
namespace pliant::panels {
class TextLine;
}

namespace pliant::shell {

/// Below the viewport where it shows an interlocking cell: how far that is strained, whether it has locked, its
/// smallest gap, and the way back to rest.
class CellBar final : public QWidget {
  Q_OBJECT

 public:
  explicit CellBar(QAction* reset, QWidget* parent = nullptr);

  void showState(const jobs::LiveCellState& state);
  /// Instead, of a cell that is only looked at.
  void showSentence(const QString& sentence, bool warns);
  QString text() const;

 private:
  panels::TextLine* text_;
};

/// "x +8.31 %   y −0.52 %   shear 0.00 %" of strain coordinates; a change of angle of neighbouring
/// rows, 2 E_xy to first order, counts as shear.
QString strainText(const jobs::LiveCellState& state);
/// "locked: 6 contacts", or what else there is to say of the contacts; empty: nothing.
QString contactText(const jobs::LiveCellState& state);

}  // namespace pliant::shell
