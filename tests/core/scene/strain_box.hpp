#pragma once

#include <QFile>
#include <QTest>

/// Limits of strain for scenes in which nothing but a sheet is to be computed: a box.
inline constexpr const char* strainBox = R"(v -0.1 -0.1 -0.05
v 0.1 -0.1 -0.05
v 0.1 0.1 -0.05
v -0.1 0.1 -0.05
v -0.1 -0.1 0.05
v 0.1 -0.1 0.05
v 0.1 0.1 0.05
v -0.1 0.1 0.05
f 1 3 2
f 1 4 3
f 5 6 7
f 5 7 8
f 1 2 6
f 1 6 5
f 2 3 7
f 2 7 6
f 3 4 8
f 3 8 7
f 4 1 5
f 4 5 8
)";

inline void writeText(const QString& name, const char* text) {
  QFile file(name);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(text);
}
