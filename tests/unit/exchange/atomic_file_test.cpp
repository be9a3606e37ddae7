#include "core/exchange/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

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

TEST(AtomicFile, AFailedWriterLeavesTheOldFileAndNothingBesideIt) {
  const TemporaryFolder folder;
  const fs::path path = folder / "cloud.pcd";
  ASSERT_TRUE(writeFileAtomically(path, "old"));
  const auto result = writeFileAtomically(path, [](const fs::path& beside) -> Result<void> {
    std::ofstream(beside) << "half a clo";
    EXPECT_EQ(beside.extension(), ".pcd");
    return fail("the writer broke down");
  });
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find(path.string()), std::string::npos);
  EXPECT_NE(result.error().what.find("the writer broke down"), std::string::npos);
  EXPECT_EQ(readText(path), "old");
  EXPECT_EQ(filesIn(folder.path()), 1);
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

}  // namespace
}  // namespace scantrove
