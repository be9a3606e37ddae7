#include "core/dataset/project_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <sstream>

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// A project of small scenes, exported to `home`/out.
class ProjectExportTest : public testing::Test {
 protected:
  ProjectExportTest() {
    for (const char* name : {"office", "kitchen", "a \"b\"\n/../c"}) add(name);
  }

  SmallScene& add(const std::string& name) {
    scenes_.push_back(std::make_shared<SmallScene>());
    scenes_.back()->scan_name = name;
    scenes_.back()->frames = 1;
    return *scenes_.back();
  }

  [[nodiscard]] ProjectToExport project(ScanSplit split = {}) const {
    ProjectToExport project{"my rooms", {}, std::move(split)};
    for (const auto& scene : scenes_) {
      project.scans.push_back(
          {scene->scan_name, [scene]() -> Result<std::shared_ptr<LabeledScan>> { return scene; }});
    }
    return project;
  }

  Result<ExportSummary> write(DatasetFormat format, ScanSplit split = {}, const ExportChoices& choices = {}) {
    return exportProject(project(std::move(split)),
                         {.format = format, .folder = home_ / "out", .choices = choices});
  }
  ExportSummary written(DatasetFormat format, ScanSplit split = {}, const ExportChoices& choices = {}) {
    const auto result = write(format, std::move(split), choices);
    EXPECT_TRUE(result) << (result ? "" : result.error().message());
    return result.value_or(ExportSummary{});
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    EXPECT_TRUE(fs::is_regular_file(home_ / "out" / name)) << name;
    return readText(home_ / "out" / name);
  }
  [[nodiscard]] Json json(const std::string& name) const { return Json::parse(text(name)); }

  TemporaryFolder home_;
  std::vector<std::shared_ptr<SmallScene>> scenes_;
};

ScanSplit splitOf(std::map<std::string, DatasetSplit> scans) { return {.by_scan = std::move(scans)}; }

TEST_F(ProjectExportTest, CocoHasUniqueIdsAndPrefixedImages) {
  const ExportSummary summary = written(DatasetFormat::coco);
  EXPECT_EQ(summary.scans, 3);
  EXPECT_EQ(summary.images, 3);
  const Json coco = json("annotations/instances.json");
  std::set<int> images, annotations;
  std::set<std::string> files, scans;
  for (const Json& image : coco["images"]) {
    images.insert(image["id"].get<int>());
    files.insert(image["file_name"]);
    scans.insert(image["scan"]);
    EXPECT_TRUE(fs::exists(home_ / "out" / "images" / std::string(image["file_name"])));
  }
  EXPECT_EQ(images.size(), 3U);
  EXPECT_TRUE(files.contains("kitchen_000000.jpg") && files.contains("office_000000.jpg"));
  EXPECT_TRUE(scans.contains("a \"b\"\n/../c")) << "the name is as typed in the file";
  for (const Json& one : coco["annotations"]) {
    annotations.insert(one["id"].get<int>());
    EXPECT_TRUE(images.contains(one["image_id"].get<int>()));
  }
  EXPECT_EQ(annotations.size(), coco["annotations"].size());
  EXPECT_EQ(annotations.size(), 6U) << "a box and a ball in each image";
  EXPECT_EQ(std::distance(fs::directory_iterator(home_.path()), fs::directory_iterator()), 1)
      << "no name leads outside";
}

TEST_F(ProjectExportTest, CategoriesAreTheClassesOfTheProject) {
  const std::vector<ObjectClass> classes{{ClassId{4}, "cup"}, {ClassId{9}, "toy"}};
  for (const auto& scene : scenes_) {
    scene->class_list = classes;
    for (std::size_t i : {0U, 2U}) {
      scene->labels[i].category = "toy";
      scene->labels[i].class_id = ClassId{9};
    }
  }
  written(DatasetFormat::coco);
  const Json coco = json("annotations/instances.json");
  ASSERT_EQ(coco["categories"].size(), 2U);
  EXPECT_EQ(coco["categories"][0]["id"], 4);
  for (const Json& one : coco["annotations"]) EXPECT_EQ(one["category_id"], 9);
}

TEST_F(ProjectExportTest, RefusesScansWithOtherClasses) {
  scenes_[0]->class_list = {{ClassId{4}, "cup"}};
  scenes_[1]->class_list = {{ClassId{4}, "toy"}};
  const auto result = write(DatasetFormat::coco);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().what, testing::AllOf(HasSubstr("cup"), HasSubstr("toy")));
}

TEST_F(ProjectExportTest, CocoHasAFileForEachSplit) {
  const std::string third = scenes_[2]->scan_name;
  const ExportSummary summary = written(DatasetFormat::coco, splitOf({{"office", DatasetSplit::train},
                                                                      {"kitchen", DatasetSplit::val},
                                                                      {third, DatasetSplit::test}}));
  ASSERT_EQ(summary.splits.size(), 3U);
  std::set<int> images, annotations;
  for (const char* name : {"train", "val", "test"}) {
    const Json coco = json(std::string("annotations/instances_") + name + ".json");
    ASSERT_EQ(coco["images"].size(), 1U) << name;
    images.insert(coco["images"][0]["id"].get<int>());
    for (const Json& one : coco["annotations"]) {
      EXPECT_EQ(one["image_id"], coco["images"][0]["id"]);
      annotations.insert(one["id"].get<int>());
    }
  }
  EXPECT_EQ(images.size(), 3U);
  EXPECT_EQ(annotations.size(), 6U);
  EXPECT_EQ(json("annotations/instances_val.json")["images"][0]["file_name"], "kitchen_000000.jpg");
  for (const SplitCount& split : summary.splits) {
    EXPECT_EQ(split.scans, 1);
    EXPECT_EQ(split.images, 1);
    EXPECT_EQ(split.classes.size(), 2U);
  }
}

TEST_F(ProjectExportTest, YoloAndVocDivideScansOnly) {
  scenes_[0]->frames = 9;  // with one scan alone, its last frames would be for validation
  const ScanSplit split = splitOf({{"office", DatasetSplit::train},
                                   {"kitchen", DatasetSplit::val},
                                   {scenes_[2]->scan_name, DatasetSplit::test}});
  written(DatasetFormat::yolo, split);
  const fs::path yolo = home_ / "out";
  EXPECT_THAT(Exported::filesIn(yolo / "labels/val"), ElementsAre("kitchen_000000.txt"));
  EXPECT_EQ(Exported::filesIn(yolo / "images/train").size(), 5U);
  EXPECT_EQ(Exported::filesIn(yolo / "images/test").size(), 1U);
  EXPECT_THAT(text("data.yaml"), HasSubstr("train: images/train\nval: images/val\ntest: images/test\n"));
  fs::remove_all(yolo);
  written(DatasetFormat::voc, split);
  EXPECT_EQ(text("ImageSets/Main/val.txt"), "kitchen_000000\n");
  const std::string train = text("ImageSets/Main/train.txt");
  EXPECT_EQ(std::count(train.begin(), train.end(), '\n'), 5);
  EXPECT_THAT(text("ImageSets/Main/test.txt"), testing::Not(HasSubstr("office")));
}

TEST_F(ProjectExportTest, MasksShareNumbers) {
  written(DatasetFormat::masks);
  const Json labels = json("labels.json");
  EXPECT_EQ(labels.size(), 6U);
  std::set<int> seen;
  for (const std::string& name : Exported::filesIn(home_ / "out/masks")) {
    const cv::Mat mask = cv::imread((home_ / "out/masks" / name).string(), cv::IMREAD_UNCHANGED);
    std::set<int> in_image;
    for (auto it = mask.begin<std::uint16_t>(); it != mask.end<std::uint16_t>(); ++it) in_image.insert(*it);
    in_image.erase(0);
    EXPECT_EQ(in_image.size(), 2U) << name;
    for (const int number : in_image) {
      EXPECT_TRUE(seen.insert(number).second) << "another scan has this number";
      const std::string scan = labels[std::to_string(number)]["scan"];
      if (name.starts_with("kitchen_")) {
        EXPECT_EQ(scan, "kitchen");
      }
    }
  }
}

TEST_F(ProjectExportTest, BopHasASceneForEachScan_WithOwnModels) {
  written(DatasetFormat::bop, splitOf({{"office", DatasetSplit::train},
                                       {"kitchen", DatasetSplit::train},
                                       {scenes_[2]->scan_name, DatasetSplit::test}}));
  const Json infos = json("models/models_info.json");
  EXPECT_EQ(infos.size(), 6U);
  std::set<int> objects;
  for (const char* scene : {"test/000001", "train/000002", "train/000003"}) {
    const Json poses = json(std::string(scene) + "/scene_gt.json");
    for (const Json& pose : poses["0"]) {
      EXPECT_TRUE(objects.insert(pose["obj_id"].get<int>()).second);
      EXPECT_TRUE(infos.contains(std::to_string(pose["obj_id"].get<int>())));
    }
    EXPECT_TRUE(fs::exists(home_ / "out" / scene / "rgb/000000.jpg"));
  }
  EXPECT_EQ(objects.size(), 6U);
}

TEST_F(ProjectExportTest, OtherFormatsHaveAFolderForEachScan) {
  for (const DatasetFormat format :
       {DatasetFormat::boxes, DatasetFormat::foundationpose, DatasetFormat::ply, DatasetFormat::pcd,
        DatasetFormat::mesh, DatasetFormat::tum, DatasetFormat::scannet}) {
    fs::remove_all(home_ / "out");
    written(format, splitOf({{"office", DatasetSplit::val},
                             {"kitchen", DatasetSplit::train},
                             {scenes_[2]->scan_name, DatasetSplit::train}}));
    EXPECT_FALSE(Exported::filesIn(home_ / "out/val/office").empty());
    EXPECT_FALSE(Exported::filesIn(home_ / "out/train/kitchen").empty());
    const Json scans = json("scans.json");
    ASSERT_EQ(scans.size(), 3U);
    EXPECT_EQ(scans[1]["folder"], "train/kitchen/");
  }
}

TEST_F(ProjectExportTest, DrawsTheSameSplit_WhateverTheOrder) {
  const ScanSplit split{.shares = SplitShares{0.4, 0.3, 0.3}, .seed = 5};
  written(DatasetFormat::coco, split);
  const Json first = json("scans.json");
  std::ranges::reverse(scenes_);
  written(DatasetFormat::coco, split);
  EXPECT_EQ(json("scans.json"), first);
}

TEST_F(ProjectExportTest, NamesScansWithNothingToExport) {
  for (LabeledRegion& region : scenes_[0]->labels) {
    region.name.clear();
    region.object.reset();
  }
  const ExportSummary summary = written(DatasetFormat::coco);
  EXPECT_EQ(summary.scans, 2);
  ASSERT_FALSE(summary.notes.empty());
  EXPECT_THAT(summary.notes.front(), testing::AllOf(HasSubstr("office"), HasSubstr("nothing to export")));
  const auto split = write(DatasetFormat::coco, splitOf({{"office", DatasetSplit::val},
                                                         {"kitchen", DatasetSplit::train},
                                                         {scenes_[2]->scan_name, DatasetSplit::train}}));
  ASSERT_FALSE(split);
  EXPECT_THAT(split.error().what, testing::AllOf(HasSubstr("office"), HasSubstr("nothing to export")));
  const auto unknown = write(DatasetFormat::coco, splitOf({{"cellar", DatasetSplit::val}}));
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message(), testing::AllOf(HasSubstr("no scan cellar"), HasSubstr("kitchen")));
}

TEST_F(ProjectExportTest, Fails_WhenNothingIsToBeExportedAnywhere) {
  const auto result = write(DatasetFormat::coco, {}, {.labels = ExportedLabels::confirmed});
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().what, HasSubstr("confirmed"));
  EXPECT_FALSE(exportProject({"empty", {}, {}}, {.format = DatasetFormat::coco, .folder = home_ / "out"}));
  EXPECT_TRUE(fs::is_empty(home_.path()));
}

TEST_F(ProjectExportTest, LeavesOutAScanWithoutUsableFrames) {
  scenes_[1]->without_color = {0};
  const ExportSummary summary = written(DatasetFormat::coco);
  EXPECT_EQ(summary.images, 2);
  EXPECT_THAT(summary.notes, testing::Contains(HasSubstr("kitchen")));
}

TEST_F(ProjectExportTest, DryRunCountsTheSame_AndWritesNothing) {
  for (const DatasetFormat format : {DatasetFormat::coco, DatasetFormat::tum, DatasetFormat::bop}) {
    const auto counted =
        exportProject(project(), {.format = format, .folder = home_ / "out", .dry_run = true});
    ASSERT_TRUE(counted) << counted.error().message();
    EXPECT_TRUE(fs::is_empty(home_.path()));
    const ExportSummary done = written(format);
    EXPECT_EQ(counted->images, done.images);
    ASSERT_EQ(counted->classes.size(), done.classes.size());
    for (std::size_t i = 0; i < done.classes.size(); ++i) {
      EXPECT_EQ(counted->classes[i].pixels, done.classes[i].pixels);
      EXPECT_EQ(counted->classes[i].instances, done.classes[i].instances);
    }
    fs::remove_all(home_ / "out");
  }
}

TEST_F(ProjectExportTest, ReadmeListsTheScans) {
  written(DatasetFormat::coco);
  const std::string readme = text("README.md");
  EXPECT_TRUE(readme.starts_with("# my rooms\n"));
  EXPECT_THAT(readme,
              testing::AllOf(HasSubstr("of 3 RGB-D scans"), HasSubstr("| kitchen | kitchen\\_ |  | 1 |")));
}

}  // namespace
}  // namespace scantrove::test
