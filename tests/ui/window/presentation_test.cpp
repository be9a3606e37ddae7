#include "ui/main_window/presentation.h"

#include <QFileInfo>
#include <QMenuBar>
#include <algorithm>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/scan_controller.h"
#include "ui/panels/object_panel.h"
#include "ui/panels/progress_strip.h"

namespace scantrove::test {
namespace {

class PresentationTest : public WindowTest {};

TEST_F(PresentationTest, ShowsTheSceneWithCaptions_AndSavesNothing) {
  window_->presentation()->begin();
  EXPECT_TRUE(window_->isFullScreen());
  EXPECT_FALSE(window_->menuBar()->isVisible());
  window_->open(QStringLiteral("demo"));
  EXPECT_FALSE(worker_->last_request.output_folder) << "no session";
  EXPECT_NE(worker_->last_request.database, file_.toStdString()) << "not the user's catalogue";
  worker_->report(snapshotOf(3));
  worker_->report(ObjectRecognized{ObjectId{3}, "red mug"});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->presentation()->caption() == QStringLiteral("Recognised: red mug"); }, 3000));
  EXPECT_FALSE(window_->parts().objects->isVisible()) << "the panels of a scan stay hidden";
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_FALSE(window_->presentation()->isOn());
  EXPECT_TRUE(window_->menuBar()->isVisible());
  EXPECT_TRUE(window_->onStartPage());
  window_->open(QStringLiteral("demo"));
  EXPECT_EQ(worker_->last_request.database, file_.toStdString());
  EXPECT_TRUE(worker_->last_request.output_folder);
}

TEST_F(PresentationTest, KeepsARunningScan_WhenItEnds) {
  window_->open(QStringLiteral("demo"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->controller().bridge().busy(); }, 3000));
  window_->presentation()->begin();
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_FALSE(window_->onStartPage());
  EXPECT_FALSE(window_->isFullScreen());
}

TEST_F(PresentationTest, StaysOpen_WhenASavedScanWasPresented) {
  window_->openSession(folder_.path());
  worker_->finish();
  worker_->report(ReviewOpened{});
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().actions->export_data->isEnabled(); }, 3000));
  window_->presentation()->begin();
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_FALSE(window_->presentation()->isOn());
  EXPECT_FALSE(window_->onStartPage());
  EXPECT_FALSE(std::ranges::count(worker_->commands, "close"));
}

TEST_F(PresentationTest, KeepsItsCatalogue_UntilTheScanHasEnded) {
  window_->presentation()->begin();
  window_->open(QStringLiteral("demo"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->controller().bridge().busy(); }, 3000));
  const QString folder = QFileInfo(QString::fromStdString(worker_->last_request.database)).path();
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_TRUE(QFileInfo::exists(folder)) << "the scan still writes into it";
  worker_->report(snapshotOf(107));
  worker_->finish();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !QFileInfo::exists(folder); }, 3000));
  EXPECT_TRUE(window_->onStartPage());
  EXPECT_EQ(window_->parts().progress->text(), QString()) << "nothing of the closed scan is shown";
}

}  // namespace
}  // namespace scantrove::test
