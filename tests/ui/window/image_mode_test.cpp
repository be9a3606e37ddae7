// The image mode, with real mouse events on its canvas.
#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QMouseEvent>
#include <QSlider>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>

#include "tests/ui/window/pointing_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/painting/image_canvas.h"
#include "ui/painting/image_mode.h"
#include "ui/painting/image_page.h"
#include "ui/painting/image_view_bar.h"
#include "ui/painting/paint_controller.h"
#include "ui/painting/paint_tool_bar.h"

namespace scantrove::test {
namespace {

constexpr int kWidth = 640, kHeight = 480;

/// Key frame 1 of an open scan: region 5 on the left half of the image, 7 on the right.
class ImageModeTest : public PointingTest {
 protected:
  void SetUp() override {
    PointingTest::SetUp();
    ScanSnapshot snapshot = twoRegions(30);
    snapshot.state = ScanState::finished;
    snapshot.key_frames = std::make_shared<const std::vector<int>>(std::vector{0, 30});
    snapshot.shown_key_frame = 1;
    worker_->report(std::move(snapshot));
    action()->trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !worker_->key_frames_labeled.empty(); }, kPatience_ms));
    EXPECT_EQ(worker_->key_frames_labeled.back(), 1);
    label(halves());
    tools().setBrushSize(9);
    canvas().setFocus();
  }

  static cv::Mat halves() {
    cv::Mat regions(kHeight, kWidth, CV_32SC1, cv::Scalar(5));
    regions.colRange(kWidth / 2, kWidth).setTo(7);
    return regions;
  }
  /// The scan answers with the masks of the key frame.
  void label(const cv::Mat& regions) {
    KeyFrameLabels labels;
    labels.index = 1;
    labels.key_frame = 4;
    labels.image = 30;
    labels.color = cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(40, 80, 120));
    labels.regions = regions.clone();
    labels.fused_m = cv::Mat(kHeight, kWidth, CV_32FC1, cv::Scalar(1.5));
    worker_->report(KeyFrameLabeled{labels});
    const int first = regions.at<int>(0, 0);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return painting().hasLabels() && painting().labels().regions.at<int>(0, 0) == first; },
        kPatience_ms));
    QTest::qWait(200);
  }
  QAction* action() { return window_->parts().actions->image_mode; }
  ImageCanvas& canvas() { return window_->parts().image->canvas(); }
  PaintToolBar& tools() { return window_->parts().image->tools(); }
  ImageViewBar& bar() { return window_->parts().image->view(); }
  PaintController& painting() { return window_->parts().image_mode->painting(); }

  /// Zooms to 4 pixels of the canvas for one of the image, with that pixel in the middle.
  void zoomTo(const QPointF& pixel) {
    canvas().fit();
    for (int i = 0; i < 2; ++i) {
      const QPointF at = canvas().positionOf(pixel);
      canvas().zoomAt(at, 4 / canvas().zoom().scale());
    }
    ASSERT_DOUBLE_EQ(canvas().zoom().scale(), 4);
  }
  QPoint on(double x, double y) { return canvas().positionOf({x, y}).toPoint(); }
  /// Where a position of the canvas lies, in pixels of the image.
  cv::Point2f pixelAt(const QPoint& at) {
    const QPointF pixel = canvas().zoom().toImage(at) - QPointF(0.5, 0.5);
    return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
  }
  /// A move with the left button down; QTest::mouseMove() has no buttons.
  void moveTo(const QPoint& to) {
    QMouseEvent event(QEvent::MouseMove, QPointF(to), canvas().mapToGlobal(QPointF(to)), Qt::NoButton,
                      Qt::LeftButton, {});
    QApplication::sendEvent(&canvas(), &event);
  }
  void stroke(const QPoint& from, const QPoint& to) {
    QTest::mousePress(&canvas(), Qt::LeftButton, {}, from);
    moveTo(to);
    QTest::mouseRelease(&canvas(), Qt::LeftButton, {}, to);
  }
  /// The pixels whose centres lie within `radius` of a line segment.
  static cv::Mat within(const cv::Point2f& a, const cv::Point2f& b, double radius) {
    cv::Mat mask = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
    const cv::Point2d from(a), along = cv::Point2d(b) - from;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const cv::Point2d to = cv::Point2d(x, y) - from;
        const double share = std::clamp(to.dot(along) / along.dot(along), 0.0, 1.0);
        const cv::Point2d apart = to - share * along;
        if (std::hypot(apart.x, apart.y) <= radius) mask.at<std::uint8_t>(y, x) = 255;
      }
    }
    return mask;
  }
  static int differing(const cv::Mat& a, const cv::Mat& b) { return cv::countNonZero(a != b); }
  void wheel(const QPoint& at, int notches, Qt::KeyboardModifiers modifiers = {}) {
    QWheelEvent event(QPointF(at), canvas().mapToGlobal(QPointF(at)), {}, {0, 120 * notches}, Qt::NoButton,
                      modifiers, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&canvas(), &event);
  }
};

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

TEST_F(ImageModeTest, AStrokePaintsExactlyItsPixels_AndUndoRestoresThem) {
  zoomTo({320, 240});
  selection().select(RegionId{7});
  QTest::keyClick(&canvas(), Qt::Key_P);
  const QPoint from = on(300, 240), to = on(330, 250);
  stroke(from, to);
  const cv::Mat expected = within(pixelAt(from), pixelAt(to), 4.5);
  ASSERT_EQ(worker_->edits.size(), 1U);
  const Operation paint = *lastOperation();
  EXPECT_EQ(paint.kind, OperationKind::paint);
  EXPECT_EQ(paint.regions, std::vector{RegionId{7}});
  ASSERT_TRUE(paint.correction);
  EXPECT_EQ(differing(paint.correction->added.mask(), expected), 0);
  EXPECT_TRUE(paint.correction->removed.isEmpty());
  EXPECT_EQ(paint.correction->key_frame, 4);
  EXPECT_EQ(paint.correction->image, 30);
  EXPECT_FALSE(paint.correction->this_image_only);
  // The mask shows it before the scan has answered.
  cv::Mat painted = halves();
  painted.setTo(7, expected);
  EXPECT_EQ(differing(painting().regions(), painted), 0);

  const std::size_t labeled = worker_->key_frames_labeled.size();
  worker_->storeEdit({RegionId{7}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return worker_->key_frames_labeled.size() > labeled; }, kPatience_ms));
  label(painted);
  EXPECT_EQ(differing(painting().regions(), painted), 0);

  window_->parts().actions->undo->trigger();
  ASSERT_TRUE(std::holds_alternative<UndoEdit>(worker_->edits.back()));
  worker_->storeEdit({RegionId{7}});
  label(halves());
  EXPECT_EQ(differing(painting().regions(), halves()), 0);
}

TEST_F(ImageModeTest, CtrlZLeavesNoDraft_WhenTheScanHasStoredTheStroke) {
  zoomTo({320, 240});
  selection().select(RegionId{7});
  QTest::keyClick(&canvas(), Qt::Key_P);
  stroke(on(300, 240), on(330, 250));
  ASSERT_NE(lastOperation(), nullptr);
  cv::Mat painted = halves();
  painted.setTo(7, lastOperation()->correction->added.mask());
  worker_->storeEdit({RegionId{7}});
  label(painted);
  ASSERT_EQ(differing(painting().regions(), painted), 0);
  QTest::keyClick(&canvas(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(std::holds_alternative<UndoEdit>(worker_->edits.back()));
  worker_->storeEdit({RegionId{7}});
  label(halves());
  EXPECT_EQ(differing(painting().regions(), halves()), 0) << "what the scan has, without a draft over it";
}

// Both strokes are sent before the scan answers the first.
TEST_F(ImageModeTest, KeepsTheDraftOfTheSecondStroke_WhenTheFirstIsStored) {
  zoomTo({320, 240});
  selection().select(RegionId{7});
  QTest::keyClick(&canvas(), Qt::Key_P);
  stroke(on(300, 220), on(310, 220));
  stroke(on(300, 260), on(310, 260));
  ASSERT_EQ(worker_->edits.size(), 2U);
  const cv::Mat first = std::get<Operation>(worker_->edits[0]).correction->added.mask();
  const cv::Mat second = std::get<Operation>(worker_->edits[1]).correction->added.mask();
  worker_->storeEdit(0, {RegionId{7}});
  cv::Mat stored = halves();
  stored.setTo(7, first);
  label(stored);
  cv::Mat shown = stored.clone();
  shown.setTo(7, second);
  EXPECT_EQ(differing(painting().regions(), shown), 0);
}

TEST_F(ImageModeTest, AStrokePaintsTheRegionUnderItsFirstPixel) {
  zoomTo({320, 240});
  QTest::keyClick(&canvas(), Qt::Key_P);
  tools().thisImageBox()->setChecked(true);
  stroke(on(310, 240), on(335, 240));
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{5}});
  EXPECT_TRUE(lastOperation()->correction->this_image_only);
}

TEST_F(ImageModeTest, TheEraserTakesPixelsFromTheRegion) {
  zoomTo({320, 240});
  selection().select(RegionId{7});
  QTest::keyClick(&canvas(), Qt::Key_E);
  const QPoint from = on(315, 240), to = on(340, 240);
  stroke(from, to);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_TRUE(lastOperation()->correction->added.isEmpty());
  const cv::Mat erased = within(pixelAt(from), pixelAt(to), 4.5);
  EXPECT_EQ(differing(lastOperation()->correction->removed.mask(), erased), 0);
  cv::Mat expected = halves();
  expected.setTo(5, erased);  // the region beside takes them
  EXPECT_EQ(differing(painting().regions(), expected), 0);
}

TEST_F(ImageModeTest, EscapeDropsWhatIsBeingDrawn) {
  zoomTo({320, 240});
  selection().select(RegionId{7});
  QTest::keyClick(&canvas(), Qt::Key_P);
  QTest::mousePress(&canvas(), Qt::LeftButton, {}, on(300, 240));
  moveTo(on(310, 240));
  EXPECT_TRUE(painting().isDrawing());
  QTest::keyClick(&canvas(), Qt::Key_Escape);
  EXPECT_FALSE(painting().isDrawing());
  QTest::mouseRelease(&canvas(), Qt::LeftButton, {}, on(310, 240));
  QTest::keyClick(&canvas(), Qt::Key_L);
  for (const QPoint& corner : {on(300, 230), on(310, 230), on(310, 240)})
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, corner);
  QTest::keyClick(&canvas(), Qt::Key_Escape);
  QTest::keyClick(&canvas(), Qt::Key_Return);
  EXPECT_TRUE(worker_->edits.empty());
  EXPECT_EQ(differing(painting().regions(), halves()), 0);
  EXPECT_TRUE(selection().isSelected(RegionId{7})) << "Escape did not reach the selection";
}

TEST_F(ImageModeTest, APolygonIsClosedByReturn) {
  zoomTo({320, 240});
  selection().select(RegionId{7});
  QTest::keyClick(&canvas(), Qt::Key_L);
  for (const QPoint& corner : {on(299.5, 229.5), on(309.5, 229.5), on(309.5, 239.5), on(299.5, 239.5)})
    QTest::mouseClick(&canvas(), Qt::LeftButton, {}, corner);
  EXPECT_TRUE(worker_->edits.empty());
  QTest::keyClick(&canvas(), Qt::Key_Return);
  ASSERT_NE(lastOperation(), nullptr);
  cv::Mat square = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
  square(cv::Rect(300, 230, 10, 10)).setTo(255);
  EXPECT_EQ(differing(lastOperation()->correction->added.mask(), square), 0);
}

TEST_F(ImageModeTest, TwoMagicEdgesInARowPaintBoth) {
  zoomTo({320, 240});
  QTest::keyClick(&canvas(), Qt::Key_W);
  // The second outline is complete before the first one has been moved to its edges.
  for (const double left : {300.0, 310.0}) {
    QTest::mousePress(&canvas(), Qt::LeftButton, {}, on(left, left - 80));
    for (const QPointF& corner : {QPointF(30, 0), QPointF(30, 30), QPointF(0, 30)})
      moveTo(on(left + corner.x(), left - 80 + corner.y()));
    QTest::mouseRelease(&canvas(), Qt::LeftButton, {}, on(left, left - 80));
  }
  EXPECT_TRUE(QTest::qWaitFor([&] { return worker_->edits.size() == 2; }, kPatience_ms));
}

TEST_F(ImageModeTest, FillsAHole) {
  cv::Mat regions = halves();
  const cv::Rect hole(400, 200, 12, 9);
  regions(hole).setTo(5);
  label(regions);
  zoomTo({400, 200});
  QTest::keyClick(&canvas(), Qt::Key_H);
  QTest::mouseClick(&canvas(), Qt::LeftButton, {}, on(405, 204));
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{7}}) << "what encloses it";
  cv::Mat filled = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
  filled(hole).setTo(255);
  EXPECT_EQ(differing(lastOperation()->correction->added.mask(), filled), 0);
}

TEST_F(ImageModeTest, ANewRegionIsSelected_WhenTheScanHasMadeIt) {
  zoomTo({320, 240});
  QTest::keyClick(&canvas(), Qt::Key_P);
  QTest::keyClick(&canvas(), Qt::Key_Insert);
  EXPECT_TRUE(tools().newRegionBox()->isChecked());
  EXPECT_FALSE(tools().thisImageBox()->isEnabled());
  stroke(on(280, 240), on(300, 240));
  ASSERT_NE(lastOperation(), nullptr);
  const Operation paint = *lastOperation();
  EXPECT_TRUE(paint.correction->makes_region);
  EXPECT_EQ(paint.regions, std::vector{RegionId{5}});
  EXPECT_EQ(differing(paint.correction->removed.mask(), paint.correction->added.mask() == 0), 0);
  worker_->storeEdit({RegionId{7}, RegionId{5}});
  EXPECT_TRUE(QTest::qWaitFor([&] { return selection().isSelected(RegionId{7}); }, kPatience_ms));
}

TEST_F(ImageModeTest, ResetMaskTakesPaintingsBack) {
  tools().resetAction()->trigger();
  EXPECT_TRUE(worker_->edits.empty()) << "nothing is selected";
  selection().select(RegionId{7});
  tools().resetAction()->trigger();
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->kind, OperationKind::unpaint);
  EXPECT_EQ(lastOperation()->correction->added.width, kWidth);
}

TEST_F(ImageModeTest, AFailedEditLeavesTheMasks) {
  zoomTo({320, 240});
  selection().select(RegionId{7});
  QTest::keyClick(&canvas(), Qt::Key_P);
  stroke(on(300, 240), on(310, 240));
  ASSERT_NE(lastOperation(), nullptr);
  worker_->report(EditFailed{*lastOperation(), {"No.", ""}});
  label(halves());
  EXPECT_EQ(differing(painting().regions(), halves()), 0);
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

TEST_F(ImageModeTest, BracketsAndCtrlWheelChangeTheBrush) {
  QTest::keyClick(&canvas(), Qt::Key_P);
  QTest::keyClick(&canvas(), Qt::Key_BracketRight);
  EXPECT_GT(tools().brushSize(), 9);
  wheel(canvas().rect().center(), -1, Qt::ControlModifier);
  wheel(canvas().rect().center(), -1, Qt::ControlModifier);
  EXPECT_LT(tools().brushSize(), 9);
  EXPECT_TRUE(canvas().zoom().isFitted());
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
