#include "ui/main_window/presentation.h"

#include <QMenuBar>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/scan_controller.h"
#include "ui/panels/object_panel.h"

namespace scantrove::test {
namespace {

class PresentationTest : public WindowTest {};

TEST_F(PresentationTest, ShowsTheSceneAloneSaysWhatHappensAndKeepsNothing) {
  window_->presentation()->begin();
  EXPECT_TRUE(window_->isFullScreen());
  EXPECT_FALSE(window_->menuBar()->isVisible());
  window_->open(QStringLiteral("demo"));
  EXPECT_FALSE(session_->last_request.output_folder) << "no session";
  EXPECT_NE(session_->last_request.database, file_.toStdString()) << "nor the person's catalogue";
  session_->post(snapshotOf(3));
  session_->post(ObjectRecognised{ObjectId{3}, "red mug"});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->presentation()->caption() == QStringLiteral("Recognised: red mug"); }, 3000));
  EXPECT_FALSE(window_->objectPanel()->isVisible()) << "what comes with a scan stays away";
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_FALSE(window_->presentation()->isOn());
  EXPECT_TRUE(window_->menuBar()->isVisible());
  EXPECT_TRUE(window_->onStartPage());
  window_->open(QStringLiteral("demo"));
  EXPECT_EQ(session_->last_request.database, file_.toStdString());
  EXPECT_TRUE(session_->last_request.output_folder);
}

TEST_F(PresentationTest, OfAScanThatRunsOnlyTheLookChanges) {
  window_->open(QStringLiteral("demo"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->controller().bridge().busy(); }, 3000));
  window_->presentation()->begin();
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_FALSE(window_->onStartPage());
  EXPECT_FALSE(window_->isFullScreen());
}

}  // namespace
}  // namespace scantrove::test
