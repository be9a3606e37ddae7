#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/dataset/key_frame_images.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// One instance for formats with one entry for each object: an object of the catalogue with all its regions,
/// or a region without object.
struct ExportInstance {
  std::uint32_t id = 0;  ///< of its first region, the lowest; the same in every export of the scan
  std::string name;      ///< displayName() of that region
  std::string class_name;
  ClassId class_id;                    ///< in the catalogue; null = the class has no place there
  std::optional<std::int64_t> object;  ///< in the catalogue
  std::vector<std::uint32_t> regions;  ///< ascending

  /// CV_8UC1, 255 = the instance.
  [[nodiscard]] cv::Mat maskIn(const LabeledImage& image) const;
};

/// The instances of `regions` (sorted by id), in the order of their first regions.
[[nodiscard]] std::vector<ExportInstance> instancesOf(const std::vector<LabeledRegion>& regions);

/// Names, regions and class by id: `{"<id>": {"name", "class", "object", "regions"}}`.
[[nodiscard]] ExportJson instanceLegend(const std::vector<ExportInstance>& instances);

/// Replaces the region of each vertex by the id of its instance; other regions become 0.
[[nodiscard]] LabeledMesh withInstanceIds(LabeledMesh mesh, const std::vector<ExportInstance>& instances);

/// A region for each instance, with its id, for functions that split surfaces by region.
[[nodiscard]] std::vector<LabeledRegion> regionsStandingFor(const std::vector<ExportInstance>& instances);

}  // namespace scantrove
