#include "core/session/metadata_rows.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/session/row_checks.h"
#include "core/session/table_reading.h"

namespace scantrove::rows {
namespace {

/// Positions relative to a damaged origin would be wrong.
bool isOrigin(const std::string& value) {
  const auto numbers = parseNumbers(value);
  return numbers && numbers->size() == 3 &&
         std::ranges::all_of(*numbers, [](double number) { return std::abs(number) <= kFarthest_m; });
}

bool isMetadataEntry(const std::string& name, const std::string& value) {
  if (name == "origin_m") return isOrigin(value);
  if (name != "last_region") return true;  // new regions continue from this number
  const bool is_number = !value.empty() && value.size() < 11 &&
                         std::ranges::all_of(value, [](char c) { return c >= '0' && c <= '9'; });
  return is_number && std::stoll(value) <= kRegions.most;
}

}  // namespace

Result<void> writeMetadata(DatabaseConnection& database, const SessionMetadata& metadata) {
  if (metadata.empty()) return {};
  for (const char* table : {"facts", "fact_copies"}) {
    for (const auto& [name, value] : metadata)
      SCANTROVE_TRY(put(database, table, {{"name", text(name)}, {"value", text(value)}}));
    SCANTROVE_TRY(seal(database, table));
  }
  return {};
}

Result<SessionMetadata> readMetadata(DatabaseConnection& database, std::vector<std::string>& damages) {
  SessionMetadata metadata, copies;
  const auto addTo = [](SessionMetadata& list) {
    return [&list](const QSqlQuery& row) {
      if (!isMetadataEntry(text(row, 0), text(row, 1))) return false;
      list[text(row, 0)] = text(row, 1);
      return true;
    };
  };
  std::vector<std::string> of_metadata, of_copies;
  SCANTROVE_TRY(readRows(database, {"facts", "SELECT * FROM facts", "facts"}, of_metadata, addTo(metadata)));
  SCANTROVE_TRY(readRows(database, {"fact_copies", "SELECT * FROM fact_copies", "copies of facts"}, of_copies,
                         addTo(copies)));
  const std::size_t sound = metadata.size();
  metadata.insert(copies.begin(), copies.end());
  if (metadata.size() > sound)
    of_metadata = {std::to_string(metadata.size() - sound) + " facts of the session in " + database.file() +
                   " are damaged and were taken from their copies."};
  damages.insert(damages.end(), of_metadata.begin(), of_metadata.end());
  damages.insert(damages.end(), of_copies.begin(), of_copies.end());
  return metadata;
}

}  // namespace scantrove::rows
