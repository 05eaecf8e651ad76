#include <QComboBox>
#include <algorithm>
#include <array>
#include <set>

#include "core/base/error.hpp"
#include "core/scene/macro_builder.hpp"
#include "ui/panels/sheet_panel.hpp"

namespace pliant::panels {

using scene::Json;

namespace {

/// What says which triangles there are.
constexpr std::array<const char*, 8> outlineKeys{
    "shape", "radius", "size", "mesh", "corners", "outline", "holes", "rings"};
constexpr const char* turnedAngle = "90 deg";

bool isPainted(const Json& region) {
  return region.contains("triangles") && region.value("name", "").starts_with("painted");
}

}  // namespace

void SheetPanel::fillPaints() {
  const Json cells = document_.valueAt("/interlocking_cells");
  const Json own = document_.valueAt(pointer("cell"));
  if (!cells.is_array() || cells.empty()) return;
  const std::string sheetCell = own.is_string() ? own.get<std::string>() : cells[0].value("name", "");
  QStringList texts, names;
  int other = 0;  // another material is what is wanted, where there is one
  for (const Json& cell : cells) {
    names.append(QString::fromStdString(cell.value("name", "")));
    const bool turned = cell.value("name", "") == sheetCell;
    if (!turned) other = static_cast<int>(texts.size());
    texts.append(turned ? tr("%1, turned").arg(names.back()) : names.back());
  }
  bool same = paints_->count() == texts.size();
  for (int i = 0; same && i < paints_->count(); ++i) same = paints_->itemText(i) == texts[i];
  if (same) return;
  paints_->clear();
  for (qsizetype i = 0; i < texts.size(); ++i) {
    paints_->addItem(texts[i], names[i]);
    paints_->setItemData(static_cast<int>(i), texts[i] != names[i], Qt::UserRole + 1);
  }
  paints_->setCurrentIndex(other);
}

bool SheetPanel::canPaint() const {
  if (!result_ || paints_->count() == 0) return false;
  const Json& ran = result_->provenance.options;
  return std::all_of(outlineKeys.begin(), outlineKeys.end(),
                     [&](const char* key) { return ran.value(key, Json()) == document_.valueAt(pointer(key)); });
}

std::pair<std::vector<int>, std::vector<std::string>> SheetPanel::materialsOf(const Json& regions) const {
  std::vector<int> numbers(result_->sheet->mesh.triangles.size(), 0);
  std::vector<std::string> names{"the sheet's material"};
  for (const Json& region : regions) {
    try {
      for (const int triangle : scene::regionTriangles(region, result_->sheet->mesh))
        numbers[static_cast<std::size_t>(triangle)] = static_cast<int>(names.size());
    } catch (const base::InputError&) {
      // What runs says what is wrong with it.
    }
    names.push_back(region.value("name", ""));
  }
  return {numbers, names};
}

std::pair<std::vector<int>, std::vector<std::string>> SheetPanel::materials() const {
  return materialsOf(document_.valueAt(pointer("regions")));
}

std::pair<std::vector<int>, std::vector<std::string>> SheetPanel::paintedWith(const std::vector<int>& stroke,
                                                                              bool wipes) const {
  return materialsOf(regionsWith(stroke, wipes));
}

Json SheetPanel::regionsWith(const std::vector<int>& stroke, bool wipes) const {
  const std::set<int> touched(stroke.begin(), stroke.end());
  const std::string cell = paints_->currentData().toString().toStdString();
  const bool turned = paints_->currentData(Qt::UserRole + 1).toBool();
  const std::string name = "painted " + cell;
  Json regions = Json::array();
  std::set<int> painted;
  Json mine = {{"name", name}};
  for (const Json& region : document_.valueAt(pointer("regions"))) {
    if (!isPainted(region)) {
      regions.push_back(region);
      continue;
    }
    std::set<int> left;
    for (const int triangle : region["triangles"])
      if (!touched.contains(triangle)) left.insert(triangle);
    if (region.value("name", "") == name) {
      painted = left;
      mine = region;
      continue;
    }
    if (left.empty()) continue;
    Json other = region;
    other["triangles"] = left;
    regions.push_back(other);
  }
  if (!wipes) painted.insert(touched.begin(), touched.end());
  if (painted.empty()) return regions;
  mine["triangles"] = painted;
  if (turned) {
    // The same material in another direction: with the same numbers, and limits that need not be found again.
    mine["angle"] = turnedAngle;
    for (const char* key :
         {"stretch_limits", "bending_limits", "young_modulus", "poisson_ratio", "density", "thickness"})
      if (const Json value = document_.valueAt(pointer(key)); !value.is_null()) mine[key] = value;
  } else {
    mine["cell"] = cell;
  }
  regions.push_back(mine);
  return regions;
}

void SheetPanel::paint(const std::vector<int>& stroke, bool wipes) {
  if (!canPaint()) {
    document_.raise(base::Severity::warning, tr("Run the study with its new outline before it is painted."));
    return;
  }
  std::string place = pointer("");
  place.pop_back();
  Json changed = document_.scene().json()[Json::json_pointer(place)];
  changed["regions"] = regionsWith(stroke, wipes);
  for (const char* key : {"native", "elements"}) changed.erase(key);
  setStudyJson(changed, tr("a stroke on %1").arg(QString::fromStdString(study())));
}

}  // namespace pliant::panels
