#include "ui/panels/sheet_outline.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace pliant::panels {

using scene::Json;

namespace {

/// And what names its triangles.
void eraseOutline(Json& study) {
  for (const char* key : {"radius", "size", "mesh", "corners", "outline", "holes"}) study.erase(key);
  if (!study.contains("regions")) return;
  Json kept = Json::array();
  for (const Json& region : study["regions"])
    if (!region.contains("triangles")) kept.push_back(region);
  study["regions"] = kept;
}

/// Whether "rings" are counted along a side and not from the middle.
bool countsAcross(const Json& study) {
  const std::string shape = study.value("shape", "disk");
  return shape == "rectangle" || shape == "outline";
}

}  // namespace

int ringsOf(const Json& study) {
  const int rings = study.at("rings");
  return countsAcross(study) ? std::max(1, (rings + 1) / 2) : rings;
}

std::optional<double> extentOf(const Json& study) {
  if (study.contains("radius")) return 2 * study["radius"].get<double>();
  if (study.contains("size")) return std::max(study["size"][0].get<double>(), study["size"][1].get<double>());
  if (!study.contains("corners")) return std::nullopt;
  double extent = 0;
  for (const int axis : {0, 1}) {
    double least = INFINITY, most = -INFINITY;
    for (const Json& corner : study["corners"]) {
      least = std::min(least, corner[static_cast<std::size_t>(axis)].get<double>());
      most = std::max(most, corner[static_cast<std::size_t>(axis)].get<double>());
    }
    extent = std::max(extent, most - least);
  }
  return extent;
}

Json withOutline(Json study, SheetOutline outline, double extent, int rings) {
  eraseOutline(study);
  study["rings"] = outline == SheetOutline::square ? 2 * rings : rings;
  if (outline == SheetOutline::square) {
    study["shape"] = "rectangle";
    study["size"] = {extent, extent};
  } else {
    study["shape"] = outline == SheetOutline::disk ? "disk" : "hexagon";
    study["radius"] = 0.5 * extent;
  }
  return study;
}

Json withOutlineFrom(Json study, const std::filesystem::path& file, const std::filesystem::path& folder) {
  eraseOutline(study);
  std::string extension = file.extension().string();
  std::transform(
      extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  const bool mesh = extension == ".ply" || extension == ".stl";
  study["shape"] = mesh ? "mesh" : "outline";
  study[mesh ? "mesh" : "outline"] =
      (folder.empty() ? std::filesystem::absolute(file) : file.lexically_proximate(folder)).generic_string();
  study.erase("native");
  return study;
}

}  // namespace pliant::panels
