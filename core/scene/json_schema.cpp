#include <cmath>

#include "core/scene/json_text.hpp"
#include "core/scene/scene.hpp"

namespace pliant::scene {

using base::ParameterSpec;
using base::ValueKind;

namespace {

Json schemaOf(const ParameterSpec& spec);

Json numberSchema(const ParameterSpec& spec) {
  Json number{{"type", "number"}};
  if (std::isfinite(spec.minimum)) number[spec.exclusiveMinimum ? "exclusiveMinimum" : "minimum"] = spec.minimum;
  if (std::isfinite(spec.maximum)) number["maximum"] = spec.maximum;
  if (spec.dimension == base::Dimension{}) return number;
  const std::string sign = spec.minimum >= 0 ? "[+]?" : "[+-]?";
  const Json text{
      {"type", "string"},
      {"pattern", "^ *" + sign + "([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?(( *[^ .0-9+-]| +1/).*)?$"}};
  return Json{{"anyOf", Json::array({number, text})}};
}

Json listSchema(const ParameterSpec& spec) {
  Json result{{"type", "array"}};
  if (spec.items.size() > 1)
    for (std::size_t i = 0; i + 1 < spec.items.size(); ++i) result["prefixItems"].push_back(schemaOf(spec.items[i]));
  result["items"] = schemaOf(spec.items.back());
  if (spec.minimumCount > 0) result["minItems"] = spec.minimumCount;
  if (spec.maximumCount < std::numeric_limits<int>::max()) result["maxItems"] = spec.maximumCount;
  return result;
}

Json objectSchema(const ParameterSpec& spec, bool hasType, bool typeRequired) {
  Json properties = Json::object(), required = Json::array();
  if (hasType) properties["type"] = {{"const", spec.key}};
  if (typeRequired) required.push_back("type");
  for (const ParameterSpec& field : spec.fields) {
    properties[field.key] = schemaOf(field);
    // A reference that may be left out is optional only where it is unique, which a schema cannot say.
    if (field.required()) required.push_back(field.key);
  }
  Json result{{"type", "object"}, {"properties", properties}};
  if (!required.empty()) result["required"] = required;
  result["additionalProperties"] = false;
  for (const std::string& key : spec.exactlyOne) result["oneOf"].push_back({{"required", Json::array({key})}});
  return result;
}

std::string descriptionWithUnit(const ParameterSpec& spec) {
  const std::string unit = spec.kind == ValueKind::number ? base::siUnit(spec.dimension) : "";
  return spec.description + (unit.empty() ? "" : " [" + unit + "]");
}

Json schemaOf(const ParameterSpec& spec) {
  Json result;
  switch (spec.kind) {
    case ValueKind::number: result = numberSchema(spec); break;
    case ValueKind::integer:
      result = {{"type", "integer"},
                {"minimum", static_cast<long>(spec.minimum)},
                {"maximum", static_cast<long>(spec.maximum)}};
      break;
    case ValueKind::boolean: result = {{"type", "boolean"}}; break;
    case ValueKind::text:
    case ValueKind::path:
    case ValueKind::reference: result = {{"type", "string"}}; break;
    case ValueKind::name:
      result = {{"type", "string"},
                {"minLength", 1},
                {"maxLength", 80},
                {"pattern", "^[^ .!-,/:-@\\[-^`{-~]([^!-,/:-@\\[-^`{-~]*[^ !-,/:-@\\[-^`{-~])?$"}};
      break;
    case ValueKind::choice: result = {{"enum", spec.choices}}; break;
    case ValueKind::list: result = listSchema(spec); break;
    case ValueKind::object: result = objectSchema(spec, false, false); break;
    case ValueKind::variant: {
      Json items = Json::array();
      for (const ParameterSpec& item : spec.items) {
        Json schema{{"title", item.key}, {"description", item.description}};
        schema.update(objectSchema(item, true, &item != spec.itemWithoutType()));
        items.push_back(schema);
      }
      result = {{"oneOf", items}};
      break;
    }
  }
  if (!spec.description.empty()) result["description"] = descriptionWithUnit(spec);
  if (!spec.defaultValue.is_null()) result["default"] = spec.defaultValue;
  return result;
}

}  // namespace

Json jsonSchema() {
  Json result{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "Pliant scene, version " + std::to_string(schemaVersion)}};
  result.update(schemaOf(sceneSpec()));
  return result;
}

}  // namespace pliant::scene
