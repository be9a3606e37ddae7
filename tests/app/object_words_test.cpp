// Lists, label maps and data sets say the same of an object, as its catalogue has it now.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/app/demo_scan.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;

class ObjectWords : public DemoScanTest {
 protected:
  void name(const std::string& region, const std::string& name, const std::string& category = "") {
    const Finished run = tell({"name", "--region", region, "--name", name, "--class", category});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    ASSERT_EQ(run.err, "");
  }
  Finished objects(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "objects");
    arguments.insert(arguments.end(), {"--database", catalogue_});
    return scantrove(arguments);
  }
  Json objectList() const { return jsonOf(objects({"list", "--json"})); }
  /// labels.json of a data set of masks: what it says of its regions, by number.
  Json dataset(std::string* said = nullptr) {
    const fs::path out = folder_ / ("masks" + std::to_string(++datasets_));
    const Finished run = scantrove({"export", scan_, "--format", "masks", "--out", out});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    if (said != nullptr) *said = run.err;
    return Json::parse(readText(out / "labels.json"));
  }
  std::vector<std::string> cocoCategories() {
    const fs::path out = folder_ / ("coco" + std::to_string(++datasets_));
    EXPECT_EQ(scantrove({"export", scan_, "--format", "coco", "--out", out}).exit_code, 0);
    std::vector<std::string> names;
    const Json coco = Json::parse(readText(out / "annotations" / "instances.json"));
    for (const Json& category : coco["categories"]) names.push_back(category["name"]);
    return names;
  }

  int datasets_ = 0;
};

TEST_F(ObjectWords, RenamedInTheCatalogueIsRenamedInTheDataSet) {
  const std::string one = plainRegions().at(0);
  name(one, "mug");
  ASSERT_EQ(objects({"rename", "mug", "red mug"}).exit_code, 0);
  EXPECT_EQ(region(one)["name"], "red mug");
  EXPECT_EQ(dataset()[one]["name"], "red mug");
  EXPECT_THAT(cocoCategories(), testing::Contains("red mug"));
  EXPECT_THAT(cocoCategories(), testing::Not(testing::Contains("mug")));
}

TEST_F(ObjectWords, DeletedInTheCatalogueIsNoObjectOfTheDataSet) {
  const std::string one = plainRegions().at(0);
  name(one, "mug", "cup");
  ASSERT_TRUE(dataset().contains(one));
  ASSERT_EQ(objects({"delete", "mug"}).exit_code, 0);
  EXPECT_FALSE(dataset().contains(one));
  EXPECT_EQ(region(one)["is_object"], false);
  EXPECT_TRUE(region(one)["object"].is_null());
  EXPECT_EQ(region(one)["name"], "");
  name(one, "mug");
  EXPECT_TRUE(dataset().contains(one)) << "it is one again";
}

TEST_F(ObjectWords, MergedInTheCatalogueIsTheOneThatHoldsBoth) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "mug", "cup");
  name(other, "handle", "part");
  ASSERT_EQ(objects({"merge", "mug", "handle"}).exit_code, 0);
  const Json said = dataset();
  EXPECT_EQ(said[other]["name"], said[one]["name"]);
  EXPECT_EQ(said[other]["object"], said[one]["object"]);
  EXPECT_EQ(said[other]["category"], said[one]["category"]);
  EXPECT_EQ(region(other)["object"], region(one)["object"]);
  EXPECT_EQ(region(other)["confirmed"], true);
}

TEST_F(ObjectWords, AnotherScanCallsWhatItRecognizesByName) {
  const auto all = regions();
  const auto found = std::ranges::find_if(all, [](const Json& one) { return !one["object"].is_null(); });
  ASSERT_NE(found, all.end()) << "the demo gives an object in so many frames";
  const int object = (*found)["object"];
  ASSERT_EQ(objects({"rename", std::to_string(object), "lunch box"}).exit_code, 0);
  const Finished run =
      scantrove({"scan", "demo", "--frames", "40", "--out", folder_ / "second", "--database", catalogue_});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_THAT(run.out, HasSubstr("lunch box")) << "it is not recognised: the test shows nothing";
  const fs::path out = folder_ / "second-masks";
  ASSERT_EQ(scantrove({"export", folder_ / "second", "--format", "masks", "--out", out}).exit_code, 0);
  const auto holds = [](const Json& labels) {
    return std::ranges::any_of(labels, [](const Json& label) { return label["name"] == "lunch box"; });
  };
  EXPECT_TRUE(holds(Json::parse(readText(out / "labels.json"))));
  EXPECT_TRUE(holds(Json::parse(readText(folder_ / "second" / "labels.json"))));
  EXPECT_THAT(scantrove({"session", "regions", folder_ / "second"}).out, HasSubstr("lunch box"));
}

TEST_F(ObjectWords, WithoutItsCatalogueASessionSaysWhatItKept) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "mug");
  ASSERT_EQ(objects({"rename", "mug", "red mug"}).exit_code, 0);
  name(other, "box");  // by then the session has heard of it
  for (const char* file : {"catalogue.sqlite", "catalogue.sqlite-wal", "catalogue.sqlite-shm"})
    fs::remove(scan_ / file);
  std::string said;
  const Json labels = dataset(&said);
  EXPECT_EQ(labels[one]["name"], "red mug");
  EXPECT_EQ(labels[one]["confirmed"], true);
  EXPECT_THAT(said, testing::AllOf(HasSubstr(catalogue_), HasSubstr("what the session kept")));
  ASSERT_EQ(tell({"name", "--region", one, "--name", "blue mug"}).exit_code, 0);
  EXPECT_EQ(region(one)["name"], "blue mug") << "what is said now counts for more";
}

TEST_F(ObjectWords, ANameOfTheSessionAloneHolds) {
  const std::string one = plainRegions().at(0);
  name(one, "mug");
  ASSERT_EQ(tell({"name", "--region", one, "--name", "my mug", "--no-catalogue"}).exit_code, 0);
  EXPECT_EQ(region(one)["name"], "my mug");
  EXPECT_EQ(dataset()[one]["name"], "my mug");
}

TEST_F(ObjectWords, WhatIsNoObjectAnyMoreIsInNoDataSet) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "mug");
  ASSERT_EQ(tell({"object", other}).exit_code, 0);
  ASSERT_TRUE(dataset().contains(one));
  ASSERT_TRUE(dataset().contains(other));
  ASSERT_EQ(tell({"object", one, other, "--off"}).exit_code, 0);
  EXPECT_FALSE(dataset().contains(one));
  EXPECT_FALSE(dataset().contains(other));
  EXPECT_EQ(region(one)["is_object"], false);
  EXPECT_EQ(region(other)["is_object"], false);
  ASSERT_EQ(tell({"undo"}).exit_code, 0);
  EXPECT_TRUE(dataset().contains(one));
  ASSERT_EQ(tell({"redo"}).exit_code, 0);
  ASSERT_EQ(tell({"object", one}).exit_code, 0);
  EXPECT_EQ(region(one)["is_object"], true);
  EXPECT_TRUE(dataset().contains(one));
}

TEST_F(ObjectWords, AJoinedRegionTakesTheObjectAlong) {
  const std::string plain = plainRegions().at(0), one = plainRegions().at(1);
  name(one, "mug");
  const Json before = objectList(), object = region(one)["object"];
  ASSERT_FALSE(object.is_null());
  ASSERT_EQ(tell({"join", plain, one}).exit_code, 0);
  EXPECT_EQ(region(plain)["object"], object);
  EXPECT_EQ(region(plain)["name"], "mug");
  name(plain, "red mug");
  EXPECT_EQ(objectList().size(), before.size()) << "no second object";
  EXPECT_EQ(region(plain)["object"], object);
  ASSERT_EQ(tell({"undo", "--steps", "2"}).exit_code, 0);
  EXPECT_EQ(region(one)["object"], object) << "in a new process";
  EXPECT_TRUE(region(plain)["object"].is_null());
  EXPECT_EQ(objectList(), before);
  ASSERT_EQ(tell({"redo"}).exit_code, 0);
  EXPECT_EQ(region(plain)["object"], object);
}

TEST_F(ObjectWords, JoinedRegionsOfTwoObjectsBecomeOne) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "mug");
  ASSERT_EQ(tell({"object", other}).exit_code, 0);
  const Json before = objectList(), object = region(one)["object"];
  const Finished joined = tell({"join", other, one});
  ASSERT_EQ(joined.exit_code, 0);
  EXPECT_EQ(joined.err, "");
  EXPECT_EQ(objectList().size(), before.size() - 1);
  EXPECT_EQ(region(other)["object"], object) << "the one that a person named holds both";
  ASSERT_EQ(tell({"undo"}).exit_code, 0);
  EXPECT_EQ(objectList().size(), before.size());
  EXPECT_EQ(region(one)["object"], object);
  EXPECT_FALSE(region(other)["object"].is_null());
}

TEST_F(ObjectWords, JoinedRegionsStayTwoObjects_WhenAPersonNamedBoth) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "mug");
  name(other, "handle");
  const Json before = objectList();
  const Finished joined = tell({"join", one, other});
  ASSERT_EQ(joined.exit_code, 0);
  EXPECT_THAT(joined.err, testing::AllOf(HasSubstr("mug"), HasSubstr("handle"), HasSubstr("objects merge")));
  EXPECT_EQ(objectList(), before);
  ASSERT_EQ(tell({"undo"}).exit_code, 0);
  EXPECT_EQ(region(other)["name"], "handle");
  EXPECT_FALSE(region(other)["object"].is_null());
}

}  // namespace
}  // namespace scantrove::test
