#pragma once

#include <QTableWidget>

#include "ui/plots/limit_shape.hpp"

namespace pliant::panels {

/// The handles of a stretch limit as numbers to be typed: directions in degrees, and stretches, which may be given as
/// strains ("+5 %") too.
class LimitTable final : public QTableWidget {
  Q_OBJECT

 public:
  explicit LimitTable(QWidget* parent = nullptr);

  /// Null: nothing is shown.
  void setShape(const plots::LimitShape* shape);
  /// Opens the stretch of a handle for typing.
  void type(int handle);

  QSize sizeHint() const override { return {240, 132}; }

 Q_SIGNALS:
  void typed(int handle, const pliant::cloth::DirectionLimit& place);
  void refused(const QString& sentence);

 private:
  void read(int row, int column);

  std::vector<cloth::DirectionLimit> handles_;
};

}  // namespace pliant::panels
