// Recordings of the Azure Kinect and the Orbbec Femto, and the calibration inside.
#include "core/capture/containers/kinect_calibration.h"
#include "core/image/jpeg_encoder.h"
#include "tests/support/captured_log.h"
#include "tests/unit/capture/container_fixture.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

/// calibration.json with the colour camera 30 mm to the right of the depth camera. Lenses are pinholes.
std::string pinholeCalibration(double cx = 0.5, double fx = 0.5) {
  const auto camera = [&](const std::string& location, const std::string& translation) {
    return R"({"Location":"CALIBRATION_CameraLocation)" + location +
           R"(","Intrinsics":{"ModelParameters":[)" + std::to_string(cx) + ",0.5," + std::to_string(fx) +
           R"(,0.5,0,0,0,0,0,0,0,0,0,0]},"Rt":{"Rotation":[1,0,0,0,1,0,0,0,1],"Translation":[)" +
           translation + "]}}";
  };
  return R"({"CalibrationInformation":{"Cameras":[)" + camera("D0", "0,0,0") + "," +
         camera("PV0", "-0.03,0,0") + "]}}";
}

std::string bigEndian(const cv::Mat& depth) {
  std::string bytes;
  for (std::size_t i = 0; i < depth.total(); ++i) {
    const std::uint16_t value = depth.ptr<std::uint16_t>()[i];
    bytes += {static_cast<char>(value >> 8), static_cast<char>(value & 0xFF)};
  }
  return bytes;
}

const cv::Size kBinnedDepth{320, 288};
const cv::Size kSmallColor{1280, 720};

std::string kinectBytes(int frames, const std::string& calibration = pinholeCalibration()) {
  MatroskaTestTrack depth{"DEPTH", "b16g", kBinnedDepth.width, kBinnedDepth.height, {}};
  MatroskaTestTrack infrared{"IR", "b16g", kBinnedDepth.width, kBinnedDepth.height, {}};
  MatroskaTestTrack color{"COLOR", "MJPG", kSmallColor.width, kSmallColor.height, {}};
  for (int i = 0; i < frames; ++i) {
    infrared.images.emplace_back(33 * i, std::string(2 * 320 * 288, 'i'));
    depth.images.emplace_back(33 * i, bigEndian(containerDepth(i, kBinnedDepth)));
    color.images.emplace_back(33 * i + 2,
                              encodeJpeg(cv::Mat(kSmallColor, CV_8UC3, cv::Scalar(10 * i, 90, 30)), 90));
  }
  return matroskaBytes({infrared, depth, color}, calibration);
}

TEST(KinectRecording, GivesEveryBitOfDepth_AndTheColorCamera) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.mkv", kinectBytes(3));
  const auto source = openInput(file.string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().kind, "Azure Kinect recording");
  EXPECT_EQ((*source)->info().frame_count, 3);
  // 512 x 512 of which 320 x 288 are kept from (96, 90) on; pixel centres lie at integers.
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{256, 256, 159.5F, 165.5F, 320, 288}));
  const auto frames = readAllFrames(file);
  ASSERT_EQ(frames.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const RgbdFrame& frame = frames[static_cast<std::size_t>(i)];
    EXPECT_TRUE(areEqual(frame.depth, containerDepth(i, kBinnedDepth)));
    EXPECT_NEAR(frame.timestamp_s, 0.033 * i, 1e-9);
    ASSERT_EQ(frame.color.size(), kSmallColor);
    EXPECT_NEAR(frame.color.at<cv::Vec3b>(300, 300)[0], 10 * i, 3);
    ASSERT_TRUE(frame.color_camera);
    EXPECT_EQ(frame.color_camera->K, (Intrinsics{640, 480, 639.5F, 359.5F, 1280, 720}));
    EXPECT_NEAR(frame.color_camera->T_color_depth.translation().x(), -0.03, 1e-9);
  }
}

TEST(KinectRecording, SaysWhatToGive_WithoutCalibration) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.mkv", kinectBytes(1, "{}"));
  EXPECT_THAT(openContainerError(file),
              AllOf(HasSubstr("a.mkv"), HasSubstr("calibration"), HasSubstr("--intrinsics")));
  SourceOptions options;
  options.intrinsics = Intrinsics{250, 250, 160, 144, 0, 0};
  const CapturedLog log;
  EXPECT_EQ(readAllFrames(file, options).size(), 1U);
  EXPECT_THAT(log.text(), HasSubstr("without colour"));  // 16:9 is not registered to 10:9
}

TEST(KinectRecording, IsRefused_WhenAVideoWithoutDepth) {
  const TemporaryFolder folder;
  const auto file = folder.write("film.mkv", matroskaBytes({{"v", "MJPG", 64, 48, {{0, "jpeg"}}}}, "{}"));
  EXPECT_THAT(openContainerError(file), AllOf(HasSubstr("film.mkv"), HasSubstr("without the depth")));
}

TEST(KinectCalibration, CutsEachModeFromTheWholeSensor) {
  struct Mode {
    cv::Size depth, color;
    Intrinsics K, color_K;
  };
  // f = 0.5 and c = 0.5 of the whole image, minus the offset of the part and half a pixel.
  for (const Mode& mode : {Mode{{640, 576},
                                {1920, 1080},
                                {512, 512, 319.5F, 331.5F, 640, 576},
                                {960, 720, 959.5F, 539.5F, 1920, 1080}},
                           Mode{{512, 512},
                                {2048, 1536},
                                {256, 256, 255.5F, 255.5F, 512, 512},
                                {1024, 768, 1023.5F, 767.5F, 2048, 1536}},
                           Mode{{1024, 1024},
                                {3840, 2160},
                                {512, 512, 511.5F, 511.5F, 1024, 1024},
                                {1920, 1440, 1919.5F, 1079.5F, 3840, 2160}}}) {
    const auto cameras = kinectCameras(pinholeCalibration(), mode.depth, mode.color, "a.mkv");
    ASSERT_TRUE(cameras) << cameras.error().message();
    EXPECT_EQ(cameras->depth.K, mode.K);
    ASSERT_TRUE(cameras->color);
    EXPECT_EQ(cameras->color->K, mode.color_K);
  }
  EXPECT_FALSE(kinectCameras(pinholeCalibration(), {100, 100}, {1280, 720}, "a.mkv"));
  EXPECT_FALSE(kinectCameras(pinholeCalibration(), {640, 576}, {800, 600}, "a.mkv")->is_color_place_known);
}

}  // namespace
}  // namespace scantrove
