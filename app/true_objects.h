#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "app/label_images.h"
#include "core/evaluation/catalogue_metrics.h"

namespace scantrove {

/// Who is who in the instance images of a recording.
struct TrueScene {
  NumberedImages images;  ///< of the frames that count
  std::map<int, TrueObject> objects;
  std::map<int, std::string> names;  ///< of all instances that have one
};

/// Reads instances.json of a recording's folder; without it every instance is an object. Looks through the
/// instance images of the frames that `isScanned` holds of, for how often each object is seen. Sizes that
/// instances.json does not give come from depth and poses. Error: names the file; no frame is left; a size is
/// missing and the folder is no recording with poses.
[[nodiscard]] Result<TrueScene> readTrueScene(const std::filesystem::path& folder,
                                              const std::function<bool(long)>& isScanned);

}  // namespace scantrove
