#pragma once

#include <QSize>
#include <QString>
#include <vector>

class QGridLayout;
class QLabel;
class QPushButton;
class QScrollArea;
class QWidget;

namespace pliant::shell {

/// Cards of galleries: one big button each, with a picture, a title and a description.
inline constexpr QSize cardSize(256, 248), cardPictureSize(240, 128);
inline constexpr int cardGap = 16, galleryMargin = 48;

QPushButton* makeCard(const QString& title, const QString& description, QLabel*& picture);

/// Puts cards side by side, as many in a row as a gallery of this width has room for.
void layOutCards(QGridLayout& grid, const std::vector<QPushButton*>& cards, int width);

/// The cards, to be scrolled on the gallery's background.
QScrollArea* makeCardArea(QWidget* cards);

}  // namespace pliant::shell
