#include "ui/shell/card.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>

namespace pliant::shell {

namespace {

int cardColumns(int width) {
  const int room = std::max(width, 640) - 2 * galleryMargin;
  return std::max(1, (room + cardGap) / (cardSize.width() + cardGap));
}

}  // namespace

QPushButton* makeCard(const QString& titleText, const QString& descriptionText, QLabel*& picture) {
  auto* card = new QPushButton;
  card->setFixedSize(cardSize);
  card->setCursor(Qt::PointingHandCursor);
  card->setAccessibleName(titleText);
  auto* column = new QVBoxLayout(card);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  picture = new QLabel;
  picture->setFixedSize(cardPictureSize);
  auto* title = new QLabel(titleText);
  QFont strong = title->font();
  strong.setWeight(QFont::DemiBold);
  title->setFont(strong);
  auto* description = new QLabel(descriptionText);
  description->setWordWrap(true);
  description->setAlignment(Qt::AlignTop);
  description->setForegroundRole(QPalette::PlaceholderText);
  description->setMinimumHeight(0);
  description->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);  // a long text does not push the title up
  for (QLabel* label : {picture, title, description}) {
    label->setAttribute(Qt::WA_TransparentForMouseEvents);
    column->addWidget(label);
  }
  column->setStretch(2, 1);
  return card;
}

void layOutCards(QGridLayout& grid, const std::vector<QPushButton*>& cards, int width) {
  const int columns = cardColumns(width);
  if (grid.columnStretch(columns) == 1) return;  // as they are
  for (int i = 0; i < static_cast<int>(cards.size()); ++i)
    grid.addWidget(cards[static_cast<std::size_t>(i)], i / columns, i % columns);
  for (int i = 0; i < grid.columnCount(); ++i) grid.setColumnStretch(i, 0);
  grid.setColumnStretch(columns, 1);
  grid.setRowStretch(static_cast<int>(cards.size()), 1);
}

QScrollArea* makeCardArea(QWidget* cards) {
  auto* area = new QScrollArea;
  area->setWidget(cards);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->viewport()->setBackgroundRole(QPalette::Base);
  cards->setBackgroundRole(QPalette::Base);
  return area;
}

}  // namespace pliant::shell
