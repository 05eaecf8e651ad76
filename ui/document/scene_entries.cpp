#include "ui/document/scene_entries.hpp"

#include <algorithm>
#include <cmath>

namespace pliant::document {

namespace {

using base::ParameterSpec;
using base::ValueKind;
using scene::Json;

/// Null if it is no list that can grow.
const ParameterSpec* listSpec(const std::string& list) {
  for (const ParameterSpec& field : scene::sceneSpec().fields)
    if (field.key == list && field.kind == ValueKind::list && field.key != "expected") return &field;
  return nullptr;
}

bool isTaken(const Json& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const Json& entry) { return entry.value("name", "") == name; });
}

/// "drive", or "drive 2" where that is taken.
std::string freeName(const Json& list, const std::string& wanted) {
  if (!isTaken(list, wanted)) return wanted;
  int number = 2;
  while (isTaken(list, wanted + " " + std::to_string(number))) ++number;
  return wanted + " " + std::to_string(number);
}

/// To a micrometre: enough to find a node again, and readable.
double shortened(double metres) { return std::round(metres * 1e6) / 1e6; }

class Defaults {
 public:
  Defaults(const scene::Scene& scene, const mechanics::Model& model, int node)
      : scene_(scene.normalized()), model_(model), node_(node) {}

  Json make(const std::string& list, const std::string& type) const {
    if (list == "geometry") return geometry(type);
    if (list == "interlocking_cells") return type == "composed" ? composedCell() : Json::object();  // all have defaults
    if (list == "materials") return {{"density", "1200 kg/m^3"}, {"young_modulus", "3 GPa"}, {"poisson_ratio", 0.35}};
    if (list == "elements") return element(type);
    if (list == "parameters") return parameter();
    if (list == "point_masses") return {{"at", at(node_)}, {"mass", mass()}};
    if (list == "springs") return spring(type);
    if (list == "boundary_conditions" || list == "probes") return {{"at", at(node_)}};
    if (list == "drives") {
      if (type == "servo") {
        Json entry = joint();
        entry["harmonics"] = Json::array({{{"amplitude", "5 deg"}}});
        return entry;
      }
      if (type == "rotation") return {{"at", at(node_)}, {"harmonics", Json::array({{{"amplitude", "5 deg"}}})}};
      return {{"at", at(node_)}, {"direction", lastAxis(1)}, {"harmonics", Json::array({{{"amplitude", "1 mm"}}})}};
    }
    if (list == "loads") {
      if (type == "gravity") return {{"acceleration", lastAxis(-9.81)}};
      return {{"at", at(node_)}, {"direction", lastAxis(1)}, {"harmonics", Json::array({{{"amplitude", "1 mN"}}})}};
    }
    return study(type);
  }

 private:
  /// Flat rings joined by upright ones.
  static Json composedCell() {
    const Json ring = {{"type", "circle"}, {"ring_radius", "4 mm"}, {"radius", "0.6 mm"}};
    const auto upright = [](Json position, Json axis) {
      return Json{{"shape", "ring"},
                  {"position", std::move(position)},
                  {"rotation", {{"axis", std::move(axis)}, {"angle", "90 deg"}}}};
    };
    const auto link = [](int b, Json shift, int number) {
      return Json{{"a", 0}, {"b", b}, {"shift", std::move(shift)}, {"number", number}};
    };
    return {
        {"lattice", {{"12 mm", 0}, {0, "12 mm"}}},
        {"shapes", Json::array({{{"name", "ring"}, {"pieces", Json::array({ring})}}})},
        {"elements",
         Json::array({{{"shape", "ring"}}, upright({"6 mm", 0, 0}, {1, 0, 0}), upright({0, "6 mm", 0}, {0, 1, 0})})},
        {"links", Json::array({link(1, {0, 0}, -1), link(1, {-1, 0}, 1), link(2, {0, 0}, -1), link(2, {0, -1}, 1)})}};
  }

  Json at(int node) const {
    Json place = Json::array();
    for (int axis = 0; axis < model_.dimension; ++axis)
      place.push_back(shortened(model_.restPositions[node * model_.dimension + axis]));
    Json selection = Json::object();
    if (model_.parts.size() > 1)
      for (const auto& part : model_.parts)
        if (node >= part.firstNode && node < part.firstNode + part.nodeCount) selection["geometry"] = part.name;
    selection["nearest"] = place;
    return selection;
  }

  Json lastAxis(double value) const {
    Json vector = Json::array();
    for (int axis = 0; axis < model_.dimension; ++axis) vector.push_back(axis + 1 == model_.dimension ? value : 0.0);
    return vector;
  }

  Json geometry(const std::string& type) const {
    if (type == "fork")
      return {{"handle_length", "60 mm"}, {"prong_length", "90 mm"}, {"width", "20 mm"}, {"spacing", "40 mm"},
              {"handle_cells", 5},        {"prong_cells", 8},        {"width_cells", 2}};
    if (type == "strip" || type == "grid")
      return {{"length", "100 mm"}, {"width", "20 mm"}, {"length_cells", 10}, {"width_cells", 2}};
    const auto point = [&](double x, double y) {
      Json place = Json::array();
      for (int axis = 0; axis < model_.dimension; ++axis) place.push_back(axis == 0 ? x : axis == 1 ? y : 0.0);
      return place;
    };
    if (type == "blocks")
      return {{"cell", Json::array({"10 mm", "10 mm", "10 mm"})},
              {"blocks", Json::array({{{"name", "block"},
                                       {"minimum", Json::array({0, 0, 0})},
                                       {"maximum", Json::array({"50 mm", "20 mm", "20 mm"})}}})}};
    if (type == "mesh")
      return {{"points", Json::array({point(0, 0), point(0.1, 0), point(0, 0.1)})},
              {"triangles", Json::array({Json::array({0, 1, 2})})}};
    return {{"points", Json::array({point(0, 0)})}};
  }

  /// The node `others` further than the selected one, going around.
  int next(int others) const { return (node_ + others) % model_.nodeCount(); }

  /// A joint at the selected node between the links to the next two.
  Json joint() const { return {{"joint", at(node_)}, {"from", at(next(1))}, {"to", at(next(2))}}; }

  /// The first number of the scene that shapes the model.
  Json parameter() const {
    for (const char* pointer : {"/elements/0/thickness", "/elements/0/diameter", "/springs/0/coefficients/0",
                                "/materials/0/young_modulus", "/drives/0/harmonics/0/amplitude"})
      if (scene_.contains(Json::json_pointer(pointer))) return {{"pointer", pointer}};
    return {{"pointer", "/damping/mass_proportional"}, {"minimum", 0}, {"maximum", 1}};
  }

  Json element(const std::string& type) const {
    Json entry = Json::object();
    if (type == "link") return {{"joints", Json::array({0, 1})}};
    if (type == "rigid_angle") return {{"joints", Json::array({0, 1, 2})}};
    // A body on the newest geometry: the earlier ones have theirs.
    for (const auto& [key, list] : {std::pair{"geometry", "geometry"}, std::pair{"material", "materials"}})
      if (scene_.at(list).size() > 1) entry[key] = scene_.at(list).back().at("name");
    if (type == "rod") {
      entry["diameter"] = "1 mm";
    } else if (type == "flat_rod") {
      entry["width"] = "5 mm";
      entry["height"] = "1 mm";
      entry["director"] = lastAxis(1);
    } else if (type != "solid") {
      entry["thickness"] = "0.5 mm";
    }
    return entry;
  }

  Json spring(const std::string& type) const {
    const Json coefficients = Json::array({"100 N/m"});
    if (type == "torsion") {
      Json entry = joint();
      entry["stiffness"] = "0.1 N m/rad";
      return entry;
    }
    if (type == "local")
      return {{"from", {{"type", "node"}, {"at", at(node_)}}},
              {"to", {{"type", "node"}, {"at", at(next(1))}}},
              {"coefficients", coefficients}};
    if (type == "between")
      return {{"from", at(node_)},
              {"to", at(node_ + 1 < model_.nodeCount() ? node_ + 1 : 0)},
              {"coefficients", coefficients}};
    if (type == "anchored") {
      Json anchor = at(node_).at("nearest");
      anchor.back() = anchor.back().get<double>() + 0.05;
      return {{"at", at(node_)}, {"anchor", anchor}, {"coefficients", coefficients}};
    }
    return {{"at", at(node_)}, {"direction", lastAxis(1)}, {"coefficients", coefficients}};
  }

  /// Like the last one, so that a slider is of a fitting size.
  Json mass() const {
    const Json& masses = scene_.at("point_masses");
    const double last = masses.empty() ? 0.0 : masses.back().at("mass").get<double>();
    return base::formatQuantity(last > 0 ? last : 1e-3, base::dimensions::mass);
  }

  Json study(const std::string& type) const {
    double from = 1, to = 20, at = 10;
    for (const Json& other : scene_.at("studies")) {
      if (other.contains("frequency")) at = other.at("frequency");
      if (other.contains("from")) {
        from = other.at("from");
        to = other.at("to");
      }
    }
    Json entry = Json::object();
    const ParameterSpec* spec = listSpec("studies");
    for (const ParameterSpec& kind : spec->items.front().items)
      if (kind.key == type)
        for (const ParameterSpec& field : kind.fields) {
          if (field.key == "frequency") entry["frequency"] = at;
          if (field.key == "from") entry["from"] = from;
          if (field.key == "to") entry["to"] = to;
        }
    if (type == "backbone") {
      const double extent = model_.restPositions.maxCoeff() - model_.restPositions.minCoeff();
      entry["maximum_amplitude"] = extent > 0 ? 0.1 * extent : 0.1;
    }
    return entry;
  }

  const Json& scene_;
  const mechanics::Model& model_;
  int node_;
};

void writeReferences(const scene::Scene& scene, const std::string& list, const std::string& pointer, Json& written) {
  const Json& normalized = scene.normalized().at(Json::json_pointer(pointer));
  if (written.is_array()) {
    for (std::size_t i = 0; i < written.size() && written[i].is_structured(); ++i)
      writeReferences(scene, list, pointer + "/" + std::to_string(i), written[i]);
    return;
  }
  const ParameterSpec* spec = scene::specAt(scene, pointer);
  if (!spec || !written.is_object()) return;
  for (const ParameterSpec& field : spec->fields) {
    const bool refers = field.kind == ValueKind::reference && field.target == list;
    if (refers && !written.contains(field.key) && normalized.contains(field.key))
      written[field.key] = normalized.at(field.key);
    else if (written.contains(field.key) && written[field.key].is_structured())
      writeReferences(scene, list, pointer + "/" + field.key, written[field.key]);
  }
}

std::string nameOf(const std::string& list, const std::string& type) {
  if (list == "springs") return "spring";
  if (list == "drives") return "drive";
  if (list == "point_masses") return "mass";
  if (list == "materials") return "material";
  if (list == "boundary_conditions") return "lock";
  if (type == "harmonic_force") return "force";
  if (type == "periodic_motion") return "motion";
  if (type == "frequency_response") return "response";
  if (type == "linear_modes") return "modes";
  return type;
}

}  // namespace

std::vector<std::string> entryTypes(const std::string& list) {
  const ParameterSpec* spec = listSpec(list);
  if (!spec) return {};
  const ParameterSpec& item = spec->items.front();
  if (item.kind != ValueKind::variant) return {item.key};
  std::vector<std::string> types;
  for (const ParameterSpec& type : item.items)
    if (type.key != "file") types.push_back(type.key);
  return types;
}

Json defaultEntry(const scene::Scene& scene, const mechanics::Model& model, const std::string& list,
                  const std::string& type, int node) {
  const Json& normalized = scene.normalized();
  Json entry{{"name", freeName(normalized.at(list), nameOf(list, type))}};
  const ParameterSpec* spec = listSpec(list);
  if (spec && spec->items.front().kind == ValueKind::variant) entry["type"] = type;
  entry.update(Defaults(scene, model, std::clamp(node, 0, model.nodeCount() - 1)).make(list, type));
  return entry;
}

void addBodyOf(Json& written, const Json& geometry, int dimension) {
  const auto list = [&](const char* key) -> Json& {
    Json& entries = written[key];
    if (entries.is_null()) entries = Json::array();
    return entries;
  };
  const std::string name = geometry.at("name");
  if (geometry.at("type") == "points") {
    Json nodes = Json::array();
    for (std::size_t i = 0; i < geometry.at("points").size(); ++i) nodes.push_back(i);
    Json& masses = list("point_masses");
    masses.push_back(
        {{"name", freeName(masses, name)}, {"at", {{"geometry", name}, {"nodes", nodes}}}, {"mass", "1 g"}});
    return;
  }
  Json& materials = list("materials");
  if (materials.empty())
    materials.push_back(
        {{"name", "material"}, {"density", "1200 kg/m^3"}, {"young_modulus", "3 GPa"}, {"poisson_ratio", 0.35}});
  Json& elements = list("elements");
  Json element = elements.empty() ? Json{{"type", dimension == 3 ? "shell" : "membrane"}, {"thickness", "0.5 mm"}}
                                  : elements.back();
  element["name"] = freeName(elements, name);
  element["geometry"] = name;
  if (!element.contains("material")) element["material"] = materials.back().at("name");
  elements.push_back(std::move(element));
}

Json withReferencesWritten(const scene::Scene& scene, const std::string& list) {
  Json written = scene.json();
  writeReferences(scene, list, "", written);
  return written;
}

Json withoutEntry(const scene::Scene& scene, const std::string& list, std::size_t index) {
  Json written = scene.json();
  if (list == "studies" && written.contains("expected")) {
    Json& expected = written["expected"];
    const Json name = written[list][index]["name"];
    expected.erase(std::remove_if(expected.begin(), expected.end(),
                                  [&](const Json& value) { return value.value("study", Json()) == name; }),
                   expected.end());
  }
  written[list].erase(index);
  return written;
}

Json copiedEntry(const Json& list, std::size_t index) {
  Json entry = list.at(index);
  if (!entry.is_object() || !entry.contains("name")) return entry;
  std::string name = entry.at("name").get<std::string>();
  // "tip 2" is copied to "tip 3", not to "tip 2 2".
  const std::size_t space = name.find_last_of(' ');
  if (space != std::string::npos && space + 1 < name.size() &&
      std::all_of(name.begin() + static_cast<long>(space) + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; }))
    name.erase(space);
  entry["name"] = freeName(list, name);
  return entry;
}

}  // namespace pliant::document
