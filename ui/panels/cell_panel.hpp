#pragma once

#include <QWidget>
#include <vector>

#include "ui/document/document.hpp"
#include "ui/jobs/cell_inspector.hpp"

class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

namespace pliant::panels {

class CellParameterRow;

/// The interlocking materials of the scene, one at a time: every number of its kind as the scene's format declares it,
/// and whether its elements are linked as they should be and how near they come. What is edited is a draft of the
/// entry, inspected as it changes; a draft that can be computed with is put into the scene when the hand lets go, as
/// one undo step. One that cannot is kept here, with the reason, until further edits make it fit or it is taken back.
class CellPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit CellPanel(document::Document& document, QWidget* parent = nullptr);

  /// Null: the material has no such number.
  CellParameterRow* row(const std::string& key) const;
  /// The entry of "interlocking_cells" on show; -1: there is none.
  int shownCell() const { return index_; }
  /// The draft differs from the scene since it cannot be computed with.
  bool isRefused() const { return refused_; }
  /// What the panel says of the material.
  QString findings() const;
  void takeBack();

 Q_SIGNALS:
  /// What is now to be seen; `draft`: it is not in the scene (yet).
  void cellInspected(const pliant::jobs::InspectedCell& cell, bool draft);
  /// The scene has no material, or another scene is open.
  void cellLost();
  void familyRequested();

 private:
  void refresh(bool another);
  void rebuild();
  void showValues(const document::Json& normalized);
  void draft(const std::string& key, const document::Json& value);
  void commit(const QString& text, int mergeId);
  void showInspected(const jobs::InspectedCell& cell);
  void showFindings(const jobs::InspectedCell& cell);
  document::Json entryOfScene() const;
  /// The draft has something that the scene will have in a moment.
  bool isAhead() const;
  std::string pointer() const;

  document::Document& document_;
  jobs::CellInspector inspector_;
  int index_ = -1;
  document::Json draft_;   ///< as it is written
  document::Json before_;  ///< the drag
  bool refused_ = false;
  bool dragging_ = false;
  QString commitText_;  ///< the draft is to be put into the scene once it is inspected; empty: it is not
  int commitMergeId_ = -1;
  std::string family_;  ///< whose rows are there

  QComboBox* cells_;
  QLabel* title_;
  QLabel* sentence_;
  QVBoxLayout* list_;
  std::vector<CellParameterRow*> rows_;
  QWidget* supercell_;
  QSpinBox* counts_[2];
  QLabel* links_;
  QLabel* gap_;
  QPushButton* back_;
};

}  // namespace pliant::panels
