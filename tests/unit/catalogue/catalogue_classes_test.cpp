// Classes in CatalogueModel: each rule, and how it is undone.
#include <gmock/gmock.h>

#include <array>

#include "core/catalogue/catalogue_model.h"

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using ChangeKind = CatalogueChange::Kind;

constexpr ObjectId kFirst{1}, kSecond{2};

class CatalogueClassesTest : public testing::Test {
 protected:
  CatalogueClassesTest() {
    for (const ObjectId id : {kFirst, kSecond}) model_.put({id, "Obj_" + std::to_string(id.value)});
  }
  ClassId add(const std::string& name) { return model_.addClass({.name = name}).value(); }
  [[nodiscard]] ObjectClass state(ClassId id) const { return *model_.classes().find(id); }
  [[nodiscard]] std::string classOf(ObjectId id) const {
    const ObjectClass* own = model_.classOf(model_.find(id)->classification);
    return own == nullptr ? "" : own->name;
  }
  std::vector<Reclassified> classify(ObjectId object, ClassId class_id) {
    return model_.classify(std::array{object}, class_id).value();
  }
  [[nodiscard]] std::vector<ChangeKind> changes() {
    std::vector<ChangeKind> kinds;
    for (const CatalogueChange& change : model_.takeChanges()) kinds.push_back(change.kind);
    return kinds;
  }

  CatalogueModel model_{"the file"};
};

TEST_F(CatalogueClassesTest, AddClass_GivesTheNextIdAndAColor) {
  EXPECT_EQ(add("  chair "), ClassId{1});
  EXPECT_EQ(add("table"), ClassId{2});
  EXPECT_EQ(state(ClassId{1}).name, "chair");
  EXPECT_EQ(state(ClassId{1}).color, defaultClassColor(ClassId{1}));
  EXPECT_NE(state(ClassId{1}).color, state(ClassId{2}).color);
  EXPECT_THAT(changes(), ElementsAre(ChangeKind::class_added, ChangeKind::class_added));
}

TEST_F(CatalogueClassesTest, AddClass_ContinuesAfterTheLargestId) {
  EXPECT_EQ(model_.addClass({.id = ClassId{90}, .name = "toothbrush"}).value(), ClassId{90});
  EXPECT_EQ(add("chair"), ClassId{91});
}

TEST_F(CatalogueClassesTest, AddClass_FindsAFreeId_WhenTheLargestIsTaken) {
  ASSERT_TRUE(model_.addClass({.id = ClassId{1}, .name = "one"}));
  ASSERT_TRUE(model_.addClass({.id = ClassId{kLargestClassId}, .name = "last"}));
  EXPECT_EQ(add("chair"), ClassId{2});
  EXPECT_EQ(add("table"), ClassId{3});
}

TEST_F(CatalogueClassesTest, AddClass_Fails_WhenNameOrIdAreTakenOrNotValid) {
  const ClassId chair = add("chair");
  static_cast<void>(changes());
  EXPECT_THAT(model_.addClass({.name = "chair"}).error().what, HasSubstr("1 (chair)"));
  EXPECT_THAT(model_.addClass({.id = chair, .name = "table"}).error().what, HasSubstr("the file"));
  for (const ClassDraft& draft :
       {ClassDraft{.name = ""}, ClassDraft{.name = "12"}, ClassDraft{.name = "a\nb"},
        ClassDraft{.id = ClassId{kLargestClassId + 1}, .name = "table"},
        ClassDraft{.name = "table", .attributes = {{{"a"}, {"a"}}}},
        ClassDraft{.name = "table", .attributes = {{{"a", AttributeKind::choice}}}},
        ClassDraft{.name = "table", .attributes = {{{"a", AttributeKind::choice, {"x", " x"}}}}},
        ClassDraft{.name = "table", .attributes = {{{"a", AttributeKind::text, {"x"}}}}}})
    EXPECT_FALSE(model_.addClass(draft)) << draft.name;
  EXPECT_THAT(changes(), IsEmpty());
}

TEST_F(CatalogueClassesTest, AddClass_RestoresTheHiddenClassOfThatName) {
  const ClassId chair = add("chair");
  ASSERT_TRUE(model_.hideClasses(std::array{chair}));
  EXPECT_EQ(model_.addClass({.name = "chair", .supercategory = "furniture"}).value(), chair)
      << "exports keep its id";
  EXPECT_FALSE(state(chair).hidden);
  EXPECT_EQ(state(chair).supercategory, "furniture");
}

TEST_F(CatalogueClassesTest, EditClass_ChangesWhatIsGiven_AndIsUndoneByTheClassBefore) {
  const ClassId chair = add("chair");
  const ClassDraft all{chair,
                       "seat",
                       ClassColor{1, 2, 3},
                       "furniture",
                       {{{"material", AttributeKind::choice, {"wood", "steel"}}}}};
  const ObjectClass before = model_.editClass(all).value();
  EXPECT_EQ(draftOf(state(chair)), all);
  ASSERT_TRUE(model_.editClass({.id = chair, .name = "stool"}));
  EXPECT_EQ(state(chair).supercategory, "furniture") << "not given";
  ASSERT_TRUE(model_.editClass(draftOf(before)));
  EXPECT_EQ(state(chair), before);
}

TEST_F(CatalogueClassesTest, EditClass_Fails_WhenAnotherClassHasTheName) {
  const ClassId chair = add("chair");
  add("table");
  static_cast<void>(changes());
  EXPECT_THAT(model_.editClass({.id = chair, .name = "table"}).error().what, HasSubstr("2 (table)"));
  EXPECT_THAT(model_.editClass({.id = ClassId{9}, .name = "x"}).error().what, HasSubstr("no class 9"));
  EXPECT_TRUE(model_.editClass({.id = chair, .name = "chair"}));
  EXPECT_THAT(changes(), IsEmpty());
}

TEST_F(CatalogueClassesTest, Classify_IsUndoneByTheEarlierClass) {
  const ClassId chair = add("chair"), table = add("table");
  static_cast<void>(classify(kFirst, chair));
  const std::vector<Reclassified> change = model_.classify(std::array{kFirst, kSecond}, table).value();
  EXPECT_EQ(change.size(), 2U);
  EXPECT_EQ(classOf(kFirst), "table");
  EXPECT_TRUE(model_.revertReclassified(change).value());
  EXPECT_EQ(classOf(kFirst), "chair");
  EXPECT_EQ(classOf(kSecond), "");
  EXPECT_THAT(classify(kFirst, chair), IsEmpty()) << "it has that class";
  EXPECT_EQ(classify(kFirst, {}).size(), 1U);
  EXPECT_EQ(classOf(kFirst), "");
}

TEST_F(CatalogueClassesTest, Classify_KeepsLaterClasses_WhenItIsUndone) {
  const ClassId chair = add("chair"), table = add("table");
  const std::vector<Reclassified> change = classify(kFirst, chair);
  static_cast<void>(classify(kFirst, table));
  EXPECT_FALSE(model_.revertReclassified(change).value());
  EXPECT_EQ(classOf(kFirst), "table");
}

TEST_F(CatalogueClassesTest, Classify_ChangesNothing_WhenAnObjectOrTheClassIsHidden) {
  const ClassId chair = add("chair"), unused = add("unused");
  ASSERT_TRUE(model_.hideClasses(std::array{unused}));
  ASSERT_TRUE(model_.remove(std::array{kSecond}));
  static_cast<void>(changes());
  EXPECT_FALSE(model_.classify(std::array{kFirst, kSecond}, chair));
  EXPECT_THAT(model_.classify(std::array{kFirst}, unused).error().what, HasSubstr("is hidden"));
  EXPECT_FALSE(model_.classify(std::array{kFirst}, ClassId{77}));
  EXPECT_THAT(changes(), IsEmpty());
}

TEST_F(CatalogueClassesTest, MergedClassesResolveToTheirRoot_UntilTheMergeIsUndone) {
  const ClassId chair = add("chair"), seat = add("seat"), stool = add("stool");
  static_cast<void>(classify(kFirst, stool));
  const ClassMerge first = model_.mergeClasses(std::array{stool}, seat).value();
  const ClassMerge second = model_.mergeClasses(std::array{seat}, chair).value();
  EXPECT_EQ(classOf(kFirst), "chair");
  EXPECT_TRUE(model_.isUsed(chair));
  EXPECT_EQ(model_.classes().named("stool"), nullptr);
  EXPECT_THAT(model_.classify(std::array{kSecond}, stool).error().what, HasSubstr("merged into class 2"));
  ASSERT_TRUE(model_.unmergeClasses(second));
  EXPECT_EQ(classOf(kFirst), "seat");
  ASSERT_TRUE(model_.unmergeClasses(first));
  EXPECT_EQ(classOf(kFirst), "stool");
  EXPECT_FALSE(model_.unmergeClasses(first));
}

TEST_F(CatalogueClassesTest, MergeClasses_ChangesNothing_WhenOneIsHiddenOrTheTarget) {
  const ClassId chair = add("chair"), seat = add("seat");
  ASSERT_TRUE(model_.hideClasses(std::array{seat}));
  static_cast<void>(changes());
  EXPECT_FALSE(model_.mergeClasses(std::array{seat}, chair));
  EXPECT_FALSE(model_.mergeClasses(std::array{chair}, seat));
  EXPECT_THAT(model_.mergeClasses(std::array{chair}, chair).error().what, HasSubstr("itself"));
  EXPECT_FALSE(model_.mergeClasses({}, chair));
  EXPECT_THAT(changes(), IsEmpty());
}

TEST_F(CatalogueClassesTest, UnmergedClassGetsANumber_WhenItsNameIsTaken) {
  const ClassId chair = add("chair"), seat = add("seat");
  const ClassMerge merge = model_.mergeClasses(std::array{seat}, chair).value();
  EXPECT_NE(add("seat"), seat) << "a merged class does not return";
  ASSERT_TRUE(model_.unmergeClasses(merge));
  EXPECT_EQ(state(seat).name, "seat (2)");
}

TEST_F(CatalogueClassesTest, MergedClassesLeaveTheirAttributesToTheRoot) {
  const ClassAttribute material{"material", AttributeKind::choice, {"wood"}}, note{"note"};
  const ClassId chair = model_.addClass({.name = "chair", .attributes = {{note}}}).value();
  const ClassId seat =
      model_.addClass({.name = "seat", .attributes = {{material, {"note", AttributeKind::yes_no}}}}).value();
  static_cast<void>(classify(kFirst, seat));
  ASSERT_TRUE(model_.answer(std::array{kFirst}, "material", "wood"));
  ASSERT_TRUE(model_.mergeClasses(std::array{seat}, chair));
  EXPECT_THAT(model_.classes().attributesOf(chair), ElementsAre(note, material));
  EXPECT_THAT(model_.answersOf(model_.find(kFirst)->classification),
              ElementsAre(testing::Pair("material", "wood")));
}

TEST_F(CatalogueClassesTest, HideClasses_Fails_WhileAnObjectHasTheClass) {
  const ClassId chair = add("chair"), seat = add("seat");
  static_cast<void>(classify(kFirst, seat));
  ASSERT_TRUE(model_.mergeClasses(std::array{seat}, chair));
  EXPECT_THAT(model_.hideClasses(std::array{chair}).error().what, HasSubstr("have the class chair"));
  ASSERT_TRUE(model_.remove(std::array{kFirst}));
  ASSERT_TRUE(model_.hideClasses(std::array{chair}));
  EXPECT_TRUE(state(chair).hidden);
  ASSERT_TRUE(model_.restoreClasses(std::array{chair}));
  EXPECT_FALSE(state(chair).hidden);
  EXPECT_FALSE(model_.restoreClasses(std::array{seat})) << "it is merged";
}

TEST_F(CatalogueClassesTest, Answer_TakesWhatTheClassAsks_AndIsUndone) {
  const ClassId chair = model_
                            .addClass({.name = "chair",
                                       .attributes = {{{"material", AttributeKind::choice, {"wood", "steel"}},
                                                       {"broken", AttributeKind::yes_no},
                                                       {"note"}}}})
                            .value();
  const std::array object{kFirst};
  EXPECT_THAT(model_.answer(object, "note", "x").error().what, HasSubstr("has no class"));
  static_cast<void>(classify(kFirst, chair));
  EXPECT_THAT(model_.answer(object, "weight", "x").error().what, HasSubstr("no attribute 'weight'"));
  EXPECT_THAT(model_.answer(object, "material", "paper").error().advice, HasSubstr("wood, steel"));
  EXPECT_FALSE(model_.answer(object, "broken", "maybe"));
  EXPECT_FALSE(model_.answer(object, "note", "two\nlines"));
  ASSERT_TRUE(model_.answer(object, "broken", "yes"));
  const auto answered = model_.answer(object, "note", " left leg ").value();
  EXPECT_EQ(model_.find(kFirst)->classification.attributes,
            (AttributeValues{{"broken", "yes"}, {"note", "left leg"}}));
  EXPECT_TRUE(model_.revertReclassified(answered).value());
  ASSERT_TRUE(model_.answer(object, "broken", ""));
  EXPECT_THAT(model_.find(kFirst)->classification.attributes, IsEmpty());
}

// Naming and merging objects.

TEST_F(CatalogueClassesTest, NameByUser_MakesTheClass_AndItsUndoTakesItBack) {
  const ObjectNaming naming = model_.nameByUser(kFirst, "chair 2", "chair").value();
  EXPECT_EQ(classOf(kFirst), "chair");
  EXPECT_EQ(naming.made_class, ClassId{1});
  EXPECT_TRUE(model_.revertNaming(naming).value());
  EXPECT_EQ(classOf(kFirst), "");
  EXPECT_TRUE(state(ClassId{1}).hidden) << "no object has it";
  EXPECT_EQ(model_.nameByUser(kFirst, "chair 2", "chair").value().made_class, ClassId{1});
}

TEST_F(CatalogueClassesTest, RevertNaming_KeepsTheMadeClass_WhenAnotherObjectHasIt) {
  const ObjectNaming naming = model_.nameByUser(kFirst, "chair", "chair").value();
  static_cast<void>(classify(kSecond, naming.made_class));
  EXPECT_TRUE(model_.revertNaming(naming).value());
  EXPECT_FALSE(state(naming.made_class).hidden);
}

TEST_F(CatalogueClassesTest, RevertNaming_BringsBackTheEarlierClass) {
  const ClassId chair = add("chair"), table = add("table");
  static_cast<void>(classify(kFirst, chair));
  const ObjectNaming naming = model_.nameByUser(kFirst, "desk", "table").value();
  EXPECT_EQ(classOf(kFirst), "table");
  EXPECT_TRUE(model_.revertNaming(naming).value());
  EXPECT_EQ(classOf(kFirst), "chair");
  const ObjectNaming again = model_.nameByUser(kFirst, "desk", "table").value();
  static_cast<void>(classify(kFirst, {}));
  static_cast<void>(classify(kFirst, table));
  EXPECT_TRUE(model_.revertNaming(again).value());
}

TEST_F(CatalogueClassesTest, NameByUser_UsesAKnownClass_WhenNoneIsGiven) {
  EXPECT_FALSE(model_.nameByUser(kSecond, "stapler").value().reclassified);
  EXPECT_THAT(model_.classes().all(), IsEmpty()) << "none is made";
  const ClassId mug = add("mug");
  EXPECT_EQ(model_.nameByUser(kFirst, "red mug").value().reclassified->after.class_id, mug);
  add("jug");
  EXPECT_FALSE(model_.nameByUser(kFirst, "blue jug").value().reclassified) << "it has a class";
}

TEST_F(CatalogueClassesTest, NameByUser_MergesIntoTheObjectOfThatName_WhichTakesTheClass) {
  const ClassId mug = add("mug");
  static_cast<void>(classify(kFirst, mug));
  ASSERT_TRUE(model_.rename(kSecond, "cup", NamedBy::user));
  const ObjectNaming naming = model_.nameByUser(kFirst, "cup").value();
  EXPECT_EQ(naming.object, kSecond);
  EXPECT_EQ(classOf(kSecond), "mug") << "it had none";
  EXPECT_TRUE(model_.revertNaming(naming).value());
  EXPECT_EQ(classOf(kSecond), "");
  EXPECT_EQ(classOf(kFirst), "mug");
}

TEST_F(CatalogueClassesTest, NameByUser_ChangesNothing_WhenTheClassIsNotValid) {
  static_cast<void>(changes());
  EXPECT_FALSE(model_.nameByUser(kFirst, "mug", "12"));
  EXPECT_FALSE(model_.nameByUser(kFirst, "mug", std::string(300, 'x')));
  EXPECT_THAT(changes(), IsEmpty());
}

TEST_F(CatalogueClassesTest, Merge_GivesTheRootTheOtherClass_OnlyIfItHasNone) {
  const ClassId chair = add("chair"), table = add("table");
  static_cast<void>(classify(kSecond, chair));
  const ObjectMerge merge = model_.merge(std::array{kFirst, kSecond}).value();
  EXPECT_EQ(merge.into, kFirst);
  EXPECT_EQ(classOf(kFirst), "chair");
  ASSERT_TRUE(model_.unmerge(merge));
  EXPECT_EQ(classOf(kFirst), "");
  EXPECT_EQ(classOf(kSecond), "chair");
  static_cast<void>(classify(kFirst, table));
  EXPECT_FALSE(model_.merge(std::array{kFirst, kSecond}).value().reclassified);
  EXPECT_EQ(classOf(kFirst), "table");
}

TEST_F(CatalogueClassesTest, ClassRoot_IsFound_WhenMergesInADamagedFileAreCircular) {
  model_.putClass({.id = ClassId{1}, .name = "a", .hidden = true, .merged_into = ClassId{2}});
  model_.putClass({.id = ClassId{2}, .name = "b", .hidden = true, .merged_into = ClassId{1}});
  model_.putClass({.id = ClassId{3}, .name = "c", .hidden = true, .merged_into = ClassId{9}});
  EXPECT_NE(model_.classes().rootOf(ClassId{1}), nullptr);
  EXPECT_EQ(model_.classes().rootOf(ClassId{3})->id, ClassId{3});
  EXPECT_EQ(model_.classes().rootOf(ClassId{9}), nullptr);
}

}  // namespace
}  // namespace scantrove
