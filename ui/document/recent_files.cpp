#include "ui/document/recent_files.hpp"

#include <QFileInfo>
#include <QSettings>

namespace pliant::document {

namespace {
const QString settingsKey = QStringLiteral("recentFiles");
}

RecentFiles::RecentFiles(bool remember, QObject* parent) : QObject(parent), remember_(remember) {
  if (remember_) files_ = QSettings().value(settingsKey).toStringList();
}

QStringList RecentFiles::files() const {
  QStringList existing;
  for (const QString& file : files_)
    if (QFileInfo::exists(file)) existing << file;
  return existing;
}

void RecentFiles::add(const QString& file) {
  const QString path = QFileInfo(file).absoluteFilePath();
  files_.removeAll(path);
  files_.prepend(path);
  while (files_.size() > maximum) files_.removeLast();
  store();
  Q_EMIT changed();
}

void RecentFiles::clear() {
  files_.clear();
  store();
  Q_EMIT changed();
}

void RecentFiles::store() const {
  if (remember_) QSettings().setValue(settingsKey, files_);
}

}  // namespace pliant::document
