// Sessions from untrusted sources.
#include <gmock/gmock.h>

#include <sys/stat.h>

#include <filesystem>

#include "core/session/inside_folder.h"
#include "core/session/session_list.h"
#include "core/session/session_store.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class CraftedSessionTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(SessionStore::create(path_)); }

  void execute(const QString& sql) {
    const auto connection = DatabaseConnection::open((path_ / "session.sqlite").string());
    ASSERT_TRUE(connection);
    const auto done = (*connection)->execute(sql);
    ASSERT_TRUE(done) << done.error().message();
  }

  void executeFrame(int number) {
    execute(QString("INSERT INTO frames (number, source_index, time_s, state, tx, ty, tz, qx, qy, qz, qw)"
                    " VALUES (%1, 0, 0, 'tracking', 0, 0, 0, 0, 0, 0, 1)")
                .arg(number));
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "scan";
};

TEST_F(CraftedSessionTest, OpenFails_WhenAViewReplacesATable) {
  execute("DROP TABLE frames");
  execute(
      "CREATE VIEW frames AS WITH RECURSIVE r(n) AS (SELECT 0 UNION ALL SELECT n + 1 FROM r)"
      " SELECT n AS number, 0 AS source_index, 0.0 AS time_s, 'tracking' AS state FROM r");
  const auto store = SessionStore::open(path_);
  ASSERT_FALSE(store);
  EXPECT_THAT(store.error().message(),
              AllOf(HasSubstr("session.sqlite"), HasSubstr("view"), HasSubstr("frames")));
  const auto listed = listSessions(path_);
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_THAT(listed[0].damage, HasSubstr("frames"));
}

TEST_F(CraftedSessionTest, OpenFails_WhenATriggerExists) {
  execute("CREATE TRIGGER silent AFTER INSERT ON operations BEGIN DELETE FROM operations; END");
  const auto store = SessionStore::open(path_);
  ASSERT_FALSE(store);
  EXPECT_THAT(store.error().message(), HasSubstr("silent"));
}

TEST_F(CraftedSessionTest, OpenSucceeds_WhenAnUnusedViewExists) {
  execute("CREATE VIEW my_frames AS SELECT number FROM frames");
  EXPECT_TRUE(SessionStore::open(path_));
}

TEST_F(CraftedSessionTest, LoadSkipsAKeyFrame_WhenItsImageLiesOutside) {
  folder_.write("outside.png", "secret");
  std::filesystem::create_symlink(folder_ / "outside.png", path_ / "keyframes" / "link.png");
  int number = 0;
  for (const std::string& file : {std::string("keyframes/000000.png"), (folder_ / "outside.png").string(),
                                  std::string("../outside.png"), std::string("keyframes/../../outside.png"),
                                  std::string("keyframes/link.png")}) {
    executeFrame(number);
    execute(QString("INSERT INTO key_frames (number, color_file, depth_file, metres_per_unit, color)"
                    " VALUES (%1, '%2', 'keyframes/d.png', 0.001, '{\"size\":[4,4]}')")
                .arg(number++)
                .arg(QString::fromStdString(file)));
  }
  const auto store = SessionStore::open(path_);
  ASSERT_TRUE(store) << store.error().message();
  const auto scan = (*store)->load();
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->key_frames.size(), 1U);
  EXPECT_EQ(scan->key_frames[0].frame, 0);
  EXPECT_THAT((*store)->damages(), ElementsAre(HasSubstr("4 key frames")));
}

TEST_F(CraftedSessionTest, ListShowsNoImage_WhenItLiesOutside) {
  folder_.write("outside.png", "secret");
  executeFrame(1);
  execute(
      "INSERT INTO key_frames (number, color_file, depth_file, metres_per_unit, color)"
      " VALUES (1, '../outside.png', 'keyframes/d.png', 0.001, '{}')");
  const auto listed = listSessions(path_);
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_TRUE(listed[0].picture.empty()) << listed[0].picture;
}

TEST_F(CraftedSessionTest, IsInsideFolderIsFalse_ForAPipe) {
  ASSERT_EQ(::mkfifo((path_ / "keyframes" / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(isInsideFolder(path_, "keyframes/pipe"));
  EXPECT_TRUE(isInsideFolder(path_, "keyframes/missing.png"));
}

TEST_F(CraftedSessionTest, SaveSucceeds_WhenAPageNamesAMissingFile) {
  execute(
      "INSERT INTO pages (x, y, z, file, offset, bytes, unpacked_bytes, checksum)"
      " VALUES (1, 2, 3, 1099511627776, 0, 8, 8, 0)");
  const auto store = SessionStore::open(path_);
  ASSERT_TRUE(store) << store.error().message();
  const auto page = (*store)->loadPage({1, 2, 3});
  ASSERT_FALSE(page);
  EXPECT_THAT(page.error().message(), HasSubstr("1099511627776.bricks is missing"));
  ASSERT_TRUE((*store)->writePages(std::vector{SavedPage{{2, 2, 3}, {1, 2, 3}}}));
  ASSERT_TRUE((*store)->save({}));
  EXPECT_TRUE(std::filesystem::exists(path_ / "map" / "000001.bricks"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path_ / "map"), {}), 1);
}

TEST_F(CraftedSessionTest, WritesThroughNoLink) {
  namespace fs = std::filesystem;
  folder_.write("diary.txt", "mine");
  for (const char* name :
       {"map/000001.bricks", "session.lock", "session.sqlite", "session.sqlite-wal", "map", "keyframes"}) {
    const fs::path scan = folder_ / ("with-" + fs::path(name).filename().string());
    { ASSERT_TRUE(SessionStore::create(scan)); }
    const bool is_folder = fs::path(name) == "map" || fs::path(name) == "keyframes";
    fs::remove_all(scan / name);
    if (is_folder) fs::create_directory(folder_ / "pictures");
    fs::create_symlink(is_folder ? folder_ / "pictures" : folder_ / "diary.txt", scan / name);
    const auto store = SessionStore::create(scan);
    if (store) {
      EXPECT_TRUE((*store)->writePages(std::vector{SavedPage{{2, 2, 3}, {1, 2, 3}}})) << name;
    }
    // A taken map file name is skipped; any other link refuses the session.
    EXPECT_EQ(store.has_value(), name == std::string("map/000001.bricks")) << name;
    if (!store) {
      EXPECT_THAT(store.error().message(), AllOf(HasSubstr(name), HasSubstr("link")));
    }
    EXPECT_EQ(readText(folder_ / "diary.txt"), "mine") << name;
    if (is_folder) {
      EXPECT_TRUE(fs::is_empty(folder_ / "pictures")) << name;
    }
  }
}

TEST_F(CraftedSessionTest, LoadPageFails_WhenTheMapFileIsALink) {
  namespace fs = std::filesystem;
  {
    const auto store = SessionStore::open(path_);
    ASSERT_TRUE((*store)->writePages(std::vector{SavedPage{{2, 2, 3}, {1, 2, 3}}}));
    ASSERT_TRUE((*store)->save({}));
  }
  fs::rename(path_ / "map" / "000001.bricks", folder_ / "elsewhere");
  fs::create_symlink(folder_ / "elsewhere", path_ / "map" / "000001.bricks");
  const auto store = SessionStore::open(path_);
  ASSERT_TRUE(store) << store.error().message();
  const auto page = (*store)->loadPage({2, 2, 3});
  ASSERT_FALSE(page);
  EXPECT_THAT(page.error().message(), AllOf(HasSubstr("000001.bricks"), HasSubstr("link")));
  // New pages go to another file.
  const auto bytes = fs::file_size(folder_ / "elsewhere");
  ASSERT_TRUE((*store)->writePages(std::vector{SavedPage{{3, 2, 3}, {1, 2, 3}}}));
  ASSERT_TRUE((*store)->save({}));
  EXPECT_EQ(fs::file_size(folder_ / "elsewhere"), bytes);
}

TEST_F(CraftedSessionTest, OpenRemovesNoForeignFile_WhenTheFileTableNamesIt) {
  folder_.write("scan/keyframes/holiday.jpg", "mine");
  folder_.write("scan/000001.bricks", "mine");
  folder_.write("000002.bricks", "mine");
  for (const char* name :
       {"keyframes/holiday.jpg", "000001.bricks", "../000002.bricks", "map/../../000002.bricks"})
    execute(QString("INSERT INTO files (name, state) VALUES ('%1', 'old')").arg(name));
  { ASSERT_TRUE(SessionStore::open(path_)); }
  EXPECT_EQ(readText(path_ / "keyframes/holiday.jpg"), "mine");
  EXPECT_EQ(readText(path_ / "000001.bricks"), "mine");
  EXPECT_EQ(readText(folder_ / "000002.bricks"), "mine");
}

}  // namespace
}  // namespace scantrove::test
