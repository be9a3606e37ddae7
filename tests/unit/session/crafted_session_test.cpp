// Sessions of other people: what they name is not believed.
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

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "scan";
};

TEST_F(CraftedSessionTest, OpeningFails_WhenViewStandsForTable) {
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

TEST_F(CraftedSessionTest, OpeningFails_WhenThereIsTrigger) {
  execute("CREATE TRIGGER silent AFTER INSERT ON operations BEGIN DELETE FROM operations; END");
  const auto store = SessionStore::open(path_);
  ASSERT_FALSE(store);
  EXPECT_THAT(store.error().message(), HasSubstr("silent"));
}

TEST_F(CraftedSessionTest, OpeningSucceeds_WhenViewIsNotRead) {
  execute("CREATE VIEW my_frames AS SELECT number FROM frames");
  EXPECT_TRUE(SessionStore::open(path_));
}

TEST_F(CraftedSessionTest, KeyFrameIsLeftOut_WhenItsImageLiesOutside) {
  folder_.write("outside.png", "secret");
  std::filesystem::create_symlink(folder_ / "outside.png", path_ / "keyframes" / "link.png");
  int number = 0;
  for (const std::string& file : {std::string("keyframes/000000.png"), (folder_ / "outside.png").string(),
                                  std::string("../outside.png"), std::string("keyframes/../../outside.png"),
                                  std::string("keyframes/link.png")}) {
    execute(QString("INSERT INTO frames VALUES (%1, 0, 0, 'tracking', 0, 0, 0, 0, 0, 0, 1)").arg(number));
    execute(QString("INSERT INTO key_frames VALUES (%1, '%2', 'keyframes/d.png', 0.001, '{\"size\":[4,4]}')")
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

TEST_F(CraftedSessionTest, ListShowsNoPicture_WhenItLiesOutside) {
  folder_.write("outside.png", "secret");
  execute("INSERT INTO frames VALUES (1, 0, 0, 'tracking', 0, 0, 0, 0, 0, 0, 1)");
  execute("INSERT INTO key_frames VALUES (1, '../outside.png', 'keyframes/d.png', 0.001, '{}')");
  const auto listed = listSessions(path_);
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_TRUE(listed[0].picture.empty()) << listed[0].picture;
}

TEST_F(CraftedSessionTest, FileIsRefused_WhenItIsPipe) {
  ASSERT_EQ(::mkfifo((path_ / "keyframes" / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(isInsideFolder(path_, "keyframes/pipe"));
  EXPECT_TRUE(isInsideFolder(path_, "keyframes/missing.png"));
}

TEST_F(CraftedSessionTest, SavingGoesOn_WhenPageNamesFarFile) {
  execute("INSERT INTO pages VALUES (1, 2, 3, 1099511627776, 0, 8, 8, 0)");
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

}  // namespace
}  // namespace scantrove::test
