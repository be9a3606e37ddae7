// Reads each available real recording to its end.
#include "tests/support/recordings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/capture/depth_plausibility.h"
#include "tests/support/captured_log.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;
using Status = FrameRead::Status;

/// Reads all and expects registered, plausible 640x480 frames; returns how many had a pose.
int expectCompleteRecording(const std::filesystem::path& path, int frame_count, const std::string& kind) {
  const CapturedLog log;
  const auto source = openSource(path.string(), {});
  if (!source) {
    ADD_FAILURE() << source.error().message();
    return 0;
  }
  EXPECT_EQ((*source)->info().kind, kind);
  EXPECT_EQ((*source)->info().frame_count, frame_count);
  int count = 0;
  int posed = 0;
  while (true) {
    const FrameRead read = (*source)->next();
    if (read.status == Status::end) {
      break;
    }
    EXPECT_EQ(read.status, Status::frame) << read.error.message();
    if (read.status != Status::frame) {
      break;
    }
    EXPECT_EQ(read.frame.index, count);
    EXPECT_EQ(read.frame.depth.size(), cv::Size(640, 480));
    EXPECT_EQ(read.frame.color.size(), cv::Size(640, 480));
    posed += read.frame.T_world_camera ? 1 : 0;
    if (count % 50 == 0) {
      const auto median = medianDepth(read.frame.depth, read.frame.meters_per_unit);
      EXPECT_TRUE(median && *median > 0.5 && *median < 4) << count;
    }
    ++count;
  }
  EXPECT_EQ(count, frame_count);
  EXPECT_THAT(log.text(), Not(HasSubstr("--depth-scale")));
  return posed;
}

TEST(Recordings, ReadsSevenScenesKitchen) {
  SCANTROVE_NEED_RECORDING(path, "kitchen");
  EXPECT_EQ(expectCompleteRecording(path, 500, "7-Scenes"), 500);
}

TEST(Recordings, ReadsTumDesk) {
  SCANTROVE_NEED_RECORDING(path, "desk");
  EXPECT_EQ(expectCompleteRecording(path, 110, "TUM RGB-D"), 110);
  const auto source = openSource(path.string(), {});
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{517.3F, 516.5F, 318.6F, 255.3F, 640, 480}));
}

TEST(Recordings, ReadsRedwoodLivingRoom) {
  SCANTROVE_NEED_RECORDING(path, "redwood");
  EXPECT_EQ(expectCompleteRecording(path, 211, "numbered images"), 211);
}

TEST(Recordings, ReadsTableTopPhotographsAsNumberedFolder) {
  SCANTROVE_NEED_RECORDING(path, "mosd");
  const TemporaryFolder folder;
  for (const char* const kind : {"color", "depth"}) {
    std::filesystem::create_directories(folder / kind);
    for (int i = 0; i < 45; ++i) {
      std::filesystem::copy_file(path / ("learn" + std::to_string(i) + "-" + kind + ".png"),
                                 folder / kind / numbered("%05d.png", i));
    }
  }
  EXPECT_EQ(expectCompleteRecording(folder.path(), 45, "numbered images"), 0);
}

}  // namespace
}  // namespace scantrove
