#include <opencv2/core.hpp>

#include <algorithm>
#include <fstream>
#include <map>

#include "core/capture/trajectory_reader.h"
#include "core/exchange/label_image_writer.h"
#include "tests/app/recording.h"
#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Finished scan(const std::string& source, const fs::path& out, const std::vector<std::string>& options = {},
              const ChildProcess::Environment& environment = {}) {
  std::vector<std::string> arguments{"scan", source, "--out", out};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return scantrove(arguments, environment);
}

nlohmann::json reportIn(const fs::path& out) {
  return nlohmann::json::parse(readText(out / "report.json"), nullptr, false);
}

/// The number of labels that cover more than a fiftieth of the image.
int largeLabelsOf(const cv::Mat& labels) {
  std::map<int, int> pixels;
  for (int i = 0; i < static_cast<int>(labels.total()); ++i) {
    const int label = labels.at<std::uint16_t>(i / labels.cols, i % labels.cols);
    if (label != 0) ++pixels[label];
  }
  return static_cast<int>(std::ranges::count_if(
      pixels, [&](const auto& entry) { return entry.second > static_cast<int>(labels.total()) / 50; }));
}

TEST(Scan, WritesAllResults) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 6);
  const fs::path out = folder / "new" / "out";
  const Finished run =
      scan(folder / "recording", out, {"--label-maps", "--start", "1", "--stride", "2"}, {{"DISPLAY", ""}});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("3 tracked"));
  EXPECT_THAT(run.out, HasSubstr(out.string()));

  const auto trajectory = readTrajectory(out / "trajectory.txt");
  ASSERT_TRUE(trajectory) << trajectory.error().message();
  ASSERT_EQ(trajectory->size(), 3U);
  EXPECT_NEAR((*trajectory)[0].timestamp_s, 1 / 30.0, 1e-6);
  EXPECT_NEAR((*trajectory)[2].timestamp_s, 5 / 30.0, 1e-6);
  for (const char* kind : {"segments", "labels", "labels-final"}) {
    for (const char* name : {"000001.png", "000003.png", "000005.png"}) {
      const auto image = readLabelImage(out / kind / name);
      ASSERT_TRUE(image) << image.error().message();
      EXPECT_EQ(image->size(), cv::Size(320, 240));
      EXPECT_GT(cv::countNonZero(*image), 320 * 240 / 2) << kind << name;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(out / kind), fs::directory_iterator()), 3) << kind;
  }
  EXPECT_THAT(readText(out / "cloud.pcd").substr(0, 400), HasSubstr("FIELDS x y z rgba label"));
  EXPECT_THAT(readText(out / "cloud.ply").substr(0, 400), HasSubstr("property uint label"));
  EXPECT_TRUE(nlohmann::json::parse(readText(out / "labels.json"), nullptr, false).is_object());
  EXPECT_TRUE(fs::exists(out / "catalogue.sqlite"));

  const auto report = reportIn(out);
  for (const char* key : {"source", "device", "params", "frames", "fps", "frame_ms", "stages",
                          "peak_memory_mb", "map", "regions", "slivers", "objects"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["frames"]["read"], 3);
  EXPECT_EQ(report["frames"]["tracked"], 3);
  EXPECT_EQ(report["frames"]["lost"], 0);
  EXPECT_GT(report["fps"], 0);
  EXPECT_GT(report["map"]["bricks"], 1000);  // 3 m^2 of surface, 2.2 x 10^-3 m^2 per brick
  // Two walls, the floor and the ball; surfaces that the ball splits may count twice.
  const auto final_labels = readLabelImage(out / "labels-final" / "000005.png");
  ASSERT_TRUE(final_labels) << final_labels.error().message();
  EXPECT_THAT(largeLabelsOf(*final_labels), testing::AllOf(testing::Ge(4), testing::Le(6)));
  EXPECT_GE(report["regions"], 4);
  EXPECT_TRUE(report["params"].contains("segmentation.k"));
  EXPECT_FALSE(report["stages"].empty());
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr(".part"))) << "a temporary file remains";
  }
}

// Results do not depend on the order of the device's threads.
TEST(Scan, GivesTheSameResultsTwice) {
  const TemporaryFolder folder;
  for (const char* out : {"first", "second"}) {
    const Finished run = scan("demo", folder / out, {"--frames", "10", "--label-maps"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  for (const char* name : {"trajectory.txt", "cloud.ply", "cloud.pcd", "labels.json", "segments/000009.png",
                           "labels/000009.png", "labels-final/000009.png"}) {
    const std::string first = readText(folder / "first" / name);
    EXPECT_FALSE(first.empty()) << name;
    EXPECT_TRUE(first == readText(folder / "second" / name)) << name;
  }
}

TEST(Scan, WritesLabelMaps_OnlyWhenRequested) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 2);
  ASSERT_EQ(scan(folder / "recording", folder / "out", {"--database", folder / "mine.sqlite"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "out/segments"));
  EXPECT_FALSE(fs::exists(folder / "out/catalogue.sqlite"));
  EXPECT_TRUE(fs::exists(folder / "mine.sqlite"));
  EXPECT_EQ(jsonOf(scantrove({"objects", "list", "--json", "--database", folder / "mine.sqlite"})).type(),
            nlohmann::json::value_t::array);
}

TEST(Scan, SkipsAndCountsATruncatedFrame) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 5);
  truncate(folder / "recording/frame-000002.depth.png");
  const Finished run = scan(folder / "recording", folder / "out");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("frame-000002.depth.png"));
  EXPECT_EQ(reportIn(folder / "out")["frames"]["skipped"], 1);
  EXPECT_EQ(reportIn(folder / "out")["frames"]["tracked"], 4);
}

TEST(Scan, SkipsAndCountsANanPose) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 4);
  folder.write("recording/frame-000001.pose.txt",
               "nan nan nan nan\nnan nan nan nan\nnan nan nan nan\n0 0 0 1\n");
  const Finished run = scan(folder / "recording", folder / "out", {"--poses", "given"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(reportIn(folder / "out")["frames"]["skipped"], 1);
  EXPECT_EQ(reportIn(folder / "out")["frames"]["tracked"], 3);
}

TEST(Scan, Fails_WhenAllFramesAreTruncated) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 2);
  truncate(folder / "recording/frame-000000.depth.png");
  truncate(folder / "recording/frame-000001.depth.png");
  expectJobFailure(scan(folder / "recording", folder / "out"), {"frame-000000.depth.png", "truncated"});
}

TEST(Scan, RefusesMissingEmptyAndUnknownSources) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "empty");
  expectJobFailure(scan(folder / "missing", folder / "out"), {(folder / "missing").string()});
  expectJobFailure(scan(folder / "empty", folder / "out"), {(folder / "empty").string()});
  expectJobFailure(scan(folder.write("notes.txt", "x"), folder / "out"), {"notes.txt"});
}

TEST(Scan, WarnsAboutAssumedIntrinsics) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 2);
  for (const char* kind : {"color", "depth"}) {
    fs::create_directories(folder.path() / "images" / kind);
    for (const char* i : {"0", "1"}) {
      fs::copy(folder.path() / "recording" / (std::string("frame-00000") + i + "." + kind + ".png"),
               folder.path() / "images" / kind / (std::string(i) + ".png"));
    }
  }
  const Finished assumed = scan(folder / "images", folder / "out");
  EXPECT_EQ(assumed.exit_code, 0);
  EXPECT_THAT(assumed.err, HasSubstr("--intrinsics"));
  const Finished given = scan(folder / "images", folder / "out", {"--intrinsics", "292.5,292.5,160,120"});
  EXPECT_EQ(given.exit_code, 0);
  EXPECT_THAT(given.err, testing::Not(HasSubstr("--intrinsics")));
}

TEST(Scan, RefusesIntrinsics_WhenTheCenterIsOutsideTheImage) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 2);
  expectJobFailure(scan(folder / "recording", folder / "out", {"--intrinsics", "292.5,292.5,5000,120"}),
                   {"--intrinsics"});
}

/// Writes a recording of the corner whose depth images are `value` everywhere.
void writeFlatRecording(const fs::path& folder, int value) {
  writeRecording(folder, 3);
  for (const char* name : {"frame-000000.depth.png", "frame-000001.depth.png", "frame-000002.depth.png"}) {
    cv::imwrite((folder / name).string(), cv::Mat(240, 320, CV_16UC1, cv::Scalar(value)));
  }
}

TEST(Scan, Fails_WhenNoFrameIsUsable) {
  const TemporaryFolder folder;
  writeFlatRecording(folder / "dark", 0);
  writeRecording(folder / "recording", 3);
  const auto expectUnused = [](const Finished& run, const std::string& reason) {
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, testing::AllOf(HasSubstr("scantrove: No frame could be used: "), HasSubstr(reason)));
  };
  for (const char* poses : {"tracked", "given"}) {
    expectUnused(scan(folder / "dark", folder / "out", {"--poses", poses}), "no readings");
    expectUnused(scan(folder / "recording", folder / "out", {"--poses", poses, "--depth-scale", "1"}),
                 "--depth-scale");
  }
  expectUnused(scan(folder / "recording", folder / "out", {"--depth-scale", "1e9"}), "--depth-scale");
  expectUnused(scan(folder / "recording", folder / "out", {"--set", "fusion.max_depth_m=0.4"}),
               "0.3 m to 0.4 m");
  expectUnused(scantrove({"bench", folder / "dark"}), "no readings");
}

TEST(Scan, FailsBeforeItStarts_WhenAFolderHasTheNameOfAResult) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 2);
  fs::create_directories(folder / "out/cloud.ply");
  expectJobFailure(scan(folder / "recording", folder / "out"),
                   {(folder / "out/cloud.ply").string(), "folder"});
  EXPECT_FALSE(fs::exists(folder / "out/trajectory.txt"));
  EXPECT_FALSE(fs::exists(folder / "out/catalogue.sqlite"));
}

// The colour camera has a higher resolution and lies 25 mm beside the depth camera.
TEST(Scan, StoresViewsInTheResolutionOfTheColorImages) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 30);
  const cv::Mat color(1024, 1280, CV_8UC3, cv::Scalar(90, 120, 150));
  cv::imwrite((folder / "color.png").string(), color);
  for (int i = 0; i < 30; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "frame-%06d.color.png", i);
    fs::copy_file(folder / "color.png", folder / "recording" / name, fs::copy_options::overwrite_existing);
  }
  expectJobFailure(scan(folder / "recording", folder / "out"),
                   {"1280x1024", "320x240", "--color-registration"});
  const Finished run = scan(folder / "recording", folder / "out",
                            {"--color-registration", "1050,1050,640,512,-0.025", "--poses", "given"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto objects = reportIn(folder / "out")["objects"];
  ASSERT_EQ(objects.size(), 1U) << "the ball";
  const auto ball = jsonOf(scantrove({"objects", "show", std::to_string(objects[0]["id"].get<int>()),
                                      "--json", "--database", folder / "out/catalogue.sqlite"}));
  // The ball is 0.4 m wide, at 1.2 m; only its part away from other surfaces is found.
  EXPECT_GT(ball["views"][0]["width"], 200);
  EXPECT_GT(ball["views"][0]["height"], 200);
}

TEST(Scan, PrintsOneMessageForADamagedImage) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 3);
  const fs::path image = folder / "recording/frame-000001.color.png";
  std::string bytes = readText(image);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  std::ofstream(image, std::ios::binary) << bytes;
  const Finished run = scan(folder / "recording", folder / "out");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("frame-000001.color.png cannot be decoded"));
  EXPECT_THAT(run.err, testing::Not(HasSubstr("libpng")));
}

TEST(Scan, AcceptsFrameNumbersWithLeadingZeros) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 12);
  const Finished run = scan(folder / "recording", folder / "out", {"--start", "000010"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(reportIn(folder / "out")["frames"]["read"], 2);
}

TEST(Scan, FailsBeforeItStarts_WhenTheOutputFolderCannotBeMade) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "x");
  // The superuser ignores permissions, but cannot write below a file or in /proc either.
  expectJobFailure(scan("demo", file / "out"), {(file / "out").string()});
  expectJobFailure(scan("demo", "/proc/out"), {"/proc/out"});
  EXPECT_EQ(readText(file), "x");
}

TEST(Scan, RefusesCatalogues_WhenTheyAreNoDatabase) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 2);
  const fs::path file =
      folder.write("letter.sqlite", "Dear reader, this is not a database at all. " + std::string(5000, '.'));
  const std::string before = readText(file);
  expectJobFailure(scan(folder / "recording", folder / "out", {"--database", file}), {"letter.sqlite"});
  EXPECT_EQ(readText(file), before);
  expectJobFailure(scantrove({"objects", "list", "--database", file}), {"letter.sqlite"});
  expectJobFailure(scantrove({"objects", "list", "--database", folder / "none.sqlite"}), {"none.sqlite"});
  expectJobFailure(scan(folder / "recording", folder / "out", {"--database", "postgresql://nowhere/x"}),
                   {"postgresql"});
}

TEST(Scan, Fails_WithoutAnOpenClDevice) {
  const TemporaryFolder folder;
  writeRecording(folder / "recording", 2);
  expectJobFailure(scan(folder / "recording", folder / "out", {},
                        {{"OCL_ICD_VENDORS", "/nonexistent-folder-of-drivers/"}}),
                   {"No OpenCL device", "pocl-opencl-icd"});
  expectJobFailure(scan(folder / "recording", folder / "out", {"--device", "warp drive"}), {"warp drive"});
}

}  // namespace
}  // namespace scantrove::test
