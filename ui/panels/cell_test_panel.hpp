#pragma once

#include <QWidget>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/interlock_result.hpp"
#include "ui/document/document.hpp"

class QTableWidget;

namespace pliant::panels {

/// The limits of single directions that studies of the document find, of stretch and of bending, and patches that hang,
/// one a row; a row that is chosen is looked at.
class CellTestPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit CellTestPanel(document::Document& document, QWidget* parent = nullptr);

  /// Whether it shows results of studies of this type.
  static bool shows(const std::string& type);
  QTableWidget* table() const { return table_; }
  /// Marks the row of this study; empty: that of the material at rest; none: no row.
  void setShown(const std::optional<std::string>& study);

 Q_SIGNALS:
  /// The study is to be looked at; empty: the material at rest.
  void studyChosen(const std::string& study);
  void runRequested(const std::string& study);

 private:
  void refresh();

  document::Document& document_;
  QTableWidget* table_;
  std::vector<std::string> names_;  ///< by row, from the second on
};

}  // namespace pliant::panels
