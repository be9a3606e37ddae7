#include "core/dataset/dataset_readme.h"

#include <gtest/gtest.h>

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

TEST(DatasetReadme, SaysWhatTheDataSetIs_ForEachFormat) {
  SmallScene scene;
  const TemporaryFolder home;
  std::set<std::string> descriptions;
  for (std::size_t i = 0; i < datasetFormatNames().size(); ++i) {
    const std::string& name = datasetFormatNames()[i];
    const auto format = static_cast<DatasetFormat>(i);
    const auto result = exportDataset(scene, {.format = format, .folder = home / name});
    ASSERT_TRUE(result) << name << ": " << result.error().message();
    const std::string readme = readText(home / name / "README.md");
    EXPECT_TRUE(readme.starts_with("# kitchen table\n")) << name;
    EXPECT_TRUE(contains(readme, "`" + name + "`")) << readme;
    EXPECT_TRUE(contains(readme, "Scantrove " + programVersion())) << name;
    EXPECT_TRUE(contains(readme, "No licence was given.")) << name;
    EXPECT_EQ(contains(readme, "2 key frames"), hasImages(format)) << name;
    EXPECT_FALSE(std::filesystem::exists(home / name / "LICENSE.txt"));
    const std::size_t files = readme.find("## Files");
    EXPECT_TRUE(descriptions.insert(readme.substr(files, readme.find("## Labels") - files)).second) << name;
  }
}

TEST(DatasetReadme, CountsClasses) {
  const Exported exported(DatasetFormat::yolo, [](ScannedScene& scene) { scene.frames = 2; });
  const std::string readme = exported.text("README.md");
  ASSERT_EQ(exported.summary.classes.size(), 2U);
  for (const ClassCount& count : exported.summary.classes) {
    EXPECT_EQ(count.images, 2);
    EXPECT_EQ(count.instances, 2);
    const std::string row = "| " + count.name + " | 2 | 2 | " + std::to_string(count.pixels) + " |\n";
    EXPECT_TRUE(contains(readme, row)) << row << readme;
  }
}

TEST(DatasetReadme, ListsClassesThatNoImageShows) {
  const Exported exported(DatasetFormat::coco, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[4].name = "ghost";
  });
  EXPECT_TRUE(contains(exported.text("README.md"), "| ghost | 0 | 0 | 0 |\n"));
}

TEST(DatasetReadme, HasTheLicense_WhenGiven) {
  SmallScene scene;
  const TemporaryFolder home;
  const std::string license = "My licence_1\nAll rights reserved.";
  for (const char* name : {"coco", "tum"}) {
    ASSERT_TRUE(exportDataset(
        scene, {.format = *parseDatasetFormat(name), .folder = home / name, .license = license}));
    EXPECT_EQ(readText(home / name / "LICENSE.txt"), license + "\n");
    const std::string readme = readText(home / name / "README.md");
    EXPECT_TRUE(contains(readme, "My licence\\_1 (see `LICENSE.txt`)")) << readme;
  }
}

TEST(DatasetReadme, HasNoLicense_WhenItIsBlank) {
  SmallScene scene;
  const TemporaryFolder home;
  ASSERT_TRUE(
      exportDataset(scene, {.format = DatasetFormat::tum, .folder = home / "out", .license = " \n "}));
  EXPECT_FALSE(std::filesystem::exists(home / "out" / "LICENSE.txt"));
}

TEST(DatasetReadme, KeepsItsTables_WhenNamesHaveMarkup) {
  const Exported exported(DatasetFormat::yolo, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[0].name = "a | b\n# c";
    scene.scan_name = "# scan\n*2*";
  });
  const std::string readme = exported.text("README.md");
  EXPECT_TRUE(contains(readme, "| a \\| b \\# c | 1 |")) << readme;
  EXPECT_TRUE(readme.starts_with("# \\# scan \\*2\\*\n"));
}

TEST(License, HasANameAndAnAddress) {
  EXPECT_EQ(licenseName("\n  CC0 1.0\r\nmore"), "CC0 1.0");
  EXPECT_EQ(licenseName("  "), "");
  EXPECT_EQ(licenseUrl("see <http://a.org/x> and others"), "http://a.org/x");
  EXPECT_EQ(licenseUrl("none"), "");
}

}  // namespace
}  // namespace scantrove::test
