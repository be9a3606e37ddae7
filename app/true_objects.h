#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "app/label_images.h"
#include "core/evaluation/catalogue_metrics.h"

namespace scantrove {

/// Ground truth of a recording: instance images and their objects.
struct TrueScene {
  NumberedImages images;  ///< of the scanned frames
  std::map<int, TrueObject> objects;
  std::map<int, std::string> names;  ///< of all named instances
};

/// Reads an instances.json into the names and objects of `scene`, with the extents that it gives. False: the
/// file does not exist. Error: names it.
[[nodiscard]] Result<bool> readInstanceList(const std::filesystem::path& file, TrueScene& scene);

/// Reads instances.json of a recording; without it every instance is an object. Counts how often each object
/// is visible in the instance images of scanned frames. Measures sizes missing in instances.json from depth
/// and poses. Error: a file is invalid (the message names it); no frame was scanned; a size is missing and
/// the folder has no depth and poses.
[[nodiscard]] Result<TrueScene> readTrueScene(const std::filesystem::path& folder,
                                              const std::function<bool(long)>& isScanned);

}  // namespace scantrove
