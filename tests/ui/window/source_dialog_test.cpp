#include "ui/panels/source_dialog.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>

namespace scantrove {
namespace {

TEST(SourceDialog, UsesPosesOfADevice_UnlessThePersonChoosesOtherwise) {
  const SourceDialog dialog(QStringLiteral("/recording"));
  EXPECT_EQ(dialog.poses(), ScanRequest::Poses::automatic);
  auto* poses = dialog.findChild<QComboBox*>();
  ASSERT_EQ(poses->count(), 3);
  poses->setCurrentIndex(poses->findText(QStringLiteral("Track the camera")));
  EXPECT_EQ(dialog.poses(), ScanRequest::Poses::tracked);
  poses->setCurrentIndex(poses->findText(QStringLiteral("Use the poses of the recording")));
  EXPECT_EQ(dialog.poses(), ScanRequest::Poses::given);
}

TEST(SourceDialog, ScansOneObject_WhenThePersonChoosesIt) {
  SourceDialog dialog(QStringLiteral("/recording"));
  EXPECT_FALSE(dialog.object());
  auto* one = dialog.findChild<QCheckBox*>();
  ASSERT_NE(one, nullptr);
  one->setChecked(true);
  EXPECT_EQ(dialog.object(), ObjectChoice{});
  dialog.askToContinue(QStringLiteral("kitchen"));
  EXPECT_FALSE(dialog.object()) << "a scan of one object is not continued";
}

}  // namespace
}  // namespace scantrove
