// Names that users give to objects, and catalogues that are opened to read.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "catalogue_test_support.h"
#include "core/base/label_name.h"
#include "core/database/database_connection.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ObjectNamingTest : public CatalogueTest {
 protected:
  ObjectId add(int seed) { return database_->addObject(randomView(seed))->id; }
  ObjectNaming name(ObjectId id, const std::string& name) {
    const Result<ObjectNaming> naming = database_->nameByUser(id, name);
    EXPECT_TRUE(naming) << naming.error().message();
    return naming.value_or(ObjectNaming{});
  }
  ObjectRecord record(ObjectId id) {
    const Result<ObjectRecord> record = database_->object(id);
    EXPECT_TRUE(record) << record.error().message();
    return record.value_or(ObjectRecord{});
  }
  bool revert(const ObjectNaming& naming) {
    const Result<bool> done = database_->revertNaming(naming);
    EXPECT_TRUE(done) << done.error().message();
    return done.value_or(false);
  }

  std::unique_ptr<ObjectDatabase> database_ = openOrFail(file());
};

TEST_F(ObjectNamingTest, SetsAndRevertsNameAndConfirmation) {
  const ObjectId mug = add(1);
  const ObjectNaming naming = name(mug, "  blue mug ");
  EXPECT_EQ(naming.object, mug);
  EXPECT_EQ(naming.name, "blue mug");
  EXPECT_EQ(record(mug).name, "blue mug");
  EXPECT_TRUE(record(mug).confirmed);
  EXPECT_EQ(record(mug).named_by, NamedBy::user);
  EXPECT_TRUE(revert(naming));
  EXPECT_EQ(record(mug).name, "Obj_1");
  EXPECT_FALSE(record(mug).confirmed);
  EXPECT_EQ(record(mug).named_by, NamedBy::program);
  EXPECT_FALSE(revert(naming)) << "it is reverted already";
}

TEST_F(ObjectNamingTest, RevertsNamesOneByOne) {
  const ObjectId mug = add(1);
  const ObjectNaming first = name(mug, "mug"), second = name(mug, "cup");
  EXPECT_TRUE(revert(second));
  EXPECT_EQ(record(mug).name, "mug");
  EXPECT_TRUE(record(mug).confirmed);
  EXPECT_TRUE(revert(first));
  EXPECT_EQ(record(mug).name, "Obj_1");
}

TEST_F(ObjectNamingTest, RevertKeepsTheName_WhenItChangedSince) {
  const ObjectId mug = add(1);
  const ObjectNaming naming = name(mug, "mug");
  ASSERT_TRUE(database_->rename(mug, "jug"));
  EXPECT_FALSE(revert(naming));
  EXPECT_EQ(record(mug).name, "jug");
  EXPECT_TRUE(record(mug).confirmed);
}

TEST_F(ObjectNamingTest, MergesIntoTheObjectOfThatName) {
  const ObjectId mug = add(1), other = add(2);
  ASSERT_TRUE(database_->rename(mug, "mug"));
  const ObjectNaming naming = name(other, "mug");
  EXPECT_EQ(naming.object, mug);
  ASSERT_TRUE(naming.merge);
  EXPECT_EQ(database_->objects()->size(), 1U);
  EXPECT_EQ(record(mug).views, 2);
  EXPECT_TRUE(record(mug).confirmed);
  EXPECT_EQ(*database_->mergeRoot(other), mug);
  EXPECT_TRUE(revert(naming));
  EXPECT_EQ(record(mug).views, 1);
  EXPECT_FALSE(record(mug).confirmed) << "as before";
  EXPECT_EQ(record(mug).name, "mug");
  EXPECT_EQ(record(other).name, "Obj_2");
}

TEST_F(ObjectNamingTest, MergesIntoTheObjectOfThatName_WhenItHasFewerViews) {
  const ObjectId first = add(1), second = add(2);
  ObjectView more = randomView(3);
  more.object = second;
  ASSERT_TRUE(database_->addView(more));
  EXPECT_EQ(name(second, "Obj_1").object, first) << "a user may type a generated name";
  EXPECT_EQ(record(first).views, 3);
}

TEST_F(ObjectNamingTest, MergesNothing_WhenAUserNamedBoth) {
  const ObjectId mug = add(1), cup = add(2);
  name(mug, "mug");
  name(cup, "cup");
  EXPECT_FALSE(name(cup, "mug").object);
  EXPECT_EQ(record(cup).name, "cup");
  EXPECT_EQ(database_->objects()->size(), 2U);
}

TEST_F(ObjectNamingTest, RefusesInvalidNamesAndDeletedObjects) {
  const ObjectId mug = add(1);
  EXPECT_THAT(database_->nameByUser(mug, "12").error().message(), HasSubstr("number alone"));
  EXPECT_FALSE(checkedLabelName(" \t"));
  EXPECT_EQ(*checkedLabelName(" a mug "), "a mug");
  ASSERT_TRUE(database_->remove(std::array{mug}));
  EXPECT_THAT(database_->nameByUser(mug, "mug").error().message(), HasSubstr("deleted"));
}

class ReadOnlyCatalogueTest : public ObjectNamingTest {
 protected:
  std::vector<std::string> filesInFolder() const {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      files.push_back(entry.path().filename().string());
    std::ranges::sort(files);
    return files;
  }
};

TEST_F(ReadOnlyCatalogueTest, ChangesNoFiles) {
  const ObjectId mug = add(1);
  database_.reset();
  const auto before = std::filesystem::last_write_time(file());
  const auto files = filesInFolder();
  {
    const auto reader = ObjectDatabase::openToRead(file());
    ASSERT_TRUE(reader) << reader.error().message();
    EXPECT_EQ((*reader)->objects()->size(), 1U);
    EXPECT_EQ((*reader)->views().of(mug)->size(), 1U);
    EXPECT_TRUE((*reader)->isStill());
    const Result<void> refused = (*reader)->rename(mug, "mug");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), HasSubstr(file()));
  }
  EXPECT_EQ(std::filesystem::last_write_time(file()), before);
  EXPECT_EQ(filesInFolder(), files);
}

TEST_F(ReadOnlyCatalogueTest, ShowsNewObjects_WhenAnotherConnectionAddsThem) {
  add(1);  // in SQLite's write-ahead log, not yet in the file
  const auto reader = ObjectDatabase::openToRead(file());
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_EQ((*reader)->objects()->size(), 1U);
  add(2);
  EXPECT_EQ((*reader)->objects()->size(), 2U);
}

TEST_F(ReadOnlyCatalogueTest, IsNotStill_WhenAnotherConnectionWrote) {
  add(1);
  database_.reset();
  const auto reader = ObjectDatabase::openToRead(file());
  ASSERT_TRUE(reader);
  EXPECT_TRUE((*reader)->isStill());
  database_ = openOrFail(file());
  add(2);
  EXPECT_FALSE((*reader)->isStill());
}

TEST_F(ReadOnlyCatalogueTest, HasNoCameras_WhenTheVersionIsOlder) {
  add(1);
  database_.reset();
  for (const char* sql : {"ALTER TABLE sessions DROP COLUMN fx", "PRAGMA user_version = 3"})
    askSqlite(file(), sql);
  const auto reader = ObjectDatabase::openToRead(file());
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_TRUE((*reader)->sessions().cameras()->empty());
  EXPECT_EQ((*reader)->objects()->size(), 1U);
  askSqlite(file(), "PRAGMA user_version = 1");
  EXPECT_THAT(ObjectDatabase::openToRead(file()).error().message(), HasSubstr("older"));
}

TEST_F(ReadOnlyCatalogueTest, ReportsWhy_WhenThereIsNoCatalogue) {
  EXPECT_THAT(ObjectDatabase::openToRead(file("none.sqlite")).error().message(),
              AllOf(HasSubstr("no database"), HasSubstr("none.sqlite")));
  EXPECT_FALSE(std::filesystem::exists(file("none.sqlite"))) << "none is created";
  EXPECT_THAT(ObjectDatabase::openToRead(folder_.string()).error().message(), HasSubstr("is a folder"));
  { std::ofstream(file("empty.sqlite")); }
  EXPECT_THAT(ObjectDatabase::openToRead(file("empty.sqlite")).error().message(), HasSubstr("empty"));
}

TEST_F(ReadOnlyCatalogueTest, Opens_WhenTheFileNameHasSpecialCharacters) {
  add(1);
  database_.reset();
  const std::string special = file("what? #100% \xC3\xA4.sqlite");
  std::filesystem::rename(file(), special);
  const auto reader = ObjectDatabase::openToRead(special);
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_EQ((*reader)->objects()->size(), 1U);
}

}  // namespace
}  // namespace scantrove::test
