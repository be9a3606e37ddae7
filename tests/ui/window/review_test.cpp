#include <gtest/gtest.h>

#include <QComboBox>
#include <QSlider>
#include <QUndoStack>

#include "tests/ui/window/pointing_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/review_controller.h"
#include "ui/main_window/window_dialogs.h"
#include "ui/panels/export_dialog.h"
#include "ui/panels/next_step_strip.h"
#include "ui/panels/time_line.h"

namespace scantrove::test {
namespace {

/// A scan that has ended, with key frames 0, 30, 60 and 90 of the recording; 60 is checked.
class ReviewTest : public PointingTest {
 protected:
  void SetUp() override {
    PointingTest::SetUp();
    worker_->finish();
    report({ReviewState::open, ReviewState::open, ReviewState::checked, ReviewState::open});
    worker_->report(ReviewOpened{});
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return timeLine()->isVisible() && strip()->isVisible(); }, kPatience_ms));
  }
  void report(const std::vector<ReviewState>& states) {
    ScanSnapshot snapshot = twoRegions(90);
    snapshot.state = ScanState::finished;
    std::vector<int> images;
    std::vector<FrameReview> reviews;
    for (const ReviewState state : states) {
      const auto number = static_cast<int>(images.size());
      images.push_back(30 * number);
      reviews.push_back({2 * number, images.back(), state});
    }
    snapshot.key_frames = std::make_shared<const std::vector<int>>(std::move(images));
    snapshot.reviews = std::make_shared<const std::vector<FrameReview>>(std::move(reviews));
    snapshot.shown_key_frame = 0;
    worker_->report(std::move(snapshot));
  }
  TimeLine* timeLine() { return window_->parts().time_line; }
  NextStepStrip* strip() { return window_->parts().next_steps; }
};

TEST_F(ReviewTest, ClickOnTheSliderLeavesTheKeysToThePictures) {
  QTest::mouseClick(timeLine()->slider(), Qt::LeftButton);
  EXPECT_NE(window_->focusWidget(), timeLine()->slider());
}

TEST_F(ReviewTest, KeyChecksTheFrame_AndGoesToTheNextOpenOne) {
  QTest::keyClick(window_.get(), Qt::Key_K);
  const Operation* const operation = lastOperation();
  ASSERT_NE(operation, nullptr);
  EXPECT_EQ(operation->kind, OperationKind::review);
  EXPECT_EQ(operation->review, (FrameReview{0, 0, ReviewState::checked}));
  EXPECT_EQ(timeLine()->current(), 1);
  QTest::keyClick(window_.get(), Qt::Key_K, Qt::ShiftModifier);
  EXPECT_EQ(lastOperation()->review, (FrameReview{2, 30, ReviewState::left_out}));
  EXPECT_EQ(timeLine()->current(), 3) << "frame 60 is checked already";
  EXPECT_EQ(worker_->key_frames_shown, (std::vector{1, 3}));
}

TEST_F(ReviewTest, IsAStepOfTheHistory) {
  QTest::keyClick(window_.get(), Qt::Key_K);
  EXPECT_EQ(window_->history().stack().undoText(), QStringLiteral("Image 0: checked"));
  window_->history().stack().undo();
  ASSERT_EQ(worker_->edits.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<UndoEdit>(worker_->edits.back()));
}

TEST_F(ReviewTest, KeysGoToOpenFramesInBothDirections) {
  QTest::keyClick(window_.get(), Qt::Key_PageUp, Qt::ControlModifier);
  EXPECT_EQ(timeLine()->current(), 3);
  QTest::keyClick(window_.get(), Qt::Key_PageDown, Qt::ControlModifier);
  EXPECT_EQ(timeLine()->current(), 0);
}

TEST_F(ReviewTest, FilterSaysWhichFramesAreBrowsed) {
  timeLine()->filterBox()->setCurrentIndex(2);  // checked
  QTest::keyClick(window_.get(), Qt::Key_PageDown);
  EXPECT_EQ(timeLine()->current(), 2);
  EXPECT_TRUE(timeLine()->text().contains(QStringLiteral("checked")));
}

TEST_F(ReviewTest, StripCountsWhatIsLeft_AndChecks) {
  EXPECT_EQ(strip()->texts().mid(0, 1), QStringList(QStringLiteral("Check 3 key frames")));
  QTest::keyClick(window_.get(), Qt::Key_K);
  EXPECT_EQ(strip()->texts().mid(0, 1), QStringList(QStringLiteral("Check 2 key frames")));
  timeLine()->go(2);
  emit strip()->requested(NextStep::Kind::check);
  ASSERT_TRUE(QTest::qWaitFor([&] { return timeLine()->current() == 3; }, kPatience_ms));
}

TEST_F(ReviewTest, StripOpensTheExport) {
  emit strip()->requested(NextStep::Kind::export_data);
  EXPECT_TRUE(QTest::qWaitFor([&] { return window_->dialogs().exportDialog() != nullptr; }, kPatience_ms));
}

TEST_F(ReviewTest, StripStaysClosed_UntilTheNextScan) {
  QTest::mouseClick(strip()->findChild<QToolButton*>(QStringLiteral("closeNextSteps")), Qt::LeftButton);
  EXPECT_FALSE(strip()->isVisible());
  QTest::keyClick(window_.get(), Qt::Key_K);
  EXPECT_FALSE(strip()->isVisible());
}

TEST_F(ReviewTest, StripVanishes_WhenTheScanIsClosed) {
  window_->closeScan();
  EXPECT_FALSE(strip()->isVisible());
}

TEST_F(ReviewTest, LateAnswerSuggestsNothing_WhenTheScanIsClosed) {
  Operation naming;
  naming.kind = OperationKind::name;
  naming.regions = {RegionId{5}};
  naming.name = "chair";
  window_->closeScan();
  worker_->report(Edited{naming, naming.regions});
  QTest::qWait(300);
  EXPECT_EQ(window_->regions().operations().proposals().first(), nullptr);
}

TEST_F(ReviewTest, StripIsLow_SoThatSmallScreensHaveRoom) { EXPECT_LE(strip()->sizeHint().height(), 40); }

}  // namespace
}  // namespace scantrove::test
