#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/dataset/dataset_export.h"

namespace scantrove {

/// One image of a data set, as a preview before the export.
struct ExportSample {
  int index = 0, count = 0;  ///< index (from 0) among `count` images; count 0: the format has none
  int frame = 0;             ///< number in the source
  int masks = 0;             ///< labelled regions in it
  cv::Mat picture;  ///< CV_8UC3 BGR, reduced: the colour image (without colour: depth, near is bright) with
                    ///< each mask in its region's colour; empty: see `problem`
  std::string problem;  ///< why the image is not in the data set; empty: it is
};

/// The image at `index`, or the nearest one; without `index` the middle one. Masks as written by
/// exportDataset(). Error: as for reading the scan's regions, key frames or map.
[[nodiscard]] Result<ExportSample> sampleExport(LabeledScan& scan, const ExportOptions& options,
                                                std::optional<int> index);

}  // namespace scantrove
