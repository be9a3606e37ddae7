#include <QAction>
#include <QDockWidget>
#include <QMenu>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/dock_arrangement.h"
#include "ui/main_window/main_actions.h"

namespace scantrove {
namespace {

class DocksTest : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    beginScan();
  }

  void beginScan() {
    window_->open(QStringLiteral("demo"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return dock("framesDock")->isVisible(); }, 3000));
  }

  QDockWidget* dock(const char* name) { return window_->findChild<QDockWidget*>(QString::fromLatin1(name)); }

  void resizeWindow(int width, int height) {
    window_->resize(width, height);  // the height is at least what the panels need
    ASSERT_TRUE(QTest::qWaitFor([&] { return window_->width() == width; }, 3000)) << window_->width();
    QTest::qWait(100);
  }
};

TEST_F(DocksTest, MenuAndKeyCloseAndReopenEachDock) {
  const std::map<const char*, Qt::Key> keys = {
      {"objectsDock", Qt::Key_1}, {"framesDock", Qt::Key_2}, {"settingsDock", Qt::Key_3}};
  for (const auto& [name, key] : keys) {
    QAction* toggle = dock(name)->toggleViewAction();
    ASSERT_TRUE(toggle->isEnabled()) << name;
    toggle->trigger();
    EXPECT_FALSE(dock(name)->isVisible()) << name;
    toggle->trigger();
    EXPECT_TRUE(dock(name)->isVisible()) << name;
    QTest::keyClick(window_.get(), key, Qt::ControlModifier);
    EXPECT_FALSE(dock(name)->isVisible()) << name;
    QTest::keyClick(window_.get(), key, Qt::ControlModifier);
    EXPECT_TRUE(dock(name)->isVisible()) << name;
  }
}

TEST_F(DocksTest, WidthsAreRestored_AfterTheWindowWasSmall) {
  const int objects = dock("objectsDock")->width();
  const int frames = dock("framesDock")->width();
  resizeWindow(700, 500);
  EXPECT_LT(dock("framesDock")->width(), frames);
  resizeWindow(1280, 800);
  EXPECT_EQ(dock("objectsDock")->width(), objects);
  EXPECT_EQ(dock("framesDock")->width(), frames);
}

TEST_F(DocksTest, DocksBecomeTabs_OnASmallScreen) {
  EXPECT_TRUE(window_->tabifiedDockWidgets(dock("objectsDock")).isEmpty());
  window_->docks().arrangeFor({683, 384});
  QTest::qWait(100);
  EXPECT_EQ(window_->tabifiedDockWidgets(dock("objectsDock")).size(), 3);
  resizeWindow(683, 384);
  EXPECT_EQ(window_->height(), 384) << "the window fits the screen";
  EXPECT_GT(window_->centralWidget()->width(), 300);
  window_->docks().arrangeFor({800, 500});  // 1600 x 1000 pixels at scale 2
  QTest::qWait(100);
  resizeWindow(800, 500);
  EXPECT_EQ(window_->height(), 500);
  window_->docks().arrangeFor({1366, 768});
  EXPECT_TRUE(window_->tabifiedDockWidgets(dock("objectsDock")).isEmpty());
  EXPECT_TRUE(window_->tabifiedDockWidgets(dock("framesDock")).isEmpty());
}

TEST_F(DocksTest, WidthsSetByAUserAreKept) {
  const QRect frames = dock("framesDock")->geometry();
  const QPoint edge(frames.left() - 3, frames.center().y());
  QTest::mousePress(window_.get(), Qt::LeftButton, {}, edge);
  QTest::mouseMove(window_.get(), edge + QPoint(40, 0));
  QTest::mouseMove(window_.get(), edge + QPoint(80, 0));
  QTest::qWait(100);
  QTest::mouseRelease(window_.get(), Qt::LeftButton, {}, edge + QPoint(80, 0));
  QTest::qWait(100);
  const int requested = dock("framesDock")->width();
  EXPECT_NEAR(requested, frames.width() - 80, 4);
  resizeWindow(700, 500);
  resizeWindow(1280, 800);
  EXPECT_EQ(dock("framesDock")->width(), requested);
  window_->close();
  restart();
  beginScan();
  EXPECT_EQ(dock("framesDock")->width(), requested);
  window_->parts().actions->reset_layout->trigger();
  QTest::qWait(50);
  EXPECT_EQ(dock("framesDock")->width(), frames.width());
}

TEST_F(DocksTest, ClosedDockStaysClosed_AfterARestart) {
  dock("settingsDock")->close();
  window_->close();
  restart();
  EXPECT_FALSE(dock("framesDock")->isVisible());  // the start page has no frame to show
  beginScan();
  EXPECT_FALSE(dock("settingsDock")->isVisible());
  EXPECT_TRUE(dock("framesDock")->isVisible());
}

}  // namespace
}  // namespace scantrove
