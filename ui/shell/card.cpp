#include "ui/shell/card.hpp"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

namespace pliant::shell {

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

int cardColumns(int width) {
  const int room = std::max(width, 640) - 2 * galleryMargin;
  return std::max(1, (room + cardGap) / (cardSize.width() + cardGap));
}

}  // namespace pliant::shell
