#include "core/session/mask_corrections.h"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "core/session/session_store.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using State = OperationLog::State;

constexpr int kKeyFrame = 4;

MaskCorrection someCorrection() {
  cv::Mat added = cv::Mat::zeros(6, 8, CV_8UC1), removed = added.clone();
  added(cv::Rect(1, 1, 3, 2)).setTo(255);
  removed(cv::Rect(5, 1, 2, 4)).setTo(255);
  MaskCorrection correction = correctionOf(added, removed);
  correction.key_frame = kKeyFrame;
  correction.image = 12;
  return correction;
}

Operation paintOf(RegionId region) {
  Operation paint{.kind = OperationKind::paint, .regions = {region}};
  paint.correction = someCorrection();
  return paint;
}

class MaskCorrectionsTest : public testing::Test {
 protected:
  MaskCorrectionsTest() {
    for (int i = 0; i < 3; ++i) fragments_.push_back(table_.newFragment());
  }
  RegionId regionOf(int i) const { return table_.regionOf(fragments_[static_cast<std::size_t>(i)]); }
  void addPaint(int i) {
    log_.add(paintOf(regionOf(i)), {.anchor = fragments_[static_cast<std::size_t>(i)]});
  }
  std::vector<PaintedMask> masks() const { return paintedMasksOf(log_, table_, kKeyFrame); }

  RegionTable table_;
  OperationLog log_;
  std::vector<FragmentId> fragments_;
};

TEST_F(MaskCorrectionsTest, AreThoseThatAreDone) {
  addPaint(0);
  addPaint(1);
  ASSERT_EQ(masks().size(), 2U);
  EXPECT_EQ(masks()[0].region, regionOf(0).value);
  EXPECT_EQ(cv::countNonZero(masks()[0].added), 6);
  EXPECT_EQ(cv::countNonZero(masks()[0].removed), 8);
  EXPECT_TRUE(paintedMasksOf(log_, table_, kKeyFrame + 1).empty());
  EXPECT_THAT(paintedKeyFrames(log_), ElementsAre(kKeyFrame));
  ASSERT_NE(log_.undo(), nullptr);
  EXPECT_EQ(masks().size(), 1U);
  ASSERT_NE(log_.redo(), nullptr);
  EXPECT_EQ(masks().size(), 2U);
}

TEST_F(MaskCorrectionsTest, FollowTheirRegion_WhenItIsJoined) {
  addPaint(1);
  const RegionId joined = regionOf(1), into = regionOf(0);
  table_.join(into, joined);
  log_.add({.kind = OperationKind::join, .regions = {into, joined}},
           {.moves = {{fragments_[1], joined, into}}});
  ASSERT_EQ(masks().size(), 1U);
  EXPECT_EQ(masks()[0].region, into.value);
  EXPECT_EQ(cv::countNonZero(masks()[0].added), 6);
  EXPECT_EQ(cv::countNonZero(masks()[0].removed), 0) << "the other region may be there";
}

TEST_F(MaskCorrectionsTest, KnowThePartsOfTheirRegion) {
  addPaint(1);
  const FragmentId part = table_.newFragmentBeside(fragments_[1]);
  RegionEvents events;
  const RegionId created = table_.separate(std::vector{part}, events);
  log_.add({.kind = OperationKind::cut, .regions = {regionOf(1)}}, {.moves = {{part, regionOf(1), created}}});
  ASSERT_EQ(masks().size(), 1U);
  EXPECT_THAT(masks()[0].parts, ElementsAre(created.value));
  ASSERT_NE(log_.undo(), nullptr);
  EXPECT_TRUE(masks()[0].parts.empty());
}

TEST_F(MaskCorrectionsTest, AreGone_WhenNothingIsLeftOfTheirRegion) {
  addPaint(1);
  table_.free(fragments_[1]);
  log_.forget(fragments_[1]);
  EXPECT_TRUE(masks().empty());
}

TEST_F(MaskCorrectionsTest, AreTakenAway_ForOneRegionAndImage) {
  addPaint(0);
  addPaint(1);
  Operation unpaint{.kind = OperationKind::unpaint, .regions = {regionOf(0)}};
  unpaint.correction = MaskCorrection{.key_frame = kKeyFrame + 1, .image = 13};
  EXPECT_FALSE(checkUnpaint(log_, table_, unpaint)) << "another image";
  unpaint.correction->key_frame = kKeyFrame;
  EXPECT_TRUE(checkUnpaint(log_, table_, unpaint));
  log_.add(unpaint, {.anchor = fragments_[0]});
  ASSERT_EQ(masks().size(), 1U);
  EXPECT_EQ(masks()[0].region, regionOf(1).value);
  EXPECT_FALSE(checkUnpaint(log_, table_, unpaint)) << "nothing is left";
  addPaint(0);
  EXPECT_EQ(masks().size(), 2U) << "what is painted afterwards holds";
  ASSERT_NE(log_.undo(), nullptr);
  ASSERT_NE(log_.undo(), nullptr);
  EXPECT_EQ(masks().size(), 2U) << "undone";
}

TEST_F(MaskCorrectionsTest, StayWithTheirRegion_WhenItIsJoinedWithOneWhoseMaskWasReset) {
  addPaint(0);
  addPaint(1);
  const RegionId into = regionOf(0), joined = regionOf(1);
  Operation unpaint{.kind = OperationKind::unpaint, .regions = {into}};
  unpaint.correction = MaskCorrection{.key_frame = kKeyFrame, .image = 12};
  log_.add(unpaint, {.anchor = fragments_[0]});
  table_.join(into, joined);
  log_.add({.kind = OperationKind::join, .regions = {into, joined}},
           {.moves = {{fragments_[1], joined, into}}});
  ASSERT_EQ(masks().size(), 1U) << "what was painted for the joined region";
  EXPECT_EQ(masks()[0].region, into.value);
  log_.add(unpaint, {.anchor = fragments_[0]});
  EXPECT_TRUE(masks().empty()) << "a reset after the join takes both";
}

TEST_F(MaskCorrectionsTest, AreTakenAway_AlsoWhenTheirRegionIsJoinedLater) {
  addPaint(1);
  const RegionId into = regionOf(0), joined = regionOf(1);
  Operation unpaint{.kind = OperationKind::unpaint, .regions = {joined}};
  unpaint.correction = MaskCorrection{.key_frame = kKeyFrame, .image = 12};
  log_.add(unpaint, {.anchor = fragments_[1]});
  table_.join(into, joined);
  log_.add({.kind = OperationKind::join, .regions = {into, joined}},
           {.moves = {{fragments_[1], joined, into}}});
  EXPECT_TRUE(masks().empty());
}

TEST_F(MaskCorrectionsTest, BelongToTheNewRegionThatTheyMade) {
  const FragmentId part = table_.newFragmentBeside(fragments_[1]);
  RegionEvents events;
  const RegionId created = table_.separate(std::vector{part}, events);
  Operation paint = paintOf(regionOf(1));
  paint.correction->makes_region = true;
  log_.add(paint, {.moves = {{part, regionOf(1), created}}, .anchor = part, .created = {created}});
  ASSERT_EQ(masks().size(), 1U);
  EXPECT_EQ(masks()[0].region, created.value);
  EXPECT_TRUE(masks()[0].parts.empty());
}

class MaskRowsTest : public testing::Test {
 protected:
  MaskRowsTest() {
    auto store = SessionStore::create(path_);
    EXPECT_TRUE(store);
    SavedDelta delta;
    delta.operations.push_back(
        {1, paintOf(RegionId{3}), {.anchor = FragmentId{7}, .created = {RegionId{9}}}});
    EXPECT_TRUE((*store)->save(delta));
  }
  void execute(const QString& sql) {
    const auto connection = DatabaseConnection::open((path_ / "session.sqlite").string());
    ASSERT_TRUE(connection);
    const auto done = (*connection)->execute(sql);
    ASSERT_TRUE(done) << done.error().message();
  }
  /// Changes the row of the mask, without its checksum.
  void setMask(const QString& change) { execute("UPDATE mask_corrections SET row_check = NULL, " + change); }
  [[nodiscard]] std::vector<OperationLog::Entry> loaded() {
    const auto store = SessionStore::open(path_);
    EXPECT_TRUE(store) << store.error().message();
    const auto scan = (*store)->load();
    EXPECT_TRUE(scan);
    damages_ = (*store)->damages();
    return scan->operations;
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "scan";
  std::vector<std::string> damages_;
};

TEST_F(MaskRowsTest, LoadsWhatWasSaved) {
  const auto operations = loaded();
  ASSERT_EQ(operations.size(), 1U);
  EXPECT_EQ(operations[0].operation, paintOf(RegionId{3}));
  EXPECT_EQ(operations[0].effect.anchor, FragmentId{7});
  EXPECT_THAT(operations[0].effect.created, ElementsAre(RegionId{9}));
  EXPECT_TRUE(damages_.empty());
}

class MalformedMaskTest : public MaskRowsTest, public testing::WithParamInterface<const char*> {};

TEST_P(MalformedMaskTest, LeavesItsOperation) {
  setMask(GetParam());
  const auto operations = loaded();
  ASSERT_EQ(operations.size(), 1U);
  ASSERT_TRUE(operations[0].operation.correction);
  EXPECT_TRUE(operations[0].operation.correction->added.isEmpty());
  EXPECT_THAT(damages_, testing::Contains(HasSubstr("painted mask")));
}

INSTANTIATE_TEST_SUITE_P(Rows, MalformedMaskTest,
                         testing::Values("width = 7", "height = -6", "width = 1000000",
                                         "added = x'FFFFFFFF0F01'", "removed = x'84'", "added = x'0431'",
                                         "operation = 99", "width = 'wide'"));

TEST_F(MaskRowsTest, NoticesAMissingMask) {
  execute("DELETE FROM mask_corrections");
  ASSERT_EQ(loaded().size(), 1U);
  EXPECT_THAT(damages_, ElementsAre(HasSubstr("1 painted masks")));
}

TEST_F(MaskRowsTest, LeavesAnOperationOut_WhenItsSizeIsNoImage) {
  for (const char* size :
       {"[0, 6]", "[8, 0]", "[100000, 6]", "[8000, 8000]", "[8, -6]", "[8]", "\"large\""}) {
    execute(
        QString("UPDATE operations SET row_check = NULL, operation = '{\"kind\": \"paint\", \"regions\": [3],"
                " \"mask\": {\"key_frame\": 4, \"image\": 12, \"size\": %1}}'")
            .arg(size));
    EXPECT_TRUE(loaded().empty()) << size;
  }
}

}  // namespace
}  // namespace scantrove::test
