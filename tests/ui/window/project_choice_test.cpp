#include "ui/main_window/project_choice.h"

#include <QDir>
#include <QFile>

#include "core/session/session_store.h"
#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/scan_controller.h"
#include "ui/panels/elided_label.h"
#include "ui/panels/message_bar.h"

namespace scantrove {
namespace {

class ProjectChoiceTest : public test::WindowTest {
 protected:
  /// A saved scan with the path of its catalogue only.
  QString savedScanWith(const QString& catalogue) {
    const QString folder = folder_.filePath(QStringLiteral("scan"));
    const auto store = SessionStore::create(folder.toStdString());
    EXPECT_TRUE(store) << store.error().message();
    SavedDelta delta;
    delta.metadata["database"] = catalogue.toStdString();
    EXPECT_TRUE((*store)->save(delta));
    return folder;
  }

  /// Another catalogue than the fixture's, without objects.
  QString emptyCatalogue() {
    const QString file = folder_.filePath(QStringLiteral("kitchen.sqlite"));
    EXPECT_TRUE(ObjectDatabase::open(file.toStdString()));
    return file;
  }

  [[nodiscard]] QString shownName() const { return window_->parts().objects->catalogueLabel()->text(); }
  [[nodiscard]] std::string usedByScans() const { return window_->controller().request().database; }
};

TEST_F(ProjectChoiceTest, IsRememberedAndShown_AfterARestart) {
  const QString kitchen = emptyCatalogue();
  window_->openCatalogue(kitchen);
  EXPECT_EQ(shownName(), QStringLiteral("kitchen.sqlite"));
  restartWith({});
  EXPECT_EQ(shownName(), QStringLiteral("kitchen.sqlite"));
  EXPECT_EQ(usedByScans(), kitchen.toStdString());
}

TEST_F(ProjectChoiceTest, FallsBackToTheDefaultAndReportsIt_WhenTheFileIsMissing) {
  const QString kitchen = emptyCatalogue();
  window_->openCatalogue(kitchen);
  window_.reset();
  ASSERT_TRUE(QFile::remove(kitchen));
  restartWith({});
  EXPECT_EQ(usedByScans(), defaultProject().catalogue.string());
  EXPECT_TRUE(window_->parts().messages->text().contains(kitchen))
      << window_->parts().messages->text().toStdString();
  EXPECT_FALSE(QFile::exists(kitchen)) << "no empty catalogue is made";
}

TEST_F(ProjectChoiceTest, SavedScanShowsItsOwnCatalogue_UntilItIsClosed) {
  const QString kitchen = emptyCatalogue();
  window_->openSession(savedScanWith(kitchen));
  EXPECT_EQ(shownName(), QStringLiteral("kitchen.sqlite"));
  EXPECT_EQ(list()->model()->rowCount(), 0);
  EXPECT_EQ(usedByScans(), file_.toStdString()) << "a new scan uses the chosen catalogue";
  window_->closeScan();
  EXPECT_EQ(shownName(), QStringLiteral("catalogue.sqlite"));
  EXPECT_EQ(list()->model()->rowCount(), 3);
}

TEST_F(ProjectChoiceTest, SavedScanShowsNoObjects_WhenItsCatalogueIsMissing) {
  const QString missing = folder_.filePath(QStringLiteral("gone.sqlite"));
  window_->openSession(savedScanWith(missing));
  EXPECT_EQ(list()->model()->rowCount(), 0);
  EXPECT_TRUE(window_->parts().messages->text().contains(missing))
      << window_->parts().messages->text().toStdString();
  EXPECT_FALSE(QFile::exists(missing));
  window_->open(QStringLiteral("demo"));
  EXPECT_EQ(list()->model()->rowCount(), 3) << "a new scan shows the chosen catalogue";
}

TEST_F(ProjectChoiceTest, NewProjectIsShown_AndOpenedAgainAfterARestart) {
  const QString folder = folder_.filePath(QStringLiteral("mugs"));
  window_->createProjectFolder(folder);
  EXPECT_EQ(shownName(), QStringLiteral("mugs"));
  EXPECT_EQ(window_->windowTitle(), QStringLiteral("mugs — Scantrove"));
  EXPECT_EQ(list()->model()->rowCount(), 0);
  EXPECT_EQ(usedByScans(), (folder + QStringLiteral("/catalogue.sqlite")).toStdString());
  EXPECT_EQ(window_->controller().scansFolder(), folder + QStringLiteral("/scans"));
  EXPECT_EQ(ProjectChoice::recent().value(0), folder);
  restartWith({});
  EXPECT_EQ(shownName(), QStringLiteral("mugs"));
}

TEST_F(ProjectChoiceTest, ProjectOfTheCommandLineIsOpenedAgain_AfterARestart) {
  const QString folder = folder_.filePath(QStringLiteral("mugs"));
  ASSERT_TRUE(createProject(folder.toStdString(), {}));
  restartWith({}, folder);
  EXPECT_EQ(shownName(), QStringLiteral("mugs"));
  restartWith({});
  EXPECT_EQ(shownName(), QStringLiteral("mugs"));
  EXPECT_EQ(ProjectChoice::recent().value(0), folder);
}

TEST_F(ProjectChoiceTest, ScanIsSavedInTheProject) {
  const QString folder = folder_.filePath(QStringLiteral("mugs"));
  window_->createProjectFolder(folder);
  window_->open(QStringLiteral("demo"));
  EXPECT_TRUE(window_->controller().sessionFolder().startsWith(folder + QStringLiteral("/scans/")))
      << window_->controller().sessionFolder().toStdString();
  EXPECT_EQ(worker_->last_request.database, (folder + QStringLiteral("/catalogue.sqlite")).toStdString());
}

TEST_F(ProjectChoiceTest, ErrorIsReported_WhenAFolderIsNoProject) {
  const QString folder = folder_.filePath(QStringLiteral("plain"));
  ASSERT_TRUE(QDir().mkpath(folder + QStringLiteral("/notes")));
  window_->openProjectFolder(folder);
  EXPECT_TRUE(window_->parts().messages->text().contains(QStringLiteral("is not a project")));
  window_->createProjectFolder(folder);
  EXPECT_TRUE(window_->parts().messages->text().contains(QStringLiteral("is not an empty folder")));
  EXPECT_EQ(usedByScans(), file_.toStdString()) << "the old one stays";
}

TEST_F(ProjectChoiceTest, OpensAProject_WhenItsFolderIsDropped) {
  const QString folder = folder_.filePath(QStringLiteral("mugs"));
  ASSERT_TRUE(createProject(folder.toStdString(), {}));
  window_->open(folder);
  EXPECT_EQ(shownName(), QStringLiteral("mugs"));
  EXPECT_TRUE(window_->onStartPage());
}

TEST_F(ProjectChoiceTest, OpensAProjectOrAScan_ByTheFileInIt) {
  const QString folder = folder_.filePath(QStringLiteral("mugs"));
  ASSERT_TRUE(createProject(folder.toStdString(), {}));
  window_->open(folder + QStringLiteral("/scantrove-project.json"));
  EXPECT_EQ(shownName(), QStringLiteral("mugs"));
  const QString scan = savedScanWith(file_);
  window_->open(scan + QStringLiteral("/session.sqlite"));
  EXPECT_EQ(window_->controller().sessionFolder(), scan);
  EXPECT_TRUE(worker_->last_request.source.empty()) << "it is no recording";
}

TEST_F(ProjectChoiceTest, RunningScanKeepsItsCatalogue_WhenAnotherIsChosen) {
  window_->open(QStringLiteral("demo"));
  const QString kitchen = emptyCatalogue();
  window_->openCatalogue(kitchen);
  EXPECT_EQ(list()->model()->rowCount(), 3) << "the object ids of the scan are of this catalogue";
  EXPECT_TRUE(window_->parts().messages->text().contains(kitchen));
  window_->closeScan();
  EXPECT_EQ(shownName(), QStringLiteral("kitchen.sqlite"));
  EXPECT_EQ(usedByScans(), kitchen.toStdString());
}

}  // namespace
}  // namespace scantrove
