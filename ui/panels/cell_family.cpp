#include "ui/panels/cell_family.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <map>

#include "core/scene/interlock_specs.hpp"
#include "ui/panels/value_text.hpp"

namespace pliant::panels {

QString cellFamilyTitle(const std::string& type) {
  static const std::map<std::string, const char*> titles = {
      {"four_in_one", "4-in-1 chain mail"}, {"threefold", "Threefold chain mail"}, {"square_rosette", "Square rosette"},
      {"torus_knot", "Torus knots"},        {"scale_mail", "Scale mail"},          {"ring_net", "Ring net"}};
  const auto known = titles.find(type);
  return known == titles.end() ? humanName(type) : QCoreApplication::translate("CellFamily", known->second);
}

const std::vector<CellFamily>& cellFamilies() {
  static const std::vector<CellFamily> families = [] {
    std::vector<CellFamily> found;
    for (const ParameterSpec& spec : scene::interlockingCellSpecs()) {
      const bool complete = std::none_of(spec.fields.begin(), spec.fields.end(), [](const ParameterSpec& field) {
        return field.required() && field.kind != base::ValueKind::name;
      });
      if (complete) found.push_back({spec.key, cellFamilyTitle(spec.key), QString::fromStdString(spec.description)});
    }
    return found;
  }();
  return families;
}

scene::Json sceneOfFamily(const CellFamily& family) {
  const auto study = [](const char* name, const char* type, const char* key, const scene::Json& value) {
    return scene::Json{{"name", name}, {"type", type}, {"cell", "material"}, {key, value}};
  };
  return {{"schema_version", scene::schemaVersion},
          {"title", family.title.toStdString()},
          {"description", family.sentence.toStdString()},
          {"interlocking_cells", scene::Json::array({{{"name", "material"}, {"type", family.type}}})},
          {"studies", scene::Json::array({study("stretch x", "cell_test", "direction", "0 deg"),
                                          study("stretch y", "cell_test", "direction", "90 deg"),
                                          study("free travel", "free_travel", "directions", 36),
                                          study("boundary", "stretch_boundary", "subdivisions", 3)})}};
}

}  // namespace pliant::panels
