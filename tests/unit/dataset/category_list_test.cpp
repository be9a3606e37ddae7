#include "core/dataset/category_list.h"

#include <gmock/gmock.h>

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;

LabeledRegion regionOf(std::uint32_t id, const std::string& name, const std::string& category,
                       ClassId class_id = {}) {
  LabeledRegion region;
  region.id = id;
  region.name = name;
  region.category = category;
  region.class_id = class_id;
  return region;
}

std::vector<std::string> wordsOf(const CategoryList& list) {
  std::vector<std::string> words;
  for (const DatasetCategory& one : list.all()) words.push_back(std::to_string(one.id) + ' ' + one.name);
  return words;
}

TEST(CategoryList, CountsAlphabetically_WithoutClasses) {
  const std::vector<LabeledRegion> regions{regionOf(1, "mug", ""), regionOf(2, "", "box"),
                                           regionOf(3, "x", "box")};
  const CategoryList list({}, regions);
  EXPECT_THAT(wordsOf(list), ElementsAre("1 box", "2 mug"));
  EXPECT_EQ(list.idOf(regions[0]), 2U);
  EXPECT_EQ(list.indexOf(regions[2]), 0U);
}

TEST(CategoryList, HasAllVisibleClasses_ThenOtherNames) {
  const std::vector<ObjectClass> classes{{ClassId{7}, "table", {}, "furniture"},
                                         {ClassId{3}, "chair"},
                                         {.id = ClassId{90}, .name = "old", .hidden = true}};
  const std::vector<LabeledRegion> regions{regionOf(1, "chair 2", "chair", ClassId{3}),
                                           regionOf(2, "table", ""), regionOf(3, "zebra", ""),
                                           regionOf(4, "ant", "")};
  const CategoryList list(classes, regions);
  EXPECT_THAT(wordsOf(list), ElementsAre("3 chair", "7 table", "91 ant", "92 zebra")) << "90 is taken";
  EXPECT_EQ(list.all()[1].supercategory, "furniture");
  EXPECT_EQ(list.idOf(regions[0]), 3U);
  EXPECT_EQ(list.idOf(regions[1]), 7U) << "a class has the name of the region";
  EXPECT_EQ(list.idOf(regions[2]), 92U);
}

TEST(CategoryList, KeepsIdsOfClasses_WhateverTheRegionsAre) {
  const std::vector<ObjectClass> classes{{ClassId{3}, "chair"}, {ClassId{7}, "table"}};
  const LabeledRegion table = regionOf(1, "table", "table", ClassId{7});
  for (const auto& others :
       {std::vector<LabeledRegion>{}, {regionOf(2, "ant", "")}, {regionOf(2, "z", "chair")}}) {
    std::vector<LabeledRegion> regions{table};
    regions.insert(regions.end(), others.begin(), others.end());
    EXPECT_EQ(CategoryList(classes, regions).idOf(table), 7U);
  }
}

TEST(CategoryList, HasTheHiddenClassOfARegion_AndThoseOfAMissingCatalogue) {
  const LabeledRegion region = regionOf(1, "old chair", "chair", ClassId{5}),
                      same = regionOf(2, "x", "chair");
  EXPECT_THAT(wordsOf(CategoryList({{.id = ClassId{5}, .name = "chair", .hidden = true}}, {region})),
              ElementsAre("5 chair"));
  EXPECT_THAT(wordsOf(CategoryList({}, {region, same})), ElementsAre("5 chair"));
}

TEST(CategoryList, FindsFreeIds_WhenTheLargestIsTaken) {
  const std::vector<ObjectClass> classes{{ClassId{1}, "a"}, {ClassId{kLargestClassId}, "z"}};
  EXPECT_THAT(wordsOf(CategoryList(classes, {regionOf(1, "m", ""), regionOf(2, "n", "")})),
              ElementsAre("1 a", "2 m", "3 n", "2147483647 z"));
}

// In data sets.

void classifyScene(ScannedScene& scene) {
  scene.class_list = {
      {ClassId{4}, "ball", {}, "toy"}, {ClassId{9}, "carton", {}, "thing"}, {ClassId{2}, "cat"}};
  for (LabeledRegion& region : scene.labels) {
    if (region.id != kBox) continue;
    region.category = "carton";
    region.class_id = ClassId{9};
  }
}

TEST(CategoryList, GivesCocoItsCategories) {
  const Exported exported(DatasetFormat::coco, classifyScene);
  const Json file = exported.json("annotations/instances.json");
  ASSERT_EQ(file["categories"].size(), 3U);
  EXPECT_EQ(file["categories"][1], (Json{{"id", 4}, {"name", "ball"}, {"supercategory", "toy"}}));
  std::set<int> used;
  for (const Json& annotation : file["annotations"]) {
    const int id = annotation["category_id"].get<int>();
    used.insert(id);
    EXPECT_EQ(id, annotation["attributes"]["region"] == kBox ? 9 : 4);
  }
  EXPECT_THAT(used, ElementsAre(4, 9));
}

TEST(CategoryList, GivesYoloItsClassesInTheOrderOfIds) {
  const Exported exported(DatasetFormat::yolo, classifyScene);
  EXPECT_THAT(exported.text("data.yaml"),
              testing::HasSubstr("names:\n  0: \"cat\"\n  1: \"ball\"\n  2: \"carton\"\n"));
  const Json labels = exported.json("labels.json");
  EXPECT_EQ(labels[std::to_string(kBox)]["category"], "carton");
  EXPECT_EQ(labels[std::to_string(kBox)]["category_id"], 9);
  EXPECT_TRUE(labels[std::to_string(kBall)]["category_id"].is_null());
}

}  // namespace
}  // namespace scantrove::test
