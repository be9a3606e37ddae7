// Lists, label maps and data sets agree on an object with its catalogue.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/app/demo_scan.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;

class ObjectNamesTest : public DemoScanTest {
 protected:
  void name(const std::string& region, const std::string& name, const std::string& category = "") {
    const Finished run = session({"name", "--region", region, "--name", name, "--class", category});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    ASSERT_EQ(run.err, "");
  }
  Finished objects(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "objects");
    arguments.insert(arguments.end(), {"--database", catalogue_});
    return scantrove(arguments);
  }
  Json objectList() const { return jsonOf(objects({"list", "--json"})); }
  /// labels.json of an exported data set of masks, by region number. `warnings`: stderr of the export.
  Json dataset(std::string* warnings = nullptr) {
    const fs::path out = folder_ / ("masks" + std::to_string(++datasets_));
    const Finished run = scantrove({"export", scan_, "--format", "masks", "--out", out});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    if (warnings != nullptr) *warnings = run.err;
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

TEST_F(ObjectNamesTest, DataSetHasTheNewName_WhenTheObjectIsRenamed) {
  const std::string one = plainRegions().at(0);
  name(one, "mug");
  ASSERT_EQ(objects({"rename", "mug", "red mug"}).exit_code, 0);
  EXPECT_EQ(region(one)["name"], "red mug");
  EXPECT_EQ(dataset()[one]["name"], "red mug");
  EXPECT_THAT(cocoCategories(),
              testing::AllOf(testing::Contains("red mug"), testing::Not(testing::Contains("mug"))));
}

TEST_F(ObjectNamesTest, DataSetHasNoObject_WhenItIsDeletedInTheCatalogue) {
  const std::string one = plainRegions().at(0);
  name(one, "mug", "cup");
  ASSERT_TRUE(dataset().contains(one));
  ASSERT_EQ(objects({"delete", "mug"}).exit_code, 0);
  EXPECT_FALSE(dataset().contains(one));
  Json deleted = region(one);
  EXPECT_EQ(deleted["is_object"], false);
  EXPECT_TRUE(deleted["object"].is_null());
  EXPECT_EQ(deleted["name"], "");
  name(one, "mug");
  EXPECT_TRUE(dataset().contains(one)) << "naming makes it an object again";
}

TEST_F(ObjectNamesTest, RegionsShareAnObject_WhenTheirObjectsMergeInTheCatalogue) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "mug", "cup");
  name(other, "handle", "part");
  ASSERT_EQ(objects({"merge", "mug", "handle"}).exit_code, 0);
  const Json labels = dataset();
  Json now = regions();
  EXPECT_EQ(labels[other]["name"], labels[one]["name"]);
  EXPECT_EQ(labels[other]["object"], labels[one]["object"]);
  EXPECT_EQ(labels[other]["category"], labels[one]["category"]);
  EXPECT_EQ(now[other]["object"], now[one]["object"]);
  EXPECT_EQ(now[other]["confirmed"], true);
}

TEST_F(ObjectNamesTest, RecognizedObjectHasItsNameInAnotherScan) {
  const auto all = regionsAtFirst();
  const auto found = std::ranges::find_if(all, [](const Json& one) { return !one["object"].is_null(); });
  ASSERT_NE(found, all.end()) << "the demo gives no object in 40 frames";
  const int object = (*found)["object"];
  ASSERT_EQ(objects({"rename", std::to_string(object), "lunch box"}).exit_code, 0);
  const Finished run =
      scantrove({"scan", "demo", "--frames", "40", "--out", folder_ / "second", "--database", catalogue_});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_THAT(run.out, HasSubstr("lunch box")) << "not recognised: the test shows nothing";
  const fs::path out = folder_ / "second-masks";
  ASSERT_EQ(scantrove({"export", folder_ / "second", "--format", "masks", "--out", out}).exit_code, 0);
  const auto contains = [](const Json& labels) {
    return std::ranges::any_of(labels, [](const Json& label) { return label["name"] == "lunch box"; });
  };
  EXPECT_TRUE(contains(Json::parse(readText(out / "labels.json"))));
  EXPECT_TRUE(contains(Json::parse(readText(folder_ / "second" / "labels.json"))));
  EXPECT_THAT(scantrove({"session", "regions", folder_ / "second"}).out, HasSubstr("lunch box"));
}

TEST_F(ObjectNamesTest, SessionUsesItsStoredNames_WithoutTheCatalogue) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "mug");
  ASSERT_EQ(objects({"rename", "mug", "red mug"}).exit_code, 0);
  name(other, "box");  // the session stores the renamed object too
  for (const char* file : {"catalogue.sqlite", "catalogue.sqlite-wal", "catalogue.sqlite-shm"})
    fs::remove(scan_ / file);
  std::string warnings;
  const Json labels = dataset(&warnings);
  EXPECT_EQ(labels[one]["name"], "red mug");
  EXPECT_EQ(labels[one]["confirmed"], true);
  EXPECT_THAT(warnings, testing::AllOf(HasSubstr(catalogue_), HasSubstr("what the session kept")));
  ASSERT_EQ(session({"name", "--region", one, "--name", "blue mug"}).exit_code, 0);
  EXPECT_EQ(region(one)["name"], "blue mug") << "the newest name wins";
}

TEST_F(ObjectNamesTest, NameOfTheSessionAloneIsUsed) {
  const std::string one = plainRegions().at(0);
  name(one, "mug");
  ASSERT_EQ(session({"name", "--region", one, "--name", "my mug", "--no-catalogue"}).exit_code, 0);
  EXPECT_EQ(region(one)["name"], "my mug");
  EXPECT_EQ(dataset()[one]["name"], "my mug");
}

TEST_F(ObjectNamesTest, DataSetHasNoRegion_WhenAUserMarkedItAsNoObject) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "mug");
  ASSERT_EQ(session({"object", other}).exit_code, 0);
  const Json before = dataset();
  ASSERT_TRUE(before.contains(one) && before.contains(other));
  ASSERT_EQ(session({"object", one, other, "--off"}).exit_code, 0);
  const Json marked = dataset();
  EXPECT_FALSE(marked.contains(one) || marked.contains(other));
  Json now = regions();
  EXPECT_EQ(now[one]["is_object"], false);
  EXPECT_EQ(now[other]["is_object"], false);
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  EXPECT_TRUE(dataset().contains(one));
  ASSERT_EQ(session({"redo"}).exit_code, 0);
  ASSERT_EQ(session({"object", one}).exit_code, 0);
  EXPECT_EQ(region(one)["is_object"], true);
  EXPECT_TRUE(dataset().contains(one));
}

TEST_F(ObjectNamesTest, JoinedRegionGetsTheObject) {
  const std::string plain = plainRegions().at(0), one = plainRegions().at(1);
  name(one, "mug");
  const Json before = objectList(), object = region(one)["object"];
  ASSERT_FALSE(object.is_null());
  ASSERT_EQ(session({"join", plain, one}).exit_code, 0);
  Json joined = region(plain);
  EXPECT_EQ(joined["object"], object);
  EXPECT_EQ(joined["name"], "mug");
  name(plain, "red mug");
  EXPECT_EQ(objectList().size(), before.size()) << "no second object is added";
  EXPECT_EQ(region(plain)["object"], object);
  ASSERT_EQ(session({"undo", "--steps", "2"}).exit_code, 0);
  Json undone = regions();
  EXPECT_EQ(undone[one]["object"], object) << "in a new process";
  EXPECT_TRUE(undone[plain]["object"].is_null());
  EXPECT_EQ(objectList(), before);
  ASSERT_EQ(session({"redo"}).exit_code, 0);
  EXPECT_EQ(region(plain)["object"], object);
}

TEST_F(ObjectNamesTest, JoinedRegionsBecomeOneObject) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "mug");
  ASSERT_EQ(session({"object", other}).exit_code, 0);
  const Json before = objectList(), object = region(one)["object"];
  const Finished joined = session({"join", other, one});
  ASSERT_EQ(joined.exit_code, 0);
  EXPECT_EQ(joined.err, "");
  EXPECT_EQ(objectList().size(), before.size() - 1);
  EXPECT_EQ(region(other)["object"], object) << "the object named by a user remains";
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  EXPECT_EQ(objectList().size(), before.size());
  Json undone = regions();
  EXPECT_EQ(undone[one]["object"], object);
  EXPECT_FALSE(undone[other]["object"].is_null());
}

TEST_F(ObjectNamesTest, JoinedRegionsBecomeTheConfirmedObject_WhenAUserNamedBoth) {
  const std::string body = plainRegions().at(0), rim = plainRegions().at(1);
  name(body, "mug", "cup");
  name(rim, "handle");
  ASSERT_EQ(objects({"confirm", "--undo", "handle"}).exit_code, 0);
  const Json before = objectList(), object = region(body)["object"];
  const Finished joined = session({"join", rim, body});  // the wrong one first
  ASSERT_EQ(joined.exit_code, 0);
  EXPECT_EQ(joined.err, "");
  EXPECT_EQ(objectList().size(), before.size() - 1) << "the other object is merged away";
  EXPECT_EQ(region(rim)["object"], object);
  EXPECT_EQ(region(rim)["name"], "mug");
  EXPECT_EQ(dataset()[rim]["name"], "mug");
  EXPECT_EQ(dataset()[rim]["category"], "cup");
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  EXPECT_EQ(objectList(), before);
  Json undone = region(rim);
  EXPECT_EQ(undone["name"], "handle");
  EXPECT_FALSE(undone["object"].is_null());
}

TEST_F(ObjectNamesTest, JoinedRegionsTakeTheClass_WhenTheirObjectHasNone) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  name(one, "blue thing");
  name(other, "handle", "cup");
  const Json before = objectList();
  ASSERT_EQ(session({"join", one, other}).exit_code, 0);
  EXPECT_EQ(region(one)["name"], "blue thing") << "the older one";
  EXPECT_EQ(region(one)["category"], "cup");
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  EXPECT_EQ(objectList(), before) << "with no class again";
}

TEST_F(ObjectNamesTest, ClassReachesTheCatalogue_WithUndoAndRedo) {
  const std::string one = plainRegions().at(0), other = plainRegions().at(1);
  const auto classes = [&] { return jsonOf(objects({"classes", "list", "--json"})); };
  EXPECT_TRUE(classes().empty()) << "a scan makes no classes";
  name(one, "chair", "chair");
  ASSERT_EQ(session({"name", "--region", other, "--name", "chair 2", "--class", "chair"}).exit_code, 0);
  ASSERT_EQ(classes().size(), 1U);
  EXPECT_EQ(classes()[0]["objects"], 2);
  EXPECT_NE(region(one)["object"], region(other)["object"]) << "two things of one class";
  ASSERT_EQ(objects({"classes", "rename", "chair", "seat"}).exit_code, 0);
  EXPECT_EQ(region(one)["category"], "seat");
  EXPECT_EQ(dataset()[other]["category"], "seat");
  EXPECT_EQ(dataset()[other]["category_id"], 1);
  name(one, "red chair");
  EXPECT_EQ(region(one)["category"], "seat") << "a new name keeps the class";
  ASSERT_EQ(session({"undo", "--steps", "3"}).exit_code, 0);
  EXPECT_TRUE(region(one)["category"].is_null() || region(one)["category"] == "");
  ASSERT_EQ(session({"redo", "--steps", "1"}).exit_code, 0);
  EXPECT_EQ(region(one)["name"], "chair");
}

}  // namespace
}  // namespace scantrove::test
