#include "core/session/catalogue_numbers.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace scantrove {
namespace {

using NumbersJson = nlohmann::ordered_json;

/// Prefixes of metadata keys that refer to objects by id.
constexpr std::array<std::string_view, 6> kKeysWithNumbers{
    "namings ", "undone namings ", "gone object ", "join ", "pending edits", "refinement memory"};
/// The metadata key for the start of a session that an older version wrote.
constexpr const char* kBegunKey = "begun";

bool hasNumbers(const std::string& name) {
  return std::ranges::any_of(kKeysWithNumbers,
                             [&](std::string_view beginning) { return name.starts_with(beginning); });
}

std::string setAsideKeyOf(const std::string& uuid) { return "numbers of " + uuid; }

std::string metadataOf(const SessionMetadata& metadata, const std::string& name) {
  const auto found = metadata.find(name);
  return found == metadata.end() ? std::string() : found->second;
}

/// Moves all ids into one text; empty: there were none.
std::string takeAll(CatalogueNumbers& numbers) {
  NumbersJson json{{"objects", NumbersJson::object()}, {"facts", NumbersJson::object()}};
  for (const auto& [region, object] : std::exchange(numbers.objects, {})) {
    if (object) json["objects"][std::to_string(region.value)] = object.value;
  }
  for (auto& [name, value] : numbers.metadata) {
    if (hasNumbers(name) && !value.empty()) json["facts"][name] = std::exchange(value, {});
  }
  if (json["objects"].empty() && json["facts"].empty()) return {};
  return json.dump(-1, ' ', false, NumbersJson::error_handler_t::replace);
}

/// The reverse; empty for malformed text.
void putBack(CatalogueNumbers& numbers, const std::string& text) {
  try {
    const NumbersJson json = NumbersJson::parse(text);
    CatalogueNumbers read;
    for (const auto& [region, object] : json.at("objects").items()) {
      const RegionId id{static_cast<std::uint32_t>(std::stoul(region))};
      read.objects[id] = ObjectId{object.get<std::uint32_t>()};
    }
    for (const auto& [name, value] : json.at("facts").items()) {
      if (hasNumbers(name)) read.metadata[name] = value.get<std::string>();
    }
    numbers.objects.insert(read.objects.begin(), read.objects.end());
    for (auto& [name, value] : read.metadata) numbers.metadata[name] = std::move(value);
  } catch (const std::exception&) {
    return;  // damaged metadata: the objects are unknown, as in another catalogue
  }
}

}  // namespace

bool turnTo(CatalogueNumbers& numbers, const CatalogueIdentity& catalogue) {
  const std::string own = metadataOf(numbers.metadata, kCatalogueKey);
  const bool is_own = own.empty() ? catalogue.has_session : own == catalogue.uuid;
  if (own != catalogue.uuid) numbers.metadata[kCatalogueKey] = catalogue.uuid;
  if (is_own) return false;
  std::string aside = takeAll(numbers);
  const bool is_any = !aside.empty();
  if (is_any) numbers.metadata[setAsideKeyOf(own)] = std::move(aside);
  for (const std::string& uuid : {catalogue.uuid, std::string()}) {
    if (uuid.empty() && !catalogue.has_session) continue;
    const auto earlier = numbers.metadata.find(setAsideKeyOf(uuid));
    if (earlier != numbers.metadata.end()) putBack(numbers, std::exchange(earlier->second, {}));
  }
  return is_any;
}

bool turnTo(SavedScan& scan, const CatalogueIdentity& catalogue) {
  CatalogueNumbers numbers{std::move(scan.metadata), {}};
  for (SavedRegion& region : scan.regions) numbers.objects[region.region] = std::exchange(region.object, {});
  const bool is_other = turnTo(numbers, catalogue);
  scan.metadata = std::move(numbers.metadata);
  for (SavedRegion& region : scan.regions) {
    if (const auto object = numbers.objects.extract(region.region)) region.object = object.mapped();
  }
  for (const auto& [region, object] : numbers.objects) scan.regions.push_back({region, object, {}});
  std::ranges::sort(scan.regions, {}, &SavedRegion::region);
  return is_other;
}

Result<CatalogueIdentity> identityOf(ObjectDatabase& database, const SessionMetadata& metadata) {
  CatalogueIdentity identity;
  SCANTROVE_TRY(moveInto(identity.uuid, database.identity()));
  SCANTROVE_TRY(
      moveInto(identity.has_session, database.sessions().hasScanOf(metadataOf(metadata, kBegunKey))));
  return identity;
}

Error isAnotherCatalogue(const std::filesystem::path& folder, const std::string& database) {
  return {"The catalogue " + database + " is another one than the session " + folder.string() +
              " knows: its numbers of objects are not used there.",
          "Put the catalogue of the session back, or name the regions again."};
}

}  // namespace scantrove
