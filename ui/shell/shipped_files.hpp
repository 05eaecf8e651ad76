#pragma once

#include <QString>

namespace pliant::shell {

/// A file or folder that comes with Pliant, such as "scenes".
inline QString shippedFile(const QString& path) { return QStringLiteral(PLIANT_DATA_DIR) + QLatin1Char('/') + path; }

}  // namespace pliant::shell
