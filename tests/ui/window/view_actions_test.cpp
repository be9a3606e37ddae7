#include "ui/main_window/view_actions.h"

#include <QAction>
#include <QMouseEvent>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/scene_pane.h"
#include "ui/view/measure_tool.h"

namespace scantrove {
namespace {

using test::WindowTest;

constexpr float kVoxel_m = 3.0F / 512.0F;

class ViewActionsTest : public WindowTest {
 protected:
  ViewActions& view() { return *window_->parts().scene->viewActions(); }
  const CloudStyle& style() { return window_->parts().scene->view()->scene().cloud().style(); }

  /// A wall before the camera, half a metre wide and high, 1.17 m away.
  void showWall() {
    window_->open(QStringLiteral("demo"));
    ScanSnapshot snapshot = snapshotOf(4);
    for (int b = 0; b < 11 * 11; ++b) {
      CloudBrick brick{Eigen::Vector3i(b % 11 - 5, b / 11 - 5, 25), 1, {}};
      for (int i = 0; i < 64; ++i) {
        const Eigen::Vector3i voxel = 8 * brick.position + Eigen::Vector3i(i % 8, i / 8, 0);
        const Eigen::Vector3f center = kVoxel_m * (voxel.cast<float>().array() + 0.5F);
        brick.points.push_back({center.x(), center.y(), center.z(), FragmentId{1}});
      }
      snapshot.changed_bricks.push_back(brick);
    }
    snapshot.changed_regions = {{FragmentId{1}, RegionId{1}}};
    worker_->report(std::move(snapshot));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return window_->parts().scene->view()->scene().cloud().pointCount() > 0; }, 3000));
    window_->parts().scene->view()->setFollowing(false);
    window_->parts().scene->view()->scene().viewpoint().lookAt({0, 0, 0}, {0, 0, 1.17F});
  }
};

TEST_F(ViewActionsTest, KeysChangeTheColoring_AndItIsRemembered) {
  EXPECT_EQ(style().coloring, Coloring::regions);
  window_->open(QStringLiteral("demo"));
  QTest::keyClick(window_.get(), Qt::Key_1, Qt::AltModifier);
  EXPECT_EQ(style().coloring, Coloring::scene);
  EXPECT_TRUE(view().coloringActions().first()->isChecked());
  QTest::keyClick(window_.get(), Qt::Key_5, Qt::AltModifier);
  EXPECT_EQ(style().coloring, Coloring::height);
  QTest::keyClick(window_.get(), Qt::Key_R);
  EXPECT_EQ(style().coloring, Coloring::scene) << "the first follows the last";
  QTest::keyClick(window_.get(), Qt::Key_3, Qt::AltModifier);
  restart();
  EXPECT_EQ(style().coloring, Coloring::blended);
  EXPECT_TRUE(view().coloringActions()[2]->isChecked());
}

TEST_F(ViewActionsTest, ShiftBChangesTheBackgroundStyle) {
  view().setBackground({RegionId{5}});
  EXPECT_EQ(style().background, std::set{RegionId{5}});
  EXPECT_EQ(style().background_style, BackgroundStyle::as_others);
  window_->open(QStringLiteral("demo"));
  for (const BackgroundStyle next :
       {BackgroundStyle::dimmed, BackgroundStyle::hidden, BackgroundStyle::as_others}) {
    QTest::keyClick(window_.get(), Qt::Key_B, Qt::ShiftModifier);
    EXPECT_EQ(style().background_style, next);
    EXPECT_EQ(view().backgroundAction()->isChecked(), next != BackgroundStyle::as_others);
  }
  EXPECT_EQ(style().background, std::set{RegionId{5}});
}

TEST_F(ViewActionsTest, CtrlWheelMovesTheClipPlane_AndTheWheelZooms) {
  showWall();
  SceneView* scene = window_->parts().scene->view();
  QTest::keyClick(window_.get(), Qt::Key_X);
  ASSERT_TRUE(scene->scene().clipDistance());
  const float first = *scene->scene().clipDistance();
  const auto wheel = [&](Qt::KeyboardModifiers modifiers) {
    QWheelEvent event(QPointF(200, 200), scene->mapToGlobal(QPointF(200, 200)), {}, {0, 120}, Qt::NoButton,
                      modifiers, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(scene, &event);
  };
  const float distance = scene->scene().viewpoint().distance();
  wheel(Qt::ControlModifier);
  EXPECT_GT(*scene->scene().clipDistance(), first);
  EXPECT_EQ(scene->scene().viewpoint().distance(), distance);
  wheel({});
  EXPECT_LT(scene->scene().viewpoint().distance(), distance);
  QTest::keyClick(window_.get(), Qt::Key_X);
  EXPECT_FALSE(scene->scene().clipDistance());
}

TEST_F(ViewActionsTest, TwoClicksMeasureALength_AndEscapeEnds) {
  showWall();
  SceneView* scene = window_->parts().scene->view();
  QTest::keyClick(window_.get(), Qt::Key_T);
  ASSERT_TRUE(view().measureTool()->active());
  const QPoint middle = scene->rect().center();
  const QPoint aside = middle + QPoint(scene->height() / 8, 0);
  QTest::mouseClick(scene, Qt::LeftButton, {}, middle);
  EXPECT_FALSE(view().measureTool()->length());
  QTest::mouseClick(scene, Qt::LeftButton, {}, aside);
  ASSERT_TRUE(view().measureTool()->length());
  // An eighth of the view's height; its vertical angle is 40 degrees.
  const double expected = 1.17 * std::tan(20 * 3.14159265 / 180) / 4;
  EXPECT_NEAR(*view().measureTool()->length(), expected, 0.012);
  // A click outside the scene keeps the measurement.
  QTest::mouseClick(scene, Qt::LeftButton, {}, QPoint(2, 2));
  EXPECT_TRUE(view().measureTool()->length());
  scene->setFocus();
  QTest::keyClick(scene, Qt::Key_Escape);
  EXPECT_FALSE(view().measureTool()->active());
  EXPECT_FALSE(view().measureAction()->isChecked());
  EXPECT_FALSE(view().measureTool()->length());
}

TEST_F(ViewActionsTest, LengthTextIsInCentimetresOrMetres) {
  EXPECT_EQ(MeasureTool::lengthText(0.1234F), QStringLiteral("12.3 cm"));
  EXPECT_EQ(MeasureTool::lengthText(1.5F), QStringLiteral("1.500 m"));
}

TEST_F(ViewActionsTest, KeysTurnTheViewToTopAndFront) {
  showWall();
  SceneView* scene = window_->parts().scene->view();
  QTest::keyClick(window_.get(), Qt::Key_5, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_LT(scene->scene().viewpoint().forward().dot(scene->scene().viewpoint().up()), -0.99F);
  QTest::keyClick(window_.get(), Qt::Key_1, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_NEAR(scene->scene().viewpoint().forward().dot(scene->scene().viewpoint().up()), 0, 1e-3);
}

}  // namespace
}  // namespace scantrove
