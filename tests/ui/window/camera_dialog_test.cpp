#include <gtest/gtest.h>

#include <QCheckBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>

#include "ui/panels/camera_dialog.h"

namespace scantrove {
namespace {

TEST(CameraDialog, ShowsAdvice_WithoutACamera) {
  CameraDialog dialog([] { return Result<std::vector<CameraInfo>>(std::vector<CameraInfo>{}); });
  const QString text = dialog.findChild<QLabel*>(QStringLiteral("cameraAdvice"))->text();
  EXPECT_TRUE(text.contains(QStringLiteral("No depth camera")));
  EXPECT_GT(text.size(), 60);
  auto* start = dialog.findChild<QPushButton*>(QStringLiteral("startCamera"));
  EXPECT_EQ(dialog.source(), QString()) << "the test camera is not chosen for anybody";
  EXPECT_FALSE(start->isEnabled());
  dialog.findChild<QListWidget*>()->setCurrentRow(0);
  EXPECT_EQ(dialog.source(), QStringLiteral("camera:Dummy"));
  EXPECT_TRUE(start->isEnabled());
}

TEST(CameraDialog, ListsCamerasBeforeTheDummy) {
  CameraDialog dialog([] {
    return Result<std::vector<CameraInfo>>(
        std::vector<CameraInfo>{{"1d27/0601@1/5", "PS1080", "PrimeSense"}});
  });
  EXPECT_EQ(dialog.findChild<QListWidget*>()->count(), 2);
  EXPECT_EQ(dialog.source(), QStringLiteral("camera:1d27/0601@1/5"));
}

TEST(CameraDialog, ScansOneObject_WhenThePersonChoosesIt) {
  CameraDialog dialog([] { return Result<std::vector<CameraInfo>>(std::vector<CameraInfo>{}); });
  EXPECT_FALSE(dialog.object());
  dialog.findChild<QCheckBox*>()->setChecked(true);
  EXPECT_EQ(dialog.object(), ObjectChoice{});
}

}  // namespace
}  // namespace scantrove
