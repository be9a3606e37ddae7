#include "core/dataset/export_instances.h"

#include <map>
#include <opencv2/core.hpp>
#include <unordered_map>
#include <utility>

#include "core/dataset/region_choice.h"

namespace scantrove {

cv::Mat ExportInstance::maskIn(const LabeledImage& image) const {
  cv::Mat mask = image.maskOf(regions.front());
  for (std::size_t i = 1; i < regions.size(); ++i) mask |= image.maskOf(regions[i]);
  return mask;
}

std::vector<ExportInstance> instancesOf(const std::vector<LabeledRegion>& regions) {
  std::vector<ExportInstance> instances;
  std::map<std::int64_t, std::size_t> of_object;
  for (const LabeledRegion& region : regions) {
    const std::size_t next = instances.size();
    const std::size_t place =
        region.object ? of_object.try_emplace(*region.object, next).first->second : next;
    if (place == next)
      instances.push_back(
          {region.id, displayName(region), classOf(region), region.class_id, region.object, {}});
    instances[place].regions.push_back(region.id);
  }
  return instances;
}

ExportJson instanceLegend(const std::vector<ExportInstance>& instances) {
  ExportJson legend = ExportJson::object();
  for (const ExportInstance& instance : instances) {
    legend[std::to_string(instance.id)] = {
        {"name", instance.name},
        {"class", instance.class_name},
        {"object", instance.object ? ExportJson(*instance.object) : ExportJson(nullptr)},
        {"regions", instance.regions}};
  }
  return legend;
}

LabeledMesh withInstanceIds(LabeledMesh mesh, const std::vector<ExportInstance>& instances) {
  std::unordered_map<std::uint32_t, std::uint32_t> instance_of;
  for (const ExportInstance& instance : instances) {
    for (const std::uint32_t region : instance.regions) instance_of[region] = instance.id;
  }
  for (SurfacePoint& vertex : mesh.vertices) {
    const auto found = instance_of.find(vertex.region);
    vertex.region = found == instance_of.end() ? 0 : found->second;
  }
  return mesh;
}

std::vector<LabeledRegion> regionsStandingFor(const std::vector<ExportInstance>& instances) {
  std::vector<LabeledRegion> regions;
  for (const ExportInstance& instance : instances) regions.emplace_back().id = instance.id;
  return regions;
}

}  // namespace scantrove
