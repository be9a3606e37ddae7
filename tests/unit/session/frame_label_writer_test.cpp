#include "core/session/frame_label_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <opencv2/core.hpp>
#include <thread>

#include "core/exchange/label_image_writer.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

constexpr int kWidth = 8, kHeight = 6;

/// Left half: segment 1 and `left`; right half: segment 2 and `right`.
FrameLabelWriter::Frame frameOf(int index, std::uint32_t left, std::uint32_t right) {
  FrameLabelWriter::Frame frame;
  frame.index = index;
  frame.depth = cv::Mat(2 * kHeight, 2 * kWidth, CV_16UC1, cv::Scalar(1000));
  frame.segments.width = kWidth;
  frame.segments.height = kHeight;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const bool is_left = i % kWidth < kWidth / 2;
    frame.segments.ids.push_back(is_left ? 1 : 2);
    frame.segments.depths_m.push_back(1);
    frame.regions.push_back(RegionId{is_left ? left : right});
  }
  // The position encodes the frame index.
  frame.T_world_camera.translation().x() = index;
  return frame;
}

/// A map that shows `left` and `right` from every pose, as frameOf().
FrameLabelWriter::RenderView mapOf(std::uint32_t left, std::uint32_t right) {
  return [=](const Eigen::Isometry3d&, const std::optional<Intrinsics>&) -> Result<RenderedView> {
    RenderedView view;
    view.K.width = kWidth;
    view.K.height = kHeight;
    view.vertices_world.assign(kWidth * kHeight, {0, 0, 1, 1});
    view.regions = frameOf(0, left, right).regions;
    return view;
  };
}

void makeFolders(const TemporaryFolder& folder) {
  for (const char* part : {"segments", "labels", "labels-final"}) {
    std::filesystem::create_directories(folder / part);
  }
}

std::string nameOf(int index) {
  return std::string("0000") + (index < 10 ? "0" : "") + std::to_string(index) + ".png";
}

/// The values of the left and right half of an image; each half must have one value.
std::pair<int, int> halves(const std::filesystem::path& file) {
  const Result<cv::Mat> image = readLabelImage(file);
  if (!image || image->size() != cv::Size(2 * kWidth, 2 * kHeight)) return {-1, -1};
  const auto valueOf = [&](int x) {
    const cv::Mat half = (*image)(cv::Rect(x, 0, kWidth, 2 * kHeight));
    const auto value = half.at<std::uint16_t>(0, 0);
    return cv::countNonZero(half != value) == 0 ? static_cast<int>(value) : -1;
  };
  return {valueOf(0), valueOf(kWidth)};
}

// More frames than may wait. Region numbers equal ids.
TEST(FrameLabelWriter, WritesAllImages_WhenFramesExceedTheQueue) {
  const TemporaryFolder folder;
  makeFolders(folder);
  constexpr int kFrames = 5 * static_cast<int>(FrameLabelWriter::kMaxWaiting);
  RegionNumbers numbers;
  FrameLabelWriter writer(folder.path(), numbers);
  for (int i = 0; i < kFrames; ++i) {
    ASSERT_TRUE(writer.add(frameOf(i, 90, i < 20 ? 30U + static_cast<std::uint32_t>(i) : 29U)));
  }
  // The final map shows one region from the pose of frame 1, and a new right region from all others.
  ASSERT_TRUE(writer.finish([](const Eigen::Isometry3d& T, const std::optional<Intrinsics>& K) {
    return mapOf(90, T.translation().x() == 1 ? 90 : 95)(T, K);
  }));
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_EQ(halves(folder / "segments" / nameOf(i)), std::pair(1, 2)) << i;
    EXPECT_EQ(halves(folder / "labels" / nameOf(i)), std::pair(90, i < 20 ? 30 + i : 29)) << i;
    EXPECT_EQ(halves(folder / "labels-final" / nameOf(i)), std::pair(90, i == 1 ? 90 : 95)) << i;
  }
  EXPECT_EQ(numbers.count(), 24U);
}

TEST(FrameLabelWriter, IsDeterministic) {
  std::vector<std::string> files[2];
  for (auto& contents : files) {
    const TemporaryFolder folder;
    makeFolders(folder);
    RegionNumbers numbers;
    FrameLabelWriter writer(folder.path(), numbers);
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(writer.add(frameOf(i, 90U - static_cast<std::uint32_t>(i), 7)));
    ASSERT_TRUE(writer.finish(mapOf(90, 7)));
    for (const char* part : {"segments", "labels", "labels-final"}) {
      for (int i = 0; i < 20; ++i) contents.push_back(test::readText(folder / part / nameOf(i)));
    }
  }
  EXPECT_EQ(files[0], files[1]);
  EXPECT_GT(files[0][0].size(), 50U);
}

TEST(FrameLabelWriter, NamesTheFileAndKeepsTheOthers_WhenAFileCannotBeWritten) {
  const TemporaryFolder folder;
  makeFolders(folder);
  std::filesystem::create_directories(folder / "labels" / "000003.png" / "in the way");
  RegionNumbers numbers;
  FrameLabelWriter writer(folder.path(), numbers);
  Result<void> added;
  for (int i = 0; i < 100 && added; ++i) added = writer.add(frameOf(i, 5, 6));
  ASSERT_FALSE(added) << "no error after 100 frames";
  EXPECT_THAT(added.error().what, HasSubstr("labels/000003.png"));
  const Result<void> finished = writer.finish(mapOf(5, 6));
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().what, added.error().what);
  EXPECT_EQ(halves(folder / "labels-final" / "000002.png"), std::pair(5, 6));
}

TEST(FrameLabelWriter, LeavesOnlyLabelImages) {
  const TemporaryFolder folder;
  makeFolders(folder);
  RegionNumbers numbers;
  FrameLabelWriter writer(folder.path(), numbers);
  ASSERT_TRUE(writer.add(frameOf(0, 5, 6)));
  ASSERT_TRUE(writer.finish(mapOf(5, 6)));
  for (const char* part : {"segments", "labels", "labels-final"}) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / part)) {
      names.push_back(entry.path().filename());
    }
    EXPECT_THAT(names, testing::ElementsAre("000000.png")) << part;
  }
}

TEST(FrameLabelWriter, Fails_WhenTheMapCannotBeRendered) {
  const TemporaryFolder folder;
  makeFolders(folder);
  RegionNumbers numbers;
  FrameLabelWriter writer(folder.path(), numbers);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(writer.add(frameOf(i, 5, 6)));
  const Result<void> finished = writer.finish(
      [](const Eigen::Isometry3d& T, const std::optional<Intrinsics>& K) -> Result<RenderedView> {
        if (T.translation().x() == 1) return fail("The device is gone.");
        return mapOf(5, 6)(T, K);
      });
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().what, HasSubstr("The device is gone."));
  EXPECT_EQ(halves(folder / "labels-final" / nameOf(0)), std::pair(5, 6));
}

TEST(FrameLabelWriter, RendersTheMapForTheCameraOfEachFrame) {
  const TemporaryFolder folder;
  makeFolders(folder);
  RegionNumbers numbers;
  FrameLabelWriter writer(folder.path(), numbers);
  const Intrinsics own{7, 7, 3.5F, 2.5F, 2 * kWidth, 2 * kHeight};
  for (int i = 0; i < 2; ++i) {
    FrameLabelWriter::Frame frame = frameOf(i, 5, 6);
    if (i == 1) frame.intrinsics = own;
    ASSERT_TRUE(writer.add(std::move(frame)));
  }
  std::vector<std::optional<Intrinsics>> rendered;
  ASSERT_TRUE(writer.finish(
      [&](const Eigen::Isometry3d& T, const std::optional<Intrinsics>& K) -> Result<RenderedView> {
        rendered.push_back(K);
        return mapOf(5, 6)(T, K);
      }));
  EXPECT_THAT(rendered, testing::ElementsAre(std::nullopt, own));
}

}  // namespace
}  // namespace scantrove
