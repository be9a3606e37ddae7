#include "core/session/session_joining.h"

#include <gmock/gmock.h>

namespace scantrove {
namespace {

using Objects = std::map<RegionId, ObjectId>;

constexpr RegionId kInto{3}, kFrom{5}, kLast{6};

RegionEvents joinOf(std::initializer_list<RegionId> from) {
  RegionEvents events;
  for (const RegionId region : from) events.joined.emplace_back(kInto, region);
  return events;
}

TEST(JoinObjects, MovesTheObject_WhenTheOtherRegionHasNone) {
  Objects objects{{kFrom, ObjectId{7}}};
  const JoinedObjects joined = joinObjects(joinOf({kFrom}), objects);
  EXPECT_EQ(objects[kInto], ObjectId{7});
  EXPECT_EQ(objects[kFrom], ObjectId{});
  EXPECT_EQ(joined.state, JoinedObjects::State::done);
  EXPECT_EQ(joined.before, (Objects{{kInto, {}}, {kFrom, ObjectId{7}}}));
}

TEST(JoinObjects, RequestsAMerge_WhenBothRegionsHaveObjects) {
  Objects objects{{kFrom, ObjectId{7}}, {kLast, ObjectId{9}}};
  const JoinedObjects joined = joinObjects(joinOf({kFrom, kLast}), objects);
  EXPECT_EQ(objects[kInto], ObjectId{7});
  EXPECT_EQ(joined.state, JoinedObjects::State::to_merge);
  EXPECT_EQ(joined.pairs, (std::vector{std::pair(ObjectId{7}, ObjectId{9})}));
}

TEST(JoinObjects, StoresNothing_WhenNoRegionHasAnObject) {
  Objects objects;
  EXPECT_EQ(joinedToText(joinObjects(joinOf({kFrom}), objects)), "");
}

TEST(JoinObjects, GivesEachJoinItsOwnToken) {
  Objects objects{{kFrom, ObjectId{7}}, {kLast, ObjectId{9}}};
  const JoinedObjects first = joinObjects(joinOf({kFrom}), objects);
  const JoinedObjects second = joinObjects(joinOf({kLast}), objects);
  EXPECT_FALSE(first.token.empty());
  EXPECT_NE(first.token, second.token);
}

TEST(LastOperation, IsTheLastDoneOrUndoneOne) {
  OperationLog log;
  EXPECT_EQ(lastOperation(log, false), 0);
  EXPECT_EQ(lastOperation(log, true), 0);
  for (int i = 0; i < 3; ++i) log.add({}, {});
  EXPECT_EQ(lastOperation(log, false), 3);
  ASSERT_TRUE(log.undo());
  ASSERT_TRUE(log.undo());
  EXPECT_EQ(lastOperation(log, false), 1);
  EXPECT_EQ(lastOperation(log, true), 2) << "the next one to redo";
}

TEST(JoinedObjects, ReadBackEqual_FromText) {
  JoinedObjects joined;
  joined.state = JoinedObjects::State::to_unmerge;
  joined.token = "0123";
  joined.before = {{kInto, ObjectId{1}}, {kFrom, ObjectId{7}}};
  joined.pairs = {{ObjectId{1}, ObjectId{9}}};
  const Reclassified taken{ObjectId{1}, {}, {ClassId{4}, {{"material", "wood"}}}};
  joined.merges = {{ObjectId{1}, {ObjectId{7}}, true, taken}};
  const JoinedObjects read = joinedFrom(joinedToText(joined));
  EXPECT_EQ(read.state, joined.state);
  EXPECT_EQ(read.token, "0123");
  EXPECT_EQ(read.before, joined.before);
  EXPECT_EQ(read.pairs, joined.pairs);
  ASSERT_EQ(read.merges.size(), 1U);
  EXPECT_EQ(read.merges[0].from, joined.merges[0].from);
  EXPECT_TRUE(read.merges[0].has_confirmed);
  EXPECT_EQ(read.merges[0].reclassified, taken);
  for (const char* text : {"", "{", "[]", R"({"state": "x", "before": {"a": 1}})", R"({"before": 3})"})
    EXPECT_TRUE(joinedFrom(text).before.empty()) << text;
}

}  // namespace
}  // namespace scantrove
