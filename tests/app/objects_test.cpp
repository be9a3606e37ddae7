#include <fstream>

#include "tests/app/demo_scan.h"

namespace scantrove::test {
namespace {

/// A catalogue with at least two objects from a scan of the demo.
class ObjectsCommandTest : public testing::Test {
 protected:
  void SetUp() override {
    copy_ = copies_ / "catalogue.sqlite";
    std::filesystem::copy_file(demoFolder() / "scan/catalogue.sqlite", copy_);
    const auto objects = jsonOf(run({"list"}));
    ASSERT_GE(objects.size(), 2U) << "the demo did not give two objects";
    first_ = objects[0]["name"];
    second_ = objects[1]["name"];
    first_views_ = objects[0]["views"];
    second_views_ = objects[1]["views"];
    count_ = objects.size();
  }

  Finished run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "objects");
    arguments.insert(arguments.end(), {"--json", "--database", copy_});
    return scantrove(arguments);
  }

  TemporaryFolder copies_;
  std::string copy_, first_, second_;
  int first_views_ = 0, second_views_ = 0;
  std::size_t count_ = 0;
};

TEST_F(ObjectsCommandTest, ListsNamesAndSizes) {
  EXPECT_THAT(first_, testing::StartsWith("Obj_"));
  EXPECT_GE(first_views_, 1);
  const Finished text = scantrove({"objects", "list", "--database", copy_});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.out, testing::HasSubstr(first_));
  EXPECT_THAT(text.out, testing::HasSubstr("cm"));
}

TEST_F(ObjectsCommandTest, TakesTheDefaultProject_WithoutADatabase) {
  const std::filesystem::path data = copies_ / "data";
  const ChildProcess::Environment home = {{"XDG_DATA_HOME", data.string()}};
  expectJobFailure(scantrove({"objects", "list"}, home), {(data / "scantrove/catalogue.sqlite").string()});
  std::filesystem::create_directories(data / "scantrove");
  std::filesystem::copy_file(copy_, data / "scantrove/catalogue.sqlite");
  const Finished listed = scantrove({"objects", "list"}, home);
  EXPECT_EQ(listed.exit_code, 0);
  EXPECT_THAT(listed.out, testing::HasSubstr(first_));
  EXPECT_THAT(listed.err, testing::HasSubstr((data / "scantrove/catalogue.sqlite").string()));
}

TEST_F(ObjectsCommandTest, RenamesAndConfirmsByNameOrId) {
  const auto renamed = jsonOf(run({"rename", first_, "blue mug"}));
  EXPECT_EQ(renamed["name"], "blue mug");
  const std::string id = std::to_string(renamed["id"].get<int>());
  EXPECT_EQ(jsonOf(run({"confirm", id}))["confirmed"], true);
  EXPECT_EQ(jsonOf(run({"show", "blue mug"}))["confirmed"], true);
  EXPECT_EQ(jsonOf(run({"confirm", "--undo", "blue mug"}))["confirmed"], false);
  expectJobFailure(run({"rename", second_, "blue mug"}), {"blue mug"});
  expectJobFailure(run({"rename", second_, ""}), {});
  expectJobFailure(run({"show", first_}), {first_});
}

TEST_F(ObjectsCommandTest, MergesTwoObjects) {
  expectJobFailure(run({"merge", first_, first_}), {"itself"});
  const auto merged = jsonOf(run({"merge", first_, second_}));
  EXPECT_EQ(merged["views"], first_views_ + second_views_);
  EXPECT_EQ(merged["name"], first_views_ >= second_views_ ? first_ : second_);
  EXPECT_EQ(jsonOf(run({"list"})).size(), count_ - 1);
  const std::string removed = merged["name"] == first_ ? second_ : first_;
  expectJobFailure(run({"show", removed}), {removed});
}

TEST_F(ObjectsCommandTest, MergeKeepsTheNameGivenByAUser) {
  EXPECT_EQ(jsonOf(run({"rename", second_, "mug"}))["named_by_person"], true);
  EXPECT_EQ(jsonOf(run({"confirm", first_}))["named_by_person"], false);
  const Finished merged = scantrove({"objects", "merge", first_, "mug", "--database", copy_});
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_THAT(merged.out, testing::HasSubstr("kept mug with the views of " + first_));
  EXPECT_EQ(jsonOf(run({"show", "mug"}))["confirmed"], true);
}

TEST_F(ObjectsCommandTest, RefusesNumbersControlCharactersAndLongTextsAsNames) {
  expectJobFailure(run({"rename", first_, "2"}), {"'2'", "id"});
  expectJobFailure(run({"rename", first_, "two\nlines"}), {"control characters"});
  expectJobFailure(run({"rename", first_, std::string(100'000, 'x')}), {"100000 characters", "200"});
  EXPECT_EQ(jsonOf(run({"show", first_}))["name"], first_);
}

TEST_F(ObjectsCommandTest, NamesTheProblemOfAnUnreadableCatalogue) {
  const std::string loop = copies_ / "loop.sqlite";
  std::filesystem::create_symlink(loop, loop);
  expectJobFailure(scantrove({"objects", "list", "--database", loop}), {loop, "symbolic links"});
  const std::string folder = copies_ / "";
  expectJobFailure(scantrove({"objects", "list", "--database", folder}), {"is a folder"});
}

TEST_F(ObjectsCommandTest, EditsClasses) {
  const auto classes = [this](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "classes");
    return run(arguments);
  };
  EXPECT_TRUE(jsonOf(classes({"list"})).empty());
  const auto chair = jsonOf(classes({"add", "chair", "--id", "62", "--color", "#ff8000", "--supercategory",
                                     "furniture", "--attribute", "material=choice:wood,steel"}));
  EXPECT_EQ(chair["id"], 62);
  EXPECT_EQ(chair["color"], "#ff8000");
  EXPECT_EQ(chair["attributes"][0]["choices"], nlohmann::json::array({"wood", "steel"}));
  EXPECT_EQ(jsonOf(classes({"add", "stool"}))["id"], 63);
  const auto classified = jsonOf(classes({"classify", first_, "stool"}));
  EXPECT_EQ(classified["class_id"], 63);
  EXPECT_EQ(jsonOf(run({"list"}))[0]["class"], "stool");
  EXPECT_EQ(jsonOf(classes({"merge", "stool", "62"}))["objects"], 1);
  EXPECT_EQ(jsonOf(classes({"classify", first_, "--attribute", "material=wood"}))["attributes"]["material"],
            "wood");
  EXPECT_EQ(jsonOf(run({"show", first_}))["class"], "chair");
  EXPECT_EQ(jsonOf(run({"show", first_}))["attributes"]["material"], "wood");
  EXPECT_EQ(jsonOf(classes({"merge", "--undo", "stool", "chair"}))["objects"], 1);
  EXPECT_EQ(jsonOf(classes({"rename", "63", "bar stool"}))["name"], "bar stool");
  EXPECT_EQ(jsonOf(classes({"edit", "chair", "--supercategory", "seats"}))["supercategory"], "seats");
  expectJobFailure(classes({"hide", "bar stool"}), {"bar stool", copy_});
  EXPECT_TRUE(jsonOf(classes({"classify", first_, "--none"}))["class"].is_null());
  EXPECT_EQ(jsonOf(classes({"hide", "bar stool"}))["hidden"], true);
  EXPECT_EQ(jsonOf(classes({"list"})).size(), 1U);
  EXPECT_EQ(jsonOf(classes({"restore", "bar stool"}))["id"], 63);
  expectJobFailure(classes({"add", "chair"}), {"chair", "62"});
  expectJobFailure(classes({"add", "x", "--color", "red"}), {"'red' is no color"});
  expectJobFailure(classes({"rename", "no such class", "x"}), {"no such class"});
  EXPECT_EQ(classes({"add", "x", "--id", "0"}).exit_code, 2);
}

TEST_F(ObjectsCommandTest, ImportsAndExportsClasses) {
  const auto classes = [this](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "classes");
    return run(arguments);
  };
  ASSERT_EQ(classes({"add", "chair", "--attribute", "broken=yes_no"}).exit_code, 0);
  const auto list = jsonOf(classes({"list"}));
  const std::string json = copies_ / "list.json", csv = copies_ / "list.csv",
                    other = copies_ / "other.sqlite";
  ASSERT_EQ(classes({"export", json}).exit_code, 0);
  ASSERT_EQ(classes({"export", csv}).exit_code, 0);
  EXPECT_THAT(readText(csv), testing::StartsWith("id,name,supercategory,color\n1,chair,,#"));
  expectJobFailure(classes({"export", csv}), {csv, "exists"});
  EXPECT_EQ(jsonOf(classes({"import", json}))["unchanged"], 1);
  std::filesystem::copy_file(demoFolder() / "scan/catalogue.sqlite", other);
  for (const std::string& file : {json, csv}) {
    const Finished done = scantrove({"objects", "classes", "import", file, "--database", other});
    EXPECT_EQ(done.exit_code, 0) << done.err;
  }
  EXPECT_EQ(jsonOf(scantrove({"objects", "classes", "list", "--json", "--database", other})), list);
  const std::string foreign = copies_ / "foreign.csv";
  std::ofstream(foreign) << "id,name\n7,chair\n8,table\n";
  const Finished done = scantrove({"objects", "classes", "import", foreign, "--database", other});
  EXPECT_THAT(done.out, testing::HasSubstr("1 added"));
  EXPECT_THAT(done.err, testing::HasSubstr("chair (7 in the list) keeps its id 1"));
  std::ofstream(foreign) << "id,name\n9,cup\n9,jug\n";
  expectJobFailure(classes({"import", foreign}), {foreign, "9 occurs twice"});
}

TEST_F(ObjectsCommandTest, DeletesAnObject) {
  EXPECT_EQ(run({"delete", first_}).exit_code, 0);
  EXPECT_EQ(jsonOf(run({"list"})).size(), count_ - 1);
  expectJobFailure(run({"delete", "no such object"}), {"no such object"});
}

}  // namespace
}  // namespace scantrove::test
