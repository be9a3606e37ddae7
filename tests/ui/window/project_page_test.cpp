#include "ui/main_window/project_page.h"

#include <QFile>
#include <QLabel>
#include <QMenu>
#include <QSignalSpy>
#include <filesystem>

#include "core/session/session_store.h"
#include "tests/ui/window/saved_key_frames.h"
#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/window_dialogs.h"
#include "ui/panels/export_dialog.h"
#include "ui/panels/export_scans_panel.h"
#include "ui/panels/start_page.h"

namespace scantrove {
namespace {

constexpr int kReading_ms = 5000;

/// A project with scans of three key frames, of which one was checked and one left out.
class ProjectPageTest : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    project_ = folder_.filePath(QStringLiteral("mugs"));
    window_->createProjectFolder(project_);
  }
  QString makeScan(const QString& name) {
    const QString folder = project_ + QStringLiteral("/scans/") + name;
    const auto store = SessionStore::create(folder.toStdString());
    EXPECT_TRUE(store) << store.error().message();
    SavedDelta delta;
    delta.metadata["source"] = "demo";
    delta.metadata["ended"] = "2026-11-22T15:40:02Z";
    delta.metadata["refinement"] = "pending";
    test::addThreeKeyFrames(delta);
    delta.fragments = {{FragmentId{1}, RegionId{3}, 60}, {FragmentId{2}, RegionId{4}, 60}};
    delta.regions = {{RegionId{3}, ObjectId{2}, {"red cup", "cup", false, false, false}},
                     {RegionId{4}, ObjectId{5}, {"", "", false, false, false}}};
    for (int i = 0; i < 2; ++i) {
      Operation operation;
      operation.kind = OperationKind::review;
      operation.review = FrameReview{i, i, i == 0 ? ReviewState::checked : ReviewState::left_out};
      delta.operations.push_back({i + 1, operation, {}, OperationLog::State::done});
    }
    const Result<void> saved = (*store)->save(delta);
    EXPECT_TRUE(saved) << saved.error().message();
    return folder;
  }
  /// Reads the scans again and waits for the cards.
  QList<QToolButton*> cards() {
    QSignalSpy shown(window_->parts().project_page, &ProjectPage::shown);
    window_->parts().project_page->refresh();
    EXPECT_TRUE(shown.wait(kReading_ms));
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    return window_->parts().start->savedScans()->findChildren<QToolButton*>(QStringLiteral("startCard"));
  }

  QString project_;
};

TEST_F(ProjectPageTest, CardsSayWhatIsNamedAndReviewed) {
  makeScan(QStringLiteral("first"));
  const QList<QToolButton*> all = cards();
  ASSERT_EQ(all.size(), 1);
  const QString details = all[0]->accessibleDescription();
  EXPECT_TRUE(details.contains(QStringLiteral("1 of 2 objects named"))) << details.toStdString();
  EXPECT_TRUE(details.contains(QStringLiteral("2 of 3 images reviewed"))) << details.toStdString();
}

TEST_F(ProjectPageTest, MenuHasTheActions_AndRefinesAScanThatLacksIt) {
  const QString folder = makeScan(QStringLiteral("first"));
  const QList<QToolButton*> all = cards();
  ASSERT_EQ(all.size(), 1);
  const QMenu* const menu = all[0]->findChild<QMenu*>();
  ASSERT_NE(menu, nullptr);
  QStringList texts;
  QAction* refine = nullptr;
  for (QAction* action : menu->actions()) {
    if (action->isSeparator()) continue;
    texts << action->text().remove(QLatin1Char('&'));
    if (texts.last().startsWith(QStringLiteral("Refine"))) refine = action;
  }
  EXPECT_EQ(texts.size(), 5);
  ASSERT_NE(refine, nullptr);
  EXPECT_TRUE(refine->isEnabled());
  refine->trigger();
  EXPECT_TRUE(worker_->last_request.refine_session);
  EXPECT_EQ(worker_->last_request.output_folder, folder.toStdString());
}

TEST_F(ProjectPageTest, ExportOpensTheScanFirst) {
  const QString folder = makeScan(QStringLiteral("first"));
  emit window_->parts().start->savedScans()->actionRequested(folder, SavedScanAction::export_data);
  EXPECT_EQ(worker_->last_request.output_folder, folder.toStdString());
  EXPECT_EQ(window_->dialogs().exportDialog(), nullptr);
  worker_->report(ReviewOpened{});
  EXPECT_TRUE(QTest::qWaitFor([&] { return window_->dialogs().exportDialog() != nullptr; }, kReading_ms));
}

TEST_F(ProjectPageTest, ExportOffersTheScansOfTheProject_WhenTheyAreRead) {
  makeScan(QStringLiteral("second"));
  makeScan(QStringLiteral("first"));
  std::filesystem::create_directories((project_ + QStringLiteral("/scans/damaged")).toStdString());
  QFile damaged(project_ + QStringLiteral("/scans/damaged/session.sqlite"));
  ASSERT_TRUE(damaged.open(QIODevice::WriteOnly));
  damaged.write("no database");
  damaged.close();
  window_->openSession(project_ + QStringLiteral("/scans/first"));
  worker_->report(ReviewOpened{});
  window_->dialogs().showExport();
  window_->dialogs().showExport();  // the dialog of the first reading is gone when it ends
  const auto* const scans = window_->dialogs().exportDialog()->findChild<ExportScansPanel*>();
  ASSERT_NE(scans, nullptr);
  ASSERT_TRUE(QTest::qWaitFor([&] { return scans->isVisible(); }, kReading_ms));
  EXPECT_EQ(scans->scans(), (std::vector<std::string>{"first", "second"})) << "a damaged one is left out";
  window_->dialogs().showExport();
  window_->dialogs().closeExport();
  QTest::qWait(200);
  EXPECT_EQ(window_->dialogs().exportDialog(), nullptr);
}

TEST_F(ProjectPageTest, ContinuedScanGoesOnInItsSession_WithItsCatalogue) {
  const QString folder = makeScan(QStringLiteral("first"));
  EXPECT_FALSE(window_->parts().actions->continue_scan->isEnabled());
  window_->openSession(folder);
  worker_->report(ReviewOpened{});
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return window_->parts().actions->continue_scan->isEnabled(); }, kReading_ms));
  window_->controller().continueSession(folder, QStringLiteral("demo"), {}, ScanRequest::Poses::automatic);
  EXPECT_TRUE(worker_->last_request.resume);
  EXPECT_EQ(worker_->last_request.source, "demo");
  EXPECT_EQ(worker_->last_request.output_folder, folder.toStdString());
  EXPECT_TRUE(worker_->last_request.database.empty()) << "that of the session is used";
  window_->open(QStringLiteral("demo"));
  EXPECT_FALSE(worker_->last_request.resume) << "another scan is a new one";
  EXPECT_NE(worker_->last_request.output_folder, folder.toStdString());
}

TEST_F(ProjectPageTest, ListsFortyScans) {
  for (int i = 0; i < 40; ++i) makeScan(QStringLiteral("scan %1").arg(i));
  EXPECT_EQ(cards().size(), 40);
}

}  // namespace
}  // namespace scantrove
