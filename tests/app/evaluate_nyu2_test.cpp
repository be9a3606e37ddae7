// `evaluate nyu2` on a small data set of the same layout as NYUv2, written from a synthetic room.
#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "core/evaluation/nyu2.h"
#include "core/exchange/label_image_writer.h"
#include "tests/app/scantrove_program.h"
#include "tests/support/nyu_room.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr int kFrames = 10;

/// Two labelled images of one video: its last frame, and frame 8.
class SmallNyu {
 public:
  SmallNyu() {
    writeNyuScene(folder_ / "raw/part1/study_0001a", room_, kFrames);
    NyuLabeledWriter::write(labeled(), {room_.labeled(kFrames - 1, "study_0001", originOf(kFrames - 1)),
                                        room_.labeled(8, "study_0001", originOf(8))});
  }
  static std::string originOf(int frame) { return "study_0001a/" + nyuName('d', frame); }
  [[nodiscard]] std::filesystem::path labeled() const { return folder_ / "nyu_depth_v2_labeled.mat"; }
  [[nodiscard]] std::filesystem::path scene() const { return folder_ / "raw/part1/study_0001a"; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] const NyuRoom& room() const { return room_; }

  [[nodiscard]] Finished evaluate(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"evaluate",   "nyu2",    "--raw",    folder_ / "raw",
                                       "--labelled", labeled(), "--frames", "1,2,8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return scantrove(arguments);
  }

 private:
  TemporaryFolder folder_;
  NyuRoom room_{{320, 240}};
};

cv::Mat1i labelsOf(const std::filesystem::path& path) {
  const auto image = readLabelImage(path);
  EXPECT_TRUE(image) << path;
  cv::Mat1i labels;
  if (image) image->convertTo(labels, CV_32S);
  return labels;
}

/// The error of a scan of the last `n` frames up to `last`, from the label images that `scan` writes.
double errorOfScan(const SmallNyu& data, int last, int n, const std::string& kind) {
  const TemporaryFolder out;
  const Finished scan = scantrove({"scan", data.scene(), "--start", std::to_string(last - n + 1), "--frames",
                                   std::to_string(n), "--label-maps", "--out", out / "scan"});
  EXPECT_EQ(scan.exit_code, 0) << scan.err;
  char name[32];
  std::snprintf(name, sizeof name, "%06d.png", last);
  const LabeledImage labeled = data.room().labeled(last, "", "");
  cv::Mat1w instances;
  labeled.instances.convertTo(instances, CV_16U);
  const cv::Mat1i truth = nyuInstances(labeled.labels, instances);
  return nyu2Error(labelsOf(out / "scan" / kind / name), truth).all;
}

/// The error of the true segments where the frame has depth: there is no segment beyond its edges.
double bestError(const SmallNyu& data, int index) {
  const TemporaryFolder out;
  const Finished record = scantrove({"record", data.scene(), "--start", std::to_string(index), "--frames",
                                     "1", "--out", out / "recording"});
  EXPECT_EQ(record.exit_code, 0) << record.err;
  char name[32];
  std::snprintf(name, sizeof name, "frame-%06d.depth.png", index);
  const cv::Mat depth = cv::imread((out / "recording" / name).string(), cv::IMREAD_UNCHANGED);
  const LabeledImage labeled = data.room().labeled(index, "", "");
  cv::Mat1w instances;
  labeled.instances.convertTo(instances, CV_16U);
  const cv::Mat1i truth = nyuInstances(labeled.labels, instances);
  cv::Mat1i seen = truth.clone();
  seen.setTo(0, depth == 0);
  return nyu2Error(seen, truth).all;
}

TEST(EvaluateNyu2, GivesTheErrorsOfScansThatEndWithTheLabelledFrames) {
  const SmallNyu data;
  const auto json = jsonOf(data.evaluate({"--json"}));
  EXPECT_EQ(json["labelled_images"], 2);
  EXPECT_EQ(json["without_scene"], 0);
  EXPECT_EQ(json["unusable"], 0);
  EXPECT_EQ(json["complete"], true);
  const auto& curve = json["over_frames"];
  ASSERT_EQ(curve.size(), 3U);
  EXPECT_EQ(curve[0]["n"], 1);
  EXPECT_EQ(curve[2]["n"], 8);
  EXPECT_EQ(curve[2]["images"], 2);
  EXPECT_EQ(curve[2]["lost"], 0);
  const double single =
      (errorOfScan(data, kFrames - 1, 1, "segments") + errorOfScan(data, 8, 1, "segments")) / 2;
  const double merged = (errorOfScan(data, kFrames - 1, 8, "labels") + errorOfScan(data, 8, 8, "labels")) / 2;
  EXPECT_NEAR(curve[0]["single"]["all"], single, 0.01);
  EXPECT_NEAR(curve[2]["merged"]["all"], merged, 0.01);
  const double best = (bestError(data, kFrames - 1) + bestError(data, 8)) / 2;

  EXPECT_LT(curve[2]["merged"]["all"], best + 2) << "of a room without noise";
}

TEST(EvaluateNyu2, PrintsTheTableAndWritesTheCurve) {
  const SmallNyu data;
  const Finished run = data.evaluate({"--out", data / "out"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("single frame"), HasSubstr("17.54"), HasSubstr("images 2 of 2"),
                             HasSubstr("\n8,2,0,")));
  EXPECT_THAT(run.out, HasSubstr(readText(data / "out/table-4.1.txt")));
  EXPECT_THAT(run.out, HasSubstr(readText(data / "out/figure-4.9.csv")));
  const cv::Mat picture = cv::imread((data / "out/figure-4.9.png").string());
  EXPECT_EQ(picture.size(), cv::Size(960, 640));
}

TEST(EvaluateNyu2, ContinuesWithStoredResults_AndRefusesOtherParameters) {
  const SmallNyu data;
  const Finished first = data.evaluate({"--out", data / "out"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  std::filesystem::remove_all(data / "raw/part1");  // stored results need no frames
  const Finished second = data.evaluate({"--out", data / "out"});
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.out, first.out);
  expectJobFailure(data.evaluate({"--out", data / "out", "--set", "segmentation.k=0.5"}),
                   {"another setup", "segmentation.k"});
}

TEST(EvaluateNyu2, ReplacesNothingThatItDidNotWrite) {
  const SmallNyu data;
  std::filesystem::create_directories(data / "pictures");
  std::ofstream(data / "pictures/holiday.txt") << "mine";
  expectJobFailure(data.evaluate({"--out", data / "pictures"}), {"pictures", "did not write"});
  EXPECT_FALSE(std::filesystem::exists(data / "pictures/nyu2.json"));
  ASSERT_EQ(data.evaluate({"--out", data / "out"}).exit_code, 0);
  std::filesystem::remove(data / "out/nyu2.json");
  std::ofstream(data / "out/nyu2.json") << "{\"mine\": true}";
  expectJobFailure(data.evaluate({"--out", data / "out"}), {"nyu2.json", "damaged"});
  EXPECT_EQ(readText(data / "out/nyu2.json"), "{\"mine\": true}");
}

TEST(EvaluateNyu2, CountsImagesWithoutFrames_AndSaysWhy) {
  const SmallNyu data;
  std::filesystem::resize_file(data.scene() / nyuName('d', 8), 1000);
  const Finished run = data.evaluate({"--json"});
  const auto json = jsonOf(run);
  EXPECT_EQ(json["unusable"], 1);
  EXPECT_EQ(json["over_frames"][0]["images"], 1);
  EXPECT_THAT(run.err, AllOf(HasSubstr(nyuName('d', 8)), HasSubstr("truncated")));
  std::filesystem::rename(data.scene(), data / "raw/part1/kitchen_0007");
  expectJobFailure(data.evaluate(), {"None of the 2 labelled images", "scene"});
}

TEST(EvaluateNyu2, NamesTheFile_WhenTheLabelsAreDamaged) {
  const SmallNyu data;
  std::filesystem::resize_file(data.labeled(), std::filesystem::file_size(data.labeled()) / 2);
  expectJobFailure(data.evaluate(), {"nyu_depth_v2_labeled.mat"});
  expectWrongUsage(scantrove({"evaluate", "nyu2", "--raw", "x"}), {"--labelled"});
  expectWrongUsage(data.evaluate({"--frames", "0"}), {"--frames"});
}

}  // namespace
}  // namespace scantrove::test
