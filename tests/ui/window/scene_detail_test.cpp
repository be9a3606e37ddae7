#include <QSignalSpy>

#include "tests/ui/window/pointing_fixture.h"
#include "ui/view/scene_drawing.h"

namespace scantrove::test {
namespace {

using SceneDetailTest = PointingTest;

TEST_F(SceneDetailTest, BarBesideTheViewLeavesItsDetail) {
  worker_->finish();
  const SceneDrawing& drawing = view()->drawing();
  ASSERT_TRUE(QTest::qWaitFor([&] { return drawing.isDetailed(); }, kPatience_ms));
  QTest::qWait(500);  // until nothing is drawn any more
  QSignalSpy drawn(&drawing, &SceneDrawing::drawn);
  view()->setFixedHeight(view()->height() - 40);
  QTest::qWait(100);
  EXPECT_TRUE(drawing.isDetailed());
  EXPECT_EQ(drawn.count(), 0) << "the picture is stretched";
  EXPECT_TRUE(QTest::qWaitFor([&] { return drawn.count() == 1; }, kPatience_ms));
  EXPECT_TRUE(QTest::qWaitFor([&] { return drawing.isDetailed(); }, kPatience_ms)) << "drawn anew in detail";
}

}  // namespace
}  // namespace scantrove::test
