#include "core/exchange/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using test::readText;
using test::TemporaryFolder;

int filesIn(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AtomicFile, WritesAndReplacesWholeFiles) {
  const TemporaryFolder folder;
  const fs::path path = folder / "report.json";
  ASSERT_TRUE(writeFileAtomically(path, "first"));
  EXPECT_EQ(readText(path), "first");
  ASSERT_TRUE(writeFileAtomically(path, std::string_view("second\0byte", 11), Durability::process));
  EXPECT_EQ(readText(path), std::string("second\0byte", 11));
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(AtomicFile, WritesOnePieceAfterTheOther) {
  const TemporaryFolder folder;
  std::array<std::string_view, 4> pieces{"one ", "two ", "three", ""};
  int asked = 0;
  ASSERT_TRUE(
      writeFileAtomically(folder / "a.txt", [&] { return pieces.at(static_cast<std::size_t>(asked++)); }));
  EXPECT_EQ(readText(folder / "a.txt"), "one two three");
  EXPECT_EQ(asked, 4);
  ASSERT_TRUE(writeFileAtomically(folder / "b.txt", [] { return std::string_view(); }));
  EXPECT_EQ(readText(folder / "b.txt"), "");
}

TEST(AtomicFile, NamesThePathAndTheReasonOfAFolderThatIsMissing) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "missing" / "a.txt";
  const auto result = writeFileAtomically(path, "x");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find(path.string()), std::string::npos);
  EXPECT_NE(result.error().what.find("No such file"), std::string::npos);
  EXPECT_FALSE(result.error().advice.empty());
}

TEST(AtomicFile, ADiskThatFillsUpLeavesTheOldFile) {
  const TemporaryFolder folder;
  const fs::path path = folder / "big.bin";
  ASSERT_TRUE(writeFileAtomically(path, "old"));
  // A limit on the size of files stands in for the full disk: write() fails in the middle.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto result = writeFileAtomically(path, std::string(5000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find(path.string()), std::string::npos);
  EXPECT_EQ(readText(path), "old");
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(OutputFolder, IsMadeWithItsParents) {
  const TemporaryFolder folder;
  ASSERT_TRUE(prepareOutputFolder(folder.path() / "a" / "b"));
  EXPECT_TRUE(fs::is_directory(folder.path() / "a" / "b"));
  EXPECT_EQ(filesIn(folder.path() / "a" / "b"), 0);
  EXPECT_TRUE(prepareOutputFolder(folder.path() / "a" / "b"));
}

TEST(OutputFolder, BelowAFileIsRefusedWithItsName) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "x");
  const auto result = prepareOutputFolder(file / "out");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find((file / "out").string()), std::string::npos);
}

TEST(OutputFolder, ThatCannotBeWrittenToIsRefused) {
  // Permissions do not bind the superuser; nobody creates files in /proc.
  const auto result = prepareOutputFolder("/proc");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("/proc"), std::string::npos);
}

TEST(OutputFolder, LosesWhatAKilledRunLeft) {
  const TemporaryFolder folder;
  folder.write(".report.json.4711-3.part", "half a rep");
  const fs::path held = folder.write(".cloud.ply.4712-0.part", "half a clo");
  const fs::path others = folder.write(".notes.part", "somebody else's");
  fs::create_directory(folder / ".folder.1-1.part");
  fs::create_symlink("report.json", folder / ".link.1-2.part");
  const int lock = ::open(held.c_str(), O_RDONLY);  // as a running program does
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
  ASSERT_TRUE(prepareOutputFolder(folder.path()));
  EXPECT_FALSE(fs::exists(folder / ".report.json.4711-3.part"));
  EXPECT_TRUE(fs::exists(held));
  EXPECT_TRUE(fs::exists(others));
  EXPECT_TRUE(fs::exists(folder / ".folder.1-1.part"));
  EXPECT_TRUE(fs::is_symlink(folder / ".link.1-2.part"));
  ::close(lock);  // it was killed too
  ASSERT_TRUE(prepareOutputFolder(folder.path()));
  EXPECT_FALSE(fs::exists(held));
}

// The names of part files and of what is looked for must stay the same.
TEST(OutputFolder, LosesTheFileThatAKilledWriterLeft) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    const rlimit small{1000, 1000};  // the signal of this limit kills in the middle of writing
    setrlimit(RLIMIT_FSIZE, &small);
    (void)writeFileAtomically(folder / "big.bin", std::string(5000, 'x'));
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(filesIn(folder.path()), 1);
  ASSERT_TRUE(prepareOutputFolder(folder.path()));
  EXPECT_EQ(filesIn(folder.path()), 0);
}

TEST(OutputFolder, WithAFolderInAResultsPlaceIsRefused) {
  const TemporaryFolder folder;
  folder.write("report.json", "old");
  fs::create_directory(folder / "cloud.ply");
  const std::array names{"report.json", "trajectory.txt", "cloud.ply"};
  EXPECT_TRUE(checkReplaceable(folder.path(), std::span(names).first(2)));
  const auto result = checkReplaceable(folder.path(), names);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find((folder / "cloud.ply").string()), std::string::npos);
}

}  // namespace
}  // namespace scantrove
