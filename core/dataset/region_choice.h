#pragma once
#include <string>
#include <vector>

#include "core/dataset/export_text.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The regions that count, by id: those with a name or an object that are neither background nor rejected;
/// with `background` also all that are one of these.
[[nodiscard]] std::vector<LabeledRegion> chooseRegions(const std::vector<LabeledRegion>& all,
                                                       bool background);

/// What a region is called: its name, else its category, else "object 7", "background", "rejected" or
/// "region 12". Valid UTF-8.
[[nodiscard]] std::string displayName(const LabeledRegion& region);

/// The class it belongs to: its category, else as displayName() without numbers of regions. Valid UTF-8.
[[nodiscard]] std::string classOf(const LabeledRegion& region);

/// Classes of `regions`, each once, in alphabetical order.
[[nodiscard]] std::vector<std::string> classesOf(const std::vector<LabeledRegion>& regions);

/// Position of `name` in `classes`, where it is.
[[nodiscard]] int classIndex(const std::vector<std::string>& classes, const std::string& name);

/// `{"<region id>": {color, region, name, category, object, confirmed, background, rejected, voxels,
/// centroid_m, box_m}}`; colours as in the program's views; what is not known is null. `origin`:
/// LabeledScan::origin().
[[nodiscard]] ExportJson legendOf(const std::vector<LabeledRegion>& regions, const Eigen::Vector3d& origin);

}  // namespace scantrove
