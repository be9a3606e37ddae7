#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/dataset/dataset_export.h"

namespace scantrove {

/// One image of a data set as a person looks at it before it is made.
struct ExportSample {
  int place = 0, count = 0;  ///< the place-th (from 0) of `count` images; 0: the format has none
  int frame = 0;             ///< its number in the source
  int masks = 0;             ///< regions that are labelled in it
  cv::Mat picture;  ///< CV_8UC3 BGR, reduced: the colour image (without colour: its depth, near is bright),
                    ///< over it each mask in the colour of its region; empty: see `problem`
  std::string problem;  ///< why that image is not in the data set; empty: it is
};

/// The image at `place`, or the nearest there is; without `place` the one in the middle. Masks as
/// exportDataset() writes them. Error: as the scan's, in reading its regions, key frames or map.
[[nodiscard]] Result<ExportSample> sampleExport(LabeledScan& scan, const ExportOptions& options,
                                                std::optional<int> place);

}  // namespace scantrove
