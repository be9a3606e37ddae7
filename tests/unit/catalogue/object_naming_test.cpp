// What a person calls an object, and catalogues that are only read.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "catalogue_test_support.h"
#include "core/base/label_name.h"
#include "core/database/database_connection.h"

namespace scantrove {
namespace {

using test::askSqlite;
using test::CatalogueTest;
using test::openOrFail;
using test::randomView;
using testing::AllOf;
using testing::HasSubstr;

class NamedByPerson : public CatalogueTest {
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
  bool takeBack(const ObjectNaming& naming) {
    const Result<bool> done = database_->revertNaming(naming);
    EXPECT_TRUE(done) << done.error().message();
    return done.value_or(false);
  }

  std::unique_ptr<ObjectDatabase> database_ = openOrFail(file());
};

TEST_F(NamedByPerson, GivesNameAndMarkAndTakesBothBack) {
  const ObjectId mug = add(1);
  const ObjectNaming naming = name(mug, "  blue mug ");
  EXPECT_EQ(naming.object, mug);
  EXPECT_EQ(naming.name, "blue mug");
  EXPECT_EQ(record(mug).name, "blue mug");
  EXPECT_TRUE(record(mug).confirmed);
  EXPECT_EQ(record(mug).named_by, NamedBy::person);
  EXPECT_TRUE(takeBack(naming));
  EXPECT_EQ(record(mug).name, "Obj_1");
  EXPECT_FALSE(record(mug).confirmed);
  EXPECT_EQ(record(mug).named_by, NamedBy::program);
  EXPECT_FALSE(takeBack(naming)) << "there is nothing more to take back";
}

TEST_F(NamedByPerson, OneAfterTheOtherIsTakenBackOneAfterTheOther) {
  const ObjectId mug = add(1);
  const ObjectNaming first = name(mug, "mug"), second = name(mug, "cup");
  EXPECT_TRUE(takeBack(second));
  EXPECT_EQ(record(mug).name, "mug");
  EXPECT_TRUE(record(mug).confirmed);
  EXPECT_TRUE(takeBack(first));
  EXPECT_EQ(record(mug).name, "Obj_1");
}

TEST_F(NamedByPerson, WhatSomebodySaidSinceStays) {
  const ObjectId mug = add(1);
  const ObjectNaming naming = name(mug, "mug");
  ASSERT_TRUE(database_->rename(mug, "jug"));
  EXPECT_FALSE(takeBack(naming));
  EXPECT_EQ(record(mug).name, "jug");
  EXPECT_TRUE(record(mug).confirmed);
}

TEST_F(NamedByPerson, AnotherOfThatNameGetsTheViews) {
  const ObjectId mug = add(1), found = add(2);
  ASSERT_TRUE(database_->rename(mug, "mug"));
  const ObjectNaming naming = name(found, "mug");
  EXPECT_EQ(naming.object, mug);
  ASSERT_TRUE(naming.merge);
  EXPECT_EQ(database_->objects()->size(), 1U);
  EXPECT_EQ(record(mug).views, 2);
  EXPECT_TRUE(record(mug).confirmed);
  EXPECT_EQ(*database_->mergeRoot(found), mug);
  EXPECT_TRUE(takeBack(naming));
  EXPECT_EQ(record(mug).views, 1);
  EXPECT_FALSE(record(mug).confirmed) << "as it was";
  EXPECT_EQ(record(mug).name, "mug");
  EXPECT_EQ(record(found).name, "Obj_2");
}

TEST_F(NamedByPerson, TheOneOfThatNameHoldsBothWhateverTheOtherHas) {
  const ObjectId first = add(1), second = add(2);
  ObjectView more = randomView(3);
  more.object = second;
  ASSERT_TRUE(database_->addView(more));
  EXPECT_EQ(name(second, "Obj_1").object, first) << "a person may type a generated name";
  EXPECT_EQ(record(first).views, 3);
}

TEST_F(NamedByPerson, TwoOfWhichPersonsSaidWhatTheyAreStayTwo) {
  const ObjectId mug = add(1), cup = add(2);
  name(mug, "mug");
  name(cup, "cup");
  EXPECT_FALSE(name(cup, "mug").object);
  EXPECT_EQ(record(cup).name, "cup");
  EXPECT_EQ(database_->objects()->size(), 2U);
}

TEST_F(NamedByPerson, WhatIsNoNameOrNoObjectIsSaid) {
  const ObjectId mug = add(1);
  EXPECT_THAT(database_->nameByUser(mug, "12").error().message(), HasSubstr("number alone"));
  EXPECT_FALSE(checkedLabelName(" \t"));
  EXPECT_EQ(*checkedLabelName(" a mug "), "a mug");
  ASSERT_TRUE(database_->remove(std::array{mug}));
  EXPECT_THAT(database_->nameByUser(mug, "mug").error().message(), HasSubstr("deleted"));
}

TEST_F(NamedByPerson, SessionsKnowTheirCamera) {
  const Intrinsics K{500, 501, 320, 240, 640, 480};
  const std::int64_t with = *database_->sessions().begin("desk", K),
                     without = *database_->sessions().begin("desk");
  const auto cameras = database_->sessions().cameras();
  ASSERT_TRUE(cameras);
  EXPECT_EQ(cameras->at(with), K);
  EXPECT_FALSE(cameras->contains(without));
}

class ReadCatalogue : public NamedByPerson {
 protected:
  std::vector<std::string> filesThere() const {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      files.push_back(entry.path().filename().string());
    std::ranges::sort(files);
    return files;
  }
};

TEST_F(ReadCatalogue, IsNotChangedAndNothingIsLeftBesideIt) {
  const ObjectId mug = add(1);
  database_.reset();
  const auto before = std::filesystem::last_write_time(file());
  const auto files = filesThere();
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
  EXPECT_EQ(filesThere(), files);
}

TEST_F(ReadCatalogue, ShowsWhatAnotherProgramHasJustWritten) {
  add(1);  // in the log, not in the file
  const auto reader = ObjectDatabase::openToRead(file());
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_EQ((*reader)->objects()->size(), 1U);
  add(2);
  EXPECT_EQ((*reader)->objects()->size(), 2U);
}

TEST_F(ReadCatalogue, SaysWhenSomebodyBeganToWrite) {
  add(1);
  database_.reset();
  const auto reader = ObjectDatabase::openToRead(file());
  ASSERT_TRUE(reader);
  EXPECT_TRUE((*reader)->isStill());
  database_ = openOrFail(file());
  add(2);
  EXPECT_FALSE((*reader)->isStill());
}

TEST_F(ReadCatalogue, OfAnOlderVersionHasNoCameras) {
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

TEST_F(ReadCatalogue, ThatIsNoneIsSaid) {
  EXPECT_THAT(ObjectDatabase::openToRead(file("none.sqlite")).error().message(),
              AllOf(HasSubstr("no database"), HasSubstr("none.sqlite")));
  EXPECT_FALSE(std::filesystem::exists(file("none.sqlite"))) << "none is made";
  EXPECT_THAT(ObjectDatabase::openToRead(folder_.string()).error().message(), HasSubstr("is a folder"));
  { std::ofstream(file("empty.sqlite")); }
  EXPECT_THAT(ObjectDatabase::openToRead(file("empty.sqlite")).error().message(), HasSubstr("empty"));
}

TEST_F(ReadCatalogue, HasAnyNameThatAFileMayHave) {
  add(1);
  database_.reset();
  const std::string odd = file("what? #100% \xC3\xA4.sqlite");
  std::filesystem::rename(file(), odd);
  const auto reader = ObjectDatabase::openToRead(odd);
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_EQ((*reader)->objects()->size(), 1U);
}

}  // namespace
}  // namespace scantrove
