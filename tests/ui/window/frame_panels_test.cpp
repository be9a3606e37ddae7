#include <gtest/gtest.h>

#include <QTest>
#include <opencv2/core.hpp>

#include "tests/ui/window/panel_pixels.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/image_panel.h"

namespace scantrove {
namespace {

using test::seenAt;

TEST(FramePanels, DarkensRegionsOutsideTheSelectedObject) {
  FramePanels panels;
  ScanSnapshot snapshot;
  snapshot.color = cv::Mat(48, 64, CV_8UC3, cv::Scalar(60, 60, 60));
  snapshot.regions = cv::Mat(48, 64, CV_32SC1, cv::Scalar(5));
  snapshot.regions.colRange(32, 64).setTo(7);
  SeenObject object = seenAt(0.5F, 0, 0.5F, 1);
  object.regions = {RegionId{7}};
  snapshot.objects = {object};
  panels.showSnapshot(snapshot);
  const ImagePanel* regions = panels.panels()[4];
  const QColor lit = regions->picture().pixelColor(50, 20);
  const QColor other = regions->picture().pixelColor(10, 20);
  panels.setSelected({object.object});
  EXPECT_EQ(regions->picture().pixelColor(50, 20), lit);
  EXPECT_LT(regions->picture().pixelColor(10, 20).lightness(), other.lightness() / 2);
  panels.setSelected({});
  EXPECT_EQ(regions->picture().pixelColor(10, 20), other);
}

TEST(FramePanels, SaysSo_WhenAFrameHasNoColor) {
  FramePanels panels;
  ImagePanel* color = panels.panels()[0];
  EXPECT_TRUE(color->emptyText().isEmpty()) << "before the first frame";
  ScanSnapshot snapshot;
  snapshot.regions = cv::Mat(48, 64, CV_32SC1, cv::Scalar(5));
  snapshot.depth_raw_m = cv::Mat(48, 64, CV_32FC1, cv::Scalar(1));
  panels.showSnapshot(snapshot);
  EXPECT_TRUE(color->picture().isNull());
  EXPECT_FALSE(color->emptyText().isEmpty());
  panels.resize(420, 700);
  EXPECT_FALSE(panels.grab().isNull());
  panels.clear();
  EXPECT_TRUE(color->emptyText().isEmpty());
}

TEST(FramePanels, EnlargesAPicture_WhenItsTitleIsClicked) {
  FramePanels panels;
  panels.resize(420, 700);
  ScanSnapshot snapshot;
  snapshot.color = cv::Mat(48, 64, CV_8UC3, cv::Scalar(60, 60, 60));
  snapshot.regions = cv::Mat(48, 64, CV_32SC1, cv::Scalar(5));
  panels.showSnapshot(snapshot);
  panels.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&panels));
  EXPECT_EQ(panels.featured(), panels.panels()[0]);
  ImagePanel* regions = panels.panels()[4];
  const int small = regions->width();
  QTest::mouseClick(regions, Qt::LeftButton, {}, regions->titleRect().center().toPoint());
  EXPECT_EQ(panels.featured(), regions);
  EXPECT_GT(regions->width(), small * 3 / 2);
  QTest::mouseClick(regions, Qt::LeftButton, {}, QPoint(regions->width() / 2, 20));
  EXPECT_EQ(panels.featured(), regions) << "a click on the picture selects a region";
  QTest::mouseClick(regions, Qt::LeftButton, {}, regions->titleRect().center().toPoint());
  EXPECT_EQ(panels.featured(), panels.panels()[0]);
}

}  // namespace
}  // namespace scantrove
