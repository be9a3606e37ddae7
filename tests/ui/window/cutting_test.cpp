// Cutting a region by strokes, with real mouse events.
#include <QImage>
#include <algorithm>

#include "tests/ui/window/pointing_fixture.h"
#include "ui/main_window/region_splitter.h"
#include "ui/panels/help_dialog.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/scene_overlay.h"

namespace scantrove::test {
namespace {

class CuttingTest : public PointingTest {
 protected:
  /// A stroke of few events that lie far apart, as by hand. `release` false: the button stays down.
  static void draw(QWidget* widget, const QPoint& from, const QPoint& to,
                   Qt::KeyboardModifiers modifiers = {}, bool release = true) {
    QTest::mousePress(widget, Qt::LeftButton, modifiers, from);
    for (int i = 1; i <= 4; ++i) move(widget, from + (to - from) * i / 4, modifiers);
    if (release) QTest::mouseRelease(widget, Qt::LeftButton, modifiers, to);
  }
  /// A move with the left button down; QTest::mouseMove() has no buttons.
  static void move(QWidget* widget, const QPoint& to, Qt::KeyboardModifiers modifiers) {
    QMouseEvent event(QEvent::MouseMove, QPointF(to), widget->mapToGlobal(QPointF(to)), Qt::NoButton,
                      Qt::LeftButton, modifiers);
    QApplication::sendEvent(widget, &event);
  }
  QPoint inPicture(std::size_t i, double x, double y) { return panel(i)->positionOf({x, y}).toPoint(); }
  void drawInPicture(std::size_t i, const QPointF& from, const QPointF& to,
                     Qt::KeyboardModifiers modifiers = {}, bool release = true) {
    draw(panel(i), inPicture(i, from.x(), from.y()), inPicture(i, to.x(), to.y()), modifiers, release);
  }
  /// World x, in metres, of the points at `fraction` of a picture's width.
  static float worldX(double fraction) { return static_cast<float>((320 * fraction - 160) * 1.5 / 290); }
  /// Fits the scene into the view and waits until it is drawn.
  void showAllOfScene() {
    bool is_drawn = false;
    const auto connection = QObject::connect(view(), &SceneView::drawn, [&] { is_drawn = true; });
    view()->fitAll();
    const bool was_drawn = QTest::qWaitFor([&] { return is_drawn; }, kPatience_ms);
    QObject::disconnect(connection);
    ASSERT_TRUE(was_drawn);
    ASSERT_FALSE(pixelInScene(RegionId{5}).isNull());
  }
  SceneOverlay* overlay() { return window_->parts().scene->overlay(); }
  /// The number of pixels that differ by less than 24 per channel from `color`.
  static int pixelsLike(QWidget* widget, const QColor& color) {
    const QImage shown = widget->grab().toImage().convertToFormat(QImage::Format_RGB32);
    int count = 0;
    for (int y = 0; y < shown.height(); ++y) {
      for (int x = 0; x < shown.width(); ++x) {
        const QColor pixel = shown.pixelColor(x, y);
        const int off =
            std::max({std::abs(pixel.red() - color.red()), std::abs(pixel.green() - color.green()),
                      std::abs(pixel.blue() - color.blue())});
        count += off < 24 ? 1 : 0;
      }
    }
    return count;
  }
};

TEST_F(CuttingTest, TwoStrokesInAPictureCutARegion) {
  QTest::keyClick(panel(0), Qt::Key_C);
  EXPECT_TRUE(overlay()->hint().contains(QStringLiteral("1 of 2")));
  drawInPicture(0, {0.05, 0.3}, {0.05, 0.7});
  EXPECT_TRUE(overlay()->hint().contains(QStringLiteral("2 of 2")));
  EXPECT_TRUE(worker_->edits.empty());
  drawInPicture(0, {0.3, 0.3}, {0.45, 0.3});
  ASSERT_NE(lastOperation(), nullptr);
  const Operation& cut = *lastOperation();
  EXPECT_EQ(cut.kind, OperationKind::cut);
  EXPECT_EQ(cut.regions, std::vector{RegionId{5}});
  ASSERT_GT(cut.here_world.size(), 10U);
  ASSERT_GT(cut.there_world.size(), 5U);
  for (const Eigen::Vector3f& point : cut.here_world) EXPECT_NEAR(point.x(), worldX(0.05), 0.02F);
  EXPECT_NEAR(cut.here_world.back().y() - cut.here_world.front().y(), 0.4F * 240 * 1.5F / 290, 0.03F);
  // Points between the four mouse events are filled in: a cut needs them less than 3 cm apart.
  for (std::size_t i = 1; i < cut.here_world.size(); ++i)
    EXPECT_LT((cut.here_world[i] - cut.here_world[i - 1]).norm(), 0.03F) << i;
  EXPECT_NEAR(cut.there_world.front().x(), worldX(0.3), 0.02F);
  EXPECT_NEAR(cut.there_world.back().x(), worldX(0.45), 0.02F);
  EXPECT_TRUE(selection().selected() == std::vector{RegionId{5}}) << "the drag selected nothing";
}

TEST_F(CuttingTest, StrokeIsDrawnAtOnce_AndMarkedInAllViews) {
  window_->parts().frames->feature(panel(4));
  QTest::keyClick(panel(0), Qt::Key_C);
  const int red_before = pixelsLike(panel(0), RegionSplitter::kHereColor);
  drawInPicture(0, {0.1, 0.2}, {0.1, 0.8}, {}, false);
  EXPECT_GT(panel(0)->stroke().size(), 10);
  EXPECT_GT(pixelsLike(panel(0), RegionSplitter::kHereColor), red_before + 50);
  QTest::mouseRelease(panel(0), Qt::LeftButton, {}, inPicture(0, 0.1, 0.8));
  EXPECT_TRUE(panel(0)->stroke().isEmpty());
  for (std::size_t i = 0; i < 5; ++i) {
    ASSERT_EQ(panel(i)->marks().size(), 1U) << i;
    EXPECT_EQ(panel(i)->marks()[0].color, RegionSplitter::kHereColor);
    for (const QPointF& fraction : panel(i)->marks()[0].fractions) EXPECT_NEAR(fraction.x(), 0.1, 0.02);
  }
  const int blue_before = pixelsLike(panel(4), RegionSplitter::kThereColor);
  drawInPicture(4, {0.4, 0.2}, {0.4, 0.8}, {}, false);
  EXPECT_GT(pixelsLike(panel(4), RegionSplitter::kThereColor), blue_before + 50) << "the second colour";
  QTest::mouseRelease(panel(4), Qt::LeftButton, {}, inPicture(4, 0.4, 0.8));
  EXPECT_EQ(panel(2)->marks().size(), 2U);
  QTest::keyClick(panel(0), Qt::Key_Return);
  EXPECT_TRUE(panel(2)->marks().empty()) << "the cut is made";
  EXPECT_EQ(worker_->edits.size(), 1U);
}

TEST_F(CuttingTest, StrokesInTheSceneCutTheSurface) {
  showAllOfScene();
  const QPoint middle = pixelInScene(RegionId{5});
  const QPoint reach(0, view()->height() / 8);
  ASSERT_EQ(view()->at(middle - reach).region, RegionId{5});
  ASSERT_EQ(view()->at(middle + reach).region, RegionId{5});
  view()->setFocus();
  QTest::keyClick(view(), Qt::Key_C);
  const Eigen::Vector3f eye = view()->scene().viewpoint().eye();
  draw(view(), middle - reach, middle + reach, {}, false);
  EXPECT_GT(overlay()->stroke().size(), 10);
  EXPECT_GT(pixelsLike(overlay(), RegionSplitter::kHereColor), 50);
  QTest::mouseRelease(view(), Qt::LeftButton, {}, middle + reach);
  EXPECT_TRUE(overlay()->stroke().isEmpty());
  EXPECT_EQ(view()->scene().viewpoint().eye(), eye) << "the view does not turn";
  ASSERT_EQ(overlay()->marks().size(), 1U);
  const QPoint aside(view()->width() / 12, 0);
  ASSERT_EQ(view()->at(middle - aside).region, RegionId{5});
  QTest::mouseClick(view(), Qt::LeftButton, {}, middle - aside);  // a stroke of one point
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{5}});
  EXPECT_GT(lastOperation()->here_world.size(), 5U);
  EXPECT_EQ(lastOperation()->there_world.size(), 1U);
  for (const Eigen::Vector3f& point : lastOperation()->here_world)
    EXPECT_NEAR(point.z(), 256.5F * 3 / 512, 0.01F) << "on the surface";
}

TEST_F(CuttingTest, ViewFollowsTheCameraAgain_AfterAStroke) {
  showAllOfScene();
  const QPoint middle = pixelInScene(RegionId{5});
  view()->setFollowing(true);
  view()->setFocus();
  QTest::keyClick(view(), Qt::Key_C);
  draw(view(), middle, middle + QPoint(8, 8), {}, false);
  EXPECT_FALSE(view()->scene().following()) << "the scene rests below the pointer";
  QTest::mouseRelease(view(), Qt::LeftButton, {}, middle + QPoint(8, 8));
  EXPECT_TRUE(view()->scene().following());
}

TEST_F(CuttingTest, DragOutsideTheSceneTurnsTheView) {
  showAllOfScene();
  view()->setFocus();
  QTest::keyClick(view(), Qt::Key_C);
  const Eigen::Vector3f eye = view()->scene().viewpoint().eye();
  ASSERT_FALSE(view()->at(QPointF(3, 3)).region);
  draw(view(), QPoint(3, 3), QPoint(120, 60));
  EXPECT_NE(view()->scene().viewpoint().eye(), eye);
  EXPECT_TRUE(overlay()->marks().empty());
  EXPECT_TRUE(overlay()->hint().contains(QStringLiteral("1 of 2")));
}

TEST_F(CuttingTest, CutsOnlyTheRegionWhereTheFirstStrokeBegins) {
  QTest::keyClick(panel(0), Qt::Key_C);
  drawInPicture(0, {0.3, 0.3}, {0.7, 0.3});  // beyond the edge of region 5
  EXPECT_EQ(selection().selected(), std::vector{RegionId{5}});
  drawInPicture(0, {0.8, 0.6}, {0.95, 0.6});
  EXPECT_TRUE(worker_->edits.empty()) << "the strokes are in two regions";
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().messages->isVisible(); }, kPatience_ms));
  EXPECT_TRUE(overlay()->hint().contains(QStringLiteral("2 of 2"))) << "the step can be repeated";
  drawInPicture(0, {0.05, 0.6}, {0.1, 0.6});
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{5}});
  for (const Eigen::Vector3f& point : lastOperation()->here_world) EXPECT_LT(point.x(), worldX(0.5));
}

TEST_F(CuttingTest, ShiftAddsStrokesToTheSameSide) {
  QTest::keyClick(panel(0), Qt::Key_C);
  drawInPicture(0, {0.05, 0.2}, {0.05, 0.4}, Qt::ShiftModifier);
  drawInPicture(0, {0.1, 0.6}, {0.1, 0.8}, Qt::ShiftModifier);
  EXPECT_TRUE(overlay()->hint().contains(QStringLiteral("1 of 2")));
  QTest::keyClick(panel(0), Qt::Key_Return);
  EXPECT_TRUE(overlay()->hint().contains(QStringLiteral("2 of 2")));
  EXPECT_FALSE(nameField()->isVisible()) << "Return ends the side and starts no naming";
  drawInPicture(0, {0.4, 0.2}, {0.4, 0.4});
  ASSERT_NE(lastOperation(), nullptr);
  const auto& here = lastOperation()->here_world;
  EXPECT_NEAR(here.front().x(), worldX(0.05), 0.02F);
  EXPECT_NEAR(here.back().x(), worldX(0.1), 0.02F);
}

TEST_F(CuttingTest, ReturnAfterOneStrokeSplitsByColor_AndAFailureAsksForTheSecond) {
  QTest::keyClick(panel(0), Qt::Key_C);
  QTest::keyClick(panel(0), Qt::Key_Return);
  EXPECT_TRUE(worker_->edits.empty()) << "there is no stroke yet";
  drawInPicture(0, {0.1, 0.2}, {0.1, 0.8});
  EXPECT_TRUE(overlay()->hint().contains(QStringLiteral("Return splits by colour")));
  QTest::keyClick(panel(0), Qt::Key_Return);
  ASSERT_NE(lastOperation(), nullptr);
  EXPECT_EQ(lastOperation()->kind, OperationKind::cut);
  EXPECT_GT(lastOperation()->here_world.size(), 5U);
  EXPECT_TRUE(lastOperation()->there_world.empty());
  worker_->report(EditFailed{worker_->edits.back(), Error{"Nothing differs.", "Draw a second stroke."}});
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return overlay()->hint().contains(QStringLiteral("2 of 2")); }, kPatience_ms));
  drawInPicture(0, {0.4, 0.2}, {0.4, 0.8});
  ASSERT_EQ(worker_->edits.size(), 2U);
  EXPECT_GT(lastOperation()->here_world.size(), 5U) << "the first stroke is kept";
  EXPECT_GT(lastOperation()->there_world.size(), 5U);
}

TEST_F(CuttingTest, EscapeCancelsAStroke_AndUndoRevertsACut) {
  QTest::keyClick(panel(0), Qt::Key_C);
  drawInPicture(0, {0.1, 0.2}, {0.1, 0.8}, {}, false);
  QTest::keyClick(panel(0), Qt::Key_Escape);
  EXPECT_TRUE(panel(0)->stroke().isEmpty());
  QTest::mouseRelease(panel(0), Qt::LeftButton, {}, inPicture(0, 0.1, 0.8));
  EXPECT_TRUE(overlay()->hint().isEmpty());
  EXPECT_TRUE(panel(0)->marks().empty());
  drawInPicture(0, {0.02, 0.02}, {0.98, 0.98});
  EXPECT_EQ(selection().selected().size(), 2U) << "drags select again";
  EXPECT_TRUE(worker_->edits.empty());

  QTest::keyClick(panel(0), Qt::Key_C);
  drawInPicture(0, {0.1, 0.2}, {0.1, 0.8});
  drawInPicture(0, {0.4, 0.2}, {0.4, 0.8});
  ASSERT_EQ(worker_->edits.size(), 1U);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(worker_->edits.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<UndoEdit>(worker_->edits.back()));
  QTest::keyClick(window_.get(), Qt::Key_Y, Qt::ControlModifier);
  ASSERT_EQ(worker_->edits.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<RedoEdit>(worker_->edits.back()));
}

TEST_F(CuttingTest, TagAtThePointerShowsTheNextStep) {
  QTest::keyClick(panel(0), Qt::Key_C);
  QTest::mouseMove(panel(0), inPicture(0, 0.8, 0.6));  // no event comes if the pointer is there already
  QTest::mouseMove(panel(0), inPicture(0, 0.2, 0.3));
  ASSERT_TRUE(QTest::qWaitFor([&] { return selection().hovered() == RegionId{5}; }, kPatience_ms));
  EXPECT_EQ(panel(0)->tag().value(2), QStringLiteral("Draw over one part"));
  drawInPicture(0, {0.1, 0.2}, {0.1, 0.8});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return panel(0)->tag().value(2) == QStringLiteral("Draw over the other part"); }, kPatience_ms))
      << "at the end of the stroke, without a move";
}

TEST_F(CuttingTest, ReportsAClickWithoutDepth) {
  QTest::keyClick(panel(0), Qt::Key_C);
  emit window_->parts().frames->clicked(RegionPoint{}, Qt::NoModifier);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().messages->isVisible(); }, kPatience_ms));
  EXPECT_TRUE(overlay()->hint().contains(QStringLiteral("1 of 2"))) << "the step can be repeated";
}

}  // namespace
}  // namespace scantrove::test
