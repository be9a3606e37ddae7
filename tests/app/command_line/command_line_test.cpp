// The parser alone: options and values are checked before any command starts, so no program is run here.
#include "app/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/project/project.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

CommandLine parse(const std::vector<std::string>& arguments) {
  std::vector<const char*> argv{"scantrove"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  return parseCommandLine(static_cast<int>(argv.size()), argv.data());
}

CommandLine parseScan(const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"scan", "demo", "--out", "out"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return parse(arguments);
}

/// One message for stderr that holds all of `words`; no command and no text for stdout.
void expectRefused(const CommandLine& line, const std::vector<std::string>& words) {
  EXPECT_EQ(line.exit_code, kWrongUsage);
  EXPECT_FALSE(line.job);
  EXPECT_EQ(line.out, "");
  EXPECT_THAT(line.err, testing::StartsWith("scantrove: "));
  for (const std::string& word : words) EXPECT_THAT(line.err, HasSubstr(word));
}

void expectCommand(const CommandLine& line) {
  EXPECT_FALSE(line.exit_code) << line.err;
  EXPECT_TRUE(line.job);
}

TEST(CommandLine, HelpNamesEveryCommand) {
  const CommandLine line = parse({"--help"});
  EXPECT_EQ(line.exit_code, kDone);
  EXPECT_EQ(line.err, "");
  for (const char* name : {"scan", "evaluate", "objects", "bench", "devices", "params", "--version"}) {
    EXPECT_THAT(line.out, HasSubstr(name));
  }
}

TEST(CommandLine, HelpOfACommandNamesItsOptions) {
  const CommandLine line = parse({"scan", "--help"});
  EXPECT_EQ(line.exit_code, kDone);
  for (const char* name :
       {"--out", "--database", "--frames", "--start", "--stride", "--poses", "--intrinsics", "--depth-scale",
        "--config", "--set", "--device", "--label-maps"}) {
    EXPECT_THAT(line.out, HasSubstr(name));
  }
  EXPECT_THAT(line.out, HasSubstr("'freenect' (Kinect v1)"));
  EXPECT_THAT(line.out, HasSubstr("'realsense' (series D400)"));
  EXPECT_THAT(line.out, HasSubstr("'record3d' (iPhone"));
  EXPECT_THAT(parse({"devices", "--help"}).out, HasSubstr("--root DIR"));
  EXPECT_EQ(parse({"objects", "rename", "--help"}).exit_code, kDone);
}

TEST(CommandLine, OpensTheWindow_WithoutACommand) {
  const CommandLine line = parse({"demo", "--paused", "--window-size", "1400x900", "--frames", "7"});
  EXPECT_FALSE(line.exit_code) << line.err;
  EXPECT_FALSE(line.job);
  EXPECT_EQ(line.window.source, "demo");
  EXPECT_TRUE(line.window.start_paused);
  EXPECT_EQ(line.window.width, 1400);
  EXPECT_EQ(line.window.height, 900);
  EXPECT_EQ(line.window.source_options.frames, 7);
}

TEST(CommandLine, OpensTheProject_WhenSourceIsItsFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(createProject(folder / "kitchen", ""));
  std::filesystem::path file;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "kitchen")) {
    if (entry.path().extension() == ".json") file = entry.path();
  }
  const CommandLine line = parse({file.string()});
  EXPECT_FALSE(line.exit_code) << line.err;
  EXPECT_EQ(line.window.project, folder / "kitchen");
  EXPECT_EQ(line.window.source, "");
  expectRefused(parse({file.string(), "--project", folder.path().string()}), {"project", "Omit"});
}

TEST(CommandLine, ChecksTheOptionsOfAPicture) {
  expectCommand(parse({"render", "scan", "--out", "a.png", "--size", "800x600", "--from", "-45,20"}));
  expectCommand(parse({"render", "scan", "--out", "a.webm", "--color", "objects", "--seconds", "0.5"}));
  expectRefused(parse({"render", "scan"}), {"--out"});
  expectRefused(parse({"render", "scan", "--out", "a.gif"}), {"a.gif", ".png", ".webm"});
  expectRefused(parse({"render", "scan", "--out", "a.png", "--size", "800"}), {"--size", "1280x720"});
  expectRefused(parse({"render", "scan", "--out", "a.png", "--size", "8x8"}), {"8x8", "16"});
  expectRefused(parse({"render", "scan", "--out", "a.png", "--from", "10"}), {"--from"});
  expectRefused(parse({"render", "scan", "--out", "a.png", "--from", "10,91"}), {"90"});
  expectRefused(parse({"render", "scan", "--out", "a.png", "--color", "heat"}), {"--color"});
  expectRefused(parse({"render", "scan", "--out", "a.webm", "--seconds", "100000"}), {"36000"});
}

TEST(CommandLine, RefusesUnknownAndMissingArguments) {
  expectRefused(parse({"fold-laundry"}), {"fold-laundry"});
  expectRefused(parse({"scan", "demo", "--out", "x", "--fast"}), {"--fast"});
  expectRefused(parse({"--frames", "3", "scan", "demo", "--out", "x"}), {"--frames must follow the command"});
  expectRefused(parse({"scan", "--out", "x"}), {"SOURCE"});
  expectRefused(parse({"scan", "demo"}), {"--out", "--resume"});
  expectRefused(parse({"record", "demo"}), {"--out"});
  expectRefused(parse({"objects"}), {"subcommand"});
  expectCommand(parse({"objects", "list"}));
  expectRefused(parse({"session", "refine"}), {"DIR"});
  expectRefused(parse({"evaluate"}), {"subcommand"});
  expectRefused(parse({"evaluate", "trajectory", "--estimate", "x"}), {"--truth"});
  expectRefused(parse({"evaluate", "catalogue", "--scan", "x"}), {"--truth"});
  expectRefused(parse({"evaluate", "recognition"}), {"folder"});
  expectRefused(parse({"evaluate", "recognition", "x", "--views", "0"}), {"--views", "whole number"});
}

TEST(CommandLine, RefusesEmptyArguments) {
  for (const char* option :
       {"--database", "--intrinsics", "--config", "--set", "--device", "--color-registration",
        "--depth-topic", "--color-topic", "--poses", "--resume", "--depth-scale", "--frames"}) {
    expectRefused(parseScan({option, ""}), {option});
  }
  expectRefused(parse({"scan", "", "--out", "out"}), {"SOURCE is empty"});
  expectRefused(parse({"bench", ""}), {"SOURCE is empty"});
  expectRefused(parse({"record", "", "--out", "out"}), {"SOURCE is empty"});
  expectRefused(parse({"export", "scan", "--format", "ply", "--out", ""}), {"--out", "is empty"});
  expectRefused(parse({"session", "show", ""}), {"DIR", "is empty"});
  expectRefused(parse({"objects", "list", "--database", ""}), {"--database", "is empty"});
  expectRefused(parse({"evaluate", "trajectory", "--estimate", "", "--truth", "x"}), {"--estimate"});
}

TEST(CommandLine, AcceptsAnEmptyName) {
  expectCommand(parse({"session", "name", "scan", "--region", "1", "--name", ""}));
}

TEST(CommandLine, BackgroundTakesRegionsOrTheProposedOnes) {
  expectCommand(parse({"session", "background", "scan", "3", "12"}));
  expectCommand(parse({"session", "background", "scan", "3", "--off"}));
  expectCommand(parse({"session", "background", "scan", "--proposed"}));
  expectRefused(parse({"session", "background", "scan"}), {"--proposed", "Give one of them"});
  expectRefused(parse({"session", "background", "scan", "3", "--proposed"}),
                {"--proposed", "Give one of them"});
  expectRefused(parse({"session", "background", "scan", "--proposed", "--off"}),
                {"--off", "numbers of regions"});
}

TEST(CommandLine, RefusesArguments_WhenTheyAreNotUtf8) {
  expectRefused(parse({"scan", "demo", "--out", "out\xFF"}), {"--out", "is not UTF-8"});
  expectRefused(parse({"session", "name", "scan", "--region", "1", "--name", "\xFF"}), {"name"});
}

TEST(CommandLine, RefusesNumbersOutOfRange) {
  expectRefused(parseScan({"--frames", "0"}), {"--frames"});
  expectRefused(parseScan({"--frames", "many"}), {"--frames", "whole number from 1"});
  expectRefused(parseScan({"--frames", "1.5"}),
                {"--frames", "'1.5' is not a whole number from 1 to 2147483647"});
  expectRefused(parseScan({"--start", "99999999999"}), {"--start", "whole number"});
  expectRefused(parseScan({"--start", "-1"}), {"--start"});
  expectRefused(parseScan({"--stride", "0"}), {"--stride"});
  expectRefused(parseScan({"--poses", "guessed"}), {"--poses"});
  expectRefused(parseScan({"--depth-scale", "0"}), {"--depth-scale"});
}

TEST(CommandLine, PosesAreAutomatic_UnlessSaid) {
  using Poses = ScanRequest::Poses;
  EXPECT_EQ(parse({"demo"}).window.poses, Poses::automatic);
  EXPECT_EQ(parse({"demo", "--poses", "auto"}).window.poses, Poses::automatic);
  EXPECT_EQ(parse({"demo", "--poses", "tracked"}).window.poses, Poses::tracked);
  EXPECT_EQ(parse({"demo", "--poses", "given"}).window.poses, Poses::given);
}

TEST(CommandLine, RefusesCameras_WhenTheyAreImpossible) {
  expectRefused(parseScan({"--intrinsics", "525,525"}), {"--intrinsics", "4 numbers"});
  expectRefused(parseScan({"--intrinsics", "a,b,c,d"}), {"--intrinsics", "fx,fy,cx,cy"});
  expectRefused(parseScan({"--intrinsics", "0,525,319.5,239.5"}), {"--intrinsics", "positive"});
  expectRefused(parseScan({"--intrinsics", "525,nan,319.5,239.5"}), {"--intrinsics"});
  expectRefused(parseScan({"--color-registration", "nearby"}),
                {"--color-registration", "'nearby'", "registered, kinect", "fx,fy,cx,cy"});
  expectRefused(parseScan({"--color-registration", "525,0,320,240,0.025"}),
                {"--color-registration", "positive"});
  expectRefused(parseScan({"--color-registration", "525,525,320,240,25"}), {"more than 1 m away"});
}

TEST(CommandLine, RefusesParameters_WhenKeyOrValueIsWrong) {
  expectRefused(parseScan({"--set", "segmentation.kk=1"}), {"segmentation.kk", "segmentation.k"});
  expectRefused(parseScan({"--set", "segmentation.k=1000"}), {"segmentation.k"});
  expectRefused(parseScan({"--set", "segmentation.k=soft"}), {"segmentation.k"});
  expectRefused(parseScan({"--set", "="}), {"key=value"});
  expectRefused(parseScan({"--set", "segmentation.k"}), {"key=value"});
  expectRefused(parseScan({"--set", "detection.max_views=1.5"}), {"detection.max_views", "whole number"});
}

TEST(CommandLine, RefusesConfiguration_WhenTheFileCannotBeRead) {
  const TemporaryFolder folder;
  expectRefused(parseScan({"--config", folder / "missing.toml"}), {"missing.toml"});
  expectRefused(parse({"params", "--config", folder.write("bad.toml", "[segmentation]\nk = = 1\n")}),
                {"bad.toml"});
  const std::string loop = folder / "loop";
  std::filesystem::create_symlink("loop", loop);
  expectRefused(parse({"params", "--config", loop}), {loop, "symbolic links"});
}

// An option that may be repeated takes one value each time: the next argument is the source.
TEST(CommandLine, AcceptsSettingsBeforeTheSource) {
  expectCommand(parse({"scan", "--set", "segmentation.k=0.25", "--set", "segmentation.min_pixels=33", "demo",
                       "--out", "out"}));
}

TEST(CommandLine, RefusesExports_WhenOptionsContradict) {
  expectRefused(parse({"export", "scan", "--format", "word", "--out", "x"}), {"word"});
  expectRefused(parse({"export", "scan", "--database", "db", "--out", "x"}), {"DIR"});
  expectRefused(parse({"export", "--out", "x"}), {"--database"});
  expectRefused(parse({"export", "scan", "--format", "coco"}), {"--out"});
  expectRefused(parse({"export", "scan", "--project", "p", "--format", "coco", "--out", "x"}), {"DIR"});
  expectRefused(parse({"export", "scan", "--scan", "a", "--format", "coco", "--out", "x"}), {"--project"});
  expectRefused(parse({"export", "scan", "--split", "1,0,0", "--format", "coco", "--out", "x"}), {"yolo"});
  expectRefused(parse({"export", "scan", "--split", "0.5,0,0.5", "--format", "yolo", "--out", "x"}),
                {"test"});
  expectRefused(parse({"export", "--project", "p", "--split", "0.5,0.6", "--format", "coco", "--out", "x"}),
                {"--split"});
  expectRefused(parse({"export", "--project", "p", "--seed", "1", "--format", "coco", "--out", "x"}),
                {"--split"});
  expectRefused(
      parse({"export", "--project", "p", "--train", "a", "--val", "a", "--format", "coco", "--out", "x"}),
      {"given twice"});
  expectRefused(parse({"export", "--project", "p", "--train", "a", "--split", "1,0,0", "--format", "coco",
                       "--out", "x"}),
                {"--split"});
  expectRefused(parse({"export", "--project", "p", "--centred", "--format", "mesh", "--out", "x"}),
                {"--centred"});
  expectRefused(parse({"export", "--database", "db", "--only", "named", "--out", "x"}), {"--database"});
  expectCommand(parse({"export", "--class", "a", "--class", "b", "scan", "--format", "coco", "--dry-run"}));
  expectCommand(parse({"export", "--project", "p", "--split", "train=0.8,val=0.2", "--seed", "3", "--format",
                       "bop", "--unlabeled", "ignore", "--out", "x"}));
  expectRefused(parse({"export", "--database", "db", "--include-blurred", "--out", "x"}),
                {"--include-unfit-frames"});
  expectRefused(parse({"export", "--database", "db", "--format", "coco", "--out", "x"}), {"--format"});
  expectRefused(parse({"export", "--database", "db", "--license", "CC0", "--out", "x"}), {"--license"});
  expectRefused(parse({"export", "scan", "--out", "x"}), {"--format"});
  expectRefused(parse({"export", "scan", "--format", "ply", "--centred", "--out", "x"}), {"--centred"});
  for (const char* format : {"ply", "coco", "bop", "scannet"}) {
    expectRefused(parse({"export", "scan", "--format", format, "--texture", "--out", "x"}),
                  {"--texture", "--format mesh"});
  }
  expectRefused(parse({"export", "scan", "--format", "mesh", "--texture-size", "512", "--out", "x"}),
                {"--texture"});
  expectRefused(
      parse({"export", "scan", "--format", "mesh", "--texture", "--texture-size", "9000", "--out", "x"}),
      {"--texture-size"});
}

TEST(CommandLine, AcceptsEveryFormatOfExports) {
  for (const char* format : {"coco", "bop", "yolo", "masks", "voc", "labelstudio", "boxes", "foundationpose",
                             "ply", "pcd", "mesh", "tum", "scannet"}) {
    expectCommand(
        parse({"export", "scan", "--format", format, "--license", "CC BY 4.0", "--json", "--out", "x"}));
  }
}

TEST(CommandLine, SuggestionsNeedAFolderOfMasks) {
  expectCommand(parse({"session", "suggest", "scan", "--masks", "masks"}));
  expectCommand(parse({"session", "suggest", "scan", "--masks", "masks", "--apply", "--min-frames", "2",
                       "--json", "--no-catalogue"}));
  expectRefused(parse({"session", "suggest", "scan"}), {"--masks"});
  expectRefused(parse({"session", "suggest", "--masks", "masks"}), {"DIR"});
  expectRefused(parse({"session", "suggest", "scan", "--masks", ""}), {"--masks", "is empty"});
  expectRefused(parse({"session", "suggest", "scan", "--masks", "masks", "--min-frames", "0"}),
                {"--min-frames", "whole number from 1"});
  expectRefused(parse({"session", "show", "scan", "--masks", "masks"}), {"--masks"});
}

TEST(CommandLine, PaintTakesOneMaskAndOneMode) {
  const auto paint = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"session", "paint", "scan", "--frame", "12", "--region", "5"});
    return parse(options);
  };
  expectCommand(paint({"--add", "mask.png"}));
  expectCommand(paint({"--remove", "--polygon", "1,1,9,1,5,9", "--polygon", "3,3,5,3,4,5"}));
  expectCommand(paint({"--set", "mask.png", "--this-image-only", "--no-catalogue", "--json"}));
  expectRefused(paint({"mask.png"}), {"--add", "Give one of them"});
  expectRefused(paint({"--add", "--set", "mask.png"}), {"--add", "Give one of them"});
  expectRefused(paint({"--add"}), {"MASK", "Give one of them"});
  expectRefused(paint({"--add", "mask.png", "--polygon", "1,1,9,1,5,9"}), {"MASK", "Give one of them"});
  expectRefused(paint({"--add", ""}), {"MASK", "is empty"});
  expectRefused(parse({"session", "paint", "scan", "mask.png", "--add", "--region", "5"}), {"--frame"});
  expectRefused(parse({"session", "paint", "scan", "mask.png", "--add", "--frame", "12"}), {"--region"});
  expectCommand(parse({"session", "masks", "scan", "--frame", "12", "--out", "masks.png"}));
  expectRefused(parse({"session", "masks", "scan", "--frame", "12"}), {"--out"});
}

TEST(CommandLine, RefusesSegmentationEvaluation_WithoutOneTruthPerScan) {
  const auto evaluate = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"evaluate", "segmentation", "--truth", "truth"});
    return parse(arguments);
  };
  expectCommand(evaluate({"--scan", "scan"}));
  expectCommand(evaluate({"--estimate", "labels"}));
  expectRefused(evaluate({}), {"--scan"});
  expectRefused(evaluate({"--scan", "scan", "--estimate", "scan"}), {"--scan"});
  expectRefused(evaluate({"--scan", "scan", "--scan", "scan"}), {"each scan with its truth"});
  expectCommand(evaluate({"--scan", "scan", "--with-estimated"}));
  expectRefused(evaluate({"--estimate", "labels", "--with-estimated"}), {"--with-estimated", "--scan"});
}

TEST(CommandLine, RefusesScreenshot_WhenTheFileExists) {
  const TemporaryFolder folder;
  const std::string file = folder.write("picture.png", "a user's");
  expectRefused(parse({"demo", "--screenshot", file}), {"--screenshot", file});
}

}  // namespace
}  // namespace scantrove::test
