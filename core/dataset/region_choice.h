#pragma once
#include <string>
#include <vector>

#include "core/dataset/export_choices.h"
#include "core/dataset/export_text.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The regions of a scan, sorted by id, in what a data set does with them.
struct RegionChoice {
  std::vector<LabeledRegion> exported;
  std::vector<LabeledRegion> unlabeled;  ///< objects without the labels that `choices` asks for
};

/// Exported are regions with a name or an object that are neither background nor rejected, as far as
/// `choices` takes their labels and classes; with `background` also background and rejected ones.
[[nodiscard]] RegionChoice chooseRegions(const std::vector<LabeledRegion>& all, bool background,
                                         const ExportChoices& choices);

/// Whether a region has a class, or a name that a person gave.
[[nodiscard]] bool isNamed(const LabeledRegion& region);

/// The display name of a region: its name, else its category, else "object 7", "background", "rejected" or
/// "region 12". Valid UTF-8.
[[nodiscard]] std::string displayName(const LabeledRegion& region);

/// The class of a region: its category, else displayName() without region numbers. Valid UTF-8.
[[nodiscard]] std::string classOf(const LabeledRegion& region);

/// `{"<region id>": {color, region, name, category, category_id, object, confirmed, background, rejected,
/// voxels, centroid_m, box_m}}`; colours as in the program's views; unknown values are null; category_id is
/// that of the catalogue. `origin`: LabeledScan::origin().
[[nodiscard]] ExportJson legendOf(const std::vector<LabeledRegion>& regions, const Eigen::Vector3d& origin);

}  // namespace scantrove
