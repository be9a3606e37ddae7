#include <gtest/gtest.h>

#include <QAction>
#include <QLabel>
#include <QListWidget>
#include <QPainter>
#include <QProgressBar>
#include <QSignalSpy>
#include <QSlider>
#include <QStandardItemModel>
#include <QTest>
#include <QToolButton>
#include <opencv2/core.hpp>

#include "ui/models/object_list_model.h"
#include "ui/panels/camera_dialog.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/elided_label.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/object_delegate.h"
#include "ui/panels/params_panel.h"
#include "ui/panels/progress_strip.h"
#include "ui/panels/status_strip.h"
#include "ui/theme/theme.h"

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

TEST_F(ColorPanelTest, WhileTheCameraIsLostAGhostShowsWhereToPointIt) {
  const auto picture = [&] {
    panel_.resize(400, 300);
    return panel_.grab().toImage();
  };
  panel_.setFrame(colorPicture(cv::Mat(480, 640, CV_8UC3, cv::Scalar(60, 60, 60))), {});
  panel_.setGhost(colorPicture(cv::Mat(480, 640, CV_8UC3, cv::Scalar(0, 200, 0))));
  EXPECT_GT(picture().pixelColor(200, 150).green(), 120);
  EXPECT_GT(picture().pixelColor(200, 150).red(), 15) << "what the camera sees now shines through";
  panel_.setGhost({});
  EXPECT_EQ(picture().pixelColor(200, 150), QColor(60, 60, 60));
}

TEST_F(ColorPanelTest, RecognizedNameIsCyanAtTheTopLeftAndANewOneIsWhite) {
  const QColor cyan(0, 255, 255);
  SeenObject object = seenAt(0.25F, 0.5F, 0.25F, 0.25F);
  const QRect label(100, 128, 90, 21);
  EXPECT_EQ(countPixels(paint(object), label, cyan), 0);
  object.recognized = true;
  EXPECT_GT(countPixels(paint(object), label, cyan), 10);
}

TEST_F(ColorPanelTest, NameStaysInsideThePictureAtItsTopEdge) {
  SeenObject object = seenAt(0.3F, 0, 0.2F, 0.2F);
  object.recognized = true;
  EXPECT_GT(countPixels(paint(object), QRect(120, 0, 90, 24), QColor(0, 255, 255)), 10);
}

TEST_F(ColorPanelTest, ShowsTheNameThatAnObjectHasNow) {
  const QColor cyan(0, 255, 255);
  SeenObject object = seenAt(0.25F, 0.5F, 0.25F, 0.25F);
  object.recognized = true;
  const QRect beyond_the_old_name(170, 128, 100, 21);
  EXPECT_EQ(countPixels(paint(object), beyond_the_old_name, cyan), 0);
  panel_.setNameOf([](ObjectId) { return QStringLiteral("a name that is longer"); });
  EXPECT_GT(countPixels(paint(object), beyond_the_old_name, cyan), 10);
}

TEST_F(ColorPanelTest, SelectedObjectIsLitUp) {
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

TEST_F(ColorPanelTest, ACandidateIsDashedAndHasNoName) {
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

TEST(FramePanels, RegionsBesideASelectedObjectAreDark) {
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

TEST(FramePanels, AClickOnATitleMakesAnotherPictureLarge) {
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

/// Counts how often a widget is drawn.
class PaintCounter : public QObject {
 public:
  explicit PaintCounter(QWidget* widget) { widget->installEventFilter(this); }
  int paints = 0;

 protected:
  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    paints += event->type() == QEvent::Paint ? 1 : 0;
    return false;
  }
};

// A window with a 3D view takes tens of milliseconds to be drawn: once for all that is new, not once a panel.
TEST(ProgressStrip, IsDrawnWithWhatElseIsNew) {
  QAction skip;
  ProgressStrip strip(&skip);
  strip.resize(400, 40);
  strip.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&strip));
  ScanSnapshot snapshot;
  snapshot.frames_total = 100;
  snapshot.frames.read = 1;
  strip.showSnapshot(snapshot);
  auto* bar = strip.findChild<QProgressBar*>();
  ASSERT_NE(bar, nullptr);
  ASSERT_TRUE(QTest::qWaitFor([&] { return bar->isVisible(); }));
  QTest::qWait(50);
  PaintCounter counter(bar);
  snapshot.frames.read = 60;
  strip.showSnapshot(snapshot);
  EXPECT_EQ(counter.paints, 0);
  EXPECT_EQ(bar->value(), 60);
  EXPECT_TRUE(QTest::qWaitFor([&] { return counter.paints > 0; }));
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

TEST(StatusStrip, SaysThatTheProcessorIsPreparedUntilTheFirstFrame) {
  StatusStrip strip;
  strip.showState(ScanState::starting);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Starting…"));
  strip.showPreparing();
  EXPECT_TRUE(strip.stateText().startsWith(QStringLiteral("Preparing the OpenCL device")));
  strip.showState(ScanState::scanning);
  EXPECT_TRUE(strip.stateText().startsWith(QStringLiteral("Preparing the OpenCL device")));
  ScanSnapshot snapshot;
  snapshot.frame_index = 0;
  snapshot.pose.state = TrackingState::tracking;
  strip.showSnapshot(snapshot);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Tracking"));
  strip.showState(ScanState::starting);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Starting…"));
}

TEST(StatusStrip, SaysHowFarTheRefinementIs) {
  StatusStrip strip;
  strip.showState(ScanState::scanning);
  strip.showState(ScanState::finishing);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Finishing…")) << "a recording that is over is not stopped";
  strip.showState(ScanState::refining);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Refining objects"));
  strip.showRefinement(12, 40);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Refining objects: key frame 12 of 40"));
  strip.showState(ScanState::finished);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Finished"));
  strip.showState(ScanState::starting);
  strip.showState(ScanState::refining);
  EXPECT_EQ(strip.stateText(), QStringLiteral("Refining objects")) << "another scan has not got there";
}

TEST(StatusStrip, ShowsNoSpeed_WhileNoFramesCome) {
  StatusStrip strip;
  strip.showState(ScanState::scanning);
  ScanSnapshot snapshot;
  snapshot.frame_index = 0;
  snapshot.fps = 8.5;
  snapshot.stage_times = {{"raycast", 50}};
  strip.showSnapshot(snapshot);
  const auto showsSpeed = [&strip] {
    return std::ranges::any_of(strip.findChildren<QLabel*>(), [](const QLabel* label) {
      return label->text().contains(QStringLiteral("fps")) || label->text().contains(QStringLiteral("ms"));
    });
  };
  EXPECT_TRUE(showsSpeed());
  strip.showState(ScanState::finishing);
  EXPECT_FALSE(showsSpeed());
  strip.showSnapshot(snapshot);
  EXPECT_FALSE(showsSpeed()) << "the last snapshot comes after the last frame";
  strip.showState(ScanState::refining);
  strip.showSnapshot(snapshot);
  EXPECT_FALSE(showsSpeed());
}

TEST(ProgressStrip, MovesItsBarWhileObjectsAreRefined) {
  QAction skip;
  ProgressStrip strip(&skip);
  strip.begin(QStringLiteral("kitchen"));
  ScanSnapshot snapshot;
  snapshot.frames_total = 100;
  snapshot.frames.read = 100;
  strip.showSnapshot(snapshot);
  const auto* bar = strip.findChild<QProgressBar*>();
  const auto* button = strip.findChild<QToolButton*>(QStringLiteral("skipRefinement"));
  EXPECT_TRUE(button->isHidden());
  strip.showState(ScanState::refining);
  EXPECT_FALSE(button->isHidden());
  strip.showRefinement({0, 140, 40});
  EXPECT_EQ(bar->value(), 0);
  EXPECT_EQ(strip.text(), QStringLiteral("key frame 1 of 40"));
  strip.showRefinement({70, 140, 40});
  EXPECT_EQ(bar->value() * 2, bar->maximum());
  EXPECT_EQ(strip.text(), QStringLiteral("key frame 21 of 40"));
  strip.showSnapshot(snapshot);
  EXPECT_EQ(strip.text(), QStringLiteral("key frame 21 of 40"));
  strip.showState(ScanState::finishing);
  EXPECT_TRUE(button->isHidden());
}

TEST(StatusStrip, ASessionThatIsLookedAtHasNoSpeed) {
  StatusStrip strip;
  ScanSnapshot snapshot;
  snapshot.frame_index = 0;
  snapshot.fps = 20;
  snapshot.stage_times = {{"track", 5}};
  const auto says = [&](const QString& what) {
    return std::ranges::any_of(strip.findChildren<QLabel*>(),
                               [&](const QLabel* label) { return label->text().contains(what); });
  };
  strip.showSnapshot(snapshot);
  EXPECT_TRUE(says(QStringLiteral("20.0 fps")));
  snapshot.stage_times.clear();
  snapshot.fps = 0;
  strip.showSnapshot(snapshot);
  EXPECT_FALSE(says(QStringLiteral("fps")));
  EXPECT_FALSE(says(QStringLiteral("ms a frame")));
}

TEST(ElidedLabel, GivesWayAndSaysTheRestInItsTooltip) {
  ElidedLabel label;
  const QString text = QStringLiteral("a name that is a good deal longer than there is room");
  label.setFullText(text);
  label.resize(label.sizeHint());
  label.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&label));
  EXPECT_EQ(label.text(), text);
  EXPECT_TRUE(label.toolTip().isEmpty());
  label.resize(90, 20);
  EXPECT_TRUE(label.text().endsWith(QStringLiteral("…")));
  EXPECT_EQ(label.toolTip(), text);
  EXPECT_LT(label.minimumSizeHint().width(), 90);
}

TEST(ObjectDelegate, TheTagHasARoomOfItsOwn) {
  QStandardItemModel model(1, 1);
  model.setItem(0, new QStandardItem(QStringLiteral("an object with a name of many letters")));
  const ObjectDelegate delegate;
  const auto paint = [&](bool added, int width) {
    model.setData(model.index(0, 0), added, ObjectListModel::AddedNowRole);
    QImage image(width, delegate.sizeHint({}, {}).height(), QImage::Format_RGB32);
    image.fill(Qt::black);
    QPainter painter(&image);
    QStyleOptionViewItem option;
    option.rect = image.rect();
    delegate.paint(&painter, option, model.index(0, 0));
    return image;
  };
  // Whole in a narrow list too, and the name is not shorter for it.
  const auto tagPixels = [&](int width) {
    return countPixels(paint(true, width), QRect(0, 0, width, 70), Theme::instance().colors().warning);
  };
  EXPECT_GT(tagPixels(400), 5);
  EXPECT_EQ(tagPixels(200), tagPixels(400));
  const auto textWidth = [](const QImage& image, int rows) {
    int right = 0;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < image.width(); ++x) {
        if (image.pixelColor(x, y).lightness() > 60) right = std::max(right, x);
      }
    }
    return right;
  };
  EXPECT_NEAR(textWidth(paint(true, 200), 22), textWidth(paint(false, 200), 30), 2);
}

}  // namespace
}  // namespace scantrove
