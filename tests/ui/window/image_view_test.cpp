// Viewing in the image mode: zoom, masks and selection, with real mouse events on its canvas.
#include <QCheckBox>
#include <QSlider>
#include <string>

#include "tests/ui/window/image_mode_fixture.h"

namespace scantrove::test {
namespace {

TEST_F(ImageModeTest, ShowsTheImageInPlaceOfTheScene) {
  EXPECT_TRUE(canvas().isVisible());
  EXPECT_FALSE(view()->isVisible());
  EXPECT_FALSE(canvas().layers().picture.isNull());
  EXPECT_FALSE(canvas().layers().masks.isNull());
  bar().besideAction()->trigger();
  EXPECT_TRUE(canvas().isVisible());
  EXPECT_TRUE(view()->isVisible());
  bar().besideAction()->trigger();
  action()->trigger();
  EXPECT_FALSE(canvas().isVisible());
  EXPECT_TRUE(view()->isVisible());
}

TEST_F(ImageModeTest, ADoubleClickOnATitleOpensThatPicture) {
  action()->trigger();
  ImagePanel* const depth = panel(1);
  QTest::mouseDClick(depth, Qt::LeftButton, {}, depth->titleRect().center().toPoint());
  EXPECT_TRUE(action()->isChecked());
  EXPECT_EQ(bar().picture(), 1);
  QTest::keyClick(&canvas(), Qt::Key_V);
  EXPECT_EQ(bar().picture(), 2);
}

TEST_F(ImageModeTest, TheWheelKeepsThePixelUnderThePointer) {
  const QPoint at = on(100, 100);
  const cv::Point2f before = pixelAt(at);
  for (int i = 0; i < 6; ++i) wheel(at, 1);
  EXPECT_GT(canvas().zoom().scale(), 2);
  EXPECT_NEAR(pixelAt(at).x, before.x, 1e-3);
  EXPECT_NEAR(pixelAt(at).y, before.y, 1e-3);
  QTest::keyClick(&canvas(), Qt::Key_0, Qt::ControlModifier);
  EXPECT_TRUE(canvas().zoom().isFitted());
}

TEST_F(ImageModeTest, SpaceAndMiddleButtonMoveTheImage) {
  zoomTo({320, 240});
  const QPointF before = canvas().positionOf({320, 240});
  const QPoint from = canvas().rect().center(), by(30, 12);
  QTest::keyPress(&canvas(), Qt::Key_Space);
  stroke(from, from + by);
  QTest::keyRelease(&canvas(), Qt::Key_Space);
  EXPECT_EQ(canvas().positionOf({320, 240}), before + by);
  QTest::mousePress(&canvas(), Qt::MiddleButton, {}, from);
  moveTo(from - by);
  QTest::mouseRelease(&canvas(), Qt::MiddleButton, {}, from - by);
  EXPECT_EQ(canvas().positionOf({320, 240}), before);
  EXPECT_EQ(std::ranges::count(worker_->commands, std::string("pause")), 0);
}

TEST_F(ImageModeTest, ClicksSelect_WithoutATool) {
  QTest::keyClick(&canvas(), Qt::Key_S);
  QTest::mouseClick(&canvas(), Qt::LeftButton, {}, on(500, 100));
  EXPECT_TRUE(selection().isSelected(RegionId{7}));
  EXPECT_TRUE(worker_->edits.empty());
}

TEST_F(ImageModeTest, MasksAreFilledOutlinedOrOff) {
  const auto alphaAt = [&](int x, int y) { return canvas().layers().masks.pixelColor(x, y).alpha(); };
  EXPECT_EQ(alphaAt(100, 100), 255);
  QTest::keyClick(&canvas(), Qt::Key_M);
  EXPECT_EQ(alphaAt(100, 100), 0);
  EXPECT_EQ(alphaAt(kWidth / 2, 100), 255);
  QTest::keyClick(&canvas(), Qt::Key_M);
  EXPECT_TRUE(canvas().layers().masks.isNull());
  bar().comparisonSlider()->setValue(50);
  EXPECT_FALSE(canvas().layers().second.isNull());
  EXPECT_DOUBLE_EQ(canvas().layers().second_opacity, 0.5);
}

TEST_F(ImageModeTest, ALiveImageIsForViewingOnly) {
  worker_->report(StateChanged{ScanState::starting});
  worker_->report(StateChanged{ScanState::scanning});
  worker_->report(twoRegions(5));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !painting().hasLabels(); }, kPatience_ms));
  EXPECT_FALSE(tools().toolAction(PaintTool::brush)->isEnabled());
  stroke(on(100, 100), on(120, 100));
  EXPECT_TRUE(worker_->edits.empty());
}

}  // namespace
}  // namespace scantrove::test
