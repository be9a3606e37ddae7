// Users name regions, or mark them as objects.
#include <gmock/gmock.h>

#include <array>

#include "tests/pipeline/collection/object_collector_fixture.h"
#include "tests/support/other_program.h"

namespace scantrove {
namespace {

using test::OtherProgram;
using test::TableItem;
using testing::AllOf;
using testing::HasSubstr;

class UserRequestsTest : public test::ObjectCollectorFixture {
 protected:
  /// Reports a region's new name, as the pipeline does.
  void name(const TableItem& item, const std::string& name) {
    collector_->requests().name(item.region, {name});
    collector_->requests().request(item.region, {name});
  }
  /// Reports that the region lost its name.
  void unname(const TableItem& item, const std::string& name) {
    collector_->requests().undoName(item.region, name);
    collector_->requests().cancel(item.region);
  }
  static Candidate part(const TableItem& item) {
    Candidate candidate = item.candidate();
    candidate.is_complete = false;
    candidate.outline = 0.2F;
    return candidate;
  }
  ObjectRecord record(ObjectId id) {
    const Result<ObjectRecord> record = person_->object(id);
    EXPECT_TRUE(record) << record.error().message();
    return record.value_or(ObjectRecord{});
  }
};

TEST_F(UserRequestsTest, ObjectIsNamed_UntilTheNameIsUndone) {
  const ObjectId mug = showFrames({mug_, box_}).added.at(0).id;
  name(mug_, "blue mug");
  const FrameObjects seen = showFrame({mug_, box_});
  EXPECT_EQ(seen.seen[0].name, "blue mug");
  EXPECT_TRUE(seen.seen[0].confirmed);
  EXPECT_EQ(record(mug).name, "blue mug");
  EXPECT_TRUE(record(mug).confirmed);
  unname(mug_, "blue mug");
  EXPECT_EQ(showFrame({mug_, box_}).seen[0].name, "Obj_1");
  EXPECT_EQ(record(mug).name, "Obj_1");
  EXPECT_FALSE(record(mug).confirmed);
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(UserRequestsTest, ObjectHasTheGivenClass_UntilTheNameIsUndone) {
  const ObjectId mug = showFrames({mug_, box_}).added.at(0).id;
  collector_->requests().name(mug_.region, {"red mug", "mug"});
  static_cast<void>(showFrame({mug_, box_}));
  EXPECT_EQ(collector_->objects().describe(mug_.region).class_name, "mug");
  EXPECT_EQ(record(mug).classification.class_id, ClassId{1});
  collector_->requests().undoName(mug_.region, "red mug");
  static_cast<void>(showFrame({mug_, box_}));
  EXPECT_EQ(collector_->objects().describe(mug_.region).class_name, "");
  EXPECT_EQ(record(mug).classification, Classification{});
}

TEST_F(UserRequestsTest, ClassHasTheIdOfTheCatalogue_WhenOthersAddedOneMeanwhile) {
  const ObjectId mug = showFrames({mug_, box_}).added.at(0).id;
  ASSERT_TRUE(person_->classes().add({.name = "table"}));
  collector_->requests().name(mug_.region, {"red mug", "mug"});
  static_cast<void>(showFrame({mug_, box_}));
  const RegionObject described = collector_->objects().describe(mug_.region);
  EXPECT_EQ(described.class_name, "mug");
  EXPECT_EQ(described.class_id, ClassId{2});
  EXPECT_EQ(record(mug).classification.class_id, ClassId{2});
}

TEST_F(UserRequestsTest, ObjectIsNamedWithoutAClass_WhenThatIsNotValid) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  collector_->requests().name(mug_.region, {"mug", "12"});
  const FrameObjects seen = showFrame({mug_});
  EXPECT_EQ(record(mug).name, "mug");
  EXPECT_FALSE(record(mug).classification.class_id);
  ASSERT_TRUE(seen.catalogue_failure);
  EXPECT_THAT(seen.catalogue_failure->what, HasSubstr("number alone"));
}

TEST_F(UserRequestsTest, UndoKeepsAnotherName_GivenSince) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  name(mug_, "mug");
  settle();
  ASSERT_TRUE(person_->rename(mug, "jug"));
  unname(mug_, "mug");
  static_cast<void>(showFrame({mug_}));
  EXPECT_EQ(record(mug).name, "jug");
}

TEST_F(UserRequestsTest, RedoKeepsAnotherName_WhenOthersMergedTheObject) {
  const FrameObjects found = showFrames({mug_, box_});
  const ObjectId mug = found.added.at(0).id, box = found.added.at(1).id;
  name(box_, "cup");
  settle();
  ASSERT_TRUE(person_->rename(mug, "mug"));
  ASSERT_TRUE(person_->setConfirmed(std::array{mug}, true));
  ASSERT_TRUE(person_->merge(std::array{mug, box}));
  ASSERT_EQ(person_->mergeRoot(box).value_or(ObjectId{}), mug);
  static_cast<void>(showFrame({mug_, box_}));
  unname(box_, "cup");
  static_cast<void>(showFrame({mug_, box_}));
  EXPECT_EQ(record(mug).name, "mug");
  collector_->requests().redoName(box_.region, {"cup"});
  EXPECT_EQ(showFrame({mug_, box_}).seen[1].name, "mug");
  EXPECT_EQ(record(mug).name, "mug") << "the object merged by others keeps its name";
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(UserRequestsTest, NamedRegionBecomesAnObject_WhenItIsSeenInPart) {
  name(mug_, "mug");
  for (int frame = 0; frame < 5; ++frame) EXPECT_TRUE(showFrame({}).added.empty());
  const FrameObjects seen = showCandidates({part(mug_)}, {mug_});
  ASSERT_EQ(seen.added.size(), 1U);
  EXPECT_EQ(seen.seen[0].name, "mug");
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].name, "mug");
  EXPECT_TRUE(objects()[0].confirmed);
  EXPECT_TRUE(collector_->requests().pending().empty());
  EXPECT_EQ(collector_->objects().idOf(mug_.region), objects()[0].id);
}

TEST_F(UserRequestsTest, RequestFollowsItsRegion_WhenThatIsJoined) {
  name(mug_, "mug");
  collector_->joinRegions(box_.region, mug_.region);
  static_cast<void>(showCandidates({part(box_)}, {box_}));
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].name, "mug");
}

TEST_F(UserRequestsTest, NothingIsAdded_WhenTheRequestIsCancelled) {
  name(mug_, "mug");
  collector_->requests().cancel(mug_.region);
  for (int frame = 0; frame < 3; ++frame) static_cast<void>(showCandidates({part(mug_)}, {mug_}));
  EXPECT_TRUE(objects().empty());
}

TEST_F(UserRequestsTest, RegionJoinsTheObjectOfThatName) {
  static_cast<void>(showFrames({mug_}));
  name(mug_, "mug");
  static_cast<void>(showFrame({mug_}));
  // Another appearance in a later scan, which is not recognised.
  beginScan();
  const TableItem again{7, 1, RegionId{44}};
  name(again, "mug");
  const FrameObjects seen = showFrame({again});
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].name, "mug");
  EXPECT_EQ(objects()[0].views, 2);
  EXPECT_EQ(collector_->objects().idOf(again.region), objects()[0].id);
  EXPECT_EQ(seen.seen[0].object, objects()[0].id);
  unname(again, "mug");
  static_cast<void>(showFrame({again}));
  EXPECT_EQ(objects().size(), 1U) << "the object made for the name is removed";
  EXPECT_EQ(record(objects()[0].id).views, 1);
  static_cast<void>(showFrames({again}));
  EXPECT_EQ(objects().size(), 2U) << "frames found it without a request";
}

TEST_F(UserRequestsTest, UndoRemovesOnlyObjects_MadeForTheName) {
  const ObjectId box = showFrames({box_}).added.at(0).id;
  name(box_, "box");
  name(mug_, "mug");
  static_cast<void>(showCandidates({part(mug_), box_.candidate()}, {mug_, box_}));
  ASSERT_EQ(objects().size(), 2U);
  unname(mug_, "mug");
  unname(box_, "box");
  static_cast<void>(showFrame({}));
  ASSERT_EQ(objects().size(), 1U) << "the box is an object of the scan";
  EXPECT_EQ(objects()[0].id, box);
  EXPECT_FALSE(collector_->objects().idOf(mug_.region));
  static_cast<void>(showFrames({mug_}));
  EXPECT_EQ(objects().size(), 2U) << "frames found it without a request";
}

TEST_F(UserRequestsTest, UndoRemovesTheObject_MadeForTheRequest) {
  collector_->requests().request(mug_.region, {""});
  static_cast<void>(showCandidates({part(mug_)}, {mug_}));
  ASSERT_EQ(objects().size(), 1U);
  ASSERT_EQ(collector_->requests().storedNamings().at(mug_.region).at(0).made, objects()[0].id);
  collector_->requests().undoObject(mug_.region);
  static_cast<void>(showFrame({}));
  EXPECT_TRUE(objects().empty());
}

TEST_F(UserRequestsTest, NamingsOfAnEarlierScanAreUndone) {
  name(mug_, "mug");
  static_cast<void>(showCandidates({part(mug_)}, {mug_}));
  collector_->requests().request(box_.region, {""});
  static_cast<void>(showCandidates({part(box_)}, {box_}));
  ASSERT_EQ(objects().size(), 2U);
  std::map<RegionId, ObjectId> bound;
  for (const TableItem& item : {mug_, box_}) bound[item.region] = collector_->objects().idOf(item.region);
  const auto stored = collector_->requests().storedNamings();
  settle();
  beginScan();
  for (const auto& [region, namings] : stored) {
    collector_->bind(region, bound.at(region));
    collector_->requests().restoreNamings(region, namings);
  }
  EXPECT_EQ(collector_->requests().storedNamings().size(), 2U) << "they stay stored";
  unname(mug_, "mug");
  collector_->requests().undoObject(box_.region);
  static_cast<void>(showFrame({}));
  EXPECT_TRUE(objects().empty());
  EXPECT_TRUE(collector_->requests().storedNamings().empty());
}

TEST_F(UserRequestsTest, NamingsOfAnotherCatalogueAreNotUndone) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  name(mug_, "mug");
  settle();
  beginScan();
  StoredNaming foreign;
  foreign.naming = {ObjectId{99}, "mug", "Obj_9"};
  foreign.made = ObjectId{99};
  collector_->requests().restoreNamings(mug_.region, {foreign});
  EXPECT_TRUE(collector_->requests().storedNamings().empty());
  unname(mug_, "mug");
  static_cast<void>(showFrame({}));
  EXPECT_EQ(record(mug).name, "mug");
}

TEST_F(UserRequestsTest, ObjectIsMerged_WhenAnotherHasItsName) {
  const FrameObjects first = showFrames({mug_, box_});
  const ObjectId mug = first.added.at(0).id, box = first.added.at(1).id;
  name(mug_, "item");
  name(box_, "item");
  const FrameObjects seen = showFrame({mug_, box_});
  EXPECT_EQ(seen.seen[0].object, mug);
  EXPECT_EQ(seen.seen[1].object, mug);
  EXPECT_EQ(objects().size(), 1U);
  unname(box_, "item");
  EXPECT_EQ(showFrame({mug_, box_}).seen[1].object, box);
  EXPECT_EQ(record(mug).name, "item");
  EXPECT_EQ(record(box).name, "Obj_2");
}

TEST_F(UserRequestsTest, RegionBecomesAnObjectOfItsOwn_WhenItsObjectHasAnotherName) {
  Candidate both = mug_.candidate();
  both.regions = {mug_.region, box_.region};
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(showCandidates({both}, {mug_}));
  ASSERT_EQ(objects().size(), 1U);
  name(mug_, "mug");
  static_cast<void>(showFrame({mug_, box_}));
  name(box_, "handle");
  static_cast<void>(showFrame({mug_, box_}));
  ASSERT_EQ(objects().size(), 2U);
  EXPECT_EQ(objects()[0].name, "mug");
  EXPECT_EQ(objects()[1].name, "handle");
  EXPECT_EQ(collector_->objects().idOf(box_.region), objects()[1].id);
}

TEST_F(UserRequestsTest, RegionChangesItsObject_WhenUsersNamedBoth) {
  const FrameObjects first = showFrames({mug_, box_});
  name(mug_, "mug");
  name(box_, "box");
  static_cast<void>(showFrame({mug_, box_}));
  name(box_, "mug");  // the region was not the box
  for (int frame = 0; frame < 3; ++frame) static_cast<void>(showFrame({mug_, box_}));
  EXPECT_EQ(record(first.added.at(1).id).name, "box") << "an object is added nevertheless";
  EXPECT_EQ(collector_->objects().idOf(box_.region), first.added.at(0).id);
  collector_->requests().undoName(box_.region, "mug");
  static_cast<void>(showFrame({mug_, box_}));
  EXPECT_EQ(collector_->objects().idOf(box_.region), first.added.at(1).id);
}

TEST_F(UserRequestsTest, NameMakesANewObject_WhenTheOldOneWasDeleted) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  ASSERT_TRUE(person_->remove(std::array{mug}));
  static_cast<void>(showFrame({mug_}));
  name(mug_, "mug");
  static_cast<void>(showFrame({mug_}));
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_NE(objects()[0].id, mug);
  EXPECT_EQ(objects()[0].name, "mug");
}

TEST_F(UserRequestsTest, RefusedNameIsReportedOnce) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  name(mug_, "12");
  const FrameObjects seen = showFrame({mug_});
  ASSERT_TRUE(seen.catalogue_failure);
  EXPECT_THAT(seen.catalogue_failure->message(), HasSubstr("'12'"));
  EXPECT_FALSE(showFrame({mug_}).catalogue_failure);
  EXPECT_EQ(record(mug).name, "Obj_1");
}

TEST_F(UserRequestsTest, NamesHold_WhileTheCatalogueIsLocked) {
  static_cast<void>(showFrames({mug_, box_}));
  waits_ = false;
  {
    OtherProgram other(file());
    other.execute("BEGIN IMMEDIATE");
    name(mug_, "mug");
    name(cup_, "cup");
    FrameObjects seen = showFrame({mug_, box_, cup_});
    EXPECT_EQ(seen.seen[0].name, "mug") << "the name shows at once";
    collector_->joinRegions(mug_.region, box_.region);
    seen = showFrame({mug_, cup_});
    other.execute("ROLLBACK");
  }
  settle();
  waits_ = true;
  static_cast<void>(showFrame({mug_, cup_}));
  ASSERT_EQ(objects().size(), 2U);
  EXPECT_EQ(objects()[0].name, "mug");
  EXPECT_EQ(objects()[0].views, 2) << "with the views of the box";
  EXPECT_EQ(objects()[1].name, "cup");
  EXPECT_TRUE(objects()[1].confirmed);
}

TEST_F(UserRequestsTest, FinishReportsNames_ThatAreNotStored) {
  writer_.patience = std::chrono::milliseconds(100);
  beginScan();
  static_cast<void>(showFrames({mug_}));
  OtherProgram other(file());
  waits_ = false;
  other.execute("BEGIN IMMEDIATE");
  name(mug_, "mug");
  const Result<void> finished = collector_->finish([](const FrameObjects&) {});
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().message(), AllOf(HasSubstr("1 name"), HasSubstr("locked")));
  other.execute("ROLLBACK");
}

TEST_F(UserRequestsTest, NamingsAreStoredInTheSession) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  name(mug_, "mug");
  static_cast<void>(showFrame({mug_}));
  const auto stored = collector_->requests().storedNamings();
  ASSERT_EQ(stored.size(), 1U);
  const StoredNaming& naming = stored.at(mug_.region).at(0);
  EXPECT_EQ(naming.naming.object, mug);
  EXPECT_EQ(naming.naming.earlier_name, "Obj_1");
  const std::vector<StoredNaming> read = namingsFromJson(namingsToJson({naming}));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].naming.name, "mug");
  EXPECT_EQ(read[0].earlier, mug);
  EXPECT_TRUE(namingsFromJson("[{]").empty());
}

TEST_F(UserRequestsTest, RegionIsFixed_WhenAUserEditedOrDeletedItsObject) {
  const RegionId deleted{77}, unknown{999};
  static_cast<void>(showFrames({mug_, box_, TableItem{33, 2, deleted}}));
  ASSERT_TRUE(person_->rename(collector_->objects().idOf(box_.region), "my box"));
  ASSERT_TRUE(person_->remove(std::array{collector_->objects().idOf(deleted)}));
  settle();
  static_cast<void>(collector_->applyCatalogueChanges());
  EXPECT_TRUE(collector_->requests().isFixed(box_.region));
  EXPECT_TRUE(collector_->requests().isFixed(deleted))
      << "its regions stay bound, so its parts are not added again";
  EXPECT_FALSE(collector_->requests().isFixed(mug_.region));
  EXPECT_FALSE(collector_->requests().isFixed(unknown));
}

}  // namespace
}  // namespace scantrove
