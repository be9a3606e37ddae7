#pragma once
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/dataset_export.h"

namespace scantrove {

struct CatalogueExportSummary {
  std::filesystem::path folder;
  int objects = 0, views = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> skipped;  ///< a sentence for each object with unusable views
};

/// Writes the views of all objects of a catalogue to `folder`, atomically like exportDataset():
///     objects.json                  [{id, name, folder, views, confirmed, ...}]
///     ID_NAME/VIEW.color.png        crop of the colour image
///     ID_NAME/VIEW.mask.png         255 = of the object
///     ID_NAME/VIEW.depth.png        16 bits, millimetres, 0 = none
///     ID_NAME/VIEW.json             pose (depth camera to world, metres), direction, box, cameras
/// The catalogue is only read. `progress` is called, and `cancel` checked, before each object. Error: no
/// such catalogue, no objects, a folder that is not empty, a full disk, cancelled, ...
[[nodiscard]] Result<CatalogueExportSummary> exportCatalogue(const std::string& database,
                                                             const std::filesystem::path& folder,
                                                             const ExportProgressCallback& progress = {},
                                                             const std::stop_token& cancel = {});

}  // namespace scantrove
