#include "ui/main_window/picture_saver.h"

#include <gtest/gtest.h>

#include <QProgressDialog>
#include <QPushButton>
#include <QTest>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/main_window.h"
#include "ui/panels/message_bar.h"

namespace scantrove::test {
namespace {

constexpr int kPictureWait_ms = 5000;

class PictureSaverTest : public WindowTest {
 protected:
  PictureSaver& saver() { return *window_->findChild<PictureSaver*>(); }
  bool waitForEnd() {
    return QTest::qWaitFor([&] { return saver().progress() == nullptr; }, kPictureWait_ms);
  }
};

TEST_F(PictureSaverTest, PostsTheFile_AndShowsProgressAndEnd) {
  saver().saveTo(QStringLiteral("/tmp/scan.webm"));
  ASSERT_EQ(worker_->renders.size(), 1U);
  EXPECT_EQ(worker_->renders[0].file, "/tmp/scan.webm");
  ASSERT_NE(saver().progress(), nullptr);
  worker_->report(RenderStepped{30, 240});
  ASSERT_TRUE(QTest::qWaitFor([&] { return saver().progress()->value() == 30; }, kPictureWait_ms));
  EXPECT_EQ(saver().progress()->maximum(), 240);
  worker_->report(RenderFinished{"/tmp/scan.webm"});
  ASSERT_TRUE(waitForEnd());
  EXPECT_TRUE(window_->parts().messages->text().contains(QStringLiteral("/tmp/scan.webm")));
}

TEST_F(PictureSaverTest, CancelStopsTheWorker_WithoutAMessage) {
  saver().saveTo(QStringLiteral("/tmp/scan.png"));
  saver().progress()->findChild<QPushButton*>()->click();
  ASSERT_FALSE(worker_->commands.empty());
  EXPECT_EQ(worker_->commands.back(), "cancel export");
  worker_->report(RenderFailed{{"The picture was cancelled.", ""}});
  ASSERT_TRUE(waitForEnd());
  EXPECT_EQ(window_->parts().messages->text(), QString());
}

TEST_F(PictureSaverTest, ShowsWhyItFailed) {
  saver().saveTo(QStringLiteral("/tmp/scan.png"));
  worker_->report(RenderFailed{{"The disk is full.", ""}});
  ASSERT_TRUE(waitForEnd());
  EXPECT_EQ(window_->parts().messages->text(), QStringLiteral("The disk is full."));
}

}  // namespace
}  // namespace scantrove::test
