#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "core/image/png_encoder.h"
#include "tests/app/scantrove_program.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Finished scanInto(const fs::path& out, const std::string& source = "demo",
                  const std::vector<std::string>& options = {}) {
  std::vector<std::string> arguments{"scan", source, "--frames", "3", "--out", out.string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return scantrove(arguments);
}

int framesIn(const fs::path& session) {
  return jsonOf(scantrove({"session", "show", session.string(), "--json"}))["tracked"];
}

void expectUnchanged(const fs::path& out, const std::string& report, const std::string& command) {
  EXPECT_EQ(framesIn(out), 3) << command;
  EXPECT_EQ(readText(out / "report.json"), report) << command;
  EXPECT_FALSE(fs::is_empty(out / "keyframes")) << command;
  EXPECT_FALSE(fs::is_empty(out / "map")) << command;
}

TEST(ScanFolder, KeepsTheEarlierScan_WhenTheNewOneHasNoUsableFrame) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  ASSERT_EQ(scanInto(out).exit_code, 0);
  const std::string report = readText(out / "report.json");

  EXPECT_EQ(scanInto(out, "demo", {"--database", folder / "missing/objects.sqlite"}).exit_code, 1);
  expectUnchanged(out, report, "a mistyped catalogue");
  EXPECT_EQ(scanInto(out, folder / "missing").exit_code, 1);
  expectUnchanged(out, report, "a mistyped source");
  const std::string black = encodePng(cv::Mat(240, 320, CV_16UC1, cv::Scalar(0)));
  for (const char* name : {"black/depth/000000.png", "black/depth/000001.png"}) folder.write(name, black);
  EXPECT_EQ(scanInto(out, folder / "black", {"--intrinsics", "300,300,160,120"}).exit_code, 1);
  expectUnchanged(out, report, "depth images without depth");
}

TEST(ScanFolder, ReplacesTheEarlierScan_WhenTheNewOneHasFrames) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  ASSERT_EQ(scanInto(out).exit_code, 0);
  const Finished run = scanInto(out, "demo:wall");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(framesIn(out), 3);
  EXPECT_EQ(Json::parse(readText(out / "report.json"))["source"], "demo:wall");
}

TEST(ScanFolder, RefusesForeignFiles_WithoutOverwrite) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  ASSERT_EQ(scanInto(out).exit_code, 0);
  folder.write("out/keyframes/holiday.jpg", "mine");
  expectJobFailure(scanInto(out), {(out / "keyframes/holiday.jpg").string(), "--overwrite"});
  EXPECT_EQ(framesIn(out), 3);
  EXPECT_EQ(scanInto(out, "demo", {"--overwrite"}).exit_code, 0);
  EXPECT_EQ(readText(out / "keyframes/holiday.jpg"), "mine") << "no scan writes that file";
}

TEST(ScanFolder, RefusesTheFolderOfARecording_WithoutOverwrite) {
  const TemporaryFolder folder;
  for (const char* name : {"trajectory.txt", "labels.json", "labels/000000.png", "map/plan.png"}) {
    const std::string subfolder = "of-" + fs::path(name).filename().string();
    folder.write(subfolder + "/" + name, "mine");
    for (const char* option : {"--no-session", "--label-maps"})
      expectJobFailure(scanInto(folder / subfolder, "demo", {option}),
                       {(folder / subfolder).string(), "--overwrite"});
    EXPECT_EQ(readText(folder / subfolder / name), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / subfolder), fs::directory_iterator()), 1);
  }
  EXPECT_EQ(scanInto(folder / "of-trajectory.txt", "demo", {"--overwrite"}).exit_code, 0);
  EXPECT_NE(readText(folder / "of-trajectory.txt/trajectory.txt"), "mine");
}

}  // namespace
}  // namespace scantrove::test
