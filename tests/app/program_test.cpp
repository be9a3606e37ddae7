#include "core/capture/freenect_source.h"
#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

// The parser's own tests are in command_line/: here are exit codes and streams.
TEST(Program, PrintsHelpAndVersionOnStdout) {
  const Finished help = scantrove({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.err, "");
  EXPECT_THAT(help.out, HasSubstr("--version"));
  const Finished version = scantrove({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, testing::MatchesRegex("scantrove [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Program, ReportsWrongUsageOnStderr_AndWritesNoFile) {
  const TemporaryFolder folder;
  expectWrongUsage(scantrove({"scan", "demo", "--frames", "0", "--out", folder / "out"}), {"--frames"});
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Program, FailsWithoutWritableStdout) {
  for (const std::string arguments : {"params", "--help"}) {
    const Finished run = runProgram({"sh", "-c", "exec " SCANTROVE_BINARY " " + arguments + " > /dev/full"});
    EXPECT_EQ(run.exit_code, 1) << arguments;
    EXPECT_THAT(run.err, testing::StartsWith("scantrove: Cannot write to the standard output")) << arguments;
  }
}

TEST(Scan, RefusesCatalogue_WhenItIsNoFile) {
  const TemporaryFolder folder;
  expectJobFailure(
      scantrove({"scan", "demo", "--frames", "1", "--out", folder / "out", "--database", ":memory:"}),
      {"':memory:' is no file"});
}

TEST(OutputFolder, IsRefused_WhenItIsABrokenLink) {
  const TemporaryFolder folder;
  const std::string link = folder / "link";
  std::filesystem::create_symlink("nowhere", link);
  expectJobFailure(scantrove({"scan", "demo", "--frames", "1", "--out", link}),
                   {link, "nowhere, which does not exist"});
  expectJobFailure(scantrove({"record", "demo", "--frames", "1", "--out", link}),
                   {link, "nowhere, which does not exist"});
}

TEST(Scan, RefusesSource_WhenItIsASavedScan) {
  const TemporaryFolder folder;
  folder.write("scan/session.sqlite", "");
  expectJobFailure(scantrove({"scan", folder / "scan", "--out", folder / "out"}),
                   {"is a scan, not a recording", "scantrove " + (folder / "scan").string()});
}

// The link leads to itself.
TEST(Program, NamesALinkLoop_InEveryPathArgument) {
  const TemporaryFolder folder;
  const std::string loop = folder / "loop";
  std::filesystem::create_symlink("loop", loop);
  const std::vector<std::string> words{loop, "symbolic links"};
  expectJobFailure(scantrove({"scan", loop, "--out", folder / "out"}), words);
  expectJobFailure(scantrove({"scan", "demo", "--out", loop}), words);
  expectJobFailure(scantrove({"evaluate", "trajectory", "--estimate", loop, "--truth", loop}), words);
  expectJobFailure(scantrove({"evaluate", "segmentation", "--estimate", loop, "--truth", loop}), words);
  std::filesystem::create_directory(folder / "labels");
  std::filesystem::create_symlink("1.png", folder / "labels/1.png");
  const std::string labels = folder / "labels";
  expectJobFailure(scantrove({"evaluate", "segmentation", "--estimate", labels, "--truth", labels}),
                   {labels + "/1.png", "symbolic links"});
}

TEST(Params, ListsDefaultUnitAndRangeOfEach) {
  const Finished run = scantrove({"params"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("segmentation.k"));
  EXPECT_THAT(run.out, HasSubstr("fusion.voxel_size_m"));
  const auto params = jsonOf(scantrove({"params", "--json"}));
  ASSERT_TRUE(params.is_array());
  for (const auto& entry : params) {
    EXPECT_EQ(entry["value"], entry["default"]);
    EXPECT_NE(entry["help"], "");
    EXPECT_TRUE(entry.contains("unit"));
    int kinds = 0;
    for (const char* kind : {"range", "choices", "file"}) kinds += entry.contains(kind) ? 1 : 0;
    EXPECT_EQ(kinds, 1) << entry;
  }
}

TEST(Params, SettingsOverrideTheConfigurationFile) {
  const TemporaryFolder folder;
  const auto config = folder.write("c.toml", "[segmentation]\nk = 0.5\nmin_pixels = 33\n");
  const auto params =
      jsonOf(scantrove({"params", "--json", "--config", config, "--set", "segmentation.k=0.25"}));
  double k = 0, min_pixels = 0;
  for (const auto& entry : params) {
    if (entry["key"] == "segmentation.k") k = entry["value"];
    if (entry["key"] == "segmentation.min_pixels") min_pixels = entry["value"];
  }
  EXPECT_EQ(k, 0.25);
  EXPECT_EQ(min_pixels, 33);
}

TEST(Devices, ListsOpenClDevicesCamerasAndUsb) {
  const Finished run = scantrove({"devices"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("[0] "));
  EXPECT_THAT(run.out, HasSubstr("Cameras"));
  const auto json = jsonOf(scantrove({"devices", "--json"}));
  EXPECT_FALSE(json["opencl"].empty());
  EXPECT_TRUE(json["cameras"].is_array());
  EXPECT_TRUE(json["usb"].is_array());
}

// An Asus Xtion at a USB 1 port.
TEST(Devices, ReportsProblemsOfACameraOnUsb) {
  const TemporaryFolder folder;
  EXPECT_THAT(scantrove({"devices", "--root", folder.path()}).out, HasSubstr("no known camera"));
  for (const auto& [name, text] : {std::pair{"idVendor", "1d27"},
                                   {"idProduct", "0601"},
                                   {"busnum", "3"},
                                   {"devnum", "12"},
                                   {"speed", "12"}}) {
    folder.write(std::string("sys/bus/usb/devices/3-1/") + name, std::string(text) + "\n");
  }
  const Finished run = scantrove({"devices", "--root", folder.path()});
  EXPECT_EQ(run.exit_code, 0);
  for (const char* words : {"1d27:0601 Asus Xtion Pro Live, bus 3 device 12, 12 Mbit/s", "driver: OpenNI2",
                            "PROBLEM: There is no /dev/bus/usb/003/012", "PROBLEM: It is connected at 12"}) {
    EXPECT_THAT(run.out, HasSubstr(words));
  }
  folder.write("dev/bus/usb/003/012", "");
  const auto json = jsonOf(scantrove({"devices", "--json", "--root", folder.path()}));
  ASSERT_EQ(json["usb"].size(), 1U);
  const auto& xtion = json["usb"][0];
  EXPECT_EQ(xtion["id"], "1d27:0601");
  EXPECT_EQ(xtion["driver"], "OpenNI2");
  EXPECT_EQ(xtion["node"], "/dev/bus/usb/003/012");
  EXPECT_EQ(xtion["may_open"], true);
  ASSERT_EQ(xtion["problems"].size(), 1U);
  EXPECT_NE(xtion["problems"][0]["advice"], "");
}

// Debian's fakenect replaces libfreenect and counts one camera; it cannot give depth in mm.
TEST(Devices, ListsAKinect) {
  const std::filesystem::path fakenect = "/usr/lib/x86_64-linux-gnu/fakenect";
  if (!hasFreenect()) GTEST_SKIP() << "This build is without libfreenect.";
  if (!std::filesystem::exists(fakenect)) GTEST_SKIP() << "There is no " << fakenect;
  const std::map<std::string, std::string> environment{{"LD_LIBRARY_PATH", fakenect}};
  EXPECT_THAT(scantrove({"devices"}, environment).out,
              HasSubstr("camera:freenect:0  Microsoft Kinect v1 (libfreenect)"));
  const auto json = jsonOf(scantrove({"devices", "--json"}, environment));
  ASSERT_FALSE(json["cameras"].empty());
  EXPECT_EQ(json["cameras"].back()["uri"], "freenect:0");
  EXPECT_EQ(json["cameras"].back()["driver"], "libfreenect");
}

TEST(Scan, Fails_WithoutAKinect) {
  if (const auto kinects = listFreenectCameras(); kinects && !kinects->empty())
    GTEST_SKIP() << "A Kinect is plugged in here.";
  const TemporaryFolder folder;
  expectJobFailure(scantrove({"scan", "freenect", "--out", folder / "out"}),
                   {hasFreenect() ? "No Kinect v1" : "libfreenect"});
}

TEST(Devices, NamesThePackageToInstall_WithoutAnOpenClDriver) {
  const Finished run = scantrove({"devices"}, {{"OCL_ICD_VENDORS", "/nonexistent-folder-of-drivers/"}});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("pocl-opencl-icd"));
}

}  // namespace
}  // namespace scantrove::test
