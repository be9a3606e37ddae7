#include <QLineEdit>
#include <QListView>
#include <QMimeData>
#include <QSettings>
#include <QTest>
#include <QToolButton>
#include <algorithm>

#include "tests/ui/scripted_session.h"
#include "tests/ui/window/catalogue_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/recent_sources.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/object_panel.h"
#include "ui/panels/progress_strip.h"
#include "ui/panels/views_strip.h"

namespace scantrove {
namespace {

class WindowTest : public test::CatalogueTest {
 protected:
  void SetUp() override {
    QSettings().clear();
    CatalogueTest::SetUp();
    restart();
  }

  /// A new window over the same catalogue, as after a restart of the program.
  void restart() {
    window_.reset();
    WindowOptions options;
    options.database = file_.toStdString();
    options.width = 1280;
    options.height = 800;
    window_ = std::make_unique<MainWindow>(
        [this](SessionPort::Listener listener) {
          auto made = std::make_unique<test::ScriptedSession>(std::move(listener));
          session_ = made.get();
          return made;
        },
        options);
    window_->show();
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  }

  QListView* list() { return window_->objectPanel()->list(); }

  QModelIndex rowOf(ObjectId object) {
    for (int i = 0; i < list()->model()->rowCount(); ++i) {
      const QModelIndex index = list()->model()->index(i, 0);
      if (index.data(ObjectListModel::ObjectIdRole).toUInt() == object.value) return index;
    }
    return {};
  }

  void clickOn(ObjectId object, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mouseClick(list()->viewport(), Qt::LeftButton, modifiers,
                      list()->visualRect(rowOf(object)).center());
  }

  QLineEdit* nameEditor() { return list()->findChild<QLineEdit*>(QStringLiteral("objectNameEditor")); }

  /// Return in the name's field; Qt hands the text on from its event loop.
  void endEditing() {
    QTest::keyClick(nameEditor(), Qt::Key_Return);
    QTest::qWait(50);
  }

  void pressButton(QAction* action) {
    for (QToolButton* button : window_->objectPanel()->findChildren<QToolButton*>()) {
      if (button->defaultAction() != action) continue;
      QTest::mouseClick(button, Qt::LeftButton);
      return;
    }
    FAIL() << "no button for " << action->text().toStdString();
  }

  ScanSnapshot snapshotOf(int frame) {
    ScanSnapshot snapshot;
    snapshot.state = ScanState::scanning;
    snapshot.frame_index = frame;
    snapshot.frames.read = frame + 1;
    snapshot.frames_total = 100;
    snapshot.pose.state = TrackingState::tracking;
    snapshot.K = {290, 290, 160, 120, 320, 240};
    snapshot.color = cv::Mat(480, 640, CV_8UC3, cv::Scalar(40, 80, 120));
    snapshot.depth_raw_m = cv::Mat(240, 320, CV_32FC1, cv::Scalar(1.5));
    snapshot.depth_fused_m = snapshot.depth_raw_m;
    snapshot.segments = cv::Mat(240, 320, CV_32SC1, cv::Scalar(2));
    snapshot.regions = cv::Mat(240, 320, CV_32SC1, cv::Scalar(5));
    return snapshot;
  }

  test::ScriptedSession* session_ = nullptr;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(WindowTest, RenamedAndConfirmedByKeysIsStoredAndThereAfterARestart) {
  QTest::keyClick(window_.get(), Qt::Key_L, Qt::ControlModifier);
  ASSERT_TRUE(list()->hasFocus());
  list()->setCurrentIndex(rowOf(objects_[1]));
  QTest::keyClick(list(), Qt::Key_F2);
  ASSERT_NE(nameEditor(), nullptr);
  nameEditor()->selectAll();
  QTest::keyClicks(nameEditor(), QStringLiteral("Green cup"));
  endEditing();
  EXPECT_EQ(stored(objects_[1]).name, "Green cup");
  EXPECT_FALSE(stored(objects_[1]).confirmed);

  QTest::keyClick(list(), Qt::Key_Return);
  EXPECT_TRUE(stored(objects_[1]).confirmed);
  EXPECT_GE(session_->catalogue_changes, 2);

  restart();
  EXPECT_EQ(rowOf(objects_[1]).data(Qt::DisplayRole).toString(), QStringLiteral("Green cup"));
  EXPECT_TRUE(rowOf(objects_[1]).data(ObjectListModel::ConfirmedRole).toBool());
}

TEST_F(WindowTest, RenamedAndConfirmedByMouseIsStored) {
  clickOn(objects_[0]);
  EXPECT_EQ(window_->objectPanel()->viewsStrip()->count(), 1U);
  QTest::mouseDClick(list()->viewport(), Qt::LeftButton, {}, list()->visualRect(rowOf(objects_[0])).center());
  ASSERT_NE(nameEditor(), nullptr);
  nameEditor()->selectAll();
  QTest::keyClicks(nameEditor(), QStringLiteral("Red ball"));
  endEditing();
  pressButton(window_->objectPanel()->actions().confirm);
  EXPECT_EQ(stored(objects_[0]).name, "Red ball");
  EXPECT_TRUE(stored(objects_[0]).confirmed);
}

TEST_F(WindowTest, DeleteMergeAndUndoByKeys) {
  clickOn(objects_[0]);
  QTest::keyClick(list(), Qt::Key_Delete);
  EXPECT_EQ(storedCount(), 2U);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(storedCount(), 3U);
  clickOn(objects_[0]);
  clickOn(objects_[2], Qt::ControlModifier);
  QTest::keyClick(list(), Qt::Key_M);
  EXPECT_EQ(storedCount(), 2U);
  EXPECT_EQ(stored(objects_[0]).views, 2);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(storedCount(), 3U);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(storedCount(), 2U);
}

TEST_F(WindowTest, ARefusedNameIsSaidInTheBarAndNothingIsLost) {
  clickOn(objects_[1]);
  QTest::keyClick(list(), Qt::Key_F2);
  ASSERT_NE(nameEditor(), nullptr);
  nameEditor()->selectAll();
  QTest::keyClicks(nameEditor(), QStringLiteral("Obj_1"));
  endEditing();
  EXPECT_TRUE(window_->messageBar()->isVisible());
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
}

TEST_F(WindowTest, AMissingPathIsSaidAndTheWindowLives) {
  window_->open(QStringLiteral("/somewhere/missing"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->messageBar()->isVisible(); }, 3000));
  EXPECT_TRUE(window_->messageBar()->text().contains(QStringLiteral("/somewhere/missing")));
  EXPECT_TRUE(window_->messageBar()->text().contains(QStringLiteral("Check the path.")));
  EXPECT_TRUE(window_->onStartPage());
  EXPECT_FALSE(recentSources().contains(QStringLiteral("/somewhere/missing")));
  // And it can go on with something else.
  window_->open(QStringLiteral("demo"));
  session_->post(snapshotOf(0));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window_->progressStrip()->text().startsWith(QStringLiteral("1 of 100")); }, 3000));
  EXPECT_FALSE(window_->onStartPage());
  EXPECT_FALSE(window_->messageBar()->isVisible());
  EXPECT_TRUE(recentSources().contains(QStringLiteral("demo")));
}

TEST_F(WindowTest, SnapshotReachesPanelsAndScene) {
  window_->open(QStringLiteral("demo"));
  ScanSnapshot snapshot = snapshotOf(4);
  CloudBrick brick{Eigen::Vector3i(0, 0, 25), 1, {}};
  for (int i = 0; i < 64; ++i) {
    brick.points.push_back(
        {0.006F * static_cast<float>(i % 8), 0.006F * static_cast<float>(i / 8), 1.18F, 1});
  }
  snapshot.changed_bricks.push_back(brick);
  snapshot.region_of_label =
      std::make_shared<const std::vector<std::uint32_t>>(std::vector<std::uint32_t>{0, 1});
  SeenObject seen;
  seen.object = objects_[2];
  seen.name = "Obj_3";
  seen.box = {0.4F, 0.4F, 0.2F, 0.2F};
  snapshot.objects = {seen};
  session_->post(std::move(snapshot));
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return !window_->framePanels()->colorPanel()->picture().isNull(); }, 3000));
  for (const ImagePanel* panel : window_->framePanels()->panels()) EXPECT_FALSE(panel->picture().isNull());
  EXPECT_EQ(window_->scenePane()->view()->scene().cloud().pointCount(), 64U);
  EXPECT_TRUE(rowOf(objects_[2]).data(ObjectListModel::InViewRole).toBool());
}

TEST_F(WindowTest, KeysDriveTheScan) {
  window_->open(QStringLiteral("demo"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->actions().pause->isEnabled(); }, 3000));
  QTest::keyClick(window_.get(), Qt::Key_Space);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->actions().start->isEnabled(); }, 3000));
  QTest::keyClick(window_.get(), Qt::Key_N);
  QTest::keyClick(window_.get(), Qt::Key_Space);
  EXPECT_EQ(session_->commands, (std::vector<std::string>{"start", "pause", "step", "resume"}));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window_->actions().start->isEnabled(); }, 3000));
  QTest::keyClick(window_.get(), Qt::Key_Period, Qt::ControlModifier);
  EXPECT_EQ(session_->commands.back(), "stop");
  EXPECT_EQ(session_->last_request.database, file_.toStdString());
}

TEST_F(WindowTest, AnObjectThatTheScanAddsAppears) {
  window_->open(QStringLiteral("demo"));
  auto database = ObjectDatabase::open(file_.toStdString());
  ASSERT_TRUE(database);
  const auto added = (*database)->addObject(test::discView({0, 200, 255}));
  ASSERT_TRUE(added);
  session_->post(ObjectAdded{added->id, added->name});
  ASSERT_TRUE(QTest::qWaitFor([&] { return rowOf(added->id).isValid(); }, 3000));
  EXPECT_TRUE(rowOf(added->id).data(ObjectListModel::AddedNowRole).toBool());
}

TEST_F(WindowTest, ADroppedFolderIsOpened) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(folder_.path())});
  QDragEnterEvent enter(QPoint(300, 300), Qt::CopyAction, &data, Qt::LeftButton, {});
  QCoreApplication::sendEvent(window_.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(300, 300), Qt::CopyAction, &data, Qt::LeftButton, {});
  QCoreApplication::sendEvent(window_.get(), &drop);
  EXPECT_EQ(session_->last_request.source, folder_.path().toStdString());
}

TEST_F(WindowTest, EveryButtonHasAWordForThoseWhoDoNotSeeIt) {
  window_->open(QStringLiteral("demo"));
  for (const QToolButton* button : window_->findChildren<QToolButton*>()) {
    if (!button->isVisible()) continue;
    EXPECT_FALSE(button->text().isEmpty() && button->accessibleName().isEmpty() &&
                 button->toolTip().isEmpty())
        << button->objectName().toStdString();
  }
}

}  // namespace
}  // namespace scantrove
