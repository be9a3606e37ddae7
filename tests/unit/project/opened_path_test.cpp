#include "core/project/opened_path.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/project/project.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using Kind = OpenedPath::Kind;

/// Changes the current folder for its lifetime.
class CurrentFolder {
 public:
  explicit CurrentFolder(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~CurrentFolder() { fs::current_path(before_); }
  CurrentFolder(const CurrentFolder&) = delete;
  CurrentFolder& operator=(const CurrentFolder&) = delete;

 private:
  fs::path before_;
};

TEST(OpenedPath, IsAScan_ByItsFolderOrItsFile) {
  const TemporaryFolder folder;
  folder.write("scan/session.sqlite", "");
  for (const char* const given : {"scan", "scan/", "scan/session.sqlite", "scan/../scan"}) {
    const OpenedPath path = recognizePath(folder / given);
    EXPECT_EQ(path.kind, Kind::scan) << given;
    EXPECT_EQ(path.folder, folder / "scan") << given;
  }
}

TEST(OpenedPath, IsAProject_ByItsFolderOrItsFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(createProject(folder / "mugs", ""));
  for (const char* const given : {"mugs", "mugs/", "mugs/scantrove-project.json"}) {
    const OpenedPath path = recognizePath(folder / given);
    EXPECT_EQ(path.kind, Kind::project) << given;
    EXPECT_EQ(path.folder, folder / "mugs") << given;
  }
}

TEST(OpenedPath, IsAProjectOfAnEarlierVersion) {
  const TemporaryFolder folder;
  folder.write("mugs/project.json", R"({"scantrove_project": 1, "name": "Mugs"})");
  EXPECT_EQ(recognizePath(folder / "mugs").kind, Kind::project);
  EXPECT_EQ(recognizePath(folder / "mugs/project.json").kind, Kind::project);
}

TEST(OpenedPath, IsNoProject_WhenTheFileIsOfAnotherProgram) {
  const TemporaryFolder folder;
  folder.write("recording/project.json", R"({"title": "a recording"})");
  EXPECT_EQ(recognizePath(folder / "recording").kind, Kind::other);
  EXPECT_EQ(recognizePath(folder / "recording/project.json").kind, Kind::other);
}

TEST(OpenedPath, IsFound_WithoutAFolder) {
  const TemporaryFolder folder;
  folder.write("scan/session.sqlite", "");
  ASSERT_TRUE(createProject(folder / "mugs", ""));
  {
    const CurrentFolder here(folder / "scan");
    EXPECT_EQ(recognizePath("session.sqlite").kind, Kind::scan);
    EXPECT_TRUE(fs::equivalent(recognizePath("session.sqlite").folder, folder / "scan"));
    EXPECT_EQ(recognizePath(".").kind, Kind::scan);
  }
  const CurrentFolder here(folder / "mugs");
  EXPECT_EQ(recognizePath("scantrove-project.json").kind, Kind::project);
}

TEST(OpenedPath, IsNothing_OtherwiseAndWhenEmpty) {
  const TemporaryFolder folder;
  folder.write("plain/a.txt", "a");
  for (const std::string& given :
       {(folder / "plain").string(), (folder / "plain/a.txt").string(),
        (folder / "none/session.sqlite").string(), std::string(), std::string("demo")})
    EXPECT_EQ(recognizePath(given).kind, Kind::other) << given;
}

TEST(Project, OfAnEarlierVersionOpens_AndKeepsItsFile) {
  const TemporaryFolder folder;
  folder.write("mugs/project.json", R"({"scantrove_project": 1, "name": "Mugs"})");
  const auto opened = openProject(folder / "mugs");
  ASSERT_TRUE(opened) << opened.error().message();
  EXPECT_EQ(opened->name, "Mugs");
  EXPECT_TRUE(fs::exists(folder / "mugs/project.json"));
  EXPECT_FALSE(createProject(folder / "mugs", "other"));
}

}  // namespace
}  // namespace scantrove::test
