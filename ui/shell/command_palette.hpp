#pragma once

#include <QFrame>
#include <functional>
#include <vector>

class QLineEdit;
class QListWidget;

namespace pliant::shell {

/// Something that can be found by typing a part of its name.
struct PaletteEntry {
  QString text;
  QString detail;  ///< keys, or where it is
  std::function<void()> trigger;
};

/// "Find anything": a line, and the actions, parameters, properties, studies and scenes that match it.
class CommandPalette final : public QFrame {
  Q_OBJECT

 public:
  explicit CommandPalette(QWidget* window);

  /// Opens at the top of the window over these entries.
  void open(std::vector<PaletteEntry> entries);
  int matchCount() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void filter(const QString& text);
  void choose();

  QLineEdit* line_;
  QListWidget* list_;
  std::vector<PaletteEntry> entries_;
};

}  // namespace pliant::shell
