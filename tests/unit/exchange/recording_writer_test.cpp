#include "core/exchange/recording_writer.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>

#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using testing::HasSubstr;

TEST(RecordingWriter, RefusesTheFolder_WhenAnotherRecordingUsesIt) {
  const test::TemporaryFolder folder;
  std::optional<Result<RecordingWriter>> first = RecordingWriter::create(folder / "out", {});
  ASSERT_TRUE(*first) << first->error().message();
  const Result<RecordingWriter> second = RecordingWriter::create(folder / "out", {});
  ASSERT_FALSE(second) << "the folder is empty but in use";
  EXPECT_THAT(second.error().message(), HasSubstr("Another program is writing to the folder"));
  first.reset();
  EXPECT_TRUE(RecordingWriter::create(folder / "out", {})) << "the first recording wrote nothing";
}

TEST(RecordingWriter, KeepsAForeignFile_WhenItsNameIsNeeded) {
  const test::TemporaryFolder folder;
  Result<RecordingWriter> writer = RecordingWriter::create(folder / "out", {});
  ASSERT_TRUE(writer);
  RgbdFrame frame;
  frame.depth = cv::Mat(4, 4, CV_16UC1, cv::Scalar(1000));
  frame.T_world_camera = Eigen::Isometry3d::Identity();
  ASSERT_TRUE(writer->add(frame));
  frame.index = 1;
  const std::filesystem::path foreign = folder.write("out/frame-000001.depth.png", "somebody's");
  const Result<void> added = writer->add(frame);
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().message(), HasSubstr(foreign.string()));
  EXPECT_EQ(test::readText(foreign), "somebody's");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/frame-000001.pose.txt")) << "an incomplete frame";
  EXPECT_TRUE(std::filesystem::exists(folder / "out/frame-000000.depth.png"));
}

}  // namespace
}  // namespace scantrove
