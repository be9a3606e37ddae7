#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "core/base/ids.h"
#include "core/base/result.h"

namespace scantrove {

/// What one label of a cloud stands for.
struct LabelMapEntry {
  RegionId region;
  std::array<std::uint8_t, 3> color{};  ///< red, green, blue
  ObjectId object;                      ///< none: a region that is no known object
  std::string name;                     ///< empty without one
  std::string category = {};            ///< likewise
  bool confirmed = false;               ///< the object, by a person
  /// Its number in label images, where 16 bits do not hold its id; none: its id.
  std::optional<std::uint32_t> image_label = {};
};

/// labels.json: `{"<region id>": {"color": [r, g, b], "object": id or null, "name": text or null,
/// "category": text or null, "confirmed": true or false}, ...}`, by the region ids of the session; with
/// "image_label" where label images have another number. Written beside and renamed. Error: names `path`.
Result<void> writeLabelMap(const std::filesystem::path& path, std::span<const LabelMapEntry> entries);

}  // namespace scantrove
