#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "tests/ui/window/panel_pixels.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/image_conversion.h"

namespace scantrove {
namespace {

using test::countPixels;
using test::seenAt;

class ColorPanelTest : public testing::Test {
 protected:
  QImage paint(const SeenObject& object) {
    panel_.resize(400, 300);
    panel_.setFrame(colorPicture(cv::Mat(480, 640, CV_8UC3, cv::Scalar(60, 60, 60))), {object});
    rect_ = panel_.objectRect(object);
    return panel_.grab().toImage();
  }
  ColorPanel panel_;
  QRectF rect_;
};

TEST_F(ColorPanelTest, DrawsAWhiteRectangleAroundANewObject) {
  const QImage image = paint(seenAt(0.25F, 0.5F, 0.25F, 0.25F));
  EXPECT_EQ(rect_, QRectF(100, 150, 100, 75));
  for (const QPoint& edge : {QPoint(150, 150), QPoint(150, 225), QPoint(100, 190), QPoint(200, 190)}) {
    int brightest = 0;
    for (int d = -2; d <= 2; ++d) {
      brightest = std::max({brightest, image.pixelColor(edge.x() + d, edge.y()).lightness(),
                            image.pixelColor(edge.x(), edge.y() + d).lightness()});
    }
    EXPECT_GT(brightest, 230) << edge.x() << "," << edge.y();
  }
  EXPECT_EQ(image.pixelColor(150, 190), QColor(60, 60, 60));
}

TEST_F(ColorPanelTest, BlendsTheGhostWithTheCameraImage_WhileTrackingIsLost) {
  const auto picture = [&] {
    panel_.resize(400, 300);
    return panel_.grab().toImage();
  };
  panel_.setFrame(colorPicture(cv::Mat(480, 640, CV_8UC3, cv::Scalar(60, 60, 60))), {});
  panel_.setGhost(colorPicture(cv::Mat(480, 640, CV_8UC3, cv::Scalar(0, 200, 0))));
  EXPECT_GT(picture().pixelColor(200, 150).green(), 120);
  EXPECT_GT(picture().pixelColor(200, 150).red(), 15) << "the camera image shines through";
  panel_.setGhost({});
  EXPECT_EQ(picture().pixelColor(200, 150), QColor(60, 60, 60));
}

TEST_F(ColorPanelTest, DrawsNamesOfRecognizedObjectsInCyan) {
  const QColor cyan(0, 255, 255);
  SeenObject object = seenAt(0.25F, 0.5F, 0.25F, 0.25F);
  const QRect label(100, 128, 90, 21);
  EXPECT_EQ(countPixels(paint(object), label, cyan), 0);
  object.recognized = true;
  EXPECT_GT(countPixels(paint(object), label, cyan), 10);
}

TEST_F(ColorPanelTest, LabelsAnObjectOnce_AtItsLargestRegion) {
  SeenObject small = seenAt(0.05F, 0.2F, 0.1F, 0.1F), large = seenAt(0.25F, 0.5F, 0.25F, 0.25F);
  small.recognized = large.recognized = true;
  paint(small);
  panel_.setFrame(colorPicture(cv::Mat(480, 640, CV_8UC3, cv::Scalar(60, 60, 60))), {small, large});
  const QImage image = panel_.grab().toImage();
  const QColor cyan(0, 255, 255);
  EXPECT_EQ(countPixels(image, QRect(20, 38, 90, 21), cyan), 0);
  EXPECT_GT(countPixels(image, QRect(100, 128, 90, 21), cyan), 10);
}

TEST_F(ColorPanelTest, KeepsTheNameInsideThePicture_AtTheTopEdge) {
  SeenObject object = seenAt(0.3F, 0, 0.2F, 0.2F);
  object.recognized = true;
  EXPECT_GT(countPixels(paint(object), QRect(120, 0, 90, 24), QColor(0, 255, 255)), 10);
}

TEST_F(ColorPanelTest, ShowsTheCurrentName_AfterARename) {
  const QColor cyan(0, 255, 255);
  SeenObject object = seenAt(0.25F, 0.5F, 0.25F, 0.25F);
  object.recognized = true;
  const QRect right_of_old_name(170, 128, 100, 21);
  EXPECT_EQ(countPixels(paint(object), right_of_old_name, cyan), 0);
  panel_.setNameOf([](ObjectId) { return QStringLiteral("a name that is longer"); });
  EXPECT_GT(countPixels(paint(object), right_of_old_name, cyan), 10);
}

TEST_F(ColorPanelTest, HighlightsTheSelectedObject) {
  const SeenObject object = seenAt(0.25F, 0.5F, 0.25F, 0.25F);
  const QColor yellow(255, 208, 0);
  EXPECT_EQ(countPixels(paint(object), QRect(90, 140, 120, 95), yellow), 0);
  panel_.setSelected({ObjectId{4}});
  EXPECT_EQ(countPixels(paint(object), QRect(90, 140, 120, 95), yellow), 0);
  panel_.setSelected({ObjectId{4}, object.object});
  const QImage image = paint(object);
  EXPECT_GT(countPixels(image, QRect(90, 140, 120, 95), yellow), 200);
  EXPECT_NE(image.pixelColor(150, 190), QColor(60, 60, 60));
}

TEST_F(ColorPanelTest, DrawsACandidateDashedWithoutName) {
  SeenObject candidate = seenAt(0.25F, 0.5F, 0.25F, 0.25F);
  candidate.object = {};
  candidate.name.clear();
  candidate.regions = {RegionId{7}, RegionId{9}};
  const QImage image = paint(candidate);
  int bright = 0, dark = 0;
  for (int x = 105; x < 195; ++x) {
    int brightest = 0;
    for (int d = -2; d <= 2; ++d) brightest = std::max(brightest, image.pixelColor(x, 150 + d).lightness());
    ++(brightest > 150 ? bright : dark);
  }
  EXPECT_GT(bright, 20);
  EXPECT_GT(dark, 10) << "gaps between the dashes";
  EXPECT_EQ(countPixels(image, QRect(100, 122, 90, 21), QColor(60, 60, 60)), 90 * 21) << "no name above";
}

}  // namespace
}  // namespace scantrove
