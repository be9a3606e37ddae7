#pragma once
#include <gtest/gtest.h>

#include <QLineEdit>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/image_panel.h"

namespace scantrove::test {

inline constexpr int kPatience_ms = 4000;
inline constexpr std::size_t kPoints = 2UL * 8 * 8 * 64;  ///< of twoRegions()

/// Region 5 on the left half of the pictures, 7 on the right; in 3D two squares side by side.
class PointingTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    window_->open(QStringLiteral("demo"));
    worker_->report(twoRegions(4));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !panel(4)->picture().isNull(); }, kPatience_ms));
    // The 3D view gets the scene in parts.
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return view()->scene().cloud().pointCount() == kPoints; }, kPatience_ms));
  }

  ScanSnapshot twoRegions(int frame) {
    ScanSnapshot snapshot = snapshotOf(frame);
    snapshot.regions.colRange(160, 320).setTo(7);
    snapshot.changed_regions = {{FragmentId{1}, RegionId{5}}, {FragmentId{2}, RegionId{7}}};
    snapshot.region_infos = std::make_shared<const RegionInfos>(
        RegionInfos{{RegionId{5}, 4000, {}, {}}, {RegionId{7}, 1000, {"red cup", "cup"}, {}}});
    snapshot.operations = std::make_shared<const std::vector<DoneOperation>>();
    for (int b = 0; b < 2; ++b) {
      for (int row = 0; row < 8; ++row) {
        CloudBrick brick{Eigen::Vector3i(b * 8 - 8, row - 4, 32), 1, {}};
        for (int column = 0; column < 8; ++column) {
          brick.position.x() = b * 8 - 8 + column;
          brick.points.clear();
          for (int i = 0; i < 64; ++i) {
            const Eigen::Vector3f in_brick(Eigen::Vector3i(i % 8, i / 8, 0).cast<float>().array() + 0.5F);
            const Eigen::Vector3f point = (brick.position.cast<float>() * 8 + in_brick) * 3 / 512;
            brick.points.push_back(
                {point.x(), point.y(), point.z(), FragmentId{b == 0 ? 1U : 2U}, {}, 0, {}});
          }
          snapshot.changed_bricks.push_back(brick);
        }
      }
    }
    return snapshot;
  }

  ImagePanel* panel(std::size_t i) { return window_->parts().frames->panels()[i]; }
  SceneView* view() { return window_->parts().scene->view(); }
  /// Moves the mouse about a place of a picture until the region there is highlighted. A cursor that stands
  /// still gives no event, and the first may come before the picture.
  bool hoverOver(std::size_t picture, const QPointF& place, RegionId region) {
    return QTest::qWaitFor(
        [&] {
          const QPoint at = panel(picture)->positionOf(place).toPoint();
          QTest::mouseMove(panel(picture), at + QPoint(9, 9));
          QTest::mouseMove(panel(picture), at);
          return selection().hovered() == region;
        },
        kPatience_ms);
  }
  RegionSelection& selection() { return window_->regions().selection(); }
  QLineEdit* nameField() { return window_->regions().nameEditor().field(); }

  void clickPicture(std::size_t i, double x, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mouseClick(panel(i), Qt::LeftButton, modifiers, panel(i)->positionOf({x, 0.3}).toPoint());
  }
  /// A pixel of the 3D view inside a region; null: the region is not drawn.
  QPoint pixelInScene(RegionId region) {
    const cv::Mat& ids = view()->regionIds();
    cv::Mat mask = ids == static_cast<int>(region.value);
    cv::erode(mask, mask, {});
    std::vector<cv::Point> pixels;
    cv::findNonZero(mask, pixels);
    if (pixels.empty()) return {};
    const cv::Point middle = pixels[pixels.size() / 2];
    return {middle.x * view()->width() / ids.cols, middle.y * view()->height() / ids.rows};
  }
  const Operation* lastOperation() {
    return worker_->edits.empty() ? nullptr : std::get_if<Operation>(&worker_->edits.back());
  }
};

}  // namespace scantrove::test
