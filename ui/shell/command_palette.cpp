#include "ui/shell/command_palette.hpp"

#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace pliant::shell {

CommandPalette::CommandPalette(QWidget* window) : QFrame(window, Qt::Popup) {
  setFrameShape(QFrame::StyledPanel);
  line_ = new QLineEdit;
  line_->setPlaceholderText(tr("Find anything: actions, parameters, properties, scenes"));
  line_->setClearButtonEnabled(true);
  list_ = new QListWidget;
  list_->setFrameShape(QFrame::NoFrame);
  list_->setFocusPolicy(Qt::NoFocus);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(8);
  column->addWidget(line_);
  column->addWidget(list_);
  line_->installEventFilter(this);
  connect(line_, &QLineEdit::textChanged, this, &CommandPalette::filter);
  connect(list_, &QListWidget::itemClicked, this, &CommandPalette::choose);
}

void CommandPalette::open(std::vector<PaletteEntry> entries) {
  entries_ = std::move(entries);
  line_->clear();
  filter({});
  const QWidget* window = parentWidget();
  const QSize size(std::min(560, window->width() - 64), std::min(400, window->height() - 128));
  setGeometry(QRect(window->mapToGlobal(QPoint((window->width() - size.width()) / 2, 56)), size));
  show();
  line_->setFocus();
}

int CommandPalette::matchCount() const { return list_->count(); }

void CommandPalette::filter(const QString& text) {
  const QStringList words = text.split(QLatin1Char(' '), Qt::SkipEmptyParts);
  list_->clear();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const QString& detail = entries_[i].detail;
    const QString whole = detail.isEmpty() ? entries_[i].text : entries_[i].text + QStringLiteral("    ") + detail;
    if (!std::all_of(
            words.begin(), words.end(), [&](const QString& word) { return whole.contains(word, Qt::CaseInsensitive); }))
      continue;
    auto* item = new QListWidgetItem(whole);
    item->setData(Qt::UserRole, static_cast<int>(i));
    item->setSizeHint({0, 28});
    list_->addItem(item);
  }
  list_->setCurrentRow(0);
}

void CommandPalette::choose() {
  const QListWidgetItem* item = list_->currentItem();
  if (!item) return;
  const auto trigger = entries_[static_cast<std::size_t>(item->data(Qt::UserRole).toInt())].trigger;
  hide();
  trigger();
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (watched != line_ || event->type() != QEvent::KeyPress) return QFrame::eventFilter(watched, event);
  const int last = list_->count() - 1;
  switch (static_cast<QKeyEvent*>(event)->key()) {
    case Qt::Key_Down: list_->setCurrentRow(std::min(list_->currentRow() + 1, last)); return true;
    case Qt::Key_Up: list_->setCurrentRow(std::max(list_->currentRow() - 1, 0)); return true;
    case Qt::Key_Return:
    case Qt::Key_Enter: choose(); return true;
    case Qt::Key_Escape: hide(); return true;
    default: return QFrame::eventFilter(watched, event);
  }
}

}  // namespace pliant::shell
