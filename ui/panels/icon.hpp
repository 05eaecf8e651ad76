#pragma once

#include <QIcon>
#include <QString>

namespace pliant::panels {

/// A line icon of `resources/icons`, drawn in the colour of the palette's text, at any size.
QIcon icon(const QString& name);

}  // namespace pliant::panels
