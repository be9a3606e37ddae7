#include "core/dataset/region_choice.h"

#include <algorithm>

#include "core/exchange/region_palette.h"

namespace scantrove {
namespace {

ExportJson textOrNull(const std::string& text) {
  return text.empty() ? ExportJson(nullptr) : ExportJson(validUtf8(text));
}

ExportJson listOf(const Eigen::Vector3f& v, const Eigen::Vector3d& origin) {
  if (origin.isZero(0)) return {v.x(), v.y(), v.z()};
  return {v.x() + origin.x(), v.y() + origin.y(), v.z() + origin.z()};
}

/// For a region without name and category.
std::string kindOf(const LabeledRegion& region) {
  if (region.object) return "object " + std::to_string(*region.object);
  if (region.background) return "background";
  return region.rejected ? "rejected" : "region";
}

/// Whether `choices` takes the label of a region that is not set aside.
bool hasLabel(const LabeledRegion& region, const ExportChoices& choices) {
  if (choices.labels == ExportedLabels::confirmed) return region.confirmed;
  const bool needs_name =
      choices.labels == ExportedLabels::named || choices.unlabeled == UnlabeledObjects::ignore;
  return !needs_name || isNamed(region);
}

bool isOfClasses(const LabeledRegion& region, const ExportChoices& choices) {
  return choices.classes.empty() ||
         std::ranges::find(choices.classes, classOf(region)) != choices.classes.end();
}

}  // namespace

RegionChoice chooseRegions(const std::vector<LabeledRegion>& all, bool background,
                           const ExportChoices& choices) {
  RegionChoice choice;
  for (const LabeledRegion& region : all) {
    const bool is_set_aside = region.background || region.rejected;
    if (is_set_aside ? !background : region.name.empty() && !region.object) continue;
    if (!is_set_aside && !hasLabel(region, choices)) {
      choice.unlabeled.push_back(region);
    } else if (isOfClasses(region, choices)) {
      choice.exported.push_back(region);
    }
  }
  for (std::vector<LabeledRegion>* regions : {&choice.exported, &choice.unlabeled})
    std::ranges::sort(*regions, {}, &LabeledRegion::id);
  return choice;
}

bool isNamed(const LabeledRegion& region) {
  return (!region.name.empty() && !region.is_program_name) || !region.category.empty();
}

std::string displayName(const LabeledRegion& region) {
  if (!region.name.empty()) return validUtf8(region.name);
  if (!region.category.empty()) return validUtf8(region.category);
  const std::string kind = kindOf(region);
  return kind == "region" ? kind + " " + std::to_string(region.id) : kind;
}

std::string classOf(const LabeledRegion& region) {
  if (!region.category.empty()) return validUtf8(region.category);
  return region.name.empty() ? kindOf(region) : validUtf8(region.name);
}

ExportJson legendOf(const std::vector<LabeledRegion>& regions, const Eigen::Vector3d& origin) {
  ExportJson legend = ExportJson::object();
  for (const LabeledRegion& region : regions) {
    ExportJson box = nullptr;
    if (!region.box_world_m.isEmpty())
      box = {listOf(region.box_world_m.min(), origin), listOf(region.box_world_m.max(), origin)};
    legend[std::to_string(region.id)] = {
        {"color", regionColor(RegionId{region.id})},
        {"region", region.id},
        {"name", textOrNull(region.name)},
        {"category", textOrNull(region.category)},
        {"category_id", region.class_id ? ExportJson(region.class_id.value) : ExportJson(nullptr)},
        {"object", region.object ? ExportJson(*region.object) : ExportJson(nullptr)},
        {"confirmed", region.confirmed},
        {"background", region.background},
        {"rejected", region.rejected},
        {"voxels", region.voxels},
        {"centroid_m", listOf(region.centroid_world_m, origin)},
        {"box_m", box}};
  }
  return legend;
}

}  // namespace scantrove
