#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

struct ImageEvaluation {
  std::string folder;                 ///< NAME-color.*, NAME-depth.png, NAME-label.png (mOSD, HOTS)
  std::string device;                 ///< of OpenCL; empty: the default
  std::vector<std::string> settings;  ///< KEY=VALUE
  std::string output;                 ///< takes NAME-labels.png of each image; empty: none are written
};

/// Scans each image pair of a folder alone, as a scan of one frame, and compares its regions with the true
/// instances: their coverage by the best region, and the share over half, all and by size. Labels of mOSD
/// (all under 100) number instance and part: LABEL / 10, those under 10 are the table. Error: the folder, an
/// image or the device cannot be used.
[[nodiscard]] Result<nlohmann::ordered_json> evaluateImages(const ImageEvaluation& request);

}  // namespace scantrove
