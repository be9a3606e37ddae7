#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/dataset/silhouette.h"
#include "tests/unit/dataset/coco_reader.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

SCANTROVE_EXPORTED_ONCE(CocoExportTest, DatasetFormat::coco);

cv::Mat maskOfAnnotation(const Json& annotation) {
  const auto& size = annotation["segmentation"]["size"];
  return decodedLikeCoco(annotation["segmentation"]["counts"].get<std::string>(), size[0].get<int>(),
                         size[1].get<int>());
}

TEST_F(CocoExportTest, HasTheFilesAndTheRecordedImages) {
  EXPECT_EQ(exported().files(), (std::vector<std::string>{"annotations/instances.json", "images/000000.jpg",
                                                          "images/000010.jpg", "images/000020.jpg"}));
  for (const int frame : {0, 10, 20}) {
    const std::string name = "images/0000" + std::string(frame == 0 ? "00" : std::to_string(frame)) + ".jpg";
    EXPECT_EQ(exported().text(name), readText(exported().scene.fileOf(frame))) << "not the same bytes";
  }
  EXPECT_EQ(exported().summary.images, 3);
  EXPECT_EQ(exported().summary.regions, 2);
  EXPECT_EQ(exported().summary.annotations, 6);
  EXPECT_TRUE(exported().summary.skipped.empty());
  EXPECT_EQ(exported().summary.folder, std::filesystem::canonical(exported().home / "out"));
}

TEST_F(CocoExportTest, TablesReferToEachOther) {
  const Json file = exported().json("annotations/instances.json");
  std::set<int> images, categories, annotations;
  for (const Json& image : file["images"]) {
    EXPECT_TRUE(images.insert(image["id"].get<int>()).second);
    EXPECT_EQ(image["width"], 640);
    EXPECT_EQ(image["height"], 480);
    EXPECT_TRUE(std::filesystem::exists(exported().file("images/" + image["file_name"].get<std::string>())));
  }
  for (const Json& category : file["categories"])
    EXPECT_TRUE(categories.insert(category["id"].get<int>()).second);
  EXPECT_FALSE(categories.contains(0));
  for (const Json& annotation : file["annotations"]) {
    EXPECT_TRUE(annotations.insert(annotation["id"].get<int>()).second);
    EXPECT_TRUE(images.contains(annotation["image_id"].get<int>()));
    EXPECT_TRUE(categories.contains(annotation["category_id"].get<int>()));
    EXPECT_EQ(annotation["iscrowd"], 0);
  }
  EXPECT_FALSE(annotations.contains(0)) << "0 means no match in COCO's evaluation";
}

TEST_F(CocoExportTest, KeepsNamesAsTyped) {
  const Json file = exported().json("annotations/instances.json");
  ASSERT_EQ(file["categories"].size(), 2U);
  EXPECT_EQ(file["categories"][0]["name"], "ball") << "the name in place of a missing category";
  EXPECT_EQ(file["categories"][1]["name"], "box");
  for (const Json& annotation : file["annotations"]) {
    const Json& attributes = annotation["attributes"];
    if (attributes["region"] == kBox) {
      EXPECT_EQ(attributes["object"], 3);
      EXPECT_EQ(attributes["name"], kBoxName);
      EXPECT_EQ(annotation["category_id"], file["categories"][1]["id"]);
    } else {
      EXPECT_EQ(attributes["region"], kBall);
      EXPECT_TRUE(attributes["object"].is_null());
      EXPECT_EQ(annotation["category_id"], file["categories"][0]["id"]);
    }
  }
}

TEST_F(CocoExportTest, HasMasksOfTheScene) {
  const Json file = exported().json("annotations/instances.json");
  for (const Json& annotation : file["annotations"]) {
    const cv::Mat mask = maskOfAnnotation(annotation);
    const int frame = file["images"][annotation["image_id"].get<std::size_t>() - 1]["frame"];
    const auto region = annotation["attributes"]["region"].get<std::uint32_t>();
    EXPECT_GE(iou(mask, exported().scene.exactMask(frame, region)), 0.95) << region << " in frame " << frame;
    EXPECT_EQ(annotation["area"], cv::countNonZero(mask));
    const cv::Rect box = boxOf(mask);
    EXPECT_EQ(annotation["bbox"], Json({box.x, box.y, box.width, box.height}));
  }
}

TEST_F(CocoExportTest, CountsClassesAsTheFileHasThem) {
  std::map<std::string, ClassCount> expected;
  std::set<std::pair<int, int>> seen;
  const Json file = exported().json("annotations/instances.json");
  for (const Json& annotation : file["annotations"]) {
    const int category = annotation["category_id"].get<int>();
    const std::string name = category == file["categories"][0]["id"] ? "ball" : "box";
    ClassCount& count = expected[name];
    count.images += seen.insert({category, annotation["image_id"].get<int>()}).second ? 1 : 0;
    ++count.instances;
    count.pixels += annotation["area"].get<std::uint64_t>();
  }
  ASSERT_EQ(exported().summary.classes.size(), 2U);
  for (const ClassCount& count : exported().summary.classes) {
    EXPECT_EQ(count.images, expected[count.name].images) << count.name;
    EXPECT_EQ(count.instances, expected[count.name].instances) << count.name;
    EXPECT_EQ(count.pixels, expected[count.name].pixels) << count.name;
  }
}

TEST_F(CocoExportTest, HasNoLicense_WhenNoneWasGiven) {
  const Json file = exported().json("annotations/instances.json");
  EXPECT_TRUE(file["licenses"].empty());
  for (const Json& image : file["images"]) EXPECT_FALSE(image.contains("license"));
  EXPECT_GE(file["info"]["year"].get<int>(), 2024);
}

TEST(CocoExport, HasTheLicense_WhenGiven) {
  ScannedScene scene;
  scene.frames = 1;
  const TemporaryFolder home;
  ASSERT_TRUE(exportDataset(scene, {.format = DatasetFormat::coco,
                                    .folder = home / "out",
                                    .license = "CC BY 4.0\nhttps://creativecommons.org/licenses/by/4.0/"}));
  const Json file = Json::parse(readText(home / "out" / "annotations" / "instances.json"));
  ASSERT_EQ(file["licenses"].size(), 1U);
  EXPECT_EQ(file["licenses"][0]["name"], "CC BY 4.0");
  EXPECT_EQ(file["licenses"][0]["url"], "https://creativecommons.org/licenses/by/4.0/");
  EXPECT_EQ(file["images"][0]["license"], file["licenses"][0]["id"]);
}

TEST(CocoExport, IncludesBackgroundAndRejectedRegions_WhenRequested) {
  const Exported with(
      DatasetFormat::coco, [](ScannedScene& scene) { scene.frames = 1; }, true);
  std::set<std::uint32_t> regions;
  const Json file = with.json("annotations/instances.json");
  for (const Json& annotation : file["annotations"])
    regions.insert(annotation["attributes"]["region"].get<std::uint32_t>());
  EXPECT_EQ(regions, (std::set<std::uint32_t>{kTable, kBox, kBall, kBlock}));
  std::set<std::string> categories;
  for (const Json& category : file["categories"]) categories.insert(category["name"].get<std::string>());
  EXPECT_EQ(categories, (std::set<std::string>{"background", "ball", "box", "rejected"}));
}

TEST(CocoExport, HasOneAnnotation_WhenARegionHasTwoPieces) {
  const Exported exported(DatasetFormat::coco, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.divided = kBox;
    scene.labels[0].object = 3;  // the ball belongs to the object of the box
  });
  const Json file = exported.json("annotations/instances.json");
  std::multiset<std::uint32_t> regions;
  for (const Json& annotation : file["annotations"])
    regions.insert(annotation["attributes"]["region"].get<std::uint32_t>());
  EXPECT_EQ(regions, (std::multiset<std::uint32_t>{kBox, kBall}));
}

TEST(CocoExport, IncludesAllFrames_WhenRequested) {
  ScannedScene scene;
  scene.frames = 4;
  const TemporaryFolder home;
  const auto key = exportDataset(scene, {.format = DatasetFormat::coco, .folder = home / "key"});
  const auto all =
      exportDataset(scene, {.format = DatasetFormat::coco, .folder = home / "all", .all_frames = true});
  ASSERT_TRUE(key && all);
  EXPECT_EQ(key->images, 2);
  EXPECT_EQ(all->images, 4);
}

}  // namespace
}  // namespace scantrove::test
