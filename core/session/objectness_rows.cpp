#include "core/session/objectness_rows.h"

#include <cmath>
#include <optional>
#include <utility>

#include "core/session/row_checks.h"
#include "core/session/table_reading.h"

namespace scantrove::rows {
namespace {

/// Beyond any sum of trees.
constexpr double kMaxLogOdds = 1e3;

std::optional<std::pair<RegionId, float>> objectnessFrom(const QSqlQuery& row) {
  bool is_number = false;
  const double log_odds = row.value(1).toDouble(&is_number);
  if (!integerAt(row, 0, kRegions) || !is_number || !(std::abs(log_odds) <= kMaxLogOdds)) return std::nullopt;
  return std::pair(RegionId{row.value(0).toUInt()}, static_cast<float>(log_odds));
}

}  // namespace

Result<void> writeObjectness(DatabaseConnection& database, const SavedObjectness& objectness) {
  SCANTROVE_TRY(database.execute("DELETE FROM objectness"));
  for (const auto& [region, log_odds] : objectness)
    SCANTROVE_TRY(
        put(database, "objectness", {{"region", region.value}, {"log_odds", static_cast<double>(log_odds)}}));
  return seal(database, "objectness");
}

Result<SavedObjectness> readObjectness(DatabaseConnection& database, std::vector<std::string>& damages) {
  std::vector<std::pair<RegionId, float>> list;
  SCANTROVE_TRY(readTable(
      database,
      {"objectness", "SELECT region, log_odds, row_check FROM objectness ORDER BY region", "ratings"},
      damages, list, objectnessFrom));
  return SavedObjectness(list.begin(), list.end());
}

}  // namespace scantrove::rows
