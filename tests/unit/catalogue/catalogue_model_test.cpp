#include "core/catalogue/catalogue_model.h"

#include <gmock/gmock.h>

#include <array>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = CatalogueChange::Kind;

constexpr ObjectId kOld{1}, kMiddle{2}, kNew{3};

class CatalogueModelTest : public testing::Test {
 protected:
  CatalogueModelTest() {
    for (const ObjectId id : {kOld, kMiddle, kNew}) model_.put({id, "Obj_" + std::to_string(id.value)});
  }
  [[nodiscard]] ObjectState state(ObjectId id) const { return model_.known(id).value(); }
  [[nodiscard]] std::vector<Kind> changes() {
    std::vector<Kind> kinds;
    for (const CatalogueChange& change : model_.takeChanges()) kinds.push_back(change.kind);
    return kinds;
  }
  void settle(ObjectId id, const std::string& name) { ASSERT_TRUE(model_.rename(id, name, NamedBy::user)); }
  ObjectMerge merge(ObjectId a, ObjectId b) { return model_.merge(std::array{a, b}).value(); }

  CatalogueModel model_{"the file"};
};

// Lookup.

TEST_F(CatalogueModelTest, Known_NamesTheFile_WhenTheObjectIsUnknown) {
  EXPECT_THAT(model_.known(ObjectId{9}).error().what, HasSubstr("the file holds no object 9"));
}

TEST_F(CatalogueModelTest, Shown_SaysMergedOrDeleted_WhenTheObjectIsHidden) {
  merge(kOld, kMiddle);
  ASSERT_TRUE(model_.remove(std::array{kNew}));
  EXPECT_THAT(model_.shown(kMiddle).error().what, HasSubstr("merged into object 1"));
  EXPECT_THAT(model_.shown(kNew).error().what, HasSubstr("was deleted"));
}

TEST_F(CatalogueModelTest, MergeRoot_FollowsMergesOfMerges) {
  settle(kNew, "mug");
  merge(kOld, kMiddle);
  merge(kOld, kNew);
  for (const ObjectId id : {kOld, kMiddle, kNew}) EXPECT_EQ(model_.mergeRoot(id), kNew);
}

TEST_F(CatalogueModelTest, MergeRoot_IsNone_WhenTheRootIsDeletedOrMergesAreCyclic) {
  merge(kOld, kMiddle);
  ASSERT_TRUE(model_.remove(std::array{kOld}));
  EXPECT_FALSE(model_.mergeRoot(kMiddle));
  EXPECT_EQ(model_.viewOwner(kMiddle), kOld);
  model_.put({kOld, "Obj_1", NamedBy::program, false, true, kMiddle});
  EXPECT_FALSE(model_.mergeRoot(kOld));
  EXPECT_FALSE(model_.mergeRoot(ObjectId{9}));
}

// Names and marks.

TEST_F(CatalogueModelTest, Rename_DropsBlanksAndIsOneChange) {
  settle(kOld, "  blue mug ");
  EXPECT_EQ(state(kOld).name, "blue mug");
  EXPECT_EQ(state(kOld).named_by, NamedBy::user);
  EXPECT_FALSE(state(kOld).confirmed);
  EXPECT_THAT(changes(), ElementsAre(Kind::renamed));
  settle(kOld, "blue mug");
  EXPECT_THAT(changes(), IsEmpty()) << "it has that name already";
}

TEST_F(CatalogueModelTest, Rename_Fails_WhenAnotherVisibleObjectHasTheName) {
  EXPECT_THAT(model_.rename(kOld, "Obj_2", NamedBy::user).error().what, HasSubstr("is called Obj_2"));
  ASSERT_TRUE(model_.remove(std::array{kMiddle}));
  EXPECT_TRUE(model_.rename(kOld, "Obj_2", NamedBy::user));
}

TEST_F(CatalogueModelTest, SetConfirmed_ChangesNothing_WhenOneIsHidden) {
  ASSERT_TRUE(model_.remove(std::array{kNew}));
  static_cast<void>(changes());
  EXPECT_FALSE(model_.setConfirmed(std::array{kOld, kNew}, true));
  EXPECT_FALSE(state(kOld).confirmed);
  EXPECT_THAT(changes(), IsEmpty());
}

// Naming by a user.

TEST_F(CatalogueModelTest, NameByUser_ConfirmsTheMergeRoot) {
  merge(kOld, kMiddle);
  const ObjectNaming naming = model_.nameByUser(kMiddle, "mug").value();
  EXPECT_EQ(naming.object, kOld);
  EXPECT_EQ(state(kOld).name, "mug");
  EXPECT_TRUE(state(kOld).confirmed);
  EXPECT_EQ(model_.revertNaming(naming), true);
  EXPECT_EQ(state(kOld), (ObjectState{kOld, "Obj_1"}));
}

TEST_F(CatalogueModelTest, NameByUser_MergesIntoTheObjectOfThatName) {
  settle(kNew, "mug");
  const ObjectNaming naming = model_.nameByUser(kOld, "mug").value();
  EXPECT_EQ(naming.object, kNew);
  EXPECT_EQ(model_.mergeRoot(kOld), kNew) << "although the other is older";
  EXPECT_TRUE(model_.revertNaming(naming).value());
  EXPECT_EQ(model_.mergeRoot(kOld), kOld);
  EXPECT_FALSE(state(kNew).confirmed);
  EXPECT_EQ(state(kNew).name, "mug") << "as it was before";
}

TEST_F(CatalogueModelTest, NameByUser_DoesNothing_WhenASettledObjectGetsTheNameOfAnother) {
  settle(kOld, "cup");
  settle(kNew, "mug");
  static_cast<void>(changes());
  EXPECT_FALSE(model_.nameByUser(kOld, "mug").value().object);
  EXPECT_THAT(changes(), IsEmpty());
}

TEST_F(CatalogueModelTest, RevertNaming_KeepsLaterUserNames) {
  const ObjectNaming naming = model_.nameByUser(kOld, "mug").value();
  settle(kOld, "jug");
  EXPECT_FALSE(model_.revertNaming(naming).value());
  EXPECT_EQ(state(kOld).name, "jug");
}

TEST_F(CatalogueModelTest, RevertNaming_LeavesTheName_WhenTheEarlierOneIsTaken) {
  const ObjectNaming naming = model_.nameByUser(kOld, "mug").value();
  settle(kNew, "Obj_1");
  EXPECT_FALSE(model_.revertNaming(naming).value());
  EXPECT_EQ(state(kOld).name, "mug");
}

// Merging.

TEST_F(CatalogueModelTest, Merge_PrefersNamedThenConfirmedThenOldestAsRoot) {
  EXPECT_EQ(merge(kMiddle, kOld).into, kOld);
  ASSERT_TRUE(model_.setConfirmed(std::array{kNew}, true));
  EXPECT_EQ(merge(kOld, kNew).into, kNew);
  model_.put({ObjectId{4}, "mug", NamedBy::user});
  const ObjectMerge last = merge(kNew, ObjectId{4});
  EXPECT_EQ(last.into, ObjectId{4});
  EXPECT_TRUE(last.has_confirmed);
  EXPECT_TRUE(state(ObjectId{4}).confirmed) << "the confirmation is kept";
}

TEST_F(CatalogueModelTest, Merge_Fails_WithItselfAndWithHiddenOnes) {
  EXPECT_FALSE(model_.merge(std::array{kOld, kOld}));
  ASSERT_TRUE(model_.remove(std::array{kNew}));
  static_cast<void>(changes());
  EXPECT_FALSE(model_.merge(std::array{kOld, kMiddle, kNew}));
  EXPECT_THAT(changes(), IsEmpty());
}

TEST_F(CatalogueModelTest, Unmerge_IsTheInverse) {
  ASSERT_TRUE(model_.setConfirmed(std::array{kMiddle}, true));
  settle(kNew, "mug");
  const std::map<ObjectId, ObjectState> before = model_.objects();
  const ObjectMerge all = model_.merge(std::array{kOld, kMiddle, kNew}).value();
  static_cast<void>(changes());
  ASSERT_TRUE(model_.unmerge(all));
  EXPECT_EQ(model_.objects(), before);
  EXPECT_THAT(changes(), ElementsAre(Kind::unmerged, Kind::unmerged, Kind::unconfirmed));
  EXPECT_FALSE(model_.unmerge(all)) << "once";
}

TEST_F(CatalogueModelTest, Unmerge_NumbersTheName_WhenItIsTaken) {
  const ObjectMerge pair = merge(kOld, kMiddle);
  settle(kNew, "Obj_2");
  ASSERT_TRUE(model_.unmerge(pair));
  EXPECT_EQ(state(kMiddle).name, "Obj_2 (2)");
}

TEST_F(CatalogueModelTest, Unmerge_RemovesTheViewsFromTheRootOfTheTarget) {
  const ObjectMerge inner = merge(kMiddle, kNew);
  merge(kOld, kMiddle);
  static_cast<void>(model_.takeChanges());
  ASSERT_TRUE(model_.unmerge(inner));
  const std::vector<CatalogueChange> changes = model_.takeChanges();
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[1].kind, Kind::views_discarded);
  EXPECT_EQ(changes[1].object(), kOld);
  EXPECT_EQ(changes[1].part, kNew);
}

TEST_F(CatalogueModelTest, MayMerge_IsFalse_WhenBothAreSettledOrKeptApartOrHidden) {
  EXPECT_TRUE(model_.mayMerge(kOld, kNew));
  EXPECT_FALSE(model_.mayMerge(kOld, kOld));
  settle(kOld, "mug");
  EXPECT_TRUE(model_.mayMerge(kOld, kNew));
  ASSERT_TRUE(model_.setConfirmed(std::array{kNew}, true));
  EXPECT_FALSE(model_.mayMerge(kOld, kNew)) << "users named or confirmed both";
  EXPECT_TRUE(model_.mayMerge(kMiddle, kNew));
  model_.keepApart(kNew, kMiddle);
  EXPECT_FALSE(model_.mayMerge(kMiddle, kNew)) << "a user reverted that merge";
  ASSERT_TRUE(model_.remove(std::array{kMiddle}));
  EXPECT_FALSE(model_.mayMerge(kOld, kMiddle));
}

TEST_F(CatalogueModelTest, MayDiscardViews_IsFalse_WhenSettledOrHidden) {
  EXPECT_TRUE(model_.mayDiscardViews(kNew));
  settle(kOld, "mug");
  EXPECT_FALSE(model_.mayDiscardViews(kOld)) << "a user named it";
  ASSERT_TRUE(model_.setConfirmed(std::array{kMiddle}, true));
  EXPECT_FALSE(model_.mayDiscardViews(kMiddle)) << "a user confirmed it";
  ASSERT_TRUE(model_.remove(std::array{kNew}));
  EXPECT_FALSE(model_.mayDiscardViews(kNew));
  EXPECT_FALSE(model_.mayDiscardViews(ObjectId{9})) << "there is no such object";
}

// Deleting.

TEST_F(CatalogueModelTest, Restore_ShowsDeletedObjects_AndFailsForMergedOnes) {
  ASSERT_TRUE(model_.remove(std::array{kOld, kOld}));
  EXPECT_FALSE(model_.remove(std::array{kOld}));
  ASSERT_TRUE(model_.restore(std::array{kOld, kNew}));
  EXPECT_TRUE(model_.visible(kOld));
  EXPECT_THAT(changes(), ElementsAre(Kind::removed, Kind::restored));
  merge(kOld, kMiddle);
  EXPECT_FALSE(model_.restore(std::array{kMiddle}));
}

TEST_F(CatalogueModelTest, Withdraw_Fails_WhenSettledHiddenOrWithParts) {
  settle(kOld, "mug");
  EXPECT_FALSE(model_.withdraw(kOld).value());
  merge(kMiddle, kNew);
  EXPECT_FALSE(model_.withdraw(kMiddle).value());
  EXPECT_FALSE(model_.withdraw(kNew).value());
  model_.put({ObjectId{4}, "Obj_4"});
  EXPECT_TRUE(model_.withdraw(ObjectId{4}).value());
  EXPECT_FALSE(model_.withdraw(ObjectId{4}).value());
}

}  // namespace
}  // namespace scantrove
