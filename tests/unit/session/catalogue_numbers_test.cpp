#include "core/session/catalogue_numbers.h"

#include <gmock/gmock.h>

#include "core/catalogue/stored_namings.h"

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

constexpr RegionId kMugRegion{3}, kBoxRegion{5};

/// Numbers of a session with two objects of catalogue "A"; a naming refers to one of them.
CatalogueNumbers numbersOfA() {
  return {{{kCatalogueKey, "A"},
           {"source", "demo"},
           {namingsKeyOf(kMugRegion), "[1]"},
           {removedObjectKeyOf(kBoxRegion), "9"}},
          {{kMugRegion, ObjectId{7}}, {kBoxRegion, ObjectId{8}}, {RegionId{6}, {}}}};
}

std::string metadataOf(const CatalogueNumbers& numbers, const std::string& name) {
  const auto found = numbers.metadata.find(name);
  return found == numbers.metadata.end() ? "" : found->second;
}

TEST(CatalogueNumbers, Stay_WhenTheCatalogueIsTheSame) {
  CatalogueNumbers numbers = numbersOfA();
  EXPECT_FALSE(turnTo(numbers, {"A"}));
  EXPECT_EQ(numbers.metadata, numbersOfA().metadata);
  EXPECT_EQ(numbers.objects, numbersOfA().objects);
}

TEST(CatalogueNumbers, AreSetAside_WhenTheCatalogueChanges) {
  CatalogueNumbers numbers = numbersOfA();
  EXPECT_TRUE(turnTo(numbers, {"B"}));
  EXPECT_THAT(numbers.objects, IsEmpty());
  EXPECT_EQ(metadataOf(numbers, namingsKeyOf(kMugRegion)), "");
  EXPECT_EQ(metadataOf(numbers, removedObjectKeyOf(kBoxRegion)), "");
  EXPECT_EQ(metadataOf(numbers, "source"), "demo");
  EXPECT_EQ(metadataOf(numbers, kCatalogueKey), "B");
  EXPECT_FALSE(turnTo(numbers, {"B"})) << "reported once";
}

TEST(CatalogueNumbers, Return_WhenTheirCatalogueReturns) {
  CatalogueNumbers numbers = numbersOfA();
  turnTo(numbers, {"B"});
  numbers.objects[kMugRegion] = ObjectId{1};
  EXPECT_TRUE(turnTo(numbers, {"A"}));
  EXPECT_THAT(numbers.objects, ElementsAre(Pair(kMugRegion, ObjectId{7}), Pair(kBoxRegion, ObjectId{8})));
  EXPECT_EQ(metadataOf(numbers, namingsKeyOf(kMugRegion)), "[1]");
  EXPECT_EQ(metadataOf(numbers, removedObjectKeyOf(kBoxRegion)), "9");
  EXPECT_TRUE(turnTo(numbers, {"B"}));
  EXPECT_THAT(numbers.objects, ElementsAre(Pair(kMugRegion, ObjectId{1})));
  EXPECT_EQ(metadataOf(numbers, namingsKeyOf(kMugRegion)), "");
}

TEST(CatalogueNumbers, OfAnOlderSessionStay_WhenTheCatalogueHasItsScan) {
  CatalogueNumbers numbers = numbersOfA();
  numbers.metadata.erase(kCatalogueKey);
  CatalogueNumbers foreign = numbers;
  EXPECT_FALSE(turnTo(numbers, {"A", true}));
  EXPECT_EQ(numbers.objects, numbersOfA().objects);
  EXPECT_EQ(metadataOf(numbers, kCatalogueKey), "A") << "stored from now on";
  EXPECT_TRUE(turnTo(foreign, {"B", false}));
  EXPECT_THAT(foreign.objects, IsEmpty());
  EXPECT_TRUE(!turnTo(foreign, {"A", true}));
  EXPECT_EQ(foreign.objects.at(kMugRegion), ObjectId{7});
}

TEST(CatalogueNumbers, ReportNoChange_WhenThereAreNone) {
  CatalogueNumbers numbers{{{kCatalogueKey, "A"}}, {{kMugRegion, {}}}};
  EXPECT_FALSE(turnTo(numbers, {"B"}));
  EXPECT_EQ(metadataOf(numbers, kCatalogueKey), "B");
}

TEST(CatalogueNumbers, AreEmpty_WhenTheirMetadataIsDamaged) {
  for (const char* text : {"", "{", "[]", R"({"objects": {"x": 1}, "facts": {}})",
                           R"({"objects": {"3": "y"}})", R"({"objects": {}, "facts": {"source": "evil"}})"}) {
    CatalogueNumbers numbers{{{kCatalogueKey, "B"}, {"numbers of A", text}, {"source", "demo"}}, {}};
    EXPECT_FALSE(turnTo(numbers, {"A"})) << text;
    EXPECT_THAT(numbers.objects, IsEmpty()) << text;
    EXPECT_EQ(metadataOf(numbers, "source"), "demo") << text;
  }
}

TEST(CatalogueNumbers, OfASavedScanFollowItsRegions) {
  SavedScan scan;
  scan.metadata = numbersOfA().metadata;
  scan.regions = {{kMugRegion, ObjectId{7}, {"mug", ""}}, {kBoxRegion, ObjectId{8}, {}}};
  const SavedScan before = scan;
  EXPECT_TRUE(turnTo(scan, {"B"}));
  EXPECT_THAT(scan.regions,
              ElementsAre(SavedRegion{kMugRegion, {}, {"mug", ""}}, SavedRegion{kBoxRegion, {}, {}}));
  scan.regions.pop_back();  // a region without data has no row
  EXPECT_FALSE(turnTo(scan, {"A"}));
  EXPECT_EQ(scan.regions, before.regions);
}

}  // namespace
}  // namespace scantrove
