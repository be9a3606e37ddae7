#include <gtest/gtest.h>

#include <QLabel>
#include <QListWidget>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>
#include <opencv2/core.hpp>

#include "ui/panels/camera_dialog.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/params_panel.h"
#include "ui/panels/status_strip.h"

namespace scantrove {
namespace {

SeenObject seenAt(float x, float y, float w, float h) {
  SeenObject object;
  object.object = ObjectId{3};
  object.name = "Obj_3";
  object.box = {x, y, w, h};
  return object;
}

/// How many pixels of `image` inside `rect` are exactly that colour.
int countPixels(const QImage& image, const QRect& rect, const QColor& color) {
  int count = 0;
  for (int y = rect.top(); y <= rect.bottom(); ++y) {
    for (int x = rect.left(); x <= rect.right(); ++x) {
      if (image.rect().contains(x, y) && image.pixelColor(x, y) == color) ++count;
    }
  }
  return count;
}

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

TEST_F(ColorPanelTest, DiscoveredObjectHasAWhiteRectangleThere) {
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

TEST_F(ColorPanelTest, RecognisedNameIsCyanAtTheTopLeftAndANewOneIsWhite) {
  const QColor cyan(0, 255, 255);
  SeenObject object = seenAt(0.25F, 0.5F, 0.25F, 0.25F);
  const QRect label(100, 128, 90, 21);
  EXPECT_EQ(countPixels(paint(object), label, cyan), 0);
  object.recognised = true;
  EXPECT_GT(countPixels(paint(object), label, cyan), 10);
}

TEST_F(ColorPanelTest, NameStaysInsideThePictureAtItsTopEdge) {
  SeenObject object = seenAt(0.3F, 0, 0.2F, 0.2F);
  object.recognised = true;
  EXPECT_GT(countPixels(paint(object), QRect(120, 0, 90, 24), QColor(0, 255, 255)), 10);
}

TEST_F(ColorPanelTest, ShowsTheNameThatAnObjectHasNow) {
  const QColor cyan(0, 255, 255);
  SeenObject object = seenAt(0.25F, 0.5F, 0.25F, 0.25F);
  object.recognised = true;
  const QRect beyond_the_old_name(170, 128, 100, 21);
  EXPECT_EQ(countPixels(paint(object), beyond_the_old_name, cyan), 0);
  panel_.setNameOf([](ObjectId) { return QStringLiteral("a name that is longer"); });
  EXPECT_GT(countPixels(paint(object), beyond_the_old_name, cyan), 10);
}

TEST(FramePanels, AClickMakesAnotherPictureLarge) {
  FramePanels panels;
  panels.resize(420, 700);
  panels.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&panels));
  EXPECT_EQ(panels.featured(), panels.panels()[0]);
  ImagePanel* regions = panels.panels()[4];
  const int small = regions->width();
  QTest::mouseClick(regions, Qt::LeftButton);
  EXPECT_EQ(panels.featured(), regions);
  EXPECT_GT(regions->width(), small * 3 / 2);
  QTest::mouseClick(regions, Qt::LeftButton);
  EXPECT_EQ(panels.featured(), panels.panels()[0]);
}

TEST(MessageBar, CountsRepetitionsAndKeepsErrors) {
  QWidget parent;
  MessageBar bar(&parent);
  EXPECT_TRUE(bar.isHidden());
  bar.show(MessageBar::Kind::warning, QStringLiteral("Frame 3 cannot be read."));
  bar.show(MessageBar::Kind::warning, QStringLiteral("Frame 3 cannot be read."));
  EXPECT_TRUE(
      bar.findChild<QLabel*>(QStringLiteral("messageText"))->text().contains(QStringLiteral("2 times")));
  bar.show(MessageBar::Kind::error, QStringLiteral("The disk is full."));
  bar.show(MessageBar::Kind::warning, QStringLiteral("Frame 4 cannot be read."));
  EXPECT_EQ(bar.text(), QStringLiteral("The disk is full."));
  bar.dismiss();
  EXPECT_TRUE(bar.isHidden());
}

TEST(CameraDialog, SaysWhatToDoWhenThereIsNoCamera) {
  CameraDialog dialog([] { return Result<std::vector<CameraInfo>>(std::vector<CameraInfo>{}); });
  const QString text = dialog.findChild<QLabel*>(QStringLiteral("cameraAdvice"))->text();
  EXPECT_TRUE(text.contains(QStringLiteral("No depth camera")));
  EXPECT_GT(text.size(), 60);
  EXPECT_EQ(dialog.source(), QStringLiteral("camera:Dummy"));
}

TEST(CameraDialog, ListsCamerasFirst) {
  CameraDialog dialog([] {
    return Result<std::vector<CameraInfo>>(
        std::vector<CameraInfo>{{"1d27/0601@1/5", "PS1080", "PrimeSense"}});
  });
  EXPECT_EQ(dialog.findChild<QListWidget*>()->count(), 2);
  EXPECT_EQ(dialog.source(), QStringLiteral("camera:1d27/0601@1/5"));
}

TEST(ParamsPanel, SliderChangesKAndDefaultsBringItBack) {
  ParamsPanel panel{ScanParams{}};
  QSignalSpy changes(&panel, &ParamsPanel::changed);
  auto* slider = panel.findChild<QSlider*>();
  slider->setValue(slider->maximum());
  EXPECT_NEAR(panel.params().segmentation.k, 10.0F, 1e-2F);
  EXPECT_EQ(changes.count(), 1);
  panel.setDefaults();
  EXPECT_EQ(panel.params().segmentation.k, ScanParams{}.segmentation.k);
  EXPECT_EQ(changes.count(), 2);
}

TEST(StatusStrip, SaysWhetherTheCameraIsTracked) {
  StatusStrip strip;
  strip.showState(ScanState::scanning);
  ScanSnapshot snapshot;
  snapshot.frame_index = 0;
  snapshot.pose.state = TrackingState::tracking;
  strip.showSnapshot(snapshot);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Tracking"));
  snapshot.pose.state = TrackingState::lost;
  strip.showSnapshot(snapshot);
  EXPECT_TRUE(strip.stateText().startsWith(QStringLiteral("Lost")));
  strip.showState(ScanState::finished);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Finished"));
}

}  // namespace
}  // namespace scantrove
