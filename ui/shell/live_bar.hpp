#pragma once

#include <QWidget>
#include <string>

class QComboBox;
class QToolButton;

namespace pliant::document {
class Document;
}
namespace pliant::jobs {
class ClothSession;
}
namespace pliant::panels {
class TextLine;
}

namespace pliant::shell {

class ActionRegistry;

/// Below the viewport where the scene has a cloth: turns the live cloth on, plays, steps, resets and records it, and
/// says how fast it goes.
class LiveBar final : public QWidget {
  Q_OBJECT

 public:
  LiveBar(document::Document& document, jobs::ClothSession& session, const ActionRegistry& actions,
          QWidget* parent = nullptr);

  /// The study of the type cloth_motion that is chosen; empty: the scene has none.
  std::string study() const;
  QString text() const;

 Q_SIGNALS:
  void studyChosen();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void fillStudies();
  void refresh();

  document::Document& document_;
  jobs::ClothSession& session_;
  QComboBox* studies_;
  QWidget* controls_;
  panels::TextLine* text_;
};

}  // namespace pliant::shell
