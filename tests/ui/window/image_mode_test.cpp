// Painting in the image mode, with real mouse events on its canvas.
#include <QCheckBox>
#include <QSlider>
#include <string>

#include "tests/ui/window/image_mode_fixture.h"

namespace scantrove::test {
namespace {

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
  EXPECT_FALSE(tools().newRegionBox()->isChecked()) << "one region for each tick";
  worker_->storeEdit({RegionId{7}, RegionId{5}});
  EXPECT_TRUE(QTest::qWaitFor([&] { return selection().isSelected(RegionId{7}); }, kPatience_ms));
  stroke(on(290, 240), on(310, 240));
  ASSERT_EQ(worker_->edits.size(), 2U);
  EXPECT_FALSE(lastOperation()->correction->makes_region);
  EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{7}}) << "the next stroke extends it";
}

TEST_F(ImageModeTest, MagicEdgeMakesOneRegionForEachTick) {
  zoomTo({320, 240});
  QTest::keyClick(&canvas(), Qt::Key_W);
  QTest::keyClick(&canvas(), Qt::Key_Insert);
  QTest::mousePress(&canvas(), Qt::LeftButton, {}, on(280, 220));
  for (const QPointF& corner : {QPointF(310, 220), QPointF(310, 250), QPointF(280, 250)})
    moveTo(on(corner.x(), corner.y()));
  QTest::mouseRelease(&canvas(), Qt::LeftButton, {}, on(280, 220));
  EXPECT_FALSE(tools().newRegionBox()->isChecked());
  ASSERT_TRUE(QTest::qWaitFor([&] { return worker_->edits.size() == 1; }, kPatience_ms));
  EXPECT_TRUE(lastOperation()->correction->makes_region);
  worker_->storeEdit({RegionId{7}, RegionId{5}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return selection().isSelected(RegionId{7}); }, kPatience_ms));
  QTest::keyClick(&canvas(), Qt::Key_P);
  stroke(on(300, 240), on(318, 240));
  ASSERT_EQ(worker_->edits.size(), 2U);
  EXPECT_FALSE(lastOperation()->correction->makes_region) << "no second region unasked";
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

TEST_F(ImageModeTest, BracketsAndCtrlWheelChangeTheBrush) {
  QTest::keyClick(&canvas(), Qt::Key_P);
  QTest::keyClick(&canvas(), Qt::Key_BracketRight);
  EXPECT_GT(tools().brushSize(), 9);
  wheel(canvas().rect().center(), -1, Qt::ControlModifier);
  wheel(canvas().rect().center(), -1, Qt::ControlModifier);
  EXPECT_LT(tools().brushSize(), 9);
  EXPECT_TRUE(canvas().zoom().isFitted());
}

}  // namespace
}  // namespace scantrove::test
