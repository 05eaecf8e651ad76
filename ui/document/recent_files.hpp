#pragma once

#include <QObject>
#include <QStringList>

namespace pliant::document {

/// The scenes opened last, newest first. Remembered between sessions if `remember`; files that are gone are left out.
class RecentFiles final : public QObject {
  Q_OBJECT

 public:
  static constexpr int maximum = 10;

  explicit RecentFiles(bool remember, QObject* parent = nullptr);

  QStringList files() const;
  void add(const QString& file);
  void clear();

 Q_SIGNALS:
  void changed();

 private:
  void store() const;

  bool remember_;
  QStringList files_;
};

}  // namespace pliant::document
