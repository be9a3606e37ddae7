#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <set>

#include "catalogue_test_support.h"
#include "catalogue_user.h"

namespace scantrove::test {
namespace {

class SeveralProgramsTest : public CatalogueTest {
 protected:
  /// Inode of SQLite's write-ahead log; 0 without one.
  [[nodiscard]] ino_t journal() const {
    struct stat info {};
    return ::stat((file() + "-wal").c_str(), &info) == 0 ? info.st_ino : 0;
  }

  void noteStored(std::uint32_t id) { stored_.insert(id); }

  /// Every object reported as stored is in the catalogue, and the file is intact.
  void expectComplete() const {
    std::set<std::uint32_t> found;
    const auto database = openOrFail(file());
    ASSERT_NE(database, nullptr);
    const std::vector<ObjectRecord> objects = *database->objects();
    for (const ObjectRecord& object : objects) {
      found.insert(object.id.value);
      EXPECT_EQ(object.views, 1);
      const auto name = names_.find(object.id.value);
      EXPECT_EQ(object.name, name == names_.end() ? object.name : name->second);
    }
    EXPECT_TRUE(std::ranges::includes(found, stored_));
    EXPECT_EQ(askSqlite(file(), "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(askSqlite(file(), "PRAGMA foreign_key_check"), "");
  }

  std::set<std::uint32_t> stored_;
  std::map<std::uint32_t, std::string> names_;
};

TEST_F(SeveralProgramsTest, LosesNothing_WhenProgramsQuitOrAreKilled) {
  enum class End { quit, kill };
  int round = 0;
  for (const End window_end : {End::quit, End::kill}) {
    for (const End visitor_end : {End::quit, End::kill}) {
      CatalogueUser window(file());
      ASSERT_EQ(window.ask("open"), "ok");
      noteStored(window.add());
      ASSERT_EQ(window.ask("open"), "ok");  // a scan in the same program
      const ino_t journal_before = journal();
      ASSERT_NE(journal_before, 0U);
      for (int visit = 0; visit < 3; ++visit) {
        CatalogueUser visitor(file());
        ASSERT_EQ(visitor.ask("open"), "ok");
        const std::uint32_t id = visitor.add();
        noteStored(id);
        noteStored(window.add());
        names_[id] = "name_" + std::to_string(round) + "_" + std::to_string(visit);
        ASSERT_EQ(visitor.ask("rename " + std::to_string(id) + " " + names_[id]), "ok");
        visitor_end == End::quit ? visitor.quit() : visitor.kill();
        EXPECT_EQ(journal(), journal_before) << "it must not be deleted while a program uses it";
        noteStored(window.add());
        ASSERT_EQ(window.ask("open"), "ok");
      }
      window_end == End::quit ? window.quit() : window.kill();
      ++round;
      expectComplete();
    }
  }
  EXPECT_EQ(stored_.size(), 4U * 10U);
}

TEST_F(SeveralProgramsTest, LosesNothing_WhenKilledWhileWriting) {
  std::size_t kills = 0;
  for (const std::size_t objects : {1U, 7U, 23U, 40U}) {
    CatalogueUser writer(file());
    ASSERT_EQ(writer.ask("open"), "ok");
    writer.send("write");
    std::size_t reported = 0;
    for (std::string line = writer.nextLine(); !line.empty(); line = writer.nextLine()) {
      noteStored(CatalogueUser::idOf(line));
      if (++reported == objects) writer.kill();
    }
    ++kills;
    ASSERT_GE(reported, objects);
    expectComplete();
    EXPECT_LE(openOrFail(file())->objects()->size(), stored_.size() + kills)
        << "at most one unreported object for each kill";
  }
}

}  // namespace
}  // namespace scantrove::test
