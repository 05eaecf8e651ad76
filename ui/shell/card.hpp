#pragma once

#include <QSize>
#include <QString>

class QGridLayout;
class QLabel;
class QPushButton;
class QWidget;

namespace pliant::shell {

/// Cards of galleries: one big button each, with a picture, a title and a description.
inline constexpr QSize cardSize(256, 248), cardPictureSize(240, 128);
inline constexpr int cardGap = 16, galleryMargin = 48;

QPushButton* makeCard(const QString& title, const QString& description, QLabel*& picture);

/// How many cards stand side by side in a gallery of this width.
int cardColumns(int width);

}  // namespace pliant::shell
