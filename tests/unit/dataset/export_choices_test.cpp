#include "core/dataset/export_choices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/dataset/region_choice.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

LabeledRegion labeledRegion(std::uint32_t id, const std::string& name, std::optional<std::int64_t> object,
                            bool confirmed) {
  LabeledRegion region;
  region.id = id;
  region.name = name;
  region.object = object;
  region.confirmed = confirmed;
  return region;
}

/// A named region, a confirmed object, an object without name, a part of the wall, and nothing.
std::vector<LabeledRegion> someRegions() {
  std::vector<LabeledRegion> regions{labeledRegion(1, "mug", std::nullopt, false),
                                     labeledRegion(2, "cup", 7, true), labeledRegion(3, "", 8, false),
                                     labeledRegion(4, "", std::nullopt, false),
                                     labeledRegion(5, "", std::nullopt, false)};
  regions[3].background = true;
  return regions;
}

std::vector<std::uint32_t> idsIn(const std::vector<LabeledRegion>& regions) {
  std::vector<std::uint32_t> ids;
  for (const LabeledRegion& region : regions) ids.push_back(region.id);
  return ids;
}

TEST(ChooseRegions, TakesTheLabelsThatAreChosen) {
  const auto all = chooseRegions(someRegions(), false, {});
  EXPECT_THAT(idsIn(all.exported), ElementsAre(1, 2, 3));
  EXPECT_THAT(all.unlabeled, IsEmpty());
  const auto named = chooseRegions(someRegions(), false, {.labels = ExportedLabels::named});
  EXPECT_THAT(idsIn(named.exported), ElementsAre(1, 2));
  EXPECT_THAT(idsIn(named.unlabeled), ElementsAre(3));
  const auto confirmed = chooseRegions(someRegions(), true, {.labels = ExportedLabels::confirmed});
  EXPECT_THAT(idsIn(confirmed.exported), ElementsAre(2, 4)) << "background is a choice of its own";
  EXPECT_THAT(idsIn(confirmed.unlabeled), ElementsAre(1, 3));
}

TEST(ChooseRegions, TakesNoNameOfTheProgramForALabel) {
  std::vector<LabeledRegion> regions = someRegions();
  regions[2].name = "Obj_8";
  regions[2].is_program_name = true;
  const auto named = chooseRegions(regions, false, {.labels = ExportedLabels::named});
  EXPECT_THAT(idsIn(named.exported), ElementsAre(1, 2));
  EXPECT_THAT(idsIn(named.unlabeled), ElementsAre(3));
  regions[2].category = "cup";
  const auto with_class = chooseRegions(regions, false, {.labels = ExportedLabels::named});
  EXPECT_THAT(idsIn(with_class.exported), ElementsAre(1, 2, 3)) << "a person gave the class";
}

TEST(ChooseRegions, TakesTheClassesThatAreChosen) {
  const auto cups = chooseRegions(someRegions(), false, {.classes = {"cup"}});
  EXPECT_THAT(idsIn(cups.exported), ElementsAre(2));
  EXPECT_THAT(cups.unlabeled, IsEmpty()) << "what has another class is labelled";
}

TEST(ChooseRegions, NeverExportsObjectsWithoutName_WhenTheseAreIgnored) {
  const auto choice = chooseRegions(someRegions(), false, {.unlabeled = UnlabeledObjects::ignore});
  EXPECT_THAT(idsIn(choice.exported), ElementsAre(1, 2));
  EXPECT_THAT(idsIn(choice.unlabeled), ElementsAre(3));
}

/// A scene whose ball nobody has named.
void withUnnamedBall(ScannedScene& scene) {
  scene.frames = 1;
  scene.labels[0].name.clear();
  scene.labels[0].object = 11;
}

struct IgnoringExport {
  SmallScene scene;
  TemporaryFolder home;
  ExportSummary summary;

  explicit IgnoringExport(DatasetFormat format, UnlabeledObjects unlabeled = UnlabeledObjects::ignore) {
    withUnnamedBall(scene);
    const auto result =
        exportDataset(scene, {.format = format, .folder = home / "out", .choices = {.unlabeled = unlabeled}});
    EXPECT_TRUE(result) << (result ? "" : result.error().message());
    summary = result.value_or(ExportSummary{});
  }
  [[nodiscard]] cv::Mat image(const std::string& name) const {
    return cv::imread((home / "out" / name).string(), cv::IMREAD_UNCHANGED);
  }
  [[nodiscard]] std::string readme() const { return readText(home / "out/README.md"); }
  void expectIsBall(const cv::Mat& mask) const { EXPECT_GT(iou(mask, scene.exactMask(0, kBall)), 0.8); }
};

TEST(UnlabeledObjects, AreACrowdInCoco_WhenIgnored) {
  const IgnoringExport exported(DatasetFormat::coco);
  const Json coco = Json::parse(readText(exported.home / "out/annotations/instances.json"));
  std::vector<Json> crowds;
  for (const Json& one : coco["annotations"]) {
    if (one["iscrowd"] == 1) crowds.push_back(one);
  }
  ASSERT_EQ(crowds.size(), 1U);
  const cv::Mat ball = exported.scene.exactMask(0, kBall);
  EXPECT_NEAR(crowds[0]["area"].get<double>(), cv::countNonZero(ball), 0.2 * cv::countNonZero(ball));
  const Json& category = coco["categories"].back();
  EXPECT_EQ(category["name"], "unlabelled");
  EXPECT_EQ(category["id"], crowds[0]["category_id"]);
  EXPECT_EQ(coco["annotations"].size(), 2U) << "the box, and the crowd";
  EXPECT_THAT(exported.readme(), HasSubstr("iscrowd"));
  EXPECT_EQ(exported.summary.unlabeled, 1);
}

TEST(UnlabeledObjects, HaveTheLargestNumberInMasks_WhenIgnored) {
  const IgnoringExport exported(DatasetFormat::masks);
  exported.expectIsBall(exported.image("masks/000000.png") == 65535);
  EXPECT_THAT(exported.readme(), HasSubstr("65535"));
}

TEST(UnlabeledObjects, AreVoidInVoc_WhenIgnored) {
  const IgnoringExport exported(DatasetFormat::voc);
  EXPECT_THAT(exported.readme(), HasSubstr("255"));
  const std::string png = readText(exported.home / "out/SegmentationClass/000000.png");
  EXPECT_FALSE(png.empty());
  EXPECT_THAT(readText(exported.home / "out/Annotations/000000.xml"), testing::Not(HasSubstr("object 11")));
}

TEST(UnlabeledObjects, AreNamedInANote_WhenTheFormatCannotIgnoreThem) {
  const IgnoringExport exported(DatasetFormat::yolo);
  EXPECT_THAT(exported.summary.notes, testing::Contains(HasSubstr("yolo")));
}

TEST(UnlabeledObjects, AreCountedOrLeft) {
  const IgnoringExport warned(DatasetFormat::masks, UnlabeledObjects::warn);
  EXPECT_THAT(warned.summary.notes, testing::Contains(HasSubstr("1 objects have no name")));
  EXPECT_EQ(cv::countNonZero(warned.image("masks/000000.png") == 65535), 0);
  const IgnoringExport left(DatasetFormat::masks, UnlabeledObjects::leave);
  EXPECT_THAT(left.summary.notes, IsEmpty());
  EXPECT_EQ(left.summary.unlabeled, 1);
}

TEST(ExportChoices, RefuseClassesThatDoNotExist) {
  SmallScene scene;
  const TemporaryFolder home;
  const auto result = exportDataset(
      scene, {.format = DatasetFormat::coco, .folder = home / "out", .choices = {.classes = {"zebra"}}});
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message(), testing::AllOf(HasSubstr("zebra"), HasSubstr("ball")));
  EXPECT_TRUE(std::filesystem::is_empty(home.path()));
}

TEST(ExportChoices, SetTheShareOfFramesForValidation) {
  SmallScene scene;
  scene.frames = 7;  // four key frames
  const auto validation = [&](double share) {
    const TemporaryFolder home;
    EXPECT_TRUE(exportDataset(
        scene,
        {.format = DatasetFormat::yolo, .folder = home / "out", .choices = {.validation_share = share}}));
    const auto folder = home / "out/images/val";
    return std::filesystem::exists(folder) ? Exported::filesIn(folder).size() : 0;
  };
  EXPECT_EQ(validation(0.5), 2U);
  EXPECT_EQ(validation(0), 0U);
  EXPECT_EQ(validation(0.2), 0U) << "a fifth of four frames is less than one";
  EXPECT_EQ(validation(1), 3U) << "one is left to train with";
}

}  // namespace
}  // namespace scantrove::test
