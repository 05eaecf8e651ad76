#pragma once

#include <QDialog>
#include <vector>

#include "core/scene/parts_request.hpp"

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace pliant::shell {

/// The sizes with which the bodies of a scene are made, those alone that concern it, and what came of the last export.
/// Stands beside the window, which goes on.
class MakeDialog final : public QDialog {
  Q_OBJECT

 public:
  explicit MakeDialog(QWidget* parent = nullptr);

  /// Shows the numbers that matter for a scene; those typed before stay.
  void setScene(const scene::Scene& scene, bool hasParameters);
  scene::PartsRequest request() const;
  /// What came of it, a line each.
  void showLines(const QStringList& lines);
  QString shownText() const;
  QDoubleSpinBox* field(const char* key) const;
  QCheckBox* flat() const { return flat_; }

 Q_SIGNALS:
  void bodiesRequested();
  void tableRequested();

 private:
  struct Row {
    scene::PartsNumber number;
    QLabel* label;
    QDoubleSpinBox* field;
  };
  std::vector<Row> rows_;
  QLabel* intro_;
  QCheckBox* flat_;
  QLabel* result_;
  QPushButton* bodies_;
  QPushButton* table_;
};

}  // namespace pliant::shell
