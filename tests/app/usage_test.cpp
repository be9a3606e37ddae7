#include "core/capture/freenect_source.h"
#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

TEST(Usage, HelpNamesEveryCommand) {
  const Finished run = scantrove({"--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  for (const char* name : {"scan", "evaluate", "objects", "bench", "devices", "params", "--version"}) {
    EXPECT_THAT(run.out, HasSubstr(name));
  }
}

TEST(Usage, HelpOfACommandNamesItsOptions) {
  const Finished run = scantrove({"scan", "--help"});
  EXPECT_EQ(run.exit_code, 0);
  for (const char* name :
       {"--out", "--database", "--frames", "--start", "--stride", "--poses", "--intrinsics", "--depth-scale",
        "--config", "--set", "--device", "--label-maps"}) {
    EXPECT_THAT(run.out, HasSubstr(name));
  }
  EXPECT_THAT(run.out, HasSubstr("'freenect' (Kinect v1)"));
  EXPECT_THAT(scantrove({"devices", "--help"}).out, HasSubstr("--root DIR"));
  EXPECT_EQ(scantrove({"objects", "rename", "--help"}).exit_code, 0);
}

TEST(Usage, VersionIsOneLine) {
  const Finished run = scantrove({"--version"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, testing::MatchesRegex("scantrove [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Usage, RefusesSource_WhenItIsEmpty) {
  const TemporaryFolder folder;
  expectWrongUsage(scantrove({"scan", "", "--out", folder / "out"}), {"SOURCE is empty"});
  expectWrongUsage(scantrove({"bench", ""}), {"SOURCE is empty"});
  expectWrongUsage(scantrove({"record", "", "--out", folder / "out"}), {"SOURCE is empty"});
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Usage, EmptyArgumentsAndThoseThatAreNotUtf8AreWrongUsage) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  for (const char* option : {"--database", "--intrinsics", "--config", "--set", "--device",
                             "--color-registration", "--poses", "--resume", "--depth-scale", "--frames"}) {
    expectWrongUsage(scantrove({"scan", "demo", "--frames", "1", "--out", out, option, ""}), {option});
    EXPECT_FALSE(std::filesystem::exists(out)) << option;
  }
  expectWrongUsage(scantrove({"export", folder.path(), "--format", "ply", "--out", ""}),
                   {"--out", "is empty"});
  expectWrongUsage(scantrove({"session", "show", ""}), {"DIR", "is empty"});
  expectWrongUsage(scantrove({"objects", "list", "--database", ""}), {"--database", "is empty"});
  expectWrongUsage(scantrove({"evaluate", "trajectory", "--estimate", "", "--truth", out}), {"--estimate"});
  expectWrongUsage(scantrove({"scan", "demo", "--out", out + "\xFF"}), {"--out", "is not UTF-8"});
  expectJobFailure(scantrove({"scan", "demo", "--frames", "1", "--out", out, "--database", ":memory:"}),
                   {"':memory:' is no file"});
}

TEST(Usage, ALinkThatLeadsNowhereIsNoFolderForResults) {
  const TemporaryFolder folder;
  const std::string link = folder / "link";
  std::filesystem::create_symlink("nowhere", link);
  expectJobFailure(scantrove({"scan", "demo", "--frames", "1", "--out", link}),
                   {link, "nowhere, which does not exist"});
  expectJobFailure(scantrove({"record", "demo", "--frames", "1", "--out", link}),
                   {link, "nowhere, which does not exist"});
}

TEST(Usage, AScanIsNoRecording) {
  const TemporaryFolder folder;
  folder.write("scan/session.sqlite", "");
  expectJobFailure(scantrove({"scan", folder / "scan", "--out", folder / "out"}),
                   {"is a scan, not a recording", "scantrove " + (folder / "scan").string()});
}

TEST(Usage, WhatIsNotUnderstoodIsNamed) {
  expectWrongUsage(scantrove({"fold-laundry"}), {"fold-laundry"});
  expectWrongUsage(scantrove({"scan", "demo", "--out", "x", "--fast"}), {"--fast"});
  expectWrongUsage(scantrove({"scan", "--out", "x"}), {"SOURCE"});
  expectWrongUsage(scantrove({"scan", "demo"}), {"--out"});
  expectWrongUsage(scantrove({"objects"}), {"subcommand"});
  expectWrongUsage(scantrove({"objects", "list"}), {"--database"});
  expectWrongUsage(scantrove({"evaluate"}), {"subcommand"});
  expectWrongUsage(scantrove({"evaluate", "trajectory", "--estimate", "x"}), {"--truth"});
}

TEST(Usage, ValuesAreChecked) {
  const TemporaryFolder folder;
  const auto scan = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"scan", "demo", "--out", folder / "out"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return scantrove(arguments);
  };
  expectWrongUsage(scan({"--frames", "0"}), {"--frames"});
  expectWrongUsage(scan({"--frames", "many"}), {"--frames", "whole number from 1"});
  expectWrongUsage(scan({"--frames", "1.5"}),
                   {"--frames", "'1.5' is not a whole number from 1 to 2147483647"});
  expectWrongUsage(scan({"--start", "99999999999"}), {"--start", "whole number"});
  expectWrongUsage(scan({"--start", "-1"}), {"--start"});
  expectWrongUsage(scan({"--stride", "0"}), {"--stride"});
  expectWrongUsage(scan({"--poses", "guessed"}), {"--poses"});
  expectWrongUsage(scan({"--depth-scale", "0"}), {"--depth-scale"});
  expectWrongUsage(scan({"--intrinsics", "525,525"}), {"--intrinsics", "4 numbers"});
  expectWrongUsage(scan({"--intrinsics", "a,b,c,d"}), {"--intrinsics", "fx,fy,cx,cy"});
  expectWrongUsage(scan({"--color-registration", "nearby"}),
                   {"--color-registration", "'nearby'", "registered, kinect", "fx,fy,cx,cy"});
  expectWrongUsage(scan({"--color-registration", "525,0,320,240,0.025"}),
                   {"--color-registration", "positive"});
  expectWrongUsage(scan({"--color-registration", "525,525,320,240,25"}), {"more than 1 m away"});
  expectWrongUsage(scan({"--intrinsics", "0,525,319.5,239.5"}), {"--intrinsics", "positive"});
  expectWrongUsage(scan({"--intrinsics", "525,nan,319.5,239.5"}), {"--intrinsics"});
  expectWrongUsage(scan({"--config", "missing.toml"}), {"missing.toml"});
  expectWrongUsage(scan({"--set", "segmentation.kk=1"}), {"segmentation.kk", "segmentation.k"});
  expectWrongUsage(scan({"--set", "segmentation.k=1000"}), {"segmentation.k"});
  expectWrongUsage(scan({"--set", "segmentation.k=soft"}), {"segmentation.k"});
  expectWrongUsage(scan({"--set", "="}), {"key=value"});
  expectWrongUsage(scan({"--set", "segmentation.k"}), {"key=value"});
  expectWrongUsage(scan({"--set", "detection.max_views=1.5"}), {"detection.max_views", "whole number"});
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// A link that leads to itself.
TEST(Usage, LinksThatGoInCirclesAreNamedWhereverAPathIsGiven) {
  const TemporaryFolder folder;
  const std::string loop = folder / "loop";
  std::filesystem::create_symlink("loop", loop);
  const std::vector<std::string> words{loop, "symbolic links"};
  expectJobFailure(scantrove({"scan", loop, "--out", folder / "out"}), words);
  expectJobFailure(scantrove({"scan", "demo", "--out", loop}), words);
  expectJobFailure(scantrove({"evaluate", "trajectory", "--estimate", loop, "--truth", loop}), words);
  expectJobFailure(scantrove({"evaluate", "segmentation", "--estimate", loop, "--truth", loop}), words);
  expectWrongUsage(scantrove({"params", "--config", loop}), words);
  std::filesystem::create_directory(folder / "labels");
  std::filesystem::create_symlink("1.png", folder / "labels/1.png");
  const std::string labels = folder / "labels";
  expectJobFailure(scantrove({"evaluate", "segmentation", "--estimate", labels, "--truth", labels}),
                   {labels + "/1.png", "symbolic links"});
}

TEST(Usage, RefusesAPictureInTheFileOfSomebody) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("picture.png", "a person's");
  expectWrongUsage(scantrove({"demo", "--screenshot", file}), {"--screenshot", file});
  EXPECT_EQ(readText(file), "a person's");
}

TEST(Usage, OutputThatCannotBeWrittenIsAFailure) {
  for (const std::string arguments :
       {"params", "params --json", "devices", "--help", "scan --help", "--version"}) {
    const Finished run = runProgram({"sh", "-c", "exec " SCANTROVE_BINARY " " + arguments + " > /dev/full"});
    EXPECT_EQ(run.exit_code, 1) << arguments;
    EXPECT_THAT(run.err, testing::StartsWith("scantrove: Cannot write to the standard output")) << arguments;
  }
}

TEST(Params, AreListedWithDefaultUnitAndRange) {
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
    EXPECT_TRUE(entry.contains("range") != entry.contains("choices"));
  }
}

TEST(Params, SettingsWinOverTheConfigurationFile) {
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
  expectWrongUsage(scantrove({"params", "--config", folder.write("bad.toml", "[segmentation]\nk = = 1\n")}),
                   {"bad.toml"});
}

TEST(Devices, AreListed) {
  const Finished run = scantrove({"devices"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("[0] "));
  EXPECT_THAT(run.out, HasSubstr("Cameras"));
  const auto json = jsonOf(scantrove({"devices", "--json"}));
  EXPECT_FALSE(json["opencl"].empty());
  EXPECT_TRUE(json["cameras"].is_array());
  EXPECT_TRUE(json["usb"].is_array());
}

/// A computer with an Asus Xtion at a port of USB 1.
TEST(Devices, SayWhatKeepsACameraFromWorking) {
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

/// Debian's fakenect takes libfreenect's place and counts one camera; it cannot give depth in mm.
TEST(Devices, ListAKinect) {
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

TEST(Devices, AKinectThatIsNotThereIsAFailure) {
  if (const auto kinects = listFreenectCameras(); kinects && !kinects->empty())
    GTEST_SKIP() << "A Kinect is plugged in here.";
  const TemporaryFolder folder;
  expectJobFailure(scantrove({"scan", "freenect", "--out", folder / "out"}),
                   {hasFreenect() ? "No Kinect v1" : "libfreenect"});
}

TEST(Devices, WithoutADriverSayWhatToInstall) {
  const Finished run = scantrove({"devices"}, {{"OCL_ICD_VENDORS", "/nonexistent-folder-of-drivers/"}});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("pocl-opencl-icd"));
}

}  // namespace
}  // namespace scantrove::test
