#include <QProgressBar>
#include <QToolButton>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/scan_controller.h"
#include "ui/panels/progress_strip.h"

namespace scantrove::test {
namespace {

class WindowRefinementTest : public WindowTest {
 protected:
  void enter(ScanState state) {
    worker_->report(StateChanged{state});
    ASSERT_TRUE(QTest::qWaitFor([&] { return window_->controller().bridge().state() == state; }));
  }
  void scanToItsEnd() {
    window_->open(QStringLiteral("demo"));
    worker_->report(snapshotOf(99));
    enter(ScanState::finishing);
    enter(ScanState::refining);
  }
};

TEST_F(WindowRefinementTest, ButtonAndKeySkipIt) {
  const QAction* action = window_->parts().actions->skip_refinement;
  EXPECT_FALSE(action->isEnabled());
  scanToItsEnd();
  EXPECT_TRUE(action->isEnabled());
  worker_->report(RefinementStepped{35, 140, 40});
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->parts().progress->text() == QStringLiteral("key frame 11 of 40"); }));
  auto* button = window_->parts().progress->findChild<QToolButton*>(QStringLiteral("skipRefinement"));
  ASSERT_TRUE(button->isVisible());
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(worker_->commands.back(), "skip refinement");
  worker_->commands.push_back("nothing yet");
  QTest::keyClick(window_.get(), Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(worker_->commands.back(), "skip refinement");
  enter(ScanState::finishing);
  EXPECT_FALSE(button->isVisible());
  EXPECT_FALSE(action->isEnabled());
}

TEST_F(WindowRefinementTest, KeyStartsIt_WhenItWasSkipped) {
  const QAction* action = window_->parts().actions->refine;
  window_->openSession(QStringLiteral("/somewhere/kitchen"));
  enter(ScanState::finished);
  worker_->report(ReviewOpened{.can_refine = false});
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().actions->export_data->isEnabled(); }));
  EXPECT_FALSE(action->isEnabled()) << "the scan is refined already";
  worker_->report(ReviewOpened{.can_refine = true});
  ASSERT_TRUE(QTest::qWaitFor([&] { return action->isEnabled(); }));
  QTest::keyClick(window_.get(), Qt::Key_R, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_EQ(worker_->commands.back(), "start");
  EXPECT_TRUE(worker_->last_request.refine_session);
  EXPECT_EQ(worker_->last_request.output_folder, "/somewhere/kitchen");
  enter(ScanState::refining);
  EXPECT_FALSE(action->isEnabled());
  window_->open(QStringLiteral("demo"));
  EXPECT_FALSE(worker_->last_request.refine_session) << "the next request is a scan";
}

}  // namespace
}  // namespace scantrove::test
