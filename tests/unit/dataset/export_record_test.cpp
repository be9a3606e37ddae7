#include "core/dataset/export_record.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "core/dataset/staged_folder.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;

/// A data set of masks in `home`/out, of a scene whose frames may change.
class ReplacedDatasetTest : public testing::Test {
 protected:
  ReplacedDatasetTest() { EXPECT_TRUE(write()); }

  Result<ExportSummary> write(DatasetFormat format = DatasetFormat::masks) {
    return exportDataset(scene_, {.format = format, .folder = home_ / "out"});
  }
  [[nodiscard]] std::vector<std::string> files() const { return Exported::filesIn(home_ / "out"); }
  void expectRefused(const Result<ExportSummary>& result, const std::string& named) {
    ASSERT_FALSE(result);
    EXPECT_TRUE(contains(result.error().what, (home_ / "out" / named).string())) << result.error().message();
    EXPECT_FALSE(result.error().advice.empty());
    EXPECT_EQ(std::distance(fs::directory_iterator(home_.path()), fs::directory_iterator()), 1)
        << "nothing was written";
  }

  TemporaryFolder home_;
  SmallScene scene_;
};

TEST_F(ReplacedDatasetTest, RecordsEachFile) {
  const auto record = ExportRecord::read(home_ / "out");
  ASSERT_TRUE(record && *record);
  EXPECT_EQ((*record)->format(), "masks");
  std::vector<std::string> recorded;
  for (const auto& [name, file] : (*record)->files()) {
    recorded.push_back(name.generic_string());
    EXPECT_EQ(file.bytes, fs::file_size(home_ / "out" / name));
  }
  std::ranges::sort(recorded);
  EXPECT_EQ(recorded, files());
}

TEST_F(ReplacedDatasetTest, ReplacesItsOwnFiles) {
  ASSERT_TRUE(fs::exists(home_ / "out/masks/000010.png"));
  scene_.frames = 1;
  scene_.labels[0].name = "marble";
  ASSERT_TRUE(write());
  EXPECT_FALSE(fs::exists(home_ / "out/masks/000010.png")) << "the frame is no longer exported";
  EXPECT_TRUE(contains(readText(home_ / "out/labels.json"), "marble"));
  EXPECT_FALSE(fs::exists(home_ / "out/.scantrove-unfinished"));
  EXPECT_EQ(std::distance(fs::directory_iterator(home_.path()), fs::directory_iterator()), 1);
}

TEST_F(ReplacedDatasetTest, IsWrittenAgain_WhenFilesWereRemoved) {
  const std::vector<std::string> before = files();
  fs::remove_all(home_ / "out/color");
  ASSERT_TRUE(write());
  EXPECT_EQ(files(), before);
}

TEST_F(ReplacedDatasetTest, RefusesForeignFiles) {
  home_.write("out/masks/mine.png", "mine");
  expectRefused(write(), "masks/mine.png");
  EXPECT_EQ(readText(home_ / "out/masks/mine.png"), "mine");
}

TEST_F(ReplacedDatasetTest, RefusesFoldersOfOthers) {
  fs::create_directory(home_ / "out/mine");
  expectRefused(write(), "mine");
}

TEST_F(ReplacedDatasetTest, RefusesChangedFiles) {
  const std::string text = readText(home_ / "out/labels.json");
  std::string other = text;
  other[other.find("ball")] = 'B';
  home_.write("out/labels.json", other);
  expectRefused(write(), "labels.json");
  EXPECT_EQ(readText(home_ / "out/labels.json"), other);
  home_.write("out/labels.json", text);
  EXPECT_TRUE(write()) << "it is as the export wrote it again";
}

// Files of a user that are called like the marker of unfinished exports.
TEST_F(ReplacedDatasetTest, RefusesAFileOfTheMarkersName_WhenItIsNotTheMarker) {
  const std::string marker = StagedFolder::kMarker;
  const std::string ours =
      "Scantrove has not finished this folder. The next export to the same place removes ";
  for (const std::string& text :
       {std::string(), std::string("mine"), ours + "out.\n", ours + "out.part-abc123.\nmine\n",
        ours + "out.part-abc123", ours + "a/out.part-abc123.\n", ours + ".part-abc123.\n",
        ours + "out.part-abc-23.\n", "mine\n" + ours + "out.part-abc123.\n", std::string(1 << 20, 'x')}) {
    home_.write("out/" + marker, text);
    expectRefused(write(), marker);
    EXPECT_EQ(readText(home_ / "out" / marker), text);
  }
  fs::remove(home_ / "out" / marker);
  fs::create_symlink("labels.json", home_ / "out" / marker);
  expectRefused(write(), marker);
  EXPECT_TRUE(fs::is_symlink(home_ / "out" / marker));
  fs::remove(home_ / "out" / marker);
  EXPECT_TRUE(write());
}

// A program that was killed right before it moved the old data set has left its marker there.
TEST_F(ReplacedDatasetTest, IsReplaced_WhenItHasOurMarker) {
  for (const char* text :
       {"Scantrove has not finished this folder. The next export to the same place removes "
        "out.part-abc123.\n",
        "Scantrove was replacing this data set. The next export to the same place restores "
        "or removes out.part-abc123.\n"}) {
    home_.write("out/.scantrove-unfinished", text);
    const auto written = write();
    ASSERT_TRUE(written) << written.error().message();
    EXPECT_FALSE(fs::exists(home_ / "out/.scantrove-unfinished"));
    EXPECT_EQ(std::distance(fs::directory_iterator(home_.path()), fs::directory_iterator()), 1);
  }
}

TEST_F(ReplacedDatasetTest, KeepsAFileOfTheMarkersName_WhenItComesDuringTheExport) {
  scene_.on_render = [&](int) { home_.write("out/.scantrove-unfinished", "mine"); };
  expectRefused(write(), ".scantrove-unfinished");
  EXPECT_EQ(readText(home_ / "out/.scantrove-unfinished"), "mine");
}

TEST_F(ReplacedDatasetTest, RefusesALinkInPlaceOfAFile) {
  const std::string text = readText(home_ / "out/labels.json");
  home_.write("out/labels.json", text);
  fs::rename(home_ / "out/labels.json", home_ / "out/README.md");
  fs::create_symlink("README.md", home_ / "out/labels.json");
  EXPECT_FALSE(write());
}

TEST_F(ReplacedDatasetTest, RefusesAnotherFormat) {
  const auto result = write(DatasetFormat::tum);
  ASSERT_FALSE(result);
  EXPECT_TRUE(contains(result.error().what, "masks")) << result.error().message();
  EXPECT_TRUE(fs::exists(home_ / "out/masks/000000.png"));
}

TEST_F(ReplacedDatasetTest, RefusesADamagedRecord) {
  const std::string record = ExportRecord::kFile;
  for (const char* text : {"", "[]", "{\"scantrove_export\": 1}",
                           "{\"scantrove_export\": 1, \"format\": \"masks\", \"files\": [{\"path\": "
                           "\"../../mine\", \"bytes\": 4, \"crc32\": 1}]}"}) {
    home_.write("out/" + record, text);
    expectRefused(write(), record);
  }
  home_.write("out/" + record, "{\"scantrove_export\": 99}");
  EXPECT_FALSE(write());
}

TEST_F(ReplacedDatasetTest, IsKept_WhenTheExportFails) {
  const std::vector<std::string> before = files();
  scene_.map_is_damaged = true;
  EXPECT_FALSE(write());
  EXPECT_EQ(files(), before);
}

TEST_F(ReplacedDatasetTest, IsKept_WhenItIsChangedDuringTheExport) {
  scene_.on_render = [&](int) { home_.write("out/mine.txt", "mine"); };
  expectRefused(write(), "mine.txt");
  EXPECT_EQ(readText(home_ / "out/mine.txt"), "mine");
}

TEST_F(ReplacedDatasetTest, IsKept_WhenTheProgramIsKilled) {
  const std::vector<std::string> before = files();
  cv::setNumThreads(1);  // fork() copies only the calling thread
  const pid_t child = fork();
  if (child == 0) {
    scene_.on_render = [](int) { ::kill(::getpid(), SIGKILL); };
    (void)write();
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  cv::setNumThreads(-1);
  EXPECT_EQ(files(), before);
  EXPECT_TRUE(write());
  EXPECT_EQ(std::distance(fs::directory_iterator(home_.path()), fs::directory_iterator()), 1)
      << "the next export removes the remains";
}

// A program that was killed between the two steps of replaceInSteps().
TEST_F(ReplacedDatasetTest, IsRestored_WhenItWasMovedAside) {
  fs::rename(home_ / "out", home_ / "out.part-abc123");
  home_.write("out.part-abc123/.scantrove-unfinished",
              "Scantrove was replacing this data set. The next export to the same place restores or removes "
              "out.part-abc123.\n");
  scene_.map_is_damaged = true;
  EXPECT_FALSE(write());
  EXPECT_TRUE(fs::exists(home_ / "out/masks/000010.png")) << "the old data set is in its place again";
  EXPECT_FALSE(fs::exists(home_ / "out/.scantrove-unfinished"));
}

// A program that was killed after the exchange, before it removed the old data set.
TEST_F(ReplacedDatasetTest, LeavesNoOldDataSet_ButWhatOthersPutThere) {
  fs::copy(home_ / "out", home_ / "out.part-abc123", fs::copy_options::recursive);
  home_.write("out.part-abc123/.scantrove-unfinished",
              "Scantrove has not finished this folder. The next export to the same place removes "
              "out.part-abc123.\n");
  home_.write("out.part-abc123/masks/mine.png", "mine");
  ASSERT_TRUE(write());
  EXPECT_EQ(readText(home_ / "out.part-abc123/masks/mine.png"), "mine");
  EXPECT_FALSE(fs::exists(home_ / "out.part-abc123/masks/000010.png"));
}

TEST_F(ReplacedDatasetTest, RemovesNothingBehindALink) {
  const auto record = ExportRecord::read(home_ / "out");
  ASSERT_TRUE(record && *record);
  fs::rename(home_ / "out/masks", home_ / "kept");
  fs::create_directory_symlink(home_ / "kept", home_ / "out/masks");
  EXPECT_FALSE((*record)->removeFrom(home_ / "out"));
  EXPECT_TRUE(fs::exists(home_ / "kept/000010.png"));
  EXPECT_TRUE(fs::is_symlink(home_ / "out/masks"));
}

}  // namespace
}  // namespace scantrove::test
