#include "core/exchange/label_map_writer.h"

#include <nlohmann/json.hpp>

#include "core/exchange/atomic_file.h"

namespace scantrove {

Result<void> writeLabelMap(const std::filesystem::path& path, std::span<const LabelMapEntry> entries) {
  using Json = nlohmann::ordered_json;
  Json map = Json::object();
  for (const LabelMapEntry& entry : entries) {
    map[std::to_string(entry.region.value)] = {
        {"color", entry.color},
        {"object", entry.object ? Json(entry.object.value) : Json(nullptr)},
        {"name", entry.name.empty() ? Json(nullptr) : Json(entry.name)},
        {"category", entry.category.empty() ? Json(nullptr) : Json(entry.category)},
        {"confirmed", entry.confirmed}};
    if (entry.image_label) map[std::to_string(entry.region.value)]["image_label"] = *entry.image_label;
    if (entry.objectness) map[std::to_string(entry.region.value)]["objectness"] = *entry.objectness;
  }
  // Bytes of a name that are not UTF-8 are replaced, not refused.
  return writeFileAtomically(path, map.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace scantrove
