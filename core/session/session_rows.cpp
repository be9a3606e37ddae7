#include "core/session/session_rows.h"

#include <iterator>
#include <utility>

#include "core/fusion/packed_words.h"
#include "core/session/checked_rows.h"
#include "core/session/estimate_rows.h"
#include "core/session/frame_rows.h"
#include "core/session/mask_rows.h"
#include "core/session/metadata_rows.h"
#include "core/session/objectness_rows.h"
#include "core/session/operation_rows.h"
#include "core/session/recording_rows.h"
#include "core/session/region_rows.h"
#include "core/session/review_rows.h"

namespace scantrove::rows {
namespace {

Result<void> writeCamera(DatabaseConnection& database, const SavedCamera& camera) {
  const PackedWords packed = packWords(camera.words);
  SCANTROVE_TRY(put(database, "camera",
                    {{"one", 1},
                     {"frame", camera.frame},
                     {"packed", QByteArray(packed.bytes.data(), std::ssize(packed.bytes))},
                     {"unpacked_bytes", packed.unpacked_bytes},
                     {"checksum", static_cast<qlonglong>(packed.checksum)}}));
  return seal(database, "camera");
}

}  // namespace

Result<void> write(DatabaseConnection& database, const SavedDelta& delta) {
  SCANTROVE_TRY(writeMetadata(database, delta.metadata));
  SCANTROVE_TRY(writeRecordings(database, delta.recordings));
  SCANTROVE_TRY(writeFrames(database, delta));
  SCANTROVE_TRY(writeRegions(database, delta));
  SCANTROVE_TRY(writeEstimates(database, delta.estimates));
  if (delta.objectness) SCANTROVE_TRY(writeObjectness(database, *delta.objectness));
  if (delta.camera) SCANTROVE_TRY(writeCamera(database, *delta.camera));
  SCANTROVE_TRY(writeOperations(database, delta.operations));
  SCANTROVE_TRY(writeMasks(database, delta.operations));
  return writeReviews(database, delta.operations);
}

Result<SavedScan> read(DatabaseConnection& database, std::vector<std::string>& damages) {
  SavedScan scan;
  SCANTROVE_TRY(moveInto(scan.metadata, readMetadata(database, damages)));
  SCANTROVE_TRY(moveInto(scan.recordings, readRecordings(database, damages)));
  SCANTROVE_TRY(readFrames(database, scan, damages));
  SCANTROVE_TRY(readRegions(database, scan, damages));
  SCANTROVE_TRY(moveInto(scan.estimates, readEstimates(database, damages)));
  SCANTROVE_TRY(moveInto(scan.objectness, readObjectness(database, damages)));
  SCANTROVE_TRY(readOperations(database, scan, damages));
  SCANTROVE_TRY(readMasks(database, scan, damages));
  SCANTROVE_TRY(readReviews(database, scan, damages));
  return scan;
}

Result<std::optional<SavedCamera>> readCamera(DatabaseConnection& database) {
  Result<QSqlQuery> row =
      database.execute("SELECT frame, packed, unpacked_bytes, checksum, one, row_check FROM camera");
  if (!row) return fail(row.error());
  RowAudit audit(*row);
  if (!row->next() || !audit.take(*row)) return std::nullopt;
  const QByteArray bytes = row->value(1).toByteArray();
  auto words = unpackWords({{bytes.begin(), bytes.end()},
                            row->value(2).toUInt(),
                            static_cast<std::uint64_t>(row->value(3).toLongLong())});
  if (!words) return std::nullopt;
  return SavedCamera{row->value(0).toInt(), std::move(*words)};
}

}  // namespace scantrove::rows
