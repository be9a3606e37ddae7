#include "core/session/estimate_rows.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "core/session/row_checks.h"
#include "core/session/table_reading.h"

namespace scantrove::rows {
namespace {

static_assert(std::endian::native == std::endian::little);
/// As of the map's pages.
constexpr Bounds kBrickPositions{-(1 << 27), 1 << 27};

std::optional<SavedEstimates> estimatesFrom(const QSqlQuery& row) {
  const QByteArray cells = row.value(3).toByteArray();
  if (!areIntegers(row, 0, 2, kBrickPositions) || cells.size() % sizeof(std::uint32_t) != 0)
    return std::nullopt;
  SavedEstimates one{{row.value(0).toInt(), row.value(1).toInt(), row.value(2).toInt()}, {}};
  one.words.resize(static_cast<std::size_t>(cells.size()) / sizeof(std::uint32_t));
  std::memcpy(one.words.data(), cells.constData(), static_cast<std::size_t>(cells.size()));
  return EstimatedLabels::isValid(one) ? std::optional(std::move(one)) : std::nullopt;
}

}  // namespace

Result<void> writeEstimates(DatabaseConnection& database, const std::vector<SavedEstimates>& estimates) {
  for (const SavedEstimates& one : estimates) {
    const Eigen::Vector3i& at = one.position;
    if (one.words.empty()) {
      SCANTROVE_TRY(database.execute("DELETE FROM estimates WHERE x = ? AND y = ? AND z = ?",
                                     {at.x(), at.y(), at.z()}));
      continue;
    }
    const std::size_t bytes = one.words.size() * sizeof(std::uint32_t);
    const QByteArray cells(reinterpret_cast<const char*>(one.words.data()), static_cast<qsizetype>(bytes));
    SCANTROVE_TRY(
        put(database, "estimates", {{"x", at.x()}, {"y", at.y()}, {"z", at.z()}, {"cells", cells}}));
  }
  return estimates.empty() ? Result<void>() : seal(database, "estimates");
}

Result<std::vector<SavedEstimates>> readEstimates(DatabaseConnection& database,
                                                  std::vector<std::string>& damages) {
  std::vector<SavedEstimates> estimates;
  SCANTROVE_TRY(readTable(
      database,
      {"estimates", "SELECT x, y, z, cells, row_check FROM estimates ORDER BY x, y, z", "estimated labels"},
      damages, estimates, estimatesFrom));
  return estimates;
}

}  // namespace scantrove::rows
