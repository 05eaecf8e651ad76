#include "core/scene/format_tables.hpp"

#include <algorithm>
#include <cmath>

#include "core/scene/scene.hpp"

namespace pliant::scene {

using base::ParameterSpec;
using base::ValueKind;

namespace {

std::string code(const std::string& text) { return "`" + text + "`"; }

bool isSelection(const ParameterSpec& spec) { return spec.exactlyOne.size() == 4; }
bool isSignal(const ParameterSpec& spec) {
  return spec.kind == ValueKind::list && spec.items.front().key == "harmonic";
}

bool isMotion(const ParameterSpec& spec) {
  return spec.kind == ValueKind::list && spec.items.front().key == "keyframe";
}

std::string kindOf(const ParameterSpec& spec) {
  switch (spec.kind) {
    case ValueKind::number: {
      const std::string unit = base::siUnit(spec.dimension);
      return unit.empty() ? "number" : "number [" + unit + "]";
    }
    case ValueKind::integer: return "whole number";
    case ValueKind::boolean: return "`true` or `false`";
    case ValueKind::text: return "text";
    case ValueKind::name: return "name";
    case ValueKind::reference: return "name in " + code(spec.target);
    case ValueKind::choice: {
      std::string all;
      for (const std::string& choice : spec.choices) all += (all.empty() ? "" : ", ") + code('"' + choice + '"');
      return all;
    }
    case ValueKind::path: return "path";
    case ValueKind::list: {
      if (isSignal(spec)) {
        const auto& fields = spec.items.front().fields;
        const auto amplitude = std::find_if(
            fields.begin(), fields.end(), [](const ParameterSpec& field) { return field.key == "amplitude"; });
        return "[harmonics](#harmonics) [" + base::siUnit(amplitude->dimension) + "]";
      }
      if (isMotion(spec)) return "list of [keyframes](#keyframes)";
      const ParameterSpec& item = spec.items.front();
      const std::string unit = base::siUnit(item.dimension);
      if (spec.spatial) return unit.empty() ? "vector" : "vector [" + unit + "]";
      if (item.kind == ValueKind::object || item.kind == ValueKind::variant) return "list";
      const std::string count = spec.minimumCount == spec.maximumCount ? std::to_string(spec.minimumCount) + " " : "";
      return (count.empty() ? "list of " : "list of " + count) + kindOf(item);
    }
    case ValueKind::object: return isSelection(spec) ? "[selection](#selections)" : "object";
    case ValueKind::variant: return "object";
  }
  return "";
}

std::string rangeOf(const ParameterSpec& spec) {
  if (spec.kind != ValueKind::number && spec.kind != ValueKind::integer) return "";
  const auto show = [&](double bound) {
    return spec.kind == ValueKind::integer ? std::to_string(static_cast<long>(bound))
                                           : base::formatQuantityExactly(bound, {});
  };
  if (std::isinf(spec.minimum)) return "";
  if (std::isinf(spec.maximum)) return (spec.exclusiveMinimum ? ", above " : ", at least ") + show(spec.minimum);
  if (spec.minimum == spec.maximum) return "";
  return ", " + show(spec.minimum) + " to " + show(spec.maximum);
}

std::string defaultOf(const ParameterSpec& spec) {
  if (spec.required()) return "**required**";
  if (spec.defaultValue.is_null()) return "";
  return code(spec.defaultValue.dump());
}

void addTable(const ParameterSpec& spec, std::string& out) {
  out += "\n| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const ParameterSpec& field : spec.fields) {
    const std::string symbol = field.symbol.empty() ? "" : " " + field.symbol;
    out += "| " + code(field.key) + symbol + " | " + kindOf(field) + rangeOf(field) + " | " + defaultOf(field) + " | " +
           field.description + " |\n";
  }
}

/// Tables of the objects inside `spec` that have no table of their own elsewhere.
void addInner(const ParameterSpec& spec, std::string& out) {
  for (const ParameterSpec& field : spec.fields) {
    if (field.kind == ValueKind::object && !isSelection(field)) {
      out += "\n" + code(field.key) + ":\n";
      addTable(field, out);
    } else if (field.kind == ValueKind::list && field.items.front().kind == ValueKind::object && !isSignal(field) &&
               !isMotion(field)) {
      out += "\nEach of " + code(field.key) + ":\n";
      addTable(field.items.front(), out);
      addInner(field.items.front(), out);
    } else if (field.kind == ValueKind::list && field.items.front().kind == ValueKind::variant) {
      for (const ParameterSpec& item : field.items.front().items) {
        out +=
            "\nOf " + code(field.key) + ", " + code("\"type\": \"" + item.key + "\"") + ": " + item.description + "\n";
        addTable(item, out);
        addInner(item, out);
      }
    }
  }
}

void addHeading(const std::string& key, const std::string& description, std::string& out) {
  out += "\n### " + key + "\n\n" + description + "\n";
}

void addEntries(const ParameterSpec& field, std::string& out) {
  const ParameterSpec& entry = field.items.front();
  addHeading(field.key, entry.description, out);
  if (entry.kind == ValueKind::object) {
    addTable(entry, out);
    return;
  }
  for (const ParameterSpec& item : entry.items) {
    out += "\n**" + code("\"type\": \"" + item.key + "\"") + "**" +
           (&item == entry.itemWithoutType() ? " (may be left out)" : "") + ": " + item.description + "\n";
    addTable(item, out);
    if (&item == &entry.items.front() || field.key != "geometry") addInner(item, out);
  }
}

const ParameterSpec* find(const ParameterSpec& spec, bool (*matches)(const ParameterSpec&)) {
  if (matches(spec)) return &spec;
  for (const auto* children : {&spec.fields, &spec.items})
    for (const ParameterSpec& child : *children)
      if (const ParameterSpec* found = find(child, matches)) return found;
  return nullptr;
}

}  // namespace

std::string formatTables() {
  const ParameterSpec& scene = sceneSpec();
  std::string out = "### The scene\n";
  addTable(scene, out);
  for (const ParameterSpec& field : scene.fields) {
    if (field.kind == ValueKind::list) {
      addEntries(field, out);
    } else if (field.kind == ValueKind::object) {
      addHeading(field.key, field.description, out);
      addTable(field, out);
    }
  }
  addHeading(
      "Selections", "Exactly one of `nodes`, `group`, `nearest` and `box` says which nodes; none is an error.", out);
  const ParameterSpec* selection = find(scene, isSelection);
  addTable(*selection, out);
  addInner(*selection, out);
  addHeading(
      "Harmonics",
      "A list of terms; their sum Σ amplitude cos(order τ + phase), τ = ω t, is the value over time. The amplitude "
      "has the unit that the table above names.",
      out);
  addTable(find(scene, isSignal)->items.front(), out);
  const ParameterSpec& keyframe = find(scene, isMotion)->items.front();
  addHeading("Keyframes", keyframe.description, out);
  addTable(keyframe, out);
  return out;
}

}  // namespace pliant::scene
