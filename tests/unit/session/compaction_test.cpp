#include <gmock/gmock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

#include "core/session/session_store.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// Records flushes during a test.
struct Flushes {
  fs::path watched;                     ///< flushes are recorded while this file exists
  bool map_fails = false;               ///< flushing a map file fails
  bool new_map_fails = false;           ///< flushing any map file but the first fails
  std::vector<std::string> names = {};  ///< of files and folders, in order
};
Flushes* flushes = nullptr;  ///< null between tests

int flush(long call, int file) {
  if (flushes != nullptr) {
    std::error_code ignored;
    const fs::path path = fs::read_symlink("/proc/self/fd/" + std::to_string(file), ignored);
    if (fs::exists(flushes->watched, ignored)) flushes->names.push_back(path.filename().string());
    const bool is_map = path.extension() == ".bricks";
    if (is_map && (flushes->map_fails || (flushes->new_map_fails && path != flushes->watched))) {
      errno = EIO;
      return -1;
    }
  }
  return static_cast<int>(::syscall(call, file));
}

}  // namespace
}  // namespace scantrove

// Replaces the C library's functions.
extern "C" int fdatasync(int file) { return scantrove::flush(SYS_fdatasync, file); }
extern "C" int fsync(int file) { return scantrove::flush(SYS_fsync, file); }

namespace scantrove {
namespace {

class CompactionTest : public testing::Test {
 protected:
  void SetUp() override {
    auto created = SessionStore::create(folder_.path());
    ASSERT_TRUE(created) << created.error().message();
    store_ = std::move(*created);
    flushes = &flushes_;
  }
  void TearDown() override { flushes = nullptr; }

  /// Saves one page of 4 MB that does not compress.
  Result<void> savePage() {
    for (std::uint32_t& word : pages_[0].words) word = state_ = state_ * 1664525U + 1013904223U;
    SCANTROVE_TRY(store_->writePages(pages_));
    return store_->save({});
  }

  const test::TemporaryFolder folder_;
  const fs::path old_file_ = folder_.path() / "map" / "000001.bricks";
  Flushes flushes_{.watched = old_file_};
  std::vector<SavedPage> pages_{{{0, 0, 0}, std::vector<std::uint32_t>(1 << 20)}};
  std::uint32_t state_ = 1;
  std::unique_ptr<SessionStore> store_;
};

TEST_F(CompactionTest, FlushesTheNewMap_BeforeTheOldOneIsRemoved) {
  for (int save = 0; save < 14; ++save) ASSERT_TRUE(savePage());
  ASSERT_FALSE(fs::exists(old_file_)) << "the map has been compacted";
  EXPECT_THAT(flushes_.names, testing::IsSupersetOf({"000002.bricks", "map", "session.sqlite-wal"}));
}

TEST_F(CompactionTest, KeepsTheOldMap_WhenTheNewOneCannotBeFlushed) {
  ASSERT_TRUE(savePage());
  flushes_.new_map_fails = true;
  std::vector<std::uint32_t> saved;
  bool has_failed = false;
  for (int save = 0; save < 14 && !has_failed; ++save) {
    has_failed = !savePage();
    saved = pages_[0].words;
  }
  EXPECT_TRUE(has_failed);
  EXPECT_TRUE(fs::exists(old_file_));
  EXPECT_EQ(*store_->loadPage({0, 0, 0}), saved) << "only the compaction failed";
  flushes_.new_map_fails = false;
  ASSERT_TRUE(savePage());
  EXPECT_EQ(*store_->loadPage({0, 0, 0}), pages_[0].words);
}

TEST_F(CompactionTest, FlushesPages_BeforeTheirPositionsAreSaved) {
  ASSERT_TRUE(savePage());
  EXPECT_THAT(flushes_.names, testing::IsSupersetOf({"000001.bricks", "map"}));
}

TEST_F(CompactionTest, SavesNoPosition_WhenItsPageCannotBeFlushed) {
  ASSERT_TRUE(savePage());
  const std::vector<std::uint32_t> saved = pages_[0].words;
  flushes_.map_fails = true;
  EXPECT_FALSE(savePage());
  EXPECT_EQ(*store_->loadPage({0, 0, 0}), saved);
  flushes_.map_fails = false;
  ASSERT_TRUE(store_->save({})) << "the write is retried";
  EXPECT_EQ(*store_->loadPage({0, 0, 0}), pages_[0].words);
}

}  // namespace
}  // namespace scantrove
