#include "ui/painting/mask_tool.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace scantrove::test {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr int kWidth = 40, kHeight = 30;

class MaskToolTest : public testing::Test {
 protected:
  void use(PaintTool kind, float radius_px = 2) {
    tool_ = MaskTool::make(kind, {kWidth, kHeight});
    ASSERT_NE(tool_, nullptr);
    tool_->setRadius(radius_px);
  }
  [[nodiscard]] int painted() const { return cv::countNonZero(tool_->draft()); }
  [[nodiscard]] bool isPainted(int x, int y) const { return tool_->draft().at<std::uint8_t>(y, x) == 255; }

  std::unique_ptr<MaskTool> tool_;
};

TEST_F(MaskToolTest, SelectHasNone) { EXPECT_EQ(MaskTool::make(PaintTool::select, {4, 3}), nullptr); }

TEST_F(MaskToolTest, BrushPaintsWhatLiesWithinItsRadius) {
  use(PaintTool::brush, 2.5F);
  EXPECT_EQ(tool_->press({10, 10}), ToolStep::drawing);
  EXPECT_EQ(tool_->drag({20, 10}), ToolStep::drawing);
  EXPECT_EQ(tool_->release({20, 14}), ToolStep::finished);
  const auto distanceTo = [](float x, float y, const cv::Point2f& a, const cv::Point2f& b) {
    const cv::Point2f along = b - a, to(x - a.x, y - a.y);
    const float share = std::clamp(to.dot(along) / along.dot(along), 0.F, 1.F);
    return std::hypot(to.x - share * along.x, to.y - share * along.y);
  };
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
      const float distance =
          std::min(distanceTo(fx, fy, {10, 10}, {20, 10}), distanceTo(fx, fy, {20, 10}, {20, 14}));
      EXPECT_EQ(isPainted(x, y), distance <= 2.5F) << x << ", " << y;
    }
  }
  EXPECT_EQ(tool_->start(), cv::Point2f(10, 10));
}

TEST_F(MaskToolTest, TellsTheChangedPart_Once) {
  use(PaintTool::eraser, 1);
  static_cast<void>(tool_->press({10, 10}));
  const cv::Rect changed = tool_->takeChanged();
  for (const cv::Point& pixel : {cv::Point(10, 10), cv::Point(9, 10), cv::Point(10, 11)})
    EXPECT_TRUE(changed.contains(pixel));
  EXPECT_TRUE(tool_->takeChanged().empty());
  tool_->reset();
  EXPECT_TRUE(tool_->takeChanged().contains(cv::Point(10, 10))) << "it is to be cleared";
}

TEST_F(MaskToolTest, ResetDropsAStroke_AndLeavesItsMaskToWhoHasIt) {
  use(PaintTool::brush);
  static_cast<void>(tool_->press({10, 10}));
  const cv::Mat taken = tool_->draft();
  const int before = cv::countNonZero(taken);
  EXPECT_GT(before, 0);
  tool_->reset();
  EXPECT_EQ(painted(), 0);
  EXPECT_EQ(cv::countNonZero(taken), before);
  EXPECT_FALSE(tool_->isDrawing());
  EXPECT_EQ(tool_->drag({12, 10}), ToolStep::idle) << "the stroke is over";
  EXPECT_EQ(tool_->release({12, 10}), ToolStep::idle);
}

TEST_F(MaskToolTest, PolygonIsClosedByReturn) {
  use(PaintTool::polygon);
  for (const cv::Point2f corner : {cv::Point2f(4.5F, 4.5F), cv::Point2f(14.5F, 4.5F),
                                   cv::Point2f(14.5F, 9.5F), cv::Point2f(4.5F, 9.5F)}) {
    EXPECT_EQ(tool_->press(corner), ToolStep::drawing);
    EXPECT_EQ(tool_->release(corner), ToolStep::drawing);
  }
  EXPECT_EQ(painted(), 0) << "not closed yet";
  EXPECT_THAT(tool_->outline(), SizeIs(5)) << "four corners and the pointer";
  EXPECT_EQ(tool_->complete(), ToolStep::finished);
  EXPECT_EQ(painted(), 10 * 5);
  EXPECT_TRUE(isPainted(5, 5));
  EXPECT_TRUE(isPainted(14, 9));
  EXPECT_FALSE(isPainted(15, 9));
}

TEST_F(MaskToolTest, PolygonIsClosedAtItsFirstCorner) {
  use(PaintTool::polygon);
  for (const cv::Point2f corner :
       {cv::Point2f(4.5F, 4.5F), cv::Point2f(14.5F, 4.5F), cv::Point2f(14.5F, 9.5F)})
    EXPECT_EQ(tool_->press(corner), ToolStep::drawing);
  EXPECT_EQ(tool_->press({5, 5}), ToolStep::finished);
  EXPECT_GT(painted(), 10 * 5 / 2 - 10);
  EXPECT_LT(painted(), 10 * 5 / 2 + 10);
}

TEST_F(MaskToolTest, PolygonNeedsThreeCorners_AndStepsBack) {
  use(PaintTool::polygon);
  EXPECT_EQ(tool_->complete(), ToolStep::idle);
  static_cast<void>(tool_->press({4, 4}));
  static_cast<void>(tool_->press({14, 4}));
  EXPECT_EQ(tool_->complete(), ToolStep::drawing);
  EXPECT_EQ(tool_->stepBack(), ToolStep::drawing);
  EXPECT_EQ(tool_->stepBack(), ToolStep::idle);
  EXPECT_FALSE(tool_->isDrawing());
  EXPECT_THAT(tool_->outline(), IsEmpty());
}

TEST_F(MaskToolTest, MagicEdgeIsARoughOutline) {
  use(PaintTool::magic_edge);
  static_cast<void>(tool_->press({4.5F, 4.5F}));
  static_cast<void>(tool_->drag({14.5F, 4.5F}));
  static_cast<void>(tool_->drag({14.5F, 9.5F}));
  EXPECT_EQ(tool_->release({4.5F, 9.5F}), ToolStep::finished);
  EXPECT_EQ(painted(), 10 * 5);
}

TEST_F(MaskToolTest, HoleIsOneClick) {
  use(PaintTool::fill_hole);
  EXPECT_EQ(tool_->press({7, 8}), ToolStep::finished);
  EXPECT_EQ(tool_->start(), cv::Point2f(7, 8));
}

TEST(RegionAround, IsWhatBordersOnMostOfAHole) {
  cv::Mat regions(10, 10, CV_32SC1, cv::Scalar(3));
  regions(cv::Rect(3, 3, 4, 4)).setTo(0);
  regions.at<int>(2, 4) = 9;
  EXPECT_EQ(regionAround(regions, {4, 4}), 3);
  EXPECT_EQ(regionAround(regions, {0, 0}), 9) << "the other regions at the border of 3";
  EXPECT_EQ(regionAround(regions, {-1, 4}), 0);
  EXPECT_EQ(regionAround(cv::Mat(4, 4, CV_32SC1, cv::Scalar(3)), {1, 1}), 0);
}

}  // namespace
}  // namespace scantrove::test
