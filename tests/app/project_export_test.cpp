#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "tests/app/demo_scan.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A project with two copies of the demo's scan, in which a region is called "mug".
class ProjectExportCommandTest : public DemoScanTest {
 protected:
  ProjectExportCommandTest() {
    const std::string region = plainRegions().at(0);
    EXPECT_EQ(session({"name", "--region", region, "--name", "mug"}).exit_code, 0);
    EXPECT_EQ(scantrove({"project", "create", project_}).exit_code, 0);
    for (const char* name : {"first", "second \"half\""})
      fs::copy(scan_, project_ / "scans" / name, fs::copy_options::recursive);
  }

  [[nodiscard]] Finished exported(std::vector<std::string> arguments) const {
    std::vector<std::string> all{"export", "--project", project_};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return scantrove(all);
  }

  const fs::path project_ = folder_ / "project", out_ = folder_ / "data";
};

TEST_F(ProjectExportCommandTest, WritesAllScansIntoOneDataSet) {
  const Json summary = jsonOf(exported({"--format", "coco", "--only", "named", "--json", "--out", out_}));
  EXPECT_EQ(summary["scans"], 2);
  const Json coco = Json::parse(readText(out_ / "annotations/instances.json"));
  EXPECT_EQ(coco["images"].size(), summary["images"].get<std::size_t>());
  std::set<std::string> scans, files;
  for (const Json& image : coco["images"]) {
    scans.insert(image["scan"]);
    EXPECT_TRUE(files.insert(image["file_name"]).second);
  }
  EXPECT_EQ(scans, (std::set<std::string>{"first", "second \"half\""}));
  ASSERT_FALSE(coco["annotations"].empty());
  for (const Json& annotation : coco["annotations"]) EXPECT_EQ(annotation["attributes"]["name"], "mug");
  std::ofstream(out_ / "mine.txt") << "mine";
  expectJobFailure(exported({"--format", "coco", "--out", out_}), {"mine.txt"});
  fs::remove(out_ / "mine.txt");
  EXPECT_EQ(exported({"--format", "coco", "--scan", "first", "--out", out_}).exit_code, 0);
  EXPECT_EQ(Json::parse(readText(out_ / "scans.json")).size(), 1U);
}

TEST_F(ProjectExportCommandTest, SplitsByScan) {
  const Json summary = jsonOf(
      exported({"--format", "yolo", "--train", "first", "--val", "second \"half\"", "--dry-run", "--json"}));
  EXPECT_EQ(summary["dry_run"], true);
  ASSERT_EQ(summary["splits"].size(), 2U);
  EXPECT_EQ(summary["splits"][1]["split"], "val");
  EXPECT_EQ(summary["splits"][0]["images"], summary["splits"][1]["images"]) << "both are the same scan";
  EXPECT_FALSE(fs::exists(out_));
  const Finished text = exported({"--format", "coco", "--split", "train=0.5,val=0.5", "--dry-run"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out,
              testing::AllOf(HasSubstr("train"), HasSubstr("mug"), HasSubstr("nothing was written")));
}

TEST_F(ProjectExportCommandTest, NamesWhatIsWrong) {
  expectJobFailure(exported({"--format", "coco", "--scan", "cellar", "--out", out_}), {"cellar", "first"});
  const Finished zebra = exported({"--format", "coco", "--class", "zebra", "--out", out_});  // after progress
  EXPECT_EQ(zebra.exit_code, 1);
  EXPECT_THAT(zebra.err, testing::AllOf(HasSubstr("zebra"), HasSubstr("mug")));
  expectJobFailure(scantrove({"export", "--project", folder_ / "none", "--format", "coco", "--out", out_}),
                   {"none"});
  EXPECT_FALSE(fs::exists(out_));
}

}  // namespace
}  // namespace scantrove::test
