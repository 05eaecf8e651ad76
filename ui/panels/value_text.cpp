#include "ui/panels/value_text.hpp"

#include <QStringList>
#include <cmath>

#include "core/base/error.hpp"

namespace pliant::panels {

using base::ValueKind;

namespace {

const ParameterSpec& itemSpec(const ParameterSpec& list, std::size_t index) {
  return list.items[std::min(index, list.items.size() - 1)];
}

QString numberText(double value, const ParameterSpec& spec) {
  if (spec.dimension == base::dimensions::none || spec.kind == ValueKind::integer)
    return QString::number(value, 'g', 6);
  return QString::fromStdString(base::formatQuantity(value, spec.dimension));
}

/// The unit at the end of a text such as "12.40 g"; empty for a bare number.
QString unitOf(const QString& text) {
  const qsizetype space = text.indexOf(QLatin1Char(' '));
  return space < 0 ? QString() : text.mid(space + 1).trimmed();
}

Json parseNumber(const QString& typed, const QString& unit) {
  const QString text = typed.trimmed();
  bool isNumber = false;
  const double value = text.toDouble(&isNumber);
  if (!isNumber || !std::isfinite(value)) return text.toStdString();
  if (!unit.isEmpty()) return (text + QLatin1Char(' ') + unit).toStdString();
  return value;
}

}  // namespace

QString humanName(const std::string& key) {
  QString name = QString::fromStdString(key).replace(QLatin1Char('_'), QLatin1Char(' '));
  if (!name.isEmpty()) name[0] = name[0].toUpper();
  return name;
}

bool isShortVector(const Json& value, const ParameterSpec& spec) {
  if (spec.kind != ValueKind::list || !value.is_array() || value.empty() || value.size() > 4) return false;
  for (const Json& entry : value)
    if (!entry.is_number() && !entry.is_string()) return false;
  return spec.items.front().kind != ValueKind::object && spec.items.front().kind != ValueKind::list;
}

QString displayText(const Json& normalized, const Json& written, const ParameterSpec& spec) {
  switch (spec.kind) {
    case ValueKind::number:
      if (written.is_string()) return QString::fromStdString(written.get<std::string>());
      return normalized.is_number() ? numberText(normalized.get<double>(), spec) : QString();
    case ValueKind::integer: return normalized.is_number() ? QString::number(normalized.get<long long>()) : QString();
    case ValueKind::boolean: return normalized.is_boolean() && normalized.get<bool>() ? "yes" : "no";
    case ValueKind::list: {
      if (!isShortVector(normalized, spec))
        return normalized.is_array() ? QString::number(normalized.size()) : QString();
      QStringList parts;
      for (std::size_t i = 0; i < normalized.size(); ++i)
        parts << displayText(
            normalized[i], written.is_array() && i < written.size() ? written[i] : Json(), itemSpec(spec, i));
      return parts.join(QStringLiteral(", "));
    }
    case ValueKind::object:
    case ValueKind::variant: return {};
    default: return normalized.is_string() ? QString::fromStdString(normalized.get<std::string>()) : QString();
  }
}

QString editText(const Json& normalized, const Json& written, const ParameterSpec& spec) {
  if (spec.kind == ValueKind::number && normalized.is_number() && !written.is_string()) {
    // The unit that is shown, every digit that matters.
    const double value = normalized.get<double>();
    const QString unit = unitOf(numberText(value, spec));
    if (unit.isEmpty()) return QString::number(value, 'g', 12);
    const double size = base::parseQuantity("1 " + unit.toStdString(), spec.dimension);
    return QStringLiteral("%1 %2").arg(QString::number(value / size, 'g', 12), unit);
  }
  if (isShortVector(normalized, spec)) {
    QStringList parts;
    for (std::size_t i = 0; i < normalized.size(); ++i)
      parts << editText(
          normalized[i], written.is_array() && i < written.size() ? written[i] : Json(), itemSpec(spec, i));
    return parts.join(QStringLiteral(", "));
  }
  return displayText(normalized, written, spec);
}

Json parseText(const QString& typed, const QString& shown, const ParameterSpec& spec) {
  switch (spec.kind) {
    case ValueKind::number: return parseNumber(typed, unitOf(shown));
    case ValueKind::integer: {
      bool isInteger = false;
      const long long value = typed.trimmed().toLongLong(&isInteger);
      return isInteger ? Json(value) : Json(typed.trimmed().toStdString());
    }
    case ValueKind::boolean: return typed == QLatin1String("yes");
    case ValueKind::list: {
      const QStringList parts = typed.split(QLatin1Char(','));
      const QStringList before = shown.split(QLatin1Char(','));
      Json list = Json::array();
      for (qsizetype i = 0; i < parts.size(); ++i)
        list.push_back(parseText(parts[i], i < before.size() ? before[i].trimmed() : QString(),
                                 itemSpec(spec, static_cast<std::size_t>(i))));
      return list;
    }
    default: return typed.toStdString();
  }
}

QString explanation(const ParameterSpec& spec) {
  QStringList lines{QString::fromStdString(spec.description)};
  if (!spec.symbol.empty()) lines << QStringLiteral("Symbol: %1").arg(QString::fromStdString(spec.symbol));
  const bool isNumber = spec.kind == ValueKind::number || spec.kind == ValueKind::integer;
  const bool low = std::isfinite(spec.minimum), high = std::isfinite(spec.maximum);
  if (isNumber && low && high)
    lines << QStringLiteral("Range: %1 to %2").arg(numberText(spec.minimum, spec), numberText(spec.maximum, spec));
  else if (isNumber && low)
    lines << (spec.exclusiveMinimum ? QStringLiteral("Above %1") : QStringLiteral("At least %1"))
                 .arg(numberText(spec.minimum, spec));
  else if (isNumber && high)
    lines << QStringLiteral("At most %1").arg(numberText(spec.maximum, spec));
  if (!spec.defaultValue.is_null() && !spec.defaultValue.is_array() && !spec.defaultValue.is_object())
    lines << QStringLiteral("Default: %1").arg(displayText(spec.defaultValue, spec.defaultValue, spec));
  return lines.join(QLatin1Char('\n'));
}

QString entryName(const Json& entry, int index) {
  if (entry.is_object()) {
    for (const char* key : {"name", "type", "study"})
      if (const auto found = entry.find(key); found != entry.end() && found->is_string())
        return QString::fromStdString(found->get<std::string>());
  }
  return QString::number(index + 1);
}

RoundedQuantity rounded(double value, const base::Dimension& dimension) {
  const std::string text = base::formatQuantity(value, dimension);
  try {
    return {text, base::parseQuantity(text, dimension)};
  } catch (const base::InputError&) {
    return {base::formatQuantityExactly(value, dimension), value};
  }
}

}  // namespace pliant::panels
