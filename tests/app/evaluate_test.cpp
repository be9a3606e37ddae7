#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

void writeLabels(const std::filesystem::path& path, int cut) {
  cv::Mat labels(4, 10, CV_16UC1, cv::Scalar(2));
  labels.colRange(0, cut) = 1;
  std::filesystem::create_directories(path.parent_path());
  cv::imwrite(path.string(), labels);
}

TEST(EvaluateTrajectory, MeasuresAteAndRpeOfTumFiles) {
  const TemporaryFolder folder;
  const auto truth = folder.write(
      "truth.txt", "# t x y z qx qy qz qw\n0 -1 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n9 0 0 0 0 0 0 1\n");
  const auto estimate = folder.write("estimate.txt", "0.01 -1.1 5 0 0 0 0 1\n1.0 1.1 5 0 0 0 0 1\n");
  const auto json = jsonOf(scantrove({"evaluate", "trajectory", "--estimate", estimate, "--truth", truth}));
  EXPECT_EQ(json["poses"]["matched"], 2);
  EXPECT_EQ(json["poses"]["truth"], 3);
  EXPECT_NEAR(json["ate_m"]["rmse"], 0.1, 1e-9);
  EXPECT_NEAR(json["rpe_m"]["rmse"], 0.2, 1e-9);
  EXPECT_NEAR(json["rpe_deg"]["max"], 0, 1e-9);
}

TEST(EvaluateTrajectory, AcceptsARecordingAsTruth) {
  const TemporaryFolder folder;
  folder.write("scene/frame-000000.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  folder.write("scene/frame-000003.pose.txt", "1 0 0 1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const auto estimate = folder.write("e.txt", "0 7 0 0 0 0 0 1\n0.1 8 0 0 0 0 0 1\n");
  const auto json =
      jsonOf(scantrove({"evaluate", "trajectory", "--estimate", estimate, "--truth", folder / "scene"}));
  EXPECT_NEAR(json["ate_m"]["rmse"], 0, 1e-9);
}

TEST(EvaluateTrajectory, RefusesMissingUnmatchedAndBrokenFiles) {
  const TemporaryFolder folder;
  const auto truth = folder.write("truth.txt", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n");
  const auto late = folder.write("late.txt", "50 0 0 0 0 0 0 1\n51 1 0 0 0 0 0 1\n");
  const auto broken = folder.write("broken.txt", "0 0 0 0 0 0 0 1\n1 one 0 0 0 0 0 1\n");
  const auto evaluate = [&](const std::filesystem::path& estimate) {
    return scantrove({"evaluate", "trajectory", "--estimate", estimate, "--truth", truth});
  };
  expectJobFailure(evaluate(folder / "none.txt"), {"none.txt"});
  expectJobFailure(evaluate(late), {"late.txt", "0.02 s"});
  expectJobFailure(evaluate(broken), {"broken.txt, line 2"});
}

TEST(EvaluateSegmentation, MeasuresBoundariesAndCoverageOfLabelImages) {
  const TemporaryFolder folder;
  writeLabels(folder / "estimate/000005.png", 7);
  writeLabels(folder / "estimate/000006.png", 5);
  writeLabels(folder / "estimate/000007.png", 5);
  writeLabels(folder / "truth/img-5-label.png", 5);
  writeLabels(folder / "truth/img-6-label.png", 5);
  const auto json = jsonOf(scantrove(
      {"evaluate", "segmentation", "--estimate", folder / "estimate", "--truth", folder / "truth"}));
  EXPECT_EQ(json["images"], 2);
  EXPECT_NEAR(json["each"][0]["boundary_error"], 1.8, 1e-6);
  EXPECT_NEAR(json["mean"]["boundary_error"], 0.9, 1e-6);
  EXPECT_EQ(json["each"][1]["coverage"], 1);
  EXPECT_EQ(json["mean"]["instances"], 4);
  const auto strict = jsonOf(scantrove({"evaluate", "segmentation", "--estimate", folder / "estimate",
                                        "--truth", folder / "truth", "--tolerance", "1"}));
  EXPECT_EQ(json["each"][0]["boundary_f"], 1);
  EXPECT_EQ(strict["each"][0]["boundary_f"], 0);
}

/// A scan of frames 30 to 51, 4 x 10 pixels; the true boundary is in the middle. Segments of single frames
/// have it two columns too far right (error 1.8), merged labels are right from the third frame on, final
/// labels always.
void writeScan(const std::filesystem::path& scan, const std::filesystem::path& truth) {
  for (int i = 0; i < 22; ++i) {
    const std::string name = "0000" + std::to_string(30 + i) + ".png";
    writeLabels(scan / "segments" / name, 7);
    writeLabels(scan / "labels" / name, i < 2 ? 7 : 5);
    writeLabels(scan / "labels-final" / name, 5);
    if (i == 5) continue;  // a frame without truth
    writeLabels(truth / ("frame-0000" + std::to_string(30 + i) + ".instance.png"), 5);
    writeLabels(truth / ("frame-0000" + std::to_string(30 + i) + ".depth.png"), 1);
  }
}

TEST(EvaluateSegmentation, ComparesSingleMergedAndFinalLabelsOfAScan) {
  const TemporaryFolder folder;
  writeScan(folder / "scan", folder / "truth");
  const auto json =
      jsonOf(scantrove({"evaluate", "segmentation", "--scan", folder / "scan", "--truth", folder / "truth"}));
  EXPECT_EQ(json["images"], 21);
  EXPECT_NEAR(json["single"]["boundary_error"], 1.8, 1e-6);
  EXPECT_NEAR(json["merged"]["boundary_error"], 2 * 1.8 / 21, 1e-6);
  EXPECT_EQ(json["final"]["boundary_error"], 0);
  EXPECT_NEAR(json["ratio"], 2.0 / 21, 1e-6);
  EXPECT_EQ(json["ratio_final"], 0);
  EXPECT_EQ(json["single"]["large"]["instances"], 42) << "two large instances per image";
  EXPECT_EQ(json["single"]["large"]["over_half"], 1);
  ASSERT_EQ(json["over_frames"].size(), 19U) << "the first 20 frames without the one that has no truth";
  EXPECT_EQ(json["over_frames"][0]["n"], 1);
  EXPECT_NEAR(json["over_frames"][1]["ratio"], 1, 1e-6);
  EXPECT_EQ(json["over_frames"][2]["ratio"], 0);
  EXPECT_EQ(json["over_frames"][5]["n"], 7);
  EXPECT_EQ(json["over_frames"][5]["images"], 1);
}

TEST(EvaluateSegmentation, AveragesOverSeveralScans) {
  const TemporaryFolder folder;
  writeScan(folder / "a", folder / "truth a");
  writeScan(folder / "b", folder / "truth b");
  writeLabels(folder / "b/labels/000030.png", 5);
  const auto json =
      jsonOf(scantrove({"evaluate", "segmentation", "--scan", folder / "a", "--truth", folder / "truth a",
                        "--scan", folder / "b", "--truth", folder / "truth b"}));
  EXPECT_EQ(json["images"], 42);
  EXPECT_NEAR(json["merged"]["boundary_error"], 3 * 1.8 / 42, 1e-6);
  EXPECT_EQ(json["over_frames"][0]["images"], 2);
  EXPECT_NEAR(json["over_frames"][0]["ratio"], 0.5, 1e-6);
}

/// labels.json of a scan without the ratings of its regions.
void removeRatings(const std::filesystem::path& file) {
  auto labels = nlohmann::json::parse(readText(file));
  int rated = 0;
  for (auto& [region, entry] : labels.items()) rated += static_cast<int>(entry.erase("objectness"));
  EXPECT_GT(rated, 0) << "the refinement rated no region";
  std::filesystem::remove(file);
  std::ofstream(file) << labels.dump();
}

TEST(EvaluateSegmentation, RanksRegionsByObjectness_OrBySizeInAScanWithoutIt) {
  const TemporaryFolder folder;
  const std::string truth = folder / "truth", scan = folder / "scan";
  ASSERT_EQ(scantrove({"record", "demo", "--frames", "30", "--out", truth}).exit_code, 0);
  const Finished scanned = scantrove({"scan", truth, "--label-maps", "--out", scan});
  ASSERT_EQ(scanned.exit_code, 0) << scanned.err;
  const auto report = nlohmann::json::parse(readText(folder / "scan/report.json"));
  for (const auto& object : report["objects"]) EXPECT_TRUE(object.contains("objectness"));
  const Finished rated = scantrove({"evaluate", "segmentation", "--scan", scan, "--truth", truth});
  EXPECT_EQ(jsonOf(rated)["average_precision"]["confidence"], "objectness");
  EXPECT_EQ(rated.err, "");
  removeRatings(folder / "scan/labels.json");
  const Finished unrated = scantrove({"evaluate", "segmentation", "--scan", scan, "--truth", truth});
  EXPECT_EQ(jsonOf(unrated)["average_precision"]["confidence"], "points");
  EXPECT_THAT(unrated.err, testing::AllOf(testing::HasSubstr(scan), testing::HasSubstr("no objectness")));
  EXPECT_EQ(std::count(unrated.err.begin(), unrated.err.end(), '\n'), 1) << "one remark";
  folder.write("scan/labels.json", "{");
  expectJobFailure(scantrove({"evaluate", "segmentation", "--scan", scan, "--truth", truth}),
                   {"labels.json"});
}

TEST(EvaluateSegmentation, RefusesAScanWithoutFinalLabels) {
  const TemporaryFolder folder;
  writeScan(folder / "scan", folder / "truth");
  std::filesystem::remove_all(folder / "scan/labels-final");
  const std::string scan = folder / "scan";
  expectJobFailure(scantrove({"evaluate", "segmentation", "--scan", scan, "--truth", folder / "truth"}),
                   {scan, "labels-final", "--label-maps"});
}

TEST(EvaluateSegmentation, RefusesMissingUnmatchedAndBrokenImages) {
  const TemporaryFolder folder;
  writeLabels(folder / "estimate/000005.png", 7);
  writeLabels(folder / "truth/000009.png", 7);
  const auto evaluate = [&](const std::string& estimate) {
    return scantrove(
        {"evaluate", "segmentation", "--estimate", folder / estimate, "--truth", folder / "truth"});
  };
  expectJobFailure(evaluate("estimate"), {(folder / "estimate").string(), (folder / "truth").string()});
  expectJobFailure(evaluate("missing"), {(folder / "missing").string()});
  folder.write("broken/000009.png", "no image");
  expectJobFailure(evaluate("broken"), {"000009.png"});
}

}  // namespace
}  // namespace scantrove::test
