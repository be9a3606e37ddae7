#include "core/session/final_label_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>

#include "core/exchange/label_image_writer.h"
#include "core/synthetic/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::readText;
using testing::HasSubstr;

constexpr int kRecorded = 3;
constexpr const char* kRecording = "demo:tabletop:3";

/// Fails for a source that is no demo.
Result<std::unique_ptr<FrameSource>> openRecording(const std::string& source) {
  if (!source.starts_with("demo:")) return fail("There is no " + source + ".");
  return makeSyntheticSource(source.substr(5), {})
      .map([](std::unique_ptr<SyntheticSource> opened) -> std::unique_ptr<FrameSource> { return opened; });
}

/// A map that shows one region 1 m away from every pose.
FrameLabelWriter::RenderView mapOfRegion(std::uint32_t region) {
  return [region](const Eigen::Isometry3d&, const std::optional<Intrinsics>&) -> Result<RenderedView> {
    RenderedView view;
    view.K.width = 4;
    view.K.height = 3;
    view.vertices_world.assign(12, {0, 0, 1, 1});
    view.regions.assign(12, RegionId{region});
    return view;
  };
}

/// A scan of three frames whose images in labels-final/ show region 5.
class FinalLabelImagesTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* part : {"segments", "labels", "labels-final"})
      std::filesystem::create_directories(folder_ / part);
    const auto source = openRecording(kRecording);
    ASSERT_TRUE(source);
    RegionNumbers numbers;
    FrameLabelWriter writer(folder_.path(), numbers);
    for (int i = 0; i < kRecorded; ++i) {
      const FrameRead read = (*source)->next();
      ASSERT_EQ(read.status, FrameRead::Status::frame);
      FrameLabelWriter::Frame frame;
      frame.index = i;
      frame.depth = read.frame.depth;
      frame.meters_per_unit = read.frame.meters_per_unit;
      frame.segments.width = 4;
      frame.segments.height = 3;
      frame.segments.ids.assign(12, 1);
      frame.segments.depths_m.assign(12, 1.0F);
      frame.regions.assign(12, RegionId{5});
      ASSERT_TRUE(writer.add(frame));
      earlier_.frames.push_back({i, i, i / 30.0, TrackingState::tracking});
    }
    ASSERT_TRUE(writer.finish(mapOfRegion(5)));
    earlier_.recordings.push_back({0, kRecording, 0, 0});
    setRecord(writer.written());
  }

  void setRecord(const FinalLabelRecord& record) {
    earlier_.metadata[kFinalLabelsKey] = finalLabelsToText(record);
  }

  /// Draws the images with region 7.
  void redraw() {
    images_.begin(earlier_);
    RegionNumbers numbers;
    const auto store = [this](const FinalLabelRecord& record) -> Result<void> {
      setRecord(record);
      ++stored_;
      return {};
    };
    const Result<void> done = images_.redraw({}, numbers, mapOfRegion(7), store);
    EXPECT_TRUE(done) << done.error().message();
  }

  [[nodiscard]] std::filesystem::path fileOf(int frame) const {
    return folder_ / "labels-final" / labelFileName(frame);
  }
  /// The only region in an image; -1 if the image is missing or has no region or several.
  [[nodiscard]] int shownIn(int frame) const {
    const Result<cv::Mat> image = readLabelImage(fileOf(frame));
    if (!image) return -1;
    double region = 0;
    cv::minMaxLoc(*image, nullptr, &region);
    const int shown_px = cv::countNonZero(*image);
    return shown_px > 0 && cv::countNonZero(*image == region) == shown_px ? static_cast<int>(region) : -1;
  }
  [[nodiscard]] std::vector<int> shown() const { return {shownIn(0), shownIn(1), shownIn(2)}; }
  [[nodiscard]] std::string remarks() const {
    std::string all;
    for (const Error& remark : images_.remarks()) all += remark.message() + "\n";
    return all;
  }

  test::TemporaryFolder folder_;
  SavedScan earlier_;
  FinalLabelImages images_{folder_.path(), openRecording};
  int stored_ = 0;
};

TEST_F(FinalLabelImagesTest, RedrawsAllImages_WhenTheRecordingExists) {
  ASSERT_EQ(shown(), (std::vector{5, 5, 5}));
  redraw();
  EXPECT_EQ(shown(), (std::vector{7, 7, 7}));
  EXPECT_EQ(remarks(), "");
  EXPECT_EQ(stored_, 2) << "the record names new files before they are written, and at the end";
  redraw();
  EXPECT_EQ(remarks(), "") << "the record does not match the new files";
}

TEST_F(FinalLabelImagesTest, FindsFrames_WhenALaterRecordingIsShifted) {
  for (SavedFrame& frame : earlier_.frames) frame.source_index += 100;
  FinalLabelRecord record = finalLabelsFrom(earlier_.metadata);
  for (FinalLabelImage& image : record) {
    std::filesystem::rename(fileOf(image.frame_index), fileOf(image.frame_index + 100));
    image.frame_index += 100;
  }
  setRecord(record);
  earlier_.recordings[0].index_shift = 100;
  redraw();
  EXPECT_EQ(shownIn(101), 7);
  EXPECT_EQ(remarks(), "");
}

TEST_F(FinalLabelImagesTest, KeepsAnImage_WhenAPersonChangedIt) {
  const std::string by_person = readText(folder_ / "segments" / labelFileName(1));
  ASSERT_NE(by_person, readText(fileOf(1)));
  std::ofstream(fileOf(1), std::ios::binary) << by_person;
  redraw();
  EXPECT_EQ(shownIn(0), 7);
  EXPECT_EQ(readText(fileOf(1)), by_person);
  EXPECT_THAT(remarks(), HasSubstr("did not write 1 image in "));
}

TEST_F(FinalLabelImagesTest, KeepsAllImages_WhenTheSessionHasNoRecordOfThem) {
  earlier_.metadata.clear();
  redraw();
  EXPECT_EQ(shown(), (std::vector{5, 5, 5}));
  EXPECT_THAT(remarks(), HasSubstr("did not write 3 images in "));
}

TEST_F(FinalLabelImagesTest, RestoresNoImage_WhenAPersonRemovedIt) {
  std::filesystem::remove(fileOf(2));
  redraw();
  EXPECT_EQ(shown(), (std::vector{7, 7, -1}));
  EXPECT_EQ(remarks(), "");
}

TEST_F(FinalLabelImagesTest, NamesUnchangedImages_WhenTheRecordingIsMissing) {
  earlier_.recordings[0].source = (folder_ / "recording").string();
  redraw();
  EXPECT_EQ(shown(), (std::vector{5, 5, 5}));
  EXPECT_THAT(remarks(),
              testing::AllOf(HasSubstr("missing in 3 images"), HasSubstr("recording cannot be read")));
}

TEST_F(FinalLabelImagesTest, NamesUnchangedImages_WhenTheRecordingDiffers) {
  earlier_.recordings[0].source = "demo:tabletop:4";
  redraw();
  EXPECT_EQ(shown(), (std::vector{5, 5, 5}));
  EXPECT_THAT(remarks(), HasSubstr("has other frames"));
}

TEST_F(FinalLabelImagesTest, StartsNoCamera_WhenTheSourceIsACamera) {
  earlier_.recordings[0].source = "camera";
  redraw();
  EXPECT_EQ(shown(), (std::vector{5, 5, 5}));
  EXPECT_THAT(remarks(), HasSubstr("only key frames of a camera"));
}

TEST_F(FinalLabelImagesTest, OpensTheRecording_WhenItsFolderIsNamedLikeACamera) {
  for (const char* folder : {"camera-1", "cameras/desk", "freenect_desk"}) {
    earlier_.recordings[0].source = folder;
    std::vector<std::string> opened;
    FinalLabelImages images(folder_.path(), [&](const std::string& source) {
      opened.push_back(source);
      return openRecording(kRecording);
    });
    images.begin(earlier_);
    RegionNumbers numbers;
    const auto store = [this](const FinalLabelRecord& record) -> Result<void> {
      setRecord(record);
      return {};
    };
    ASSERT_TRUE(images.redraw({}, numbers, mapOfRegion(7), store));
    EXPECT_EQ(opened, (std::vector<std::string>{folder}));
    EXPECT_TRUE(images.remarks().empty()) << folder;
  }
}

TEST_F(FinalLabelImagesTest, RedrawsAllImages_WhenTheLastRunWasKilled) {
  FinalLabelRecord record = finalLabelsFrom(earlier_.metadata);
  ASSERT_EQ(record.size(), static_cast<std::size_t>(kRecorded));
  // The new file was written, but not yet recorded.
  record[1].next_checksum = record[1].checksum;
  record[1].checksum = 0;
  setRecord(record);
  redraw();
  EXPECT_EQ(shown(), (std::vector{7, 7, 7}));
  EXPECT_EQ(remarks(), "");
}

}  // namespace
}  // namespace scantrove
