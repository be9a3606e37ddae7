#include <algorithm>
#include <fstream>
#include <opencv2/core.hpp>
#include <thread>
#include <utility>

#include "core/exchange/label_image_writer.h"
#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;

std::vector<std::string> argumentsInto(const fs::path& out, int frames = 30) {
  return {"scan", "demo:tabletop:7", "--frames", std::to_string(frames), "--out", out};
}
constexpr int kFew = 12;  // frames, where a refinement only has to exist

nlohmann::json refinementIn(const fs::path& out) {
  const auto report = nlohmann::json::parse(readText(out / "report.json"), nullptr, false);
  return report.is_object() ? report.value("refinement", nlohmann::json()) : nlohmann::json();
}

TEST(ScanRefinement, IsReportedOnStderrAndInTheReport) {
  const TemporaryFolder folder;
  const Finished run = scantrove(argumentsInto(folder / "out", kFew));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("Refining objects with "));
  const auto refinement = refinementIn(folder / "out");
  EXPECT_GT(refinement["key_frames"], 0);
  EXPECT_GT(refinement["seconds"], 0);
  EXPECT_EQ(refinement["skipped"], false);
  EXPECT_EQ(jsonOf(scantrove({"session", "show", "--json", folder / "out"}))["refined"], true);
}

TEST(ScanRefinement, IsDoneLater_WhenSkipped) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = argumentsInto(folder / "out", kFew);
  arguments.push_back("--skip-refinement");
  const Finished run = scantrove(arguments);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, testing::Not(HasSubstr("Refining objects")));
  EXPECT_THAT(run.out, HasSubstr("session refine"));
  EXPECT_EQ(refinementIn(folder / "out")["skipped"], true);
  EXPECT_EQ(jsonOf(scantrove({"session", "show", "--json", folder / "out"}))["refined"], false);

  const auto refined = jsonOf(scantrove({"session", "refine", "--json", folder / "out"}));
  EXPECT_EQ(refined["skipped"], false);
  EXPECT_GT(refined["key_frames"], 0);
  EXPECT_EQ(refinementIn(folder / "out")["skipped"], false);
  EXPECT_EQ(jsonOf(scantrove({"session", "show", "--json", folder / "out"}))["refined"], true);
  const Finished again = scantrove({"session", "refine", folder / "out"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.out, HasSubstr("refined already"));
}

/// Over labels-final/ of frames 0 - 29 of two scans: the number of different pixels, and of all pixels.
std::pair<int, int> differentLabels(const fs::path& a, const fs::path& b) {
  std::pair<int, int> counts{0, 0};
  for (int frame = 0; frame < 30; ++frame) {
    const fs::path name = fs::path("labels-final") / (std::to_string(1'000'000 + frame).substr(1) + ".png");
    const auto first = readLabelImage(a / name), second = readLabelImage(b / name);
    if (!first || !second || first->size() != second->size()) {
      ADD_FAILURE() << name;
      continue;
    }
    counts.first += cv::countNonZero(*first != *second);
    counts.second += static_cast<int>(first->total());
  }
  return counts;
}

TEST(ScanRefinement, WritesFinalLabelsAgain_WhenDoneLater) {
  const TemporaryFolder folder;
  for (const char* name : {"at once", "later"}) {
    std::vector<std::string> arguments = argumentsInto(folder / name);
    arguments.push_back("--label-maps");
    if (name == std::string("later")) arguments.push_back("--skip-refinement");
    ASSERT_EQ(scantrove(arguments).exit_code, 0);
  }
  const auto before = differentLabels(folder / "at once", folder / "later");
  ASSERT_GT(before.first, before.second / 1000) << "refinement changes no labels: the test shows nothing";
  // A user has corrected one image before the refinement.
  const fs::path corrected = folder / "later/labels-final/000012.png";
  const std::string by_user = readText(folder / "later/segments/000012.png");
  std::ofstream(corrected, std::ios::binary) << by_user;

  const Finished refined = scantrove({"session", "refine", folder / "later"});
  ASSERT_EQ(refined.exit_code, 0) << refined.err;
  EXPECT_EQ(readText(corrected), by_user);
  EXPECT_THAT(refined.err, HasSubstr("did not write 1 image in "));
  fs::copy_file(folder / "at once/labels-final/000012.png", corrected, fs::copy_options::overwrite_existing);
  // A few voxels at borders may differ.
  const auto after = differentLabels(folder / "at once", folder / "later");
  EXPECT_LT(after.first, after.second / 1000);
}

TEST(ScanRefinement, IsCutShortByASignal_AndResultsAreKept) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    ChildProcess child(command(argumentsInto(folder / "out")));
    const auto end = std::chrono::steady_clock::now() + 180s;
    while (child.err().find("Refining objects") == std::string::npos && child.isRunning() &&
           std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(20ms);
    child.kill(signal);
    EXPECT_EQ(child.wait(), 0) << child.err();
    EXPECT_THAT(child.err(), HasSubstr("Skipping the rest of the refinement"));
    EXPECT_EQ(refinementIn(folder / "out")["skipped"], true);
    EXPECT_TRUE(fs::exists(folder / "out/cloud.ply"));
    EXPECT_EQ(scantrove({"session", "refine", folder / "out"}).exit_code, 0);
    EXPECT_EQ(refinementIn(folder / "out")["skipped"], false);
  }
}

TEST(SessionRefine, RefusesAMissingFolder) {
  const TemporaryFolder folder;
  expectJobFailure(scantrove({"session", "refine", folder / "nothing"}), {"nothing"});
}

}  // namespace
}  // namespace scantrove::test
