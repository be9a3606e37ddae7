#pragma once
#include <string>
#include <vector>

#include "core/dataset/export_text.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The regions to export, by id: those with a name or an object that are neither background nor rejected;
/// with `background` also these.
[[nodiscard]] std::vector<LabeledRegion> chooseRegions(const std::vector<LabeledRegion>& all,
                                                       bool background);

/// The display name of a region: its name, else its category, else "object 7", "background", "rejected" or
/// "region 12". Valid UTF-8.
[[nodiscard]] std::string displayName(const LabeledRegion& region);

/// The class of a region: its category, else displayName() without region numbers. Valid UTF-8.
[[nodiscard]] std::string classOf(const LabeledRegion& region);

/// Classes of `regions` without duplicates, in alphabetical order.
[[nodiscard]] std::vector<std::string> classesOf(const std::vector<LabeledRegion>& regions);

/// Index of `name` in `classes`, which must contain it.
[[nodiscard]] int classIndex(const std::vector<std::string>& classes, const std::string& name);

/// `{"<region id>": {color, region, name, category, object, confirmed, background, rejected, voxels,
/// centroid_m, box_m}}`; colours as in the program's views; unknown values are null. `origin`:
/// LabeledScan::origin().
[[nodiscard]] ExportJson legendOf(const std::vector<LabeledRegion>& regions, const Eigen::Vector3d& origin);

}  // namespace scantrove
