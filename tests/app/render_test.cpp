// Pictures and videos of a saved scan, without a display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/capture/video_frames.h"
#include "tests/app/demo_scan.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

class RenderCommandTest : public DemoScanTest {
 protected:
  [[nodiscard]] Finished render(const std::string& file, std::vector<std::string> options = {}) const {
    std::vector<std::string> arguments{"render", scan_, "--out", out_ / file, "--size", "320x240"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return scantrove(arguments, {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}});
  }
  TemporaryFolder out_;
};

/// The pixels that are not of the color of the upper left corner, where a scan never reaches.
int shownPixels(const cv::Mat& image) {
  cv::Mat difference;
  cv::absdiff(image, cv::Scalar(image.at<cv::Vec3b>(0, 0)), difference);
  return cv::countNonZero(difference.reshape(1));
}

TEST_F(RenderCommandTest, DrawsAPictureAndLeavesWhatExists) {
  const Finished run = render("scan.png");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("scan.png"));
  const cv::Mat image = cv::imread(out_ / "scan.png");
  ASSERT_EQ(image.size(), cv::Size(320, 240));
  EXPECT_GT(shownPixels(image), 320 * 240 / 10);
  const std::string bytes = readText(out_ / "scan.png");
  expectJobFailure(render("scan.png"), {"scan.png", "exists already"});
  EXPECT_EQ(readText(out_ / "scan.png"), bytes);
  ASSERT_EQ(render("again.png").exit_code, 0);
  EXPECT_EQ(readText(out_ / "again.png"), bytes);
}

TEST_F(RenderCommandTest, DrawsAVideoOfOneObject) {
  const std::string region = std::to_string(Json::parse(regionTable()).front()["id"].get<int>());
  ASSERT_EQ(session({"name", "--region", region, "--name", "thing"}).exit_code, 0);
  const Finished run =
      render("thing.webm", {"--object", "thing", "--seconds", "0.5", "--frames-per-second", "10"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  VideoFrames video(out_ / "thing.webm");
  const auto last = video.frame(4);
  ASSERT_TRUE(last) << last.error().message();
  EXPECT_EQ(last->size(), cv::Size(320, 240));
  EXPECT_FALSE(video.frame(5));
  expectJobFailure(render("none.png", {"--object", "no such thing"}), {"no such thing", "session regions"});
  EXPECT_FALSE(std::filesystem::exists(out_ / "none.png"));
}

}  // namespace
}  // namespace scantrove::test
