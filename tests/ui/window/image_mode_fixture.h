#pragma once
#include <QAction>
#include <QApplication>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "tests/ui/window/pointing_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/painting/image_canvas.h"
#include "ui/painting/image_mode.h"
#include "ui/painting/image_page.h"
#include "ui/painting/image_view_bar.h"
#include "ui/painting/paint_controller.h"
#include "ui/painting/paint_tool_bar.h"

namespace scantrove::test {

/// Key frame 1 of an open scan: region 5 on the left half of the image, 7 on the right.
class ImageModeTest : public PointingTest {
 protected:
  static constexpr int kWidth = 640, kHeight = 480;

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

}  // namespace scantrove::test
