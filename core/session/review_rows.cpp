#include "core/session/review_rows.h"

#include <map>
#include <optional>

#include "core/session/row_checks.h"
#include "core/session/table_reading.h"

namespace scantrove::rows {
namespace {

/// The same frames as in ScanReview: those that can be shown.
constexpr const char* kUsableKeyFrames =
    "SELECT k.number AS number FROM key_frames k JOIN frames f ON f.number = k.number"
    " WHERE f.state IN ('tracking', 'relocalised')";

Result<bool> hasReviews(DatabaseConnection& database) {
  Result<QSqlQuery> table =
      database.execute("SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'frame_reviews'");
  if (!table) return fail(table.error());
  return table->next() && table->value(0).toInt() > 0;
}

}  // namespace

Result<void> writeReviews(DatabaseConnection& database, const std::vector<OperationLog::Entry>& operations) {
  bool is_any = false;
  for (const OperationLog::Entry& entry : operations) {
    const std::optional<FrameReview>& review = entry.operation.review;
    if (!review || review->key_frame < 0) continue;
    is_any = true;
    SCANTROVE_TRY(put(database, "frame_reviews",
                      {{"operation", entry.number},
                       {"key_frame", review->key_frame},
                       {"state", text(std::string(toString(review->state)))}}));
  }
  return is_any ? seal(database, "frame_reviews") : Result<void>();
}

Result<void> readReviews(DatabaseConnection& database, SavedScan& scan, std::vector<std::string>& damages) {
  std::map<std::int64_t, FrameReview*> without_frame;
  for (OperationLog::Entry& entry : scan.operations) {
    if (entry.operation.review) without_frame[entry.number] = &*entry.operation.review;
  }
  return readRows(
      database,
      {"frame_reviews", "SELECT operation, key_frame, state, row_check FROM frame_reviews ORDER BY operation",
       "reviews of key frames"},
      damages, [&](const QSqlQuery& row) {
        const auto number = integerAt(row, 0, {1, kCounts.most});
        const auto key_frame = integerAt(row, 1, kCounts);
        const std::optional<ReviewState> state = reviewStateOf(text(row, 2));
        const auto found = number ? without_frame.find(*number) : without_frame.end();
        if (found == without_frame.end() || !key_frame || !state) return false;
        found->second->key_frame = static_cast<int>(*key_frame);
        found->second->state = *state;
        without_frame.erase(found);
        return true;
      });
}

Result<ReviewCounts> countReviews(DatabaseConnection& database) {
  ReviewCounts counts;
  const Result<bool> has_reviews = hasReviews(database);
  if (!has_reviews) return fail(has_reviews.error());
  const QString newest =
      *has_reviews ? "SELECT key_frame, max(operation) AS operation FROM frame_reviews WHERE operation IN"
                     " (SELECT number FROM operations WHERE state = 'done') GROUP BY key_frame"
                   : "SELECT -1 AS key_frame, -1 AS operation";
  const QString states = *has_reviews ? "frame_reviews" : "(SELECT -1 AS operation, 'open' AS state)";
  Result<QSqlQuery> rows = database.execute(
      QString("SELECT coalesce(r.state, 'open'), count(*) FROM (%1) k LEFT JOIN (%2) n ON n.key_frame ="
              " k.number LEFT JOIN %3 r ON r.operation = n.operation GROUP BY 1")
          .arg(QLatin1String(kUsableKeyFrames), newest, states));
  if (!rows) return fail(rows.error());
  while (rows->next()) {
    const std::optional<ReviewState> state = reviewStateOf(text(*rows, 0));
    counts.add(state.value_or(ReviewState::open), rows->value(1).toInt());
  }
  return counts;
}

}  // namespace scantrove::rows
