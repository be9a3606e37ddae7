#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <stop_token>

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;

constexpr DatasetFormat kAll[] = {
    DatasetFormat::coco,   DatasetFormat::bop,         DatasetFormat::yolo,  DatasetFormat::masks,
    DatasetFormat::voc,    DatasetFormat::labelstudio, DatasetFormat::boxes, DatasetFormat::foundationpose,
    DatasetFormat::ply,    DatasetFormat::pcd,         DatasetFormat::mesh,  DatasetFormat::tum,
    DatasetFormat::scannet};

std::string nameOf(DatasetFormat format) { return datasetFormatNames()[static_cast<std::size_t>(format)]; }

TEST(ParseDatasetFormat, RecognizesAllNames) {
  EXPECT_EQ(datasetFormatNames().size(), std::size(kAll));
  for (const DatasetFormat format : kAll) EXPECT_EQ(parseDatasetFormat(nameOf(format)), format);
  const auto unknown = parseDatasetFormat("kitti");
  ASSERT_FALSE(unknown);
  EXPECT_TRUE(contains(unknown.error().message(), "'kitti'") &&
              contains(unknown.error().message(), "scannet"));
}

TEST(ExportFormats, AreAllWritten) {
  SmallScene scene;
  const TemporaryFolder home;
  for (const DatasetFormat format : kAll) {
    int steps = 0;
    const auto result = exportDataset(scene, {.format = format, .folder = home / nameOf(format)},
                                      [&](const ExportProgress& progress) {
                                        EXPECT_LE(progress.done, progress.total);
                                        EXPECT_FALSE(progress.what.empty());
                                        ++steps;
                                      });
    ASSERT_TRUE(result) << nameOf(format) << ": " << result.error().message();
    EXPECT_GE(steps, 3) << nameOf(format);
    std::uintmax_t bytes = 0;
    for (const std::string& name : Exported::filesIn(home / nameOf(format)))
      bytes += fs::file_size(home / nameOf(format) / name);
    EXPECT_EQ(result->bytes, bytes) << nameOf(format);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(home.path()), fs::directory_iterator()), std::ssize(kAll));
}

TEST(PreviewExport, CountsImagesRegionsAndMegabytes) {
  SmallScene scene;
  scene.without_color = {10};
  const auto preview = previewExport(scene, {.format = DatasetFormat::coco, .folder = {}});
  ASSERT_TRUE(preview);
  EXPECT_EQ(preview->images, 1);
  EXPECT_EQ(preview->regions, 2);
  EXPECT_GT(preview->megabytes, static_cast<double>(fs::file_size(scene.fileOf(0))) / 1e6);
  EXPECT_EQ(previewExport(scene, {.format = DatasetFormat::masks, .folder = {}, .background = true})->regions,
            4);
}

TEST(ExportDataset, RefusesAFolder_WhenItIsNotEmpty) {
  SmallScene scene;
  const TemporaryFolder home;
  home.write("out/report.txt", "mine");
  const auto result = exportDataset(scene, {.format = DatasetFormat::tum, .folder = home / "out"});
  ASSERT_FALSE(result);
  EXPECT_TRUE(contains(result.error().what, (home / "out").string())) << result.error().message();
  EXPECT_EQ(Exported::filesIn(home.path()), std::vector<std::string>{"out/report.txt"});
}

TEST(ExportDataset, LeavesNothing_WhenCanceled) {
  SmallScene scene;
  const TemporaryFolder home;
  for (const DatasetFormat format : kAll) {
    for (int last = 1; last <= 4; ++last) {
      std::stop_source stop;
      int steps = 0;
      const auto result = exportDataset(
          scene, {.format = format, .folder = home / "out"},
          [&](const ExportProgress&) {
            if (++steps == last) stop.request_stop();
          },
          stop.get_token());
      if (result) {  // the export had fewer steps
        fs::remove_all(home / "out");
        continue;
      }
      EXPECT_TRUE(contains(result.error().what, "cancelled")) << result.error().message();
      EXPECT_TRUE(fs::is_empty(home.path())) << nameOf(format) << " after " << last;
    }
  }
}

TEST(ExportDataset, AdvisesBackground_WithoutLabeledRegions) {
  SmallScene scene;
  for (LabeledRegion& region : scene.labels) {
    region.name.clear();
    region.object.reset();
  }
  const TemporaryFolder home;
  for (const DatasetFormat format : kAll) {
    const auto result = exportDataset(scene, {.format = format, .folder = home / nameOf(format)});
    if (hasImages(format)) {
      ASSERT_FALSE(result) << nameOf(format);
      EXPECT_TRUE(contains(result.error().what, "kitchen table"));
      EXPECT_TRUE(contains(result.error().advice, "--background"));
      EXPECT_FALSE(fs::exists(home / nameOf(format)));
    } else {
      EXPECT_TRUE(result) << nameOf(format) << " needs only the surface or the trajectory";
    }
  }
  scene.labels.clear();
  EXPECT_TRUE(exportDataset(scene, {.format = DatasetFormat::scannet, .folder = home / "none"}));
}

TEST(ExportDataset, SkipsKeyFrames_WhenTheyAreUnusable) {
  SmallScene scene;
  scene.frames = 7;  // key frames 0, 20, 40, 60
  scene.without_color = {0};
  scene.with_damaged_color = {20};
  scene.with_damaged_depth = {40};
  const TemporaryFolder home;
  const auto result = exportDataset(scene, {.format = DatasetFormat::coco, .folder = home / "out"});
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_EQ(result->images, 1);
  ASSERT_EQ(result->skipped.size(), 3U);
  EXPECT_TRUE(contains(result->skipped[0], "Key frame 0 "));
  EXPECT_TRUE(contains(result->skipped[1], "Key frame 20 ") && contains(result->skipped[1], "frame 20.jpg"));
  EXPECT_TRUE(contains(result->skipped[2], "Key frame 40 ") && contains(result->skipped[2], "depth-40.png"));
  EXPECT_EQ(Exported::filesIn(home / "out" / "images"), std::vector<std::string>{"000060.jpg"});
}

TEST(ExportDataset, Fails_WithoutUsableKeyFrames) {
  SmallScene scene;
  scene.without_color = {0, 10};
  const TemporaryFolder home;
  const auto result = exportDataset(scene, {.format = DatasetFormat::bop, .folder = home / "out"});
  ASSERT_FALSE(result);
  EXPECT_TRUE(contains(result.error().message(), "Key frame 0 has no colour")) << result.error().message();
  EXPECT_TRUE(fs::is_empty(home.path()));
  scene.frames = 0;
  EXPECT_FALSE(exportDataset(scene, {.format = DatasetFormat::masks, .folder = home / "out"}));
  EXPECT_FALSE(exportDataset(scene, {.format = DatasetFormat::tum, .folder = home / "out"}));
  EXPECT_TRUE(exportDataset(scene, {.format = DatasetFormat::mesh, .folder = home / "out"}));
}

TEST(ExportDataset, NamesTheFile_WhenTheMapIsDamaged) {
  SmallScene scene;
  scene.map_is_damaged = true;
  const TemporaryFolder home;
  const auto result = exportDataset(scene, {.format = DatasetFormat::yolo, .folder = home / "out"});
  ASSERT_FALSE(result);
  EXPECT_TRUE(contains(result.error().what, "bricks-0001"));
  EXPECT_TRUE(fs::is_empty(home.path()));
}

TEST(ExportDataset, ReturnsAnError_WhenALibraryThrows) {
  SmallScene scene;
  scene.on_render = [](int view) {
    if (view == 2) throw std::runtime_error("out of device memory");
  };
  const TemporaryFolder home;
  const auto result = exportDataset(scene, {.format = DatasetFormat::coco, .folder = home / "out"});
  ASSERT_FALSE(result);
  EXPECT_TRUE(contains(result.error().what, "out of device memory"));
  EXPECT_TRUE(contains(result.error().what, (home / "out").string()));
  EXPECT_TRUE(fs::is_empty(home.path()));
}

TEST(ExportDataset, NamesTheFolder_WhenItIsNotWritable) {
  SmallScene scene;
  // Root ignores permissions, but cannot create files in /proc either.
  const auto result = exportDataset(scene, {.format = DatasetFormat::tum, .folder = "/proc/out"});
  ASSERT_FALSE(result);
  EXPECT_TRUE(contains(result.error().what, "/proc/out")) << result.error().message();
  EXPECT_FALSE(result.error().advice.empty());
}

/// A disk of a given size; needs the right to mount.
class SmallDisk {
 public:
  explicit SmallDisk(const std::string& kilobytes) {
    is_there_ =
        ::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, ("size=" + kilobytes + "k").c_str()) == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (is_there_) ::umount(folder_.path().c_str());
  }
  [[nodiscard]] bool isThere() const { return is_there_; }
  [[nodiscard]] fs::path path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  bool is_there_ = false;
};

void expectFullDisk(const Result<ExportSummary>& result, const fs::path& folder, DatasetFormat format,
                    const char* reason) {
  ASSERT_FALSE(result) << nameOf(format);
  EXPECT_TRUE(contains(result.error().what, (folder / "out").string())) << result.error().message();
  EXPECT_TRUE(contains(result.error().what, reason)) << result.error().message();
  EXPECT_FALSE(contains(result.error().message(), ".part-")) << result.error().message();
  EXPECT_TRUE(contains(result.error().advice, "disk is not full")) << result.error().message();
  EXPECT_TRUE(fs::is_empty(folder)) << nameOf(format);
}

TEST(ExportDataset, LeavesNothing_WhenTheDiskIsFull) {
  const SmallDisk disk("24");
  if (!disk.isThere()) {
    std::cerr << "NOT TESTED: a full disk. Mounting a tmpfs needs root; the next test replaces this one.\n";
    GTEST_SKIP() << "no tmpfs can be mounted here";
  }
  SmallScene scene;
  scene.frames = 60;
  for (const DatasetFormat format : kAll) {
    scene.frames = format == DatasetFormat::tum ? 600 : 60;
    expectFullDisk(exportDataset(scene, {.format = format, .folder = disk.path() / "out"}), disk.path(),
                   format, "No space left on device");
  }
}

TEST(ExportDataset, LeavesNothing_WhenAFileReachesItsSizeLimit) {
  SmallScene scene;
  (void)scene.keyFrames(false);  // writes its images before the limit applies
  const TemporaryFolder home;
  for (const DatasetFormat format : kAll) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{500, before.rlim_max};  // replaces a full disk
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto result = exportDataset(scene, {.format = format, .folder = home / "out"});
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_DFL);
    expectFullDisk(result, home.path(), format, "File too large");
  }
}

TEST(ExportDataset, Fails_WhenAFileDoesNotReadBack) {
  SmallScene scene;
  const TemporaryFolder home;
  scene.on_render = [&](int view) {  // truncates the first image while the second is rendered
    if (view != 2) return;
    for (const std::string& name : Exported::filesIn(home.path())) {
      if (name.ends_with("000000.jpg")) fs::resize_file(home / name, 100);
    }
  };
  const auto result = exportDataset(scene, {.format = DatasetFormat::coco, .folder = home / "out"});
  ASSERT_FALSE(result);
  EXPECT_TRUE(contains(result.error().what, "does not read back")) << result.error().message();
  EXPECT_TRUE(contains(result.error().what, (home / "out" / "images" / "000000.jpg").string()));
  EXPECT_TRUE(fs::is_empty(home.path()));
}

TEST(ExportDataset, LeavesNoTargetFolder_WhenKilled) {
  const TemporaryFolder home;
  SmallScene scene;
  cv::setNumThreads(1);  // fork() copies only the calling thread
  const pid_t child = fork();
  if (child == 0) {
    scene.on_render = [](int view) {
      if (view == 2) ::kill(::getpid(), SIGKILL);
    };
    (void)exportDataset(scene, {.format = DatasetFormat::coco, .folder = home / "out"});
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_FALSE(fs::exists(home / "out"));
  cv::setNumThreads(-1);
  EXPECT_FALSE(fs::is_empty(home.path())) << "the export had begun";
  ASSERT_TRUE(exportDataset(scene, {.format = DatasetFormat::coco, .folder = home / "out"}));
  EXPECT_EQ(std::distance(fs::directory_iterator(home.path()), fs::directory_iterator()), 1)
      << "the next export removes the remains";
}

}  // namespace
}  // namespace scantrove::test
