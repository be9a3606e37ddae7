#include "ui/painting/canvas_zoom.h"

#include <gtest/gtest.h>

namespace scantrove::test {
namespace {

class CanvasZoomTest : public testing::Test {
 protected:
  CanvasZoomTest() { zoom_.setSizes({640, 480}, {800, 800}); }
  static void expectNear(const QPointF& a, const QPointF& b) {
    EXPECT_NEAR(a.x(), b.x(), 1e-6);
    EXPECT_NEAR(a.y(), b.y(), 1e-6);
  }
  CanvasZoom zoom_;
};

TEST_F(CanvasZoomTest, FitsAtFirst) {
  EXPECT_TRUE(zoom_.isFitted());
  EXPECT_DOUBLE_EQ(zoom_.scale(), 800.0 / 640);
  expectNear(zoom_.toView({0, 0}), {0, 100});
  expectNear(zoom_.toView({640, 480}), {800, 700});
  expectNear(zoom_.imageRect().center(), {400, 400});
}

TEST_F(CanvasZoomTest, KeepsThePlaceUnderThePointer) {
  for (const QPointF at : {QPointF(100, 150), QPointF(700, 650), QPointF(400, 400), QPointF(3, 101)}) {
    zoom_.fit();
    const QPointF before = zoom_.toImage(at);
    for (int i = 0; i < 12; ++i) {
      zoom_.zoomAt(at, 1.3);
      expectNear(zoom_.toImage(at), before);
    }
  }
}

TEST_F(CanvasZoomTest, HasLimits) {
  zoom_.zoomAt({400, 400}, 1e6);
  EXPECT_DOUBLE_EQ(zoom_.scale(), CanvasZoom::kMaxScale);
  zoom_.zoomAt({400, 400}, 1e-6);
  EXPECT_TRUE(zoom_.isFitted()) << "not smaller than the view";
}

TEST_F(CanvasZoomTest, PanningKeepsTheImageInView) {
  zoom_.pan({50, 0});
  EXPECT_TRUE(zoom_.isFitted()) << "all of it is shown";
  zoom_.zoomAt({400, 400}, 4);
  const QPointF before = zoom_.toView({100, 100});
  zoom_.pan({30, -20});
  expectNear(zoom_.toView({100, 100}), before + QPointF(30, -20));
  zoom_.pan({1e6, 1e6});
  expectNear(zoom_.toView({0, 0}), {400, 400});
  zoom_.pan({-1e6, -1e6});
  expectNear(zoom_.toView({640, 480}), {400, 400});
}

TEST_F(CanvasZoomTest, KeepsItsMiddle_WhenTheViewChanges) {
  zoom_.zoomAt({400, 400}, 4);
  const QPointF middle = zoom_.toImage({400, 400});
  zoom_.setSizes({640, 480}, {600, 300});
  expectNear(zoom_.toImage({300, 150}), middle);
  EXPECT_FALSE(zoom_.isFitted());
  zoom_.setSizes({320, 240}, {600, 300});
  EXPECT_TRUE(zoom_.isFitted()) << "another image";
}

}  // namespace
}  // namespace scantrove::test
