#include "core/project/project.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <iterator>
#include <string>

#include "core/session/session_setup.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(Project, IsCreatedAndOpenedAgain) {
  const TemporaryFolder folder;
  const auto made = createProject(folder / "mugs", "Mugs & cups");
  ASSERT_TRUE(made) << made.error().message();
  EXPECT_TRUE(isProjectFolder(folder / "mugs"));
  EXPECT_TRUE(fs::is_directory(made->scansFolder()));
  const auto opened = openProject(folder / "mugs/");
  ASSERT_TRUE(opened) << opened.error().message();
  EXPECT_EQ(opened->name, "Mugs & cups");
  EXPECT_EQ(opened->catalogue, folder / "mugs/catalogue.sqlite");
}

TEST(Project, HasTheNameOfItsFolder_WithoutAnother) {
  const TemporaryFolder folder;
  const auto made = createProject(folder / "kitchen", "  ");
  ASSERT_TRUE(made) << made.error().message();
  EXPECT_EQ(made->name, "kitchen");
}

TEST(Project, KeepsTheAddressOfItsServer) {
  const TemporaryFolder folder;
  const std::string server = "postgresql://ann@lab.example:5433/things?sslmode=require";
  const auto made = createProject(folder / "lab", "Lab", server);
  ASSERT_TRUE(made) << made.error().message();
  const auto opened = openProject(folder / "lab");
  ASSERT_TRUE(opened) << opened.error().message();
  EXPECT_EQ(opened->catalogue.string(), server);
  EXPECT_EQ(opened->scansFolder(), folder / "lab/scans");
  SessionSetup setup;
  setup.database = storedDatabaseName(server, folder / "lab/scans/first");
  EXPECT_EQ(setup.database, server);
  EXPECT_EQ(databaseFileOf(setup, folder / "lab/scans/first").string(), server);
  EXPECT_EQ(projectOfCatalogue(server).catalogue.string(), server);
}

TEST(Project, IsNotCreated_WithAPasswordOrAForeignFile) {
  const TemporaryFolder folder;
  const auto secret = createProject(folder / "lab", "", "postgresql://ann:s3cret@lab.example/things");
  ASSERT_FALSE(secret);
  EXPECT_THAT(secret.error().message(), testing::Not(HasSubstr("s3cret")));
  EXPECT_FALSE(createProject(folder / "lab", "", "other.sqlite"));
  EXPECT_FALSE(fs::exists(folder / "lab"));
  EXPECT_EQ(storedDatabaseName("postgresql://ann:s3cret@lab.example/things", folder / "scan"),
            "postgresql://ann@lab.example/things");
}

TEST(Project, IsNotCreated_WhereOtherThingsAre) {
  const TemporaryFolder folder;
  folder.write("full/notes.txt", "mine");
  const auto full = createProject(folder / "full", "");
  ASSERT_FALSE(full);
  EXPECT_THAT(full.error().message(), HasSubstr("not an empty folder"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "full"), fs::directory_iterator()), 1);
  ASSERT_TRUE(createProject(folder / "new", "first"));
  const auto again = createProject(folder / "new", "second");
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message(), HasSubstr("a project already"));
  EXPECT_EQ(openProject(folder / "new")->name, "first");
}

TEST(Project, IsRefused_WhenDamagedOrNewer) {
  const TemporaryFolder folder;
  for (const char* const text :
       {"", "[]", "{", R"({"name": "a"})", R"({"scantrove_project": "1", "name": "a"})",
        R"({"scantrove_project": 1, "name": 7})", "{\"scantrove_project\": 1, \"name\": \"a\\nb\"}"}) {
    folder.write("p/scantrove-project.json", text);
    const auto opened = openProject(folder / "p");
    ASSERT_FALSE(opened) << text;
    EXPECT_THAT(opened.error().message(), HasSubstr("p/scantrove-project.json")) << text;
  }
  folder.write("p/scantrove-project.json", R"({"scantrove_project": 3, "name": "a"})");
  EXPECT_THAT(openProject(folder / "p").error().message(), HasSubstr("newer version"));
}

TEST(Project, ErrorSaysHowToMakeOne_WhenTheFolderIsNone) {
  const TemporaryFolder folder;
  EXPECT_THAT(openProject(folder / "none").error().message(), HasSubstr("project create"));
  folder.write("plain/a.txt", "a");
  EXPECT_THAT(openProject(folder / "plain").error().message(), HasSubstr("is not a project"));
}

TEST(Project, OfAScanIsTwoFoldersUp) {
  const TemporaryFolder folder;
  ASSERT_TRUE(createProject(folder / "mugs", ""));
  const auto project = projectOfScan(folder / "mugs/scans/first");
  ASSERT_TRUE(project) << project.error().message();
  EXPECT_EQ(project->name, "mugs");
  EXPECT_FALSE(projectOfScan(folder / "other/first"));
}

TEST(Project, OfACatalogueIsThatOfItsFolder_OrItsOwn) {
  const TemporaryFolder folder;
  ASSERT_TRUE(createProject(folder / "mugs", "Mugs & cups"));
  EXPECT_EQ(projectOfCatalogue(folder / "mugs/catalogue.sqlite").name, "Mugs & cups");
  for (const char* const file : {"mugs/other.sqlite", "kitchen.sqlite"}) {
    const Project alone = projectOfCatalogue(folder / file);
    EXPECT_EQ(alone.name, fs::path(file).filename());
    EXPECT_EQ(alone.catalogue, folder / file);
    EXPECT_EQ(alone.scansFolder(), defaultProject().scansFolder());
  }
}

TEST(Project, NamesFoldersOfScans) {
  const TemporaryFolder folder;
  const auto project = createProject(folder / "mugs", "");
  ASSERT_TRUE(project) << project.error().message();
  const auto nameFor = [&](const std::string& title) {
    return newScanFolder(*project, "2026-11-22 15.40.02", title).filename().string();
  };
  EXPECT_EQ(nameFor("kitchen"), "2026-11-22 15.40.02 kitchen");
  fs::create_directories(project->scansFolder() / "2026-11-22 15.40.02 kitchen");
  EXPECT_EQ(nameFor("kitchen"), "2026-11-22 15.40.02 kitchen (2)");
  EXPECT_EQ(nameFor("demo:room:3"), "2026-11-22 15.40.02 demo-room-3");
  EXPECT_EQ(nameFor("../../etc"), "2026-11-22 15.40.02 ..-..-etc");
  EXPECT_EQ(nameFor(""), "2026-11-22 15.40.02 scan");
}

TEST(Project, CutsLongNamesBetweenCharacters) {
  const Project project{"/p", "p", "/p/catalogue.sqlite"};
  std::string umlauts;
  for (int i = 0; i < 150; ++i) umlauts += "\xC3\xA4";
  const std::string name = newScanFolder(project, "2026-11-22 15.40.02", umlauts).filename().string();
  // 200 bytes, of which 20 are the day and a blank; 180 are 90 letters of two bytes each.
  EXPECT_EQ(name, "2026-11-22 15.40.02 " + umlauts.substr(0, 180));
}

TEST(Project, ScansFindTheCatalogueOfTheFolderThatTheyLieIn) {
  const TemporaryFolder folder;
  const auto project = createProject(folder / "mugs", "");
  ASSERT_TRUE(project) << project.error().message();
  const fs::path scan = project->scansFolder() / "first";
  fs::create_directories(scan);
  folder.write("mugs/catalogue.sqlite", "");
  SessionSetup setup;
  setup.database = storedDatabaseName(project->catalogue.string(), scan);
  EXPECT_EQ(setup.database, "../../catalogue.sqlite");
  fs::copy(folder / "mugs", folder / "copy", fs::copy_options::recursive);
  const fs::path found = databaseFileOf(setup, folder / "copy/scans/first");
  EXPECT_TRUE(fs::equivalent(found, folder / "copy/catalogue.sqlite")) << found;
}

}  // namespace
}  // namespace scantrove::test
