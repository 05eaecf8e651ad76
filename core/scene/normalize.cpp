#include "core/scene/normalize.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

using base::InputError;
using base::ParameterSpec;
using base::ValueKind;

namespace {

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0u);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// `; did you mean "thickness"?`, or the list of what there is if nothing is near.
std::string suggestion(std::string_view found, const std::vector<std::string>& known) {
  if (known.empty()) return "; there is none.";
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return editDistance(found, a) < editDistance(found, b);
  });
  if (editDistance(found, *nearest) <= std::max<std::size_t>(2, nearest->size() / 3))
    return "; did you mean " + quote(*nearest) + "?";
  constexpr std::size_t most = 12;
  std::string all;
  for (std::size_t i = 0; i < std::min(most, known.size()); ++i) all += (i ? ", " : "") + quote(known[i]);
  return "; known are " + all + (known.size() > most ? ", ..." : "") + ".";
}

[[noreturn]] void expected(const std::string& pointer, const std::string& what, const Json& found) {
  throw InputError(pointer, "Expected " + what + ", found " + describe(found) + ".");
}

std::string rangeText(const ParameterSpec& spec) {
  const auto show = [&](double bound) { return base::formatQuantityExactly(bound, spec.dimension); };
  if (std::isinf(spec.maximum)) return (spec.exclusiveMinimum ? "greater than " : "at least ") + show(spec.minimum);
  return "from " + show(spec.minimum) + " to " + show(spec.maximum);
}

void checkRange(const ParameterSpec& spec, double value, const Json& found, const std::string& pointer) {
  const bool low = spec.exclusiveMinimum ? !(value > spec.minimum) : !(value >= spec.minimum);
  if (low || !(value <= spec.maximum)) expected(pointer, "a value " + rangeText(spec), found);
}

void checkFinite(double value, const std::string& pointer) {
  if (!std::isfinite(value)) throw InputError(pointer, "Expected a finite number.");
}

class Normalizer {
 public:
  explicit Normalizer(int dimension) : dimension_(dimension) {}

  Json value(const ParameterSpec& spec, const Json& found, const std::string& pointer) const {
    switch (spec.kind) {
      case ValueKind::number: return number(spec, found, pointer);
      case ValueKind::integer: return integer(spec, found, pointer);
      case ValueKind::boolean:
        if (!found.is_boolean()) expected(pointer, "true or false", found);
        return found;
      case ValueKind::text:
      case ValueKind::path:
      case ValueKind::reference:
        if (!found.is_string()) expected(pointer, "a text in double quotes", found);
        return found;
      case ValueKind::name: return name(found, pointer);
      case ValueKind::choice: return choice(spec, found, pointer);
      case ValueKind::list: return list(spec, found, pointer);
      case ValueKind::object: return object(spec, found, pointer, false);
      case ValueKind::variant: return variant(spec, found, pointer);
    }
    return {};
  }

 private:
  static Json number(const ParameterSpec& spec, const Json& found, const std::string& pointer) {
    double result = 0;
    if (found.is_number()) {
      result = found.get<double>();
    } else if (found.is_string() && !(spec.dimension == base::Dimension{})) {
      try {
        result = base::parseQuantity(found.get_ref<const std::string&>(), spec.dimension);
      } catch (const InputError& error) {
        throw InputError(pointer, error.problem());
      }
    } else {
      const std::string unit = base::siUnit(spec.dimension);
      expected(pointer, unit.empty() ? "a number" : "a number or a text with a unit such as \"1 " + unit + "\"", found);
    }
    checkFinite(result, pointer);
    checkRange(spec, result, found, pointer);
    return result;
  }

  static Json integer(const ParameterSpec& spec, const Json& found, const std::string& pointer) {
    const double result = found.is_number() ? found.get<double>() : 0.5;
    if (result != std::floor(result)) expected(pointer, "a whole number", found);
    checkRange(spec, result, found, pointer);
    return static_cast<long long>(result);
  }

  static Json name(const Json& found, const std::string& pointer) {
    if (!found.is_string()) expected(pointer, "a name in double quotes", found);
    const auto& text = found.get_ref<const std::string&>();
    const auto allowed = [](unsigned char c) { return std::isalnum(c) || c >= 0x80 || c == '-' || c == '_'; };
    const bool good =
        !text.empty() && text.size() <= 80 && allowed(static_cast<unsigned char>(text.front())) && text.back() != ' ' &&
        std::all_of(text.begin(), text.end(), [&](unsigned char c) { return allowed(c) || c == ' ' || c == '.'; });
    if (!good)
      expected(pointer, "a name of at most 80 letters, digits, \"-\", \"_\", and after the first also \".\" and spaces",
               found);
    return found;
  }

  static Json choice(const ParameterSpec& spec, const Json& found, const std::string& pointer) {
    if (!found.is_string()) expected(pointer, "a text in double quotes", found);
    const auto& text = found.get_ref<const std::string&>();
    if (std::find(spec.choices.begin(), spec.choices.end(), text) == spec.choices.end())
      throw InputError(pointer, quote(text) + " is not one of the choices" + suggestion(text, spec.choices));
    return found;
  }

  Json list(const ParameterSpec& spec, const Json& found, const std::string& pointer) const {
    if (!found.is_array()) expected(pointer, "a list", found);
    const auto count = static_cast<int>(std::min<std::size_t>(found.size(), std::numeric_limits<int>::max()));
    if (spec.spatial && count != dimension_)
      throw InputError(pointer, "Expected a list of " + std::to_string(dimension_) +
                                    " because the scene's dimension is " + std::to_string(dimension_) + ", found " +
                                    std::to_string(count) + ".");
    if (count < spec.minimumCount || count > spec.maximumCount) {
      const bool exactly = spec.minimumCount == spec.maximumCount;
      throw InputError(pointer, "Expected a list of " + std::to_string(spec.minimumCount) +
                                    (exactly ? "" : " to " + std::to_string(spec.maximumCount)) + " entries, found " +
                                    std::to_string(count) + ".");
    }
    Json result = Json::array();
    std::set<std::string> names;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const ParameterSpec& item = spec.items[std::min(i, spec.items.size() - 1)];
      result.push_back(value(item, found[i], childPointer(pointer, i)));
      if (!result[i].is_object() || !result[i].contains("name")) continue;
      const auto& given = result[i]["name"].get_ref<const std::string&>();
      if (!names.insert(given).second)
        throw InputError(
            childPointer(childPointer(pointer, i), "name"), "The name " + quote(given) + " stands twice in this list.");
    }
    return result;
  }

  Json object(const ParameterSpec& spec, const Json& found, const std::string& pointer, bool hasType) const {
    if (!found.is_object()) expected(pointer, "an object", found);
    std::vector<std::string> known;
    if (hasType) known.emplace_back("type");
    for (const ParameterSpec& field : spec.fields) known.push_back(field.key);
    for (const auto& [key, item] : found.items())
      if (std::find(known.begin(), known.end(), key) == known.end())
        throw InputError(
            childPointer(pointer, key), "The key " + quote(key) + " is not known here" + suggestion(key, known));
    const auto present = std::count_if(
        spec.exactlyOne.begin(), spec.exactlyOne.end(), [&](const std::string& key) { return found.contains(key); });
    if (!spec.exactlyOne.empty() && present != 1) {
      std::string keys;
      for (const std::string& key : spec.exactlyOne) keys += (keys.empty() ? "" : ", ") + quote(key);
      throw InputError(
          pointer, "Expected exactly one of the keys " + keys + ", found " + std::to_string(present) + ".");
    }
    Json result = Json::object();
    if (hasType) result["type"] = spec.key;
    for (const ParameterSpec& field : spec.fields) {
      const std::string place = childPointer(pointer, field.key);
      if (found.contains(field.key))
        result[field.key] = value(field, found[field.key], place);
      else if (field.required())
        throw InputError(place, "This key is missing; it gives: " + field.description);
      else if (!field.defaultValue.is_null())
        result[field.key] = value(field, defaultOf(field), place);
    }
    return result;
  }

  Json defaultOf(const ParameterSpec& spec) const {
    Json result = spec.defaultValue;
    while (spec.spatial && static_cast<int>(result.size()) > dimension_) result.erase(result.size() - 1);
    return result;
  }

  Json variant(const ParameterSpec& spec, const Json& found, const std::string& pointer) const {
    if (!found.is_object()) expected(pointer, "an object", found);
    const std::string place = childPointer(pointer, "type");
    std::vector<std::string> types;
    for (const ParameterSpec& item : spec.items) types.push_back(item.key);
    if (!found.contains("type")) {
      if (const ParameterSpec* item = spec.itemWithoutType()) return object(*item, found, pointer, true);
      throw InputError(place, "This key is missing" + suggestion("", types));
    }
    if (!found["type"].is_string()) expected(place, "a text in double quotes", found["type"]);
    const auto& type = found["type"].get_ref<const std::string&>();
    for (const ParameterSpec& item : spec.items)
      if (item.key == type) return object(item, found, pointer, true);
    throw InputError(place, "There is no " + spec.key + " of type " + quote(type) + suggestion(type, types));
  }

  int dimension_;
};

std::vector<std::string> namesIn(const Json& scene, const std::string& key) {
  std::vector<std::string> names;
  for (const Json& entry : scene[key]) names.push_back(entry["name"]);
  return names;
}

/// Checks every reference below `value`, and fills in those that may be left out.
void resolveReferences(const Json& scene, const ParameterSpec& spec, Json& value, const std::string& pointer) {
  switch (spec.kind) {
    case ValueKind::list:
      if (spec.items.front().kind == ValueKind::number || spec.items.front().kind == ValueKind::integer) return;
      for (std::size_t i = 0; i < value.size(); ++i)
        resolveReferences(scene, spec.items[std::min(i, spec.items.size() - 1)], value[i], childPointer(pointer, i));
      return;
    case ValueKind::variant:
      for (const ParameterSpec& item : spec.items)
        if (item.key == value["type"]) resolveReferences(scene, item, value, pointer);
      return;
    case ValueKind::object:
      for (const ParameterSpec& field : spec.fields) {
        const std::string place = childPointer(pointer, field.key);
        if (field.kind == ValueKind::reference && !value.contains(field.key)) {
          const std::vector<std::string> names = namesIn(scene, field.target);
          if (names.size() != 1)
            throw InputError(place, "This key is missing, and the scene has " + std::to_string(names.size()) +
                                        " entries in \"" + field.target + "\" to choose from.");
          value[field.key] = names.front();
        } else if (value.contains(field.key)) {
          resolveReferences(scene, field, value[field.key], place);
        }
      }
      return;
    case ValueKind::reference: {
      const std::vector<std::string> names = namesIn(scene, spec.target);
      const auto& name = value.get_ref<const std::string&>();
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw InputError(pointer, "There is no entry named " + quote(name) + " in \"" + spec.target + "\"" +
                                      suggestion(name, names));
      return;
    }
    default: return;
  }
}

/// The dimension is needed before anything else; if it is wrong, 3, so that the error comes at its place.
int dimensionOf(const Json& scene) {
  if (!scene.contains("dimension") || !scene["dimension"].is_number()) return 3;
  const double found = scene["dimension"].get<double>();
  return found == 1 || found == 2 ? static_cast<int>(found) : 3;
}

}  // namespace

void checkNumber(const ParameterSpec& spec, double value, const std::string& pointer) {
  checkFinite(value, pointer);
  checkRange(spec, value, value, pointer);
}

Json normalizeScene(const Json& scene) {
  const ParameterSpec& spec = sceneSpec();
  Json result = Normalizer(dimensionOf(scene)).value(spec, scene, "");
  resolveReferences(Json(result), spec, result, "");
  checkScene(result);
  return result;
}

}  // namespace pliant::scene
