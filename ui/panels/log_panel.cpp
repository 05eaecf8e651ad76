#include "ui/panels/log_panel.hpp"

#include <QHeaderView>
#include <QTime>

#include "ui/panels/icon.hpp"

namespace pliant::panels {

namespace {
constexpr int longest = 1000;
}

LogPanel::LogPanel(QWidget* parent) : QTreeWidget(parent) {
  setColumnCount(2);
  setHeaderHidden(true);
  setRootIsDecorated(false);
  setFrameShape(QFrame::NoFrame);
  setWordWrap(true);
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  setAccessibleName(tr("Messages"));
}

void LogPanel::add(base::Severity severity, const QString& sentence) {
  auto* item = new QTreeWidgetItem({QTime::currentTime().toString(QStringLiteral("HH:mm:ss")), sentence});
  const bool warning = severity == base::Severity::warning;
  item->setIcon(0, icon(warning ? QStringLiteral("warning") : QStringLiteral("information")));
  if (warning) ++warnings_;
  addTopLevelItem(item);
  while (topLevelItemCount() > longest) delete takeTopLevelItem(0);
  scrollToItem(item);
}

}  // namespace pliant::panels
