#pragma once

#include <QStringList>
#include <QWidget>
#include <vector>

class QLabel;
class QPushButton;
class QTableWidget;

namespace pliant::panels {

/// Values of parameters in a table, what they are of above it, and a button below that takes them into the scene.
class ValueCard final : public QWidget {
  Q_OBJECT

 public:
  explicit ValueCard(QWidget* parent = nullptr);

  void setTitle(const QString& text);
  /// The first column holds names, the others numbers; a row has as many texts as there are `headers`.
  void setTable(const QStringList& headers, const std::vector<QStringList>& rows);

  QString title() const;
  QTableWidget* table() const { return table_; }
  QPushButton* takeButton() const { return take_; }

  QSize sizeHint() const override { return {280, 200}; }
  QSize minimumSizeHint() const override { return {180, 120}; }

 private:
  QLabel* title_;
  QTableWidget* table_;
  QPushButton* take_;
};

}  // namespace pliant::panels
