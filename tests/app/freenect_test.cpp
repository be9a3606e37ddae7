// A replacement of libfreenect simulates a Kinect v1.
#ifdef SCANTROVE_PLAYED_FREENECT
#include <opencv2/imgcodecs.hpp>

#include "tests/app/scantrove_program.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const ChildProcess::Environment kPlayed{{"LD_LIBRARY_PATH", SCANTROVE_PLAYED_FREENECT}};

TEST(SimulatedKinect, IsListedAsACamera) {
  EXPECT_THAT(scantrove({"devices"}, kPlayed).out,
              HasSubstr("camera:freenect:0  Microsoft Kinect v1 (libfreenect)"));
}

TEST(SimulatedKinect, RecordsRegisteredDepthAndColor) {
  for (const char* source : {"freenect", "camera", "camera:freenect:0"}) {
    const TemporaryFolder folder;
    const Finished run = scantrove({"record", source, "--frames", "3", "--out", folder / "out"}, kPlayed);
    ASSERT_EQ(run.exit_code, 0) << source << ": " << run.err;
    int frames = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder / "out")) {
      const std::string name = file.path().string();
      if (!name.ends_with(".depth.png")) continue;
      ++frames;
      const cv::Mat depth = cv::imread(name, cv::IMREAD_UNCHANGED);
      ASSERT_EQ(depth.size(), cv::Size(640, 480));
      EXPECT_LE(depth.at<std::uint16_t>(240, 320), 2000);
      EXPECT_GE(depth.at<std::uint16_t>(240, 320), 500);
      const std::string color_name =
          name.substr(0, name.size() - std::string("depth.png").size()) + "color.png";
      const cv::Mat color = cv::imread(color_name);
      ASSERT_FALSE(color.empty()) << color_name;
      EXPECT_EQ(color.at<cv::Vec3b>(240, 320), cv::Vec3b(0, 0, 200));
    }
    EXPECT_EQ(frames, 3);
  }
}

TEST(SimulatedKinect, ReportsThatItWasUnplugged) {
  const TemporaryFolder folder;
  ChildProcess::Environment environment = kPlayed;
  environment["PLAYED_FREENECT_IMAGES"] = "2";
  const Finished run = scantrove({"record", "freenect", "--out", folder / "out"}, environment);
  EXPECT_THAT(run.err, AllOf(HasSubstr("Kinect 0 does not answer any more: USB device disappeared."),
                             HasSubstr("Plug it in and open it again.")));
}

}  // namespace
}  // namespace scantrove::test
#endif
