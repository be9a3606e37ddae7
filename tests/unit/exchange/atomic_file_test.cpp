#include "core/exchange/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>

#include "core/exchange/part_name.h"
#include "tests/support/temporary_folder.h"

namespace {
int flushes = 0;
}  // namespace

// Replaces the C library's function to count its calls.
extern "C" int fsync(int file) {
  ++flushes;
  return static_cast<int>(::syscall(SYS_fsync, file));
}

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using test::readText;
using test::TemporaryFolder;

int filesIn(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AtomicFile, WritesAndReplacesCompleteFiles) {
  const TemporaryFolder folder;
  const fs::path path = folder / "report.json";
  ASSERT_TRUE(writeFileAtomically(path, "first"));
  EXPECT_EQ(readText(path), "first");
  ASSERT_TRUE(writeFileAtomically(path, std::string_view("second\0byte", 11), Durability::process));
  EXPECT_EQ(readText(path), std::string("second\0byte", 11));
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(AtomicFile, FlushesFileAndFolder_WhenAFileIsReplaced) {
  const TemporaryFolder folder;
  const fs::path path = folder / "labels.png";
  flushes = 0;
  ASSERT_TRUE(writeFileAtomically(path, "first", Durability::process));
  EXPECT_EQ(flushes, 0) << "no earlier file was replaced";
  ASSERT_TRUE(writeFileAtomically(path, "second", Durability::process));
  EXPECT_EQ(flushes, 2);
}

TEST(AtomicFile, WritesAllPieces_WhenStreamed) {
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

TEST(AtomicFile, NamesPathAndReason_WhenTheFolderIsMissing) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "missing" / "a.txt";
  const auto result = writeFileAtomically(path, "x");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find(path.string()), std::string::npos);
  EXPECT_NE(result.error().what.find("No such file"), std::string::npos);
  EXPECT_FALSE(result.error().advice.empty());
}

TEST(AtomicFile, KeepsTheOldFile_WhenTheDiskFillsUp) {
  const TemporaryFolder folder;
  const fs::path path = folder / "big.bin";
  ASSERT_TRUE(writeFileAtomically(path, "old"));
  // A limit on file sizes simulates a full disk: write() fails midway.
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

TEST(OutputFolder, IsCreatedWithItsParents) {
  const TemporaryFolder folder;
  ASSERT_TRUE(prepareOutputFolder(folder.path() / "a" / "b"));
  EXPECT_TRUE(fs::is_directory(folder.path() / "a" / "b"));
  EXPECT_EQ(filesIn(folder.path() / "a" / "b"), 0);
  EXPECT_TRUE(prepareOutputFolder(folder.path() / "a" / "b"));
}

TEST(OutputFolder, IsRefusedByName_WhenItsParentIsAFile) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "x");
  const auto result = prepareOutputFolder(file / "out");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find((file / "out").string()), std::string::npos);
}

TEST(OutputFolder, IsRefused_WhenNotWritable) {
  // Permissions do not restrict the superuser; nobody can create files in /proc.
  const auto result = prepareOutputFolder("/proc");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("/proc"), std::string::npos);
}

TEST(OutputFolder, RemovesPartFiles_WhenTheirRunWasKilled) {
  const TemporaryFolder folder;
  const fs::path abandoned = makePartName(folder / "report.json"),
                 locked = makePartName(folder / "cloud.ply");
  for (const fs::path& part : {abandoned, locked}) folder.write(part.filename().string(), "half");
  const int lock = ::open(locked.c_str(), O_RDONLY);  // as a running program does
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
  ASSERT_TRUE(prepareOutputFolder(folder.path()));
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(locked));
  ::close(lock);  // as when this program is killed, too
  ASSERT_TRUE(prepareOutputFolder(folder.path()));
  EXPECT_FALSE(fs::exists(locked));
}

TEST(OutputFolder, KeepsForeignFiles_WhenNamedLikeAPart) {
  const TemporaryFolder folder;
  std::string changed = makePartName(folder / "report.json").filename().string();
  changed[1] = 'R';
  const std::string name = makePartName(folder / "linked").filename().string();
  const std::string below = makePartName(folder / "folder").filename().string();
  const std::string twice = makePartName(folder / "twice").filename().string();
  for (const std::string& other :
       {std::string(".report.json.4711-3.part"), std::string(".notes.part"), changed})
    folder.write(other, "somebody else's");
  fs::create_directory(folder / below);
  fs::create_symlink(".notes.part", folder / name);
  fs::create_hard_link(folder / ".notes.part", folder / twice);
  const int entries = filesIn(folder.path());
  ASSERT_TRUE(prepareOutputFolder(folder.path()));
  EXPECT_EQ(filesIn(folder.path()), entries);
  EXPECT_EQ(readText(folder / ".notes.part"), "somebody else's");
}

TEST(AtomicFile, WritesThroughNoLink_WhenOneExistsAtThePredictableName) {
  const TemporaryFolder folder;
  const fs::path victim = folder.write("victim", "untouched");
  for (int i = 0; i < 100; ++i)
    fs::create_symlink(victim,
                       folder / (".a.txt." + std::to_string(::getpid()) + "-" + std::to_string(i) + ".part"));
  ASSERT_TRUE(writeFileAtomically(folder / "a.txt", "x"));
  EXPECT_EQ(readText(victim), "untouched");
  EXPECT_EQ(readText(folder / "a.txt"), "x");
}

TEST(PartName, IsUnique_WhenMadeTwice) {
  EXPECT_NE(makePartName("a/b.txt"), makePartName("a/b.txt"));
  EXPECT_TRUE(isPartName(makePartName("a/b.txt").filename().string()));
  EXPECT_FALSE(isPartName(".part"));
  EXPECT_FALSE(isPartName(""));
}

// Names of part files and the search pattern must stay stable.
TEST(OutputFolder, RemovesThePartFile_WhenItsWriterWasKilled) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    const rlimit small{1000, 1000};  // this limit's signal kills the process while writing
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

TEST(OutputFolder, IsRefused_WhenAFolderBlocksAResult) {
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
