#include <QCoreApplication>
#include <opencv2/imgproc.hpp>

#include "core/catalogue/object_database.h"
#include "core/exchange/recording_writer.h"
#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

/// The database driver needs a QCoreApplication.
void startQt() {
  static int count = 1;
  static char name[] = "app_tests";
  static char* arguments[] = {name, nullptr};
  static const QCoreApplication qt(count, arguments);
}

const cv::Rect kMug(100, 100, 40, 50);
const cv::Rect kBowl(140, 100, 60, 50);

/// 40 frames of 320 x 240 at 1 m: a mug (2) and a bowl (3) side by side on a table (1). Frames 10 to 33 also
/// show a pencil (4).
void writeTruth(const std::filesystem::path& folder, bool with_extents) {
  SourceInfo info;
  info.intrinsics = {250, 250, 160, 120, 320, 240};
  info.instances = {{1, "table", false}, {2, "mug", true}, {3, "bowl", true}, {4, "pencil", true}};
  if (with_extents) {
    for (InstanceName& instance : info.instances) instance.extent_m = 0.25;
  }
  auto writer = RecordingWriter::create(folder, info);
  ASSERT_TRUE(writer);
  for (int i = 0; i < 40; ++i) {
    RgbdFrame frame;
    frame.index = i;
    frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 90, 90));
    frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1000));
    frame.T_world_camera = Eigen::Isometry3d::Identity();
    frame.instances = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1));
    frame.instances(kMug) = 2;
    frame.instances(kBowl) = 3;
    if (i >= 10 && i < 34) frame.instances(cv::Rect(10, 10, 60, 4)) = 4;
    ASSERT_TRUE(writer->add(frame));
  }
}

/// Writes the trajectory of a scan of the first `frames` frames.
void writeScan(const TemporaryFolder& folder, int frames) {
  std::string trajectory;
  for (int i = 0; i < frames; ++i) trajectory += std::to_string(i / 30.0) + " 0 0 0 0 0 0 1\n";
  folder.write("scan/trajectory.txt", trajectory);
}

class Entries {
 public:
  explicit Entries(const std::filesystem::path& file) {
    startQt();
    database_ = std::move(*ObjectDatabase::open(file));
    beginSession();
  }
  void beginSession() { session_ = *database_->sessions().begin("truth"); }
  /// Adds an object with one view per box, in frames 0, 1, 2 ...; the views' images have 640 x 480 pixels.
  void add(const std::vector<cv::Rect>& boxes) {
    ObjectId object;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      ObjectView view;
      view.object = object;
      view.session = session_;
      view.frame_index = static_cast<int>(i);
      view.box_px = {2 * boxes[i].x, 2 * boxes[i].y, 2 * boxes[i].width, 2 * boxes[i].height};
      view.frame_px = {640, 480};
      view.color = cv::Mat(boxes[i].size(), CV_8UC3, cv::Scalar(10, 20, 30));
      view.mask = cv::Mat(boxes[i].size(), CV_8UC1, cv::Scalar(255));
      view.size_m = {0.2F, 0.1F, 0.1F};
      if (i == 0) {
        object = database_->addObject(view)->id;
      } else {
        EXPECT_TRUE(database_->addView(view));
      }
    }
  }

 private:
  std::unique_ptr<ObjectDatabase> database_;
  std::int64_t session_ = 0;
};

nlohmann::json evaluate(const TemporaryFolder& folder) {
  return jsonOf(scantrove({"evaluate", "catalogue", "--scan", folder / "scan", "--truth", folder / "truth"}));
}

TEST(EvaluateCatalogue, MeasuresPurityCompletenessAndVerdicts) {
  const TemporaryFolder folder;
  writeTruth(folder / "truth", true);
  writeScan(folder, 40);
  const cv::Rect half_mug(100, 100, 20, 50);
  {
    Entries entries(folder / "scan/catalogue.sqlite");
    entries.add({kMug, kMug, half_mug, kMug, kMug});
    entries.add({kMug | kBowl});
    entries.add({half_mug});
    entries.add({cv::Rect(0, 150, 80, 80)});
  }
  const auto json = evaluate(folder);
  EXPECT_EQ(json["purity"], 0.25);
  EXPECT_EQ(json["completeness"], 0.5);
  EXPECT_EQ(json["entries"], 4);
  EXPECT_EQ(json["expected"], 2) << "mug and bowl; the pencil was seen in 24 frames";
  EXPECT_EQ(json["seen_entirely"], 2);
  EXPECT_EQ(json["completeness_of_entire"], 0.5);
  EXPECT_EQ(json["missing"], (nlohmann::json{"bowl"}));
  EXPECT_EQ(json["frames"], 40);
  ASSERT_EQ(json["each"].size(), 4U);
  EXPECT_EQ(json["each"][0]["verdict"], "whole");
  EXPECT_EQ(json["each"][0]["of"], (nlohmann::json{"mug"}));
  EXPECT_EQ(json["each"][0]["views"], 5);
  EXPECT_EQ(json["each"][0]["whole_views"], 4);
  EXPECT_EQ(json["each"][1]["verdict"], "merger");
  EXPECT_EQ(json["each"][1]["of"], (nlohmann::json{"bowl", "mug"}));
  EXPECT_EQ(json["each"][2]["verdict"], "part");
  EXPECT_EQ(json["each"][3]["verdict"], "background");
  EXPECT_EQ(json["each"][3]["of"], (nlohmann::json{"table"}));
}

TEST(EvaluateCatalogue, ExpectsObjects_WhenSeenInThirtyFrames) {
  const TemporaryFolder folder;
  writeTruth(folder / "truth", true);
  writeScan(folder, 25);
  { Entries(folder / "scan/catalogue.sqlite").add({kMug}); }
  const auto json = evaluate(folder);
  EXPECT_EQ(json["frames"], 25);
  EXPECT_EQ(json["expected"], 0) << "no object was seen in 30 frames";
  EXPECT_EQ(json["purity"], 1);
}

TEST(EvaluateCatalogue, RatesTheNewestScanOfACatalogue) {
  const TemporaryFolder folder;
  writeTruth(folder / "truth", true);
  writeScan(folder, 40);
  {
    Entries entries(folder / "scan/catalogue.sqlite");
    entries.add({kMug | kBowl});
    entries.beginSession();
    entries.add({kBowl});
  }
  const auto json = evaluate(folder);
  ASSERT_EQ(json["each"].size(), 1U);
  EXPECT_EQ(json["each"][0]["of"], (nlohmann::json{"bowl"}));
  EXPECT_EQ(json["session"], 2);
}

// At 1 m and f = 250 px the bowl (60 x 50 px) is 24 cm long, the table (320 px) 1.28 m.
TEST(EvaluateCatalogue, MeasuresSizes_WhenTheTruthHasNone) {
  const TemporaryFolder folder;
  writeTruth(folder / "truth", false);
  writeScan(folder, 40);
  { Entries(folder / "scan/catalogue.sqlite").add({kMug}); }
  EXPECT_EQ(evaluate(folder)["expected"], 2);
  std::filesystem::remove(folder / "truth/instances.json");
  const auto json = evaluate(folder);
  EXPECT_EQ(json["expected"], 2) << "the table then counts as an object, but is too large";
  EXPECT_EQ(json["missing"], (nlohmann::json{"3"}));
}

TEST(EvaluateCatalogue, RefusesMissingCataloguesAndUnmatchedTruth) {
  const TemporaryFolder folder;
  writeTruth(folder / "truth", true);
  writeScan(folder, 3);
  const auto run = [&](const std::string& truth) {
    return scantrove({"evaluate", "catalogue", "--scan", folder / "scan", "--truth", folder / truth});
  };
  expectJobFailure(run("truth"), {"catalogue.sqlite", "--database"});
  { Entries(folder / "scan/catalogue.sqlite").add({kMug}); }
  expectJobFailure(run("none"), {(folder / "none").string()});
  folder.write("other/frame-000900.instance.png", "");
  expectJobFailure(run("other"), {(folder / "other").string(), "frame of the scan"});
  folder.write("truth/instances.json", R"([{"name": "mug"}])");
  expectJobFailure(run("truth"), {"instances.json", "id"});
}

}  // namespace
}  // namespace scantrove::test
