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

/// Description of one label of a cloud.
struct LabelMapEntry {
  RegionId region;
  std::array<std::uint8_t, 3> color{};  ///< red, green, blue
  ObjectId object;                      ///< none: a region without object
  std::string name;                     ///< empty without one
  std::string category = {};            ///< empty without one
  bool confirmed = false;               ///< whether a user confirmed the object
  /// Its number in label images if its id exceeds 16 bits; none: its id.
  std::optional<std::uint32_t> image_label = {};
  std::optional<float> objectness = {};  ///< log-odds that the region is one complete object; none: not rated
};

/// labels.json: `{"<region id>": {"color": [r, g, b], "object": id or null, "name": text or null, "category":
/// text or null, "confirmed": true or false}, ...}`, by the region ids of the session. "image_label" is
/// present if label images use another number, "objectness" if the region was rated. Written atomically.
/// Error: names `path`.
Result<void> writeLabelMap(const std::filesystem::path& path, std::span<const LabelMapEntry> entries);

}  // namespace scantrove
