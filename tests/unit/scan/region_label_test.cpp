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

RegionObject known(std::uint32_t id, const std::string& name, NamedBy by = NamedBy::person) {
  return {State::known, ObjectId{id}, name, by, by == NamedBy::person, false};
}

TEST(RegionLabelTest, IsTheCataloguesName_WhenAPersonGaveIt) {
  const RegionLabel label = labelOf(noteOf("mug", "cup"), known(7, "red mug"));
  EXPECT_EQ(label.name, "red mug");
  EXPECT_EQ(label.category, "cup");
  EXPECT_EQ(label.object, ObjectId{7});
  EXPECT_TRUE(label.is_object);
  EXPECT_TRUE(label.confirmed);
  EXPECT_TRUE(label.is_named);
}

TEST(RegionLabelTest, IsTheSessionsName_WhenTheCatalogueHasNoneOfAPerson) {
  EXPECT_EQ(labelOf(noteOf("mug"), known(7, "Obj_7", NamedBy::program)).name, "mug");
  EXPECT_EQ(labelOf(noteOf("mug"), {}).name, "mug");
  EXPECT_EQ(labelOf(noteOf("mug"), known(7, "cup"), true).name, "mug") << "the catalogue was not told";
}

TEST(RegionLabelTest, IsTheGeneratedName_WhenNobodyGaveOne) {
  const RegionLabel label = labelOf({}, known(7, "Obj_7", NamedBy::program));
  EXPECT_EQ(label.name, "Obj_7");
  EXPECT_FALSE(label.is_named);
  EXPECT_TRUE(label.is_object);
}

TEST(RegionLabelTest, IsNoObject_WhenItWasDeleted) {
  RegionNote note = noteOf("mug", "cup");
  note.object = true;
  const RegionLabel label = labelOf(note, {.state = State::deleted});
  EXPECT_EQ(label.name, "");
  EXPECT_EQ(label.category, "");
  EXPECT_FALSE(label.object);
  EXPECT_FALSE(label.is_object);
  EXPECT_EQ(labelOf(note, {.state = State::deleted}, true).name, "mug")
      << "named again, in the session alone";
}

TEST(RegionLabelTest, IsNoObject_WhenAPersonSaidSo) {
  RegionNote note;
  note.rejected = true;
  EXPECT_FALSE(labelOf(note, known(7, "cup")).is_object);
  note.rejected = false;
  note.background = true;
  EXPECT_FALSE(labelOf(note, known(7, "cup")).is_object);
}

TEST(RegionLabelTest, MergedRegionsAreOfTheClassOfTheirObject) {
  std::map<RegionId, RegionObject> objects{{kOne, known(7, "mug")}, {kOther, known(7, "mug")}};
  objects[kOther].is_merged = true;
  std::map<RegionId, RegionLabel> labels{{kOne, labelOf(noteOf("mug", "cup"), objects[kOne])},
                                         {kOther, labelOf(noteOf("box", "boxes"), objects[kOther])}};
  shareClasses(labels, objects);
  EXPECT_EQ(labels[kOne].category, "cup");
  EXPECT_EQ(labels[kOther].category, "cup");
  EXPECT_EQ(labels[kOther].name, "mug");
}

TEST(RememberedObjectsTest, ComeBackAsTheyWere) {
  RememberedObjects objects{{kOne, {known(7, "M\xC3\xBCsli \"x\""), "A"}},
                            {kOther, {{.state = State::deleted}, "B"}}};
  EXPECT_EQ(rememberedFrom(rememberedToText(objects)), objects);
  EXPECT_EQ(rememberedToText({}), "");
  for (const char* text : {"", "{", "[1]", R"({"x": {}})", R"({"3": {"object": "y"}})"})
    EXPECT_TRUE(rememberedFrom(text).empty()) << text;
}

TEST(RememberedObjectsTest, OfThisCatalogueAreThoseOfNow) {
  const RememberedObjects before{{kOne, {known(7, "mug"), "A"}}, {kOther, {known(8, "box"), "B"}}};
  EXPECT_EQ(remember(before, {}, "A"), (RememberedObjects{{kOther, {known(8, "box"), "B"}}}));
  EXPECT_EQ(remember(before, {{kOther, known(1, "red box")}}, "A"),
            (RememberedObjects{{kOther, {known(1, "red box"), "A"}}}));
}

}  // namespace
}  // namespace scantrove
