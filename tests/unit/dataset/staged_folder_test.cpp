#include "core/dataset/staged_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <optional>

#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

int entriesOf(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(StagedFolder, AppearsComplete_WhenCommitted) {
  const TemporaryFolder home;
  const fs::path target = home / "a" / "out";
  auto staged = StagedFolder::create(target);
  ASSERT_TRUE(staged) << staged.error().message();
  EXPECT_FALSE(fs::exists(target));
  fs::create_directories(staged->path() / "deep");
  put(staged->path() / "deep" / "file", "x");
  ASSERT_TRUE(staged->commit());
  EXPECT_EQ(readText(target / "deep" / "file"), "x");
  EXPECT_EQ(entriesOf(home / "a"), 1);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  EXPECT_EQ(static_cast<unsigned>(fs::status(target).permissions()), 0777U & ~mask)
      << "the umask decides on permissions";
}

TEST(StagedFolder, ReplacesAnEmptyFolder) {
  const TemporaryFolder home;
  fs::create_directory(home / "out");
  fs::create_directory_symlink("out", home / "link");
  auto staged = StagedFolder::create((home / "link").string() + "/");
  ASSERT_TRUE(staged) << staged.error().message();
  put(staged->path() / "file", "x");
  ASSERT_TRUE(staged->commit());
  EXPECT_EQ(readText(home.path() / "out" / "file"), "x");
  EXPECT_TRUE(fs::is_symlink(home / "link"));
}

TEST(StagedFolder, RemovesEverything_WithoutCommit) {
  const TemporaryFolder home;
  {
    auto staged = StagedFolder::create(home / "out");
    ASSERT_TRUE(staged);
    put(staged->path() / "file", "x");
    const StagedFolder moved = std::move(*staged);
    EXPECT_EQ(entriesOf(home.path()), 1);
  }
  EXPECT_EQ(entriesOf(home.path()), 0);
}

TEST(StagedFolder, RefusesATarget_WhenItIsNotAnEmptyFolder) {
  const TemporaryFolder home;
  home.write("full/file", "mine");
  home.write("file", "mine");
  for (const char* name : {"full", "file", "full/", ""}) {
    const auto staged = StagedFolder::create(*name == 0 ? fs::path() : home / name);
    ASSERT_FALSE(staged) << name;
    EXPECT_FALSE(staged.error().advice.empty());
    const std::string named = *name == 0 ? "" : (home / std::string(name).substr(0, 4)).string();
    EXPECT_NE(staged.error().what.find(named), std::string::npos);
  }
  const auto below_a_file = StagedFolder::create(home / "file" / "out");
  ASSERT_FALSE(below_a_file);
  EXPECT_NE(below_a_file.error().what.find((home / "file" / "out").string()), std::string::npos);
  EXPECT_EQ(readText(home.path() / "full" / "file"), "mine");
  EXPECT_EQ(entriesOf(home.path()), 2);
}

TEST(StagedFolder, CommitFails_WhenTheTargetWasFilledMeanwhile) {
  const TemporaryFolder home;
  {
    auto staged = StagedFolder::create(home / "out");
    ASSERT_TRUE(staged);
    home.write("out/file", "somebody else's");
    const auto committed = staged->commit();
    ASSERT_FALSE(committed);
    EXPECT_NE(committed.error().what.find((home / "out").string()), std::string::npos);
  }
  EXPECT_EQ(readText(home.path() / "out" / "file"), "somebody else's");
  EXPECT_EQ(entriesOf(home.path()), 1);
}

TEST(StagedFolder, RemovesFoldersOfKilledPrograms_ForTheSameTarget) {
  const TemporaryFolder home;
  const pid_t child = fork();
  if (child == 0) {
    auto staged = StagedFolder::create(home / "out");
    if (staged) put(staged->path() / "file", "half");
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(entriesOf(home.path()), 1);
  EXPECT_FALSE(fs::exists(home / "out"));
  for (const char* other : {"out.part-", "out.part-abcdefg", "other.part-abcdef", "out.part-abc.ef"})
    home.write(std::string(other) + "/file", "mine");
  std::optional<Result<StagedFolder>> running = StagedFolder::create(home / "out");
  ASSERT_TRUE(*running);
  EXPECT_EQ(entriesOf(home.path()), 4 + 1) << "the folder of the killed program is removed";
  {
    const auto second = StagedFolder::create(home / "out");
    ASSERT_TRUE(second);
    EXPECT_TRUE(fs::exists((*running)->path())) << "the folder of a running program stays";
  }
  running.reset();
  EXPECT_EQ(entriesOf(home.path()), 4);
}

TEST(StagedFolder, KeepsFoldersOfOthers_WhenTheirNamesLookStaged) {
  const TemporaryFolder home;
  home.write("out.part-backup/photo.jpg", "mine");
  home.write("out.part-marked/.scantrove-unfinished", "mine as well");
  fs::create_directory(home / "out.part-empty1");
  auto staged = StagedFolder::create(home / "out");
  ASSERT_TRUE(staged);
  fs::copy(staged->path(), home / "out.part-copied");
  ASSERT_TRUE(staged->commit());
  fs::remove_all(home / "out");
  ASSERT_TRUE(StagedFolder::create(home / "out"));
  EXPECT_EQ(readText(home / "out.part-backup" / "photo.jpg"), "mine");
  EXPECT_TRUE(fs::exists(home / "out.part-marked"));
  EXPECT_TRUE(fs::exists(home / "out.part-empty1"));
  EXPECT_TRUE(fs::exists(home / "out.part-copied")) << "a renamed copy belongs to its user";
}

TEST(StagedFolder, HasNoMarker_WhenCommitted) {
  const TemporaryFolder home;
  auto staged = StagedFolder::create(home / "out");
  ASSERT_TRUE(staged);
  put(staged->path() / "file", "complete");
  EXPECT_EQ(entriesOf(staged->path()), 2);
  ASSERT_TRUE(staged->commit());
  EXPECT_EQ(entriesOf(home / "out"), 1);
}

TEST(StagedFolder, ErrorsNameTheTargetFolder) {
  const TemporaryFolder home;
  const auto staged = StagedFolder::create(home / "out");
  ASSERT_TRUE(staged);
  const Error error =
      staged->inFinalWords({"Cannot write " + (staged->path() / "a").string() + ": full.", ""});
  EXPECT_EQ(error.what, "Cannot write " + (home / "out" / "a").string() + ": full.");
}

}  // namespace
}  // namespace scantrove::test
