#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <algorithm>

#include "ui/panels/sheet_panel.hpp"

namespace pliant::panels {

using scene::Json;

std::string SheetPanel::pointer(const char* key) const {
  const auto& studies = document_.studies();
  const auto found =
      std::find_if(studies.begin(), studies.end(), [&](const auto& each) { return each.name == study(); });
  return "/studies/" + std::to_string(found - studies.begin()) + "/" + key;
}

void SheetPanel::take(int picked) {
  if (!result_) return;
  if (clicks() == Clicks::read) {
    triangle_ = picked < 0 ? std::nullopt : std::optional(picked);
    refreshSpace();
  } else if (picked >= 0 && clicks() == Clicks::clamp) {
    toggleAt(picked, "clamps", Json::object(), tr("clamps of %1").arg(QString::fromStdString(study())));
  } else if (picked >= 0) {
    toggleAt(
        picked, "loads", {{"force", {0, 0, force_->value()}}}, tr("loads of %1").arg(QString::fromStdString(study())));
  }
}

void SheetPanel::toggleAt(int node, const char* key, const Json& entry, const QString& text) {
  const auto& places = result_->sheet->mesh.points;
  const auto nodeAt = [&](const Json& place) {
    Eigen::Index nearest = 0;
    (places.topRows<2>().colwise() - Eigen::Vector2d(place[0], place[1])).colwise().squaredNorm().minCoeff(&nearest);
    return static_cast<int>(nearest);
  };
  Json entries = Json::array();
  bool taken = false;
  for (const Json& each : document_.valueAt(pointer(key))) {
    if (nodeAt(each["point"]) == node)
      taken = true;
    else
      entries.push_back(each);
  }
  if (!taken) {
    Json added = entry;
    added["point"] = {places(0, node), places(1, node)};
    entries.push_back(added);
  }
  document_.setValue(pointer(key), entries, text);
}

void SheetPanel::setStudyJson(const Json& study, const QString& text) {
  std::string place = pointer("");
  place.pop_back();  // the slash
  document_.setValue(place, study, text);
}

void SheetPanel::setOutline(SheetOutline outline) {
  std::string place = pointer("");
  place.pop_back();
  const Json complete = document_.valueAt(place);
  if (complete.is_null()) return;
  double extent = extentOf(complete).value_or(0);
  if (extent == 0 && result_) {  // of a file that has been read
    const auto& points = result_->sheet->mesh.points;
    extent = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
  }
  if (extent == 0) {
    document_.raise(base::Severity::warning, tr("How large the outline from the file is, is known when it has run."));
    return;
  }
  const Json written = document_.scene().json()[Json::json_pointer(place)];
  setStudyJson(withOutline(written, outline, extent, ringsOf(complete)),
               tr("the outline of %1").arg(QString::fromStdString(study())));
}

void SheetPanel::chooseOutlineFile() {
  const QString file = QFileDialog::getOpenFileName(this, tr("Outline of the piece"),
                                                    QString::fromStdString(document_.scene().directory().string()),
                                                    tr("Outlines (*.csv *.obj);;Flat meshes (*.ply *.stl)"));
  if (!file.isEmpty()) setOutlineFrom(file);
}

void SheetPanel::setOutlineFrom(const QString& file) {
  std::string place = pointer("");
  place.pop_back();
  const Json written = document_.scene().json()[Json::json_pointer(place)];
  setStudyJson(withOutlineFrom(written, file.toStdString(), document_.scene().directory()),
               tr("the outline of %1").arg(QString::fromStdString(study())));
}

void SheetPanel::addLoadSteps() {
  constexpr int loadSteps = 10;
  if (document_.setValue(pointer("load_steps"), loadSteps, tr("load steps of %1").arg(QString::fromStdString(study()))))
    Q_EMIT studiesRequested({study()});
}

void SheetPanel::addFamily(Family family) {
  const std::string first = study();
  const bool finer = family == Family::refinement;
  Json studies = document_.scene().json()["studies"];
  const auto entry =
      std::find_if(studies.begin(), studies.end(), [&](const Json& each) { return each["name"] == first; });
  if (entry == studies.end()) return;
  const Json pattern = *entry;
  const Json normalized = document_.valueAt(pointer(finer ? "rings" : "young_modulus"));
  if (finer && pattern.value("shape", "disk") == "mesh") {
    document_.raise(base::Severity::warning, tr("A mesh from a file is not made finer here."));
    return;
  }
  const Json regions = pattern.value("regions", Json::array());
  if (finer && std::ranges::any_of(regions, [](const Json& region) { return region.contains("triangles"); })) {
    document_.raise(
        base::Severity::warning,
        tr("What is painted on the triangles of this sheet does not fit finer ones: give its regions corners."));
    return;
  }
  std::vector<std::string> names{first};
  bool changed = false;
  for (const int factor : {4, 16}) {
    const std::string name = first + " " + std::to_string(factor) + (finer ? "x triangles" : "x stiffness");
    names.push_back(name);
    if (document_.study(name)) continue;
    Json made = pattern;
    made["name"] = name;
    made["native"] = false;
    made.erase("load_steps");
    if (finer)
      made["rings"] = normalized.get<int>() * (factor == 4 ? 2 : 4);
    else
      made["young_modulus"] = normalized.get<double>() * factor;
    studies.push_back(made);
    changed = true;
  }
  if (changed && !document_.setValue("/studies", studies, tr("a series of %1").arg(QString::fromStdString(first))))
    return;
  showDeflections();
  setStudy(first);
  Q_EMIT studiesRequested(names);
}

}  // namespace pliant::panels
