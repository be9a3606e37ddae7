#include "core/session/region_label.h"

#include <gmock/gmock.h>

namespace scantrove {
namespace {

using State = RegionObject::State;

constexpr RegionId kOne{3}, kOther{5};

RegionNote noteOf(const std::string& name, const std::string& category = "") {
  RegionNote note;
  note.name = name;
  note.category = category;
  return note;
}

RegionObject known(std::uint32_t id, const std::string& name, NamedBy by = NamedBy::user) {
  return {State::known, ObjectId{id}, name, by, by == NamedBy::user, false};
}

TEST(RegionLabel, IsTheCataloguesName_WhenAPersonGaveIt) {
  const RegionLabel label = labelOf(noteOf("mug", "cup"), known(7, "red mug"));
  EXPECT_EQ(label.name, "red mug");
  EXPECT_EQ(label.category, "cup");
  EXPECT_EQ(label.object, ObjectId{7});
  EXPECT_TRUE(label.is_object);
  EXPECT_TRUE(label.confirmed);
  EXPECT_TRUE(label.is_named);
}

TEST(RegionLabel, IsTheSessionsName_WhenTheCatalogueHasNoUserName) {
  EXPECT_EQ(labelOf(noteOf("mug"), known(7, "Obj_7", NamedBy::program)).name, "mug");
  EXPECT_EQ(labelOf(noteOf("mug"), {}).name, "mug");
  EXPECT_EQ(labelOf(noteOf("mug"), known(7, "cup"), true).name, "mug")
      << "the catalogue does not have the new name";
}

TEST(RegionLabel, IsTheGeneratedName_WhenNobodyGaveOne) {
  const RegionLabel label = labelOf({}, known(7, "Obj_7", NamedBy::program));
  EXPECT_EQ(label.name, "Obj_7");
  EXPECT_FALSE(label.is_named);
  EXPECT_TRUE(label.is_object);
}

TEST(RegionLabel, IsNoObject_WhenItWasDeleted) {
  RegionNote note = noteOf("mug", "cup");
  note.object = true;
  const RegionLabel label = labelOf(note, {.state = State::deleted});
  EXPECT_EQ(label.name, "");
  EXPECT_EQ(label.category, "");
  EXPECT_FALSE(label.object);
  EXPECT_FALSE(label.is_object);
  EXPECT_EQ(labelOf(note, {.state = State::deleted}, true).name, "mug") << "renamed in the session only";
}

TEST(RegionLabel, IsNoObject_WhenAPersonRejectedIt) {
  RegionNote note;
  note.rejected = true;
  EXPECT_FALSE(labelOf(note, known(7, "cup")).is_object);
  note.rejected = false;
  note.background = true;
  EXPECT_FALSE(labelOf(note, known(7, "cup")).is_object);
}

TEST(ProposedBackground, IsASupport_ThatNobodyMarked) {
  constexpr SupportPixels kTable{10000, 9000, 0}, kMug{10000, 0, 9000};
  ASSERT_TRUE(kTable.isSupport());
  EXPECT_TRUE(isProposedBackground(kTable, {}, {}));
  EXPECT_FALSE(isProposedBackground(kMug, {}, {}));
  RegionNote background, object, rejected;
  background.background = object.object = rejected.rejected = true;
  for (const RegionNote& note : {background, object, rejected, noteOf("table"), noteOf("", "furniture")})
    EXPECT_FALSE(isProposedBackground(kTable, note, labelOf(note, {})));
}

TEST(ProposedBackground, IsNoObjectOfTheCatalogue) {
  constexpr SupportPixels kTable{10000, 9000, 0};
  EXPECT_FALSE(isProposedBackground(kTable, {}, labelOf({}, known(7, "Obj_7", NamedBy::program))));
  EXPECT_TRUE(isProposedBackground(kTable, {}, labelOf({}, {.state = State::deleted})));
}

TEST(RegionLabel, MergedRegionsShareTheClassOfTheirObject) {
  std::map<RegionId, RegionObject> objects{{kOne, known(7, "mug")}, {kOther, known(7, "mug")}};
  objects[kOther].is_merged = true;
  std::map<RegionId, RegionLabel> labels{{kOne, labelOf(noteOf("mug", "cup"), objects[kOne])},
                                         {kOther, labelOf(noteOf("box", "boxes"), objects[kOther])}};
  shareClasses(labels, objects);
  EXPECT_EQ(labels[kOne].category, "cup");
  EXPECT_EQ(labels[kOther].category, "cup");
  EXPECT_EQ(labels[kOther].name, "mug");
}

TEST(RegionLabel, HasTheClassOfTheCatalogue) {
  RegionObject object = known(7, "red mug");
  object.class_id = ClassId{4};
  object.class_name = "mug";
  const RegionLabel label = labelOf(noteOf("mug", "cup"), object);
  EXPECT_EQ(label.category, "mug");
  EXPECT_EQ(label.class_id, ClassId{4});
  EXPECT_EQ(labelOf({}, object).category, "mug");
  EXPECT_EQ(labelOf(noteOf("mug", "cup"), object, true).category, "cup") << "of the session only";
  EXPECT_FALSE(labelOf(noteOf("mug", "cup"), known(7, "mug")).class_id);
  EXPECT_EQ(labelOf(noteOf("mug", "cup"), known(7, "mug")).category, "cup") << "as in older sessions";
}

TEST(RegionLabel, MergedRegionsHaveTheClassOfTheCatalogue) {
  std::map<RegionId, RegionObject> objects{{kOne, known(7, "mug")}, {kOther, known(7, "mug")}};
  objects[kOther].is_merged = true;
  for (auto& [region, object] : objects) {
    object.class_id = ClassId{4};
    object.class_name = "mug";
  }
  std::map<RegionId, RegionLabel> labels{{kOne, labelOf(noteOf("mug", "cup"), objects[kOne])},
                                         {kOther, labelOf(noteOf("box", "boxes"), objects[kOther])}};
  shareClasses(labels, objects);
  for (const auto& [region, label] : labels) EXPECT_EQ(label.category, "mug");
}

TEST(RegionObject, HasTheRootOfItsClass) {
  CatalogueModel catalogue;
  const ClassId mug = catalogue.addClass({.name = "mug"}).value(),
                cup = catalogue.addClass({.name = "cup"}).value();
  catalogue.put({ObjectId{7}, "red mug", NamedBy::user, true, false, {}, {cup, {}}});
  ASSERT_TRUE(catalogue.mergeClasses({&cup, 1}, mug));
  const RegionObject object = regionObjectOf(catalogue, ObjectId{7});
  EXPECT_EQ(object.class_id, mug);
  EXPECT_EQ(object.class_name, "mug");
}

TEST(RememberedObjects, ReadBackEqual_FromText) {
  RememberedObjects objects{{kOne, {known(7, "M\xC3\xBCsli \"x\""), "A"}},
                            {kOther, {{.state = State::deleted}, "B"}}};
  objects[kOne].object.class_id = ClassId{4};
  objects[kOne].object.class_name = "breakfast";
  EXPECT_EQ(rememberedFrom(rememberedToText(objects)), objects);
  EXPECT_EQ(rememberedToText({}), "");
  for (const char* text : {"", "{", "[1]", R"({"x": {}})", R"({"3": {"object": "y"}})"})
    EXPECT_TRUE(rememberedFrom(text).empty()) << text;
}

TEST(RememberedObjects, AreReplaced_ForTheCurrentCatalogue) {
  const RememberedObjects before{{kOne, {known(7, "mug"), "A"}}, {kOther, {known(8, "box"), "B"}}};
  EXPECT_EQ(remember(before, {}, "A"), (RememberedObjects{{kOther, {known(8, "box"), "B"}}}));
  EXPECT_EQ(remember(before, {{kOther, known(1, "red box")}}, "A"),
            (RememberedObjects{{kOther, {known(1, "red box"), "A"}}}));
}

}  // namespace
}  // namespace scantrove
