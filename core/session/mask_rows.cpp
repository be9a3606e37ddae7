#include "core/session/mask_rows.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "core/session/row_checks.h"
#include "core/session/table_reading.h"

namespace scantrove::rows {
namespace {

QByteArray toBlob(const PaintedPixels& pixels) {
  const std::string bytes = pixels.toBytes();
  return {bytes.data(), std::ssize(bytes)};
}

/// None: no mask of this size.
std::optional<PaintedPixels> pixelsAt(const QSqlQuery& row, int column, int width, int height) {
  const QByteArray bytes = row.value(column).toByteArray();
  return PaintedPixels::fromBytes(width, height,
                                  std::span(bytes.constData(), static_cast<std::size_t>(bytes.size())));
}

bool isPainted(const OperationLog::Entry& entry) {
  return entry.operation.correction &&
         !(entry.operation.correction->added.isEmpty() && entry.operation.correction->removed.isEmpty());
}

/// Whether both masks are of the size that the operation names, which is plausible.
bool takePixels(const QSqlQuery& row, MaskCorrection& correction) {
  const int width = correction.added.width, height = correction.added.height;
  if (!integerAt(row, 1, {width, width}) || !integerAt(row, 2, {height, height})) return false;
  std::optional<PaintedPixels> added = pixelsAt(row, 3, width, height);
  std::optional<PaintedPixels> removed = pixelsAt(row, 4, width, height);
  if (!added || !removed) return false;
  correction.added = std::move(*added);
  correction.removed = std::move(*removed);
  return true;
}

}  // namespace

Result<void> writeMasks(DatabaseConnection& database, const std::vector<OperationLog::Entry>& operations) {
  bool is_any = false;
  for (const OperationLog::Entry& entry : operations) {
    if (!isPainted(entry)) continue;
    const MaskCorrection& correction = *entry.operation.correction;
    is_any = true;
    SCANTROVE_TRY(put(database, "mask_corrections",
                      {{"operation", entry.number},
                       {"width", correction.added.width},
                       {"height", correction.added.height},
                       {"added", toBlob(correction.added)},
                       {"removed", toBlob(correction.removed)}}));
  }
  return is_any ? seal(database, "mask_corrections") : Result<void>();
}

Result<void> readMasks(DatabaseConnection& database, SavedScan& scan, std::vector<std::string>& damages) {
  std::map<std::int64_t, MaskCorrection*> open;
  for (OperationLog::Entry& entry : scan.operations) {
    if (entry.operation.correction) open[entry.number] = &*entry.operation.correction;
  }
  SCANTROVE_TRY(readRows(database,
                         {"mask_corrections",
                          "SELECT operation, width, height, added, removed, row_check FROM mask_corrections"
                          " ORDER BY operation",
                          "painted masks"},
                         damages, [&](const QSqlQuery& row) {
                           const auto number = integerAt(row, 0, {1, kCounts.most});
                           const auto found = number ? open.find(*number) : open.end();
                           if (found == open.end() || !takePixels(row, *found->second)) return false;
                           open.erase(found);
                           return true;
                         }));
  return {};
}

}  // namespace scantrove::rows
