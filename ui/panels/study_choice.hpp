#pragma once

#include <QComboBox>
#include <functional>
#include <string>

#include "ui/document/document.hpp"

namespace pliant::panels {

/// Which one of the document's studies of some kind a panel shows. It follows the scene, keeps the choice by its name,
/// and is hidden where there is nothing to choose. A panel makes it before it listens to the document itself, so that
/// it finds the new studies here.
class StudyChoice final : public QComboBox {
  Q_OBJECT

 public:
  using Belongs = std::function<bool(const document::StudyState&)>;

  StudyChoice(document::Document& document, Belongs belongs, QWidget* parent);

  /// Empty if there are none.
  std::string name() const { return currentText().toStdString(); }
  /// Null if there are none.
  const document::StudyState* study() const { return document_.study(name()); }
  /// Leaves the choice as it is if there is no such study.
  void choose(const std::string& name);

 Q_SIGNALS:
  /// Another study is chosen, by hand or because the former one is gone.
  void chosen();

 private:
  void fill();

  document::Document& document_;
  Belongs belongs_;
};

}  // namespace pliant::panels
