// Names as nobody should type them: exports stay inside their folder, and numbers do not depend on names.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/dataset/export_text.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kNames{"../../escaped",
                                      "/etc/passwd",
                                      "a/b\\c",
                                      "..",
                                      ".",
                                      "two\nlines\r\n",
                                      " ",
                                      "\"'`$(rm)|;&<>",
                                      "rgb: {x} # 1",
                                      std::string(300, 'x'),
                                      "\xFF\xFE",
                                      std::string("nul\0l", 5),
                                      "con",
                                      "-rf"};

void giveName(ScannedScene& scene, const std::string& hostile) {
  scene.labels[0].name = hostile;            // the ball, by its name
  scene.labels[2].category = hostile + "2";  // the box, by its class
  scene.scan_name = hostile;
}

TEST(HostileNames, LeaveNoFileOutsideTheFolder) {
  for (const std::string& hostile : kNames) {
    const TemporaryFolder home;
    fs::create_directories(home / "inner");
    SmallScene scene;
    scene.frames = 1;
    giveName(scene, hostile);
    for (const std::string& format : datasetFormatNames()) {
      const fs::path out = home / "inner" / format;
      const auto result = exportDataset(scene, {.format = *parseDatasetFormat(format), .folder = out});
      ASSERT_TRUE(result) << format << " " << hostile << ": " << result.error().message();
      for (const auto& entry : fs::recursive_directory_iterator(out)) {
        const std::string file = entry.path().filename().string();
        EXPECT_LE(file.size(), 120U) << format;
        EXPECT_EQ(file.find_first_of(std::string("\0\n\r\t\"'\\:*?<>|$", 14)), std::string::npos) << file;
        EXPECT_FALSE(entry.is_symlink());
      }
    }
    std::set<std::string> expected(datasetFormatNames().begin(), datasetFormatNames().end());
    for (const auto& entry : fs::directory_iterator(home / "inner"))
      EXPECT_EQ(expected.erase(entry.path().filename().string()), 1U) << entry.path();
    EXPECT_TRUE(expected.empty());
    EXPECT_EQ(std::distance(fs::directory_iterator(home.path()), fs::directory_iterator()), 1);
  }
}

TEST(HostileNames, AreReadableInJson) {
  for (const std::string& hostile : kNames) {
    SmallScene scene;
    scene.frames = 1;
    giveName(scene, hostile);
    const TemporaryFolder home;
    ASSERT_TRUE(exportDataset(scene, {.format = DatasetFormat::coco, .folder = home / "coco"}));
    const Json file = Json::parse(readText(home / "coco" / "annotations" / "instances.json"));
    std::set<std::string> names;
    for (const Json& category : file["categories"]) names.insert(category["name"].get<std::string>());
    EXPECT_EQ(names, (std::set<std::string>{validUtf8(hostile), validUtf8(hostile + "2")}));
  }
}

TEST(ExportedNumbers, DoNotDependOnTheOrderOfRegions) {
  const auto instancesOf = [](bool reversed) {
    SmallScene scene;
    scene.frames = 1;
    if (reversed) std::reverse(scene.labels.begin(), scene.labels.end());
    const TemporaryFolder home;
    EXPECT_TRUE(exportDataset(scene, {.format = DatasetFormat::boxes, .folder = home / "boxes"}));
    EXPECT_TRUE(exportDataset(scene, {.format = DatasetFormat::masks, .folder = home / "masks"}));
    std::map<std::string, int> numbers;
    const Json boxes = Json::parse(readText(home / "boxes" / "boxes.json"));
    for (const Json& box : boxes["boxes"]) numbers[box["name"].get<std::string>()] = box["instance"];
    const Json masks = Json::parse(readText(home / "masks" / "labels.json"));
    for (const auto& [number, label] : masks.items())
      EXPECT_EQ(numbers.at(label["name"].get<std::string>()), std::stoi(number));
    return numbers;
  };
  EXPECT_EQ(instancesOf(false), instancesOf(true));
}

TEST(ExportedNumbers, DoNotDependOnNames) {
  std::set<std::set<std::string>> folders;
  for (const std::string& hostile : kNames) {
    SmallScene scene;
    scene.frames = 1;
    giveName(scene, hostile);
    const TemporaryFolder home;
    ASSERT_TRUE(exportDataset(scene, {.format = DatasetFormat::foundationpose, .folder = home / "out"}));
    std::set<std::string> numbers;
    for (const auto& entry : fs::directory_iterator(home / "out")) {
      if (entry.is_directory()) numbers.insert(entry.path().filename().string().substr(0, 6));
    }
    folders.insert(numbers);
  }
  EXPECT_EQ(folders, (std::set<std::set<std::string>>{{"000012", "000040"}}));
}

}  // namespace
}  // namespace scantrove::test
