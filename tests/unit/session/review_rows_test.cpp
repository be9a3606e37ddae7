#include "core/session/review_rows.h"

#include <gmock/gmock.h>

#include "core/editing/frame_review_states.h"
#include "core/session/operation_json.h"
#include "core/session/session_list.h"
#include "core/session/session_store.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using LogState = OperationLog::State;

Operation reviewOf(int key_frame, ReviewState state) {
  Operation operation{.kind = OperationKind::review};
  operation.review = FrameReview{key_frame, 100 + key_frame, state};
  return operation;
}

/// Frames 0 to 4, of which 3 was lost, all with images. Frame 0 was checked, frame 1 left out, then frame 2
/// checked, which was undone.
SavedDelta reviewedScan() {
  SavedDelta delta;
  delta.metadata["source"] = "demo";
  for (int number = 0; number < 5; ++number) {
    SavedFrame frame;
    frame.number = number;
    frame.source_index = 100 + number;
    frame.state = number == 3 ? TrackingState::lost : TrackingState::tracking;
    delta.frames.push_back(frame);
    SavedKeyFrame key;
    key.frame = number;
    key.depth_file = "keyframes/" + std::to_string(number) + ".depth.png";
    delta.key_frames.push_back(key);
  }
  delta.operations = {{1, reviewOf(0, ReviewState::left_out), {}, LogState::done},
                      {2, reviewOf(0, ReviewState::checked), {}, LogState::done},
                      {3, reviewOf(1, ReviewState::left_out), {}, LogState::done},
                      {4, reviewOf(2, ReviewState::checked), {}, LogState::undone}};
  return delta;
}

class ReviewRowsTest : public testing::Test {
 protected:
  ReviewRowsTest() {
    auto store = SessionStore::create(path_);
    EXPECT_TRUE(store) << store.error().message();
    const Result<void> saved = (*store)->save(reviewedScan());
    EXPECT_TRUE(saved) << saved.error().message();
  }
  void execute(const QString& sql) {
    const auto connection = DatabaseConnection::open((path_ / "session.sqlite").string());
    ASSERT_TRUE(connection);
    const auto done = (*connection)->execute(sql);
    ASSERT_TRUE(done) << done.error().message();
  }
  [[nodiscard]] std::vector<OperationLog::Entry> loaded() {
    const auto store = SessionStore::open(path_);
    EXPECT_TRUE(store) << store.error().message();
    const auto scan = (*store)->load();
    EXPECT_TRUE(scan);
    damages_ = (*store)->damages();
    return scan->operations;
  }
  [[nodiscard]] ReviewCounts listed() const {
    const auto sessions = listSessions(path_);
    EXPECT_EQ(sessions.size(), 1U);
    return sessions.front().reviews;
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "scan";
  std::vector<std::string> damages_;
};

TEST_F(ReviewRowsTest, LoadsWhatWasSaved) {
  const auto operations = loaded();
  ASSERT_EQ(operations.size(), 4U);
  EXPECT_EQ(operations[1].operation, reviewOf(0, ReviewState::checked));
  EXPECT_EQ(operations[2].operation, reviewOf(1, ReviewState::left_out));
  EXPECT_THAT(damages_, IsEmpty());
}

TEST_F(ReviewRowsTest, ListsTheCurrentStates_OfFramesWithAPose) {
  EXPECT_EQ(listed(), (ReviewCounts{.open = 2, .checked = 1, .left_out = 1}));
}

TEST_F(ReviewRowsTest, FollowUndo_WhenItsStateIsSaved) {
  {
    const auto store = SessionStore::open(path_);
    ASSERT_TRUE(store) << store.error().message();
    SavedDelta delta;
    delta.operations = {{2, reviewOf(0, ReviewState::checked), {}, LogState::undone}};
    ASSERT_TRUE((*store)->save(delta));
  }
  EXPECT_EQ(listed(), (ReviewCounts{.open = 2, .checked = 0, .left_out = 2}));
}

class MalformedReviewTest : public ReviewRowsTest, public testing::WithParamInterface<const char*> {};

TEST_P(MalformedReviewTest, LeavesItsOperation) {
  execute(QString("UPDATE frame_reviews SET row_check = NULL, %1 WHERE operation = 2").arg(GetParam()));
  const auto operations = loaded();
  ASSERT_EQ(operations.size(), 4U);
  ASSERT_TRUE(operations[1].operation.review);
  EXPECT_LT(operations[1].operation.review->key_frame, 0);
  EXPECT_THAT(damages_, Contains(HasSubstr("reviews of key frames")));
}

INSTANTIATE_TEST_SUITE_P(Rows, MalformedReviewTest,
                         testing::Values("key_frame = -1", "key_frame = 'first'", "state = 'perfect'",
                                         "operation = 99"));

TEST(FrameReviewStates, AreThoseOfTheNewestReviewThatIsDone) {
  OperationLog log;
  log.add(reviewOf(3, ReviewState::checked), {});
  log.add(reviewOf(3, ReviewState::left_out), {});
  log.add(reviewOf(5, ReviewState::checked), {});
  EXPECT_EQ(stateIn(reviewStatesOf(log), 3), ReviewState::left_out);
  ASSERT_NE(log.undo(), nullptr);
  ASSERT_NE(log.undo(), nullptr);
  EXPECT_EQ(stateIn(reviewStatesOf(log), 3), ReviewState::checked);
  EXPECT_EQ(stateIn(reviewStatesOf(log), 5), ReviewState::open);
  ASSERT_NE(log.redo(), nullptr);
  EXPECT_EQ(stateIn(reviewStatesOf(log), 3), ReviewState::left_out);
}

TEST(FrameReviewStates, OmitReviewsWithoutTheirRow) {
  const auto read = operationFromJson(operationToJson(reviewOf(3, ReviewState::checked)));
  ASSERT_TRUE(read);
  ASSERT_TRUE(read->review);
  EXPECT_EQ(read->review->image, 103);
  OperationLog log;
  log.add(*read, {});
  EXPECT_TRUE(reviewStatesOf(log).empty());
}

TEST(ReviewState, HasAWordForEach) {
  for (const ReviewState state : {ReviewState::open, ReviewState::checked, ReviewState::left_out})
    EXPECT_EQ(reviewStateOf(toString(state)), state);
  EXPECT_FALSE(reviewStateOf("done"));
}

}  // namespace
}  // namespace scantrove::test
