#include "ui/panels/scene_item.hpp"

#include <algorithm>

#include "ui/document/scene_entries.hpp"
#include "ui/panels/value_text.hpp"

namespace pliant::panels {

using base::ValueKind;

namespace {

constexpr std::size_t longestList = 200;  ///< longer ones are data, not properties

class Builder {
 public:
  explicit Builder(const scene::Scene& scene) : scene_(scene) {}

  SceneItem* add(SceneItem& parent, const std::string& pointer, const QString& name, const ParameterSpec* spec) {
    auto item = std::make_unique<SceneItem>();
    item->pointer = pointer;
    item->name = name;
    item->spec = spec;
    item->parent = &parent;
    parent.children.push_back(std::move(item));
    return parent.children.back().get();
  }

  void addField(SceneItem& parent, const ParameterSpec& field) {
    const std::string pointer = parent.pointer + "/" + field.key;
    const Json value = at(scene_.normalized(), pointer);
    QString name = humanName(field.key);
    if (!field.symbol.empty()) name += QStringLiteral("  ") + QString::fromStdString(field.symbol);
    if (value.is_null() && (field.kind == ValueKind::object || field.kind == ValueKind::list)) return;
    const bool canGrow = parent.pointer.empty() && !document::entryTypes(field.key).empty();
    if (value.is_array() && value.empty() && !canGrow) return;
    SceneItem* item = add(parent, pointer, name, &field);
    if (canGrow) item->list = field.key;
    fill(*item, value);
  }

  void fill(SceneItem& item, const Json& value) {
    const ParameterSpec& spec = *item.spec;
    const bool isLine = spec.kind != ValueKind::object && spec.kind != ValueKind::variant &&
                        (spec.kind != ValueKind::list || isShortVector(value, spec));
    if (isLine) {
      item.value = displayText(value, at(scene_.json(), item.pointer), spec);
      item.editable = true;
      item.missing = value.is_null();
    } else if (spec.kind == ValueKind::list) {
      fillList(item, value);
    } else {
      fillObject(item, value, spec);
    }
  }

 private:
  static Json at(const Json& json, const std::string& pointer) {
    const Json::json_pointer path(pointer);
    return json.contains(path) ? json.at(path) : Json();
  }

  void fillList(SceneItem& item, const Json& value) {
    item.value = QString::number(value.size());
    if (value.size() > longestList) return;
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string pointer = item.pointer + "/" + std::to_string(i);
      const ParameterSpec* spec = scene::specAt(scene_, pointer);
      if (!spec) continue;
      const bool compound = value[i].is_object() || value[i].is_array();
      SceneItem* entry =
          add(item, pointer, compound ? entryName(value[i], static_cast<int>(i)) : QString::number(i), spec);
      if (item.pointer == "/studies") entry->study = entry->name;
      entry->removable = value[i].is_object() && static_cast<int>(value.size()) > item.spec->minimumCount;
      fill(*entry, value[i]);
    }
  }

  void fillObject(SceneItem& item, const Json& value, const ParameterSpec& declared) {
    const ParameterSpec* object = &declared;
    if (declared.kind == ValueKind::variant) {
      const std::string type = value.value("type", "");
      item.value = QString::fromStdString(type).replace(QLatin1Char('_'), QLatin1Char(' '));
      const auto kind = std::find_if(declared.items.begin(), declared.items.end(),
                                     [&](const ParameterSpec& candidate) { return candidate.key == type; });
      if (kind == declared.items.end()) return;
      object = &*kind;
    }
    const bool choosesOne = !object->exactlyOne.empty();
    for (const ParameterSpec& field : object->fields) {
      // A list of masses is read by their masses.
      if (field.key == "mass" && item.value.isEmpty())
        item.value = displayText(value.at("mass"), at(scene_.json(), item.pointer + "/mass"), field);
      const bool alternative = choosesOne && std::find(object->exactlyOne.begin(), object->exactlyOne.end(),
                                                       field.key) != object->exactlyOne.end();
      if (alternative && !value.contains(field.key)) continue;  // writing it would contradict the one that is there
      addField(item, field);
    }
  }

  const scene::Scene& scene_;
};

}  // namespace

int SceneItem::row() const {
  if (!parent) return 0;
  const auto& siblings = parent->children;
  return static_cast<int>(
      std::find_if(siblings.begin(), siblings.end(), [this](const auto& item) { return item.get() == this; }) -
      siblings.begin());
}

SceneItem* SceneItem::find(const std::string& wanted) {
  if (pointer == wanted) return this;
  for (const auto& child : children)
    if (SceneItem* found = child->find(wanted)) return found;
  return nullptr;
}

std::unique_ptr<SceneItem> makeSceneItems(const scene::Scene& scene) {
  auto root = std::make_unique<SceneItem>();
  Builder builder(scene);
  SceneItem* general = builder.add(*root, "", QStringLiteral("General"), nullptr);
  for (const ParameterSpec& field : scene::sceneSpec().fields) {
    if (field.key == "schema_version") continue;
    const bool group = field.kind == ValueKind::list || field.kind == ValueKind::object;
    builder.addField(group ? *root : *general, field);
  }
  return root;
}

}  // namespace pliant::panels
