// The Kinect v1 on a simulated libfreenect, down to the calls and images of its C functions. Not tested with
// a real camera, its USB traffic and its clock.
#if __has_include(<libfreenect.h>)
#include "core/capture/freenect_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/capture/cameras.h"
#include "core/capture/color_registration.h"
#include "core/capture/freenect_clock.h"
#include "tests/unit/capture/fake_freenect.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Status = FrameRead::Status;
using Opened = Result<std::unique_ptr<FrameSource>>;

constexpr std::uint32_t kFrame = FakeFreenect::kTicksPerSecond / 30;

Opened openFake(const std::string& uri = "freenect", const SourceOptions& options = {}) {
  return openFreenectCamera(FakeFreenect::api(), uri, options);
}

std::string refusal(const std::string& uri = "freenect", const SourceOptions& options = {}) {
  const auto source = openFake(uri, options);
  return source ? "(opened)" : source.error().message();
}

TEST(Freenect, ReturnsDepthInMillimetersAndColor) {
  FakeFreenect fake;
  fake.depthAt(7 * kFrame, 1500);
  fake.colorAt(7 * kFrame + 1000, 200, 100, 50);
  const auto source = openFake();
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.kind, "libfreenect camera");
  EXPECT_EQ(info.name, "Kinect 0");
  EXPECT_TRUE(info.is_live);
  EXPECT_FALSE(info.frame_count);
  EXPECT_EQ(info.intrinsics, (Intrinsics{525, 525, 319.5, 239.5, 640, 480}));
  EXPECT_EQ(fake.asked_depth, FREENECT_DEPTH_REGISTERED);
  EXPECT_EQ(fake.subdevices, FREENECT_DEVICE_CAMERA);

  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame) << read.error.message();
  EXPECT_EQ(read.frame.index, 0);
  EXPECT_NEAR(read.frame.timestamp_s, 7.0 / 30, 1e-9);
  EXPECT_FLOAT_EQ(read.frame.meters_per_unit, 0.001F);
  ASSERT_EQ(read.frame.depth.size(), cv::Size(640, 480));
  ASSERT_EQ(read.frame.depth.type(), CV_16UC1);
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(0, 0), 1600);
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(479, 639), 1500);
  ASSERT_EQ(read.frame.color.size(), cv::Size(640, 480));
  EXPECT_EQ(read.frame.color.at<cv::Vec3b>(479, 639), cv::Vec3b(50, 100, 200));
  EXPECT_FALSE(read.frame.color_camera);  // registered
}

TEST(Freenect, PairsDepthWithTheColorNearestInTime) {
  FakeFreenect fake;
  for (std::uint32_t i = 0; i < 4; ++i) {
    fake.colorAt(i * kFrame + 100'000, static_cast<std::uint8_t>(10 * i), 0, 0);
    fake.depthAt(i * kFrame, static_cast<std::uint16_t>(1000 + i));
  }
  const auto source = openFake();
  ASSERT_TRUE(source) << source.error().message();
  for (int i = 0; i < 4; ++i) {
    const FrameRead read = (*source)->next();
    ASSERT_EQ(read.status, Status::frame);
    EXPECT_EQ(read.frame.index, i);
    EXPECT_EQ(read.frame.depth.at<std::uint16_t>(1, 1), 1000 + i);
    EXPECT_EQ(read.frame.color.at<cv::Vec3b>(1, 1)[2], 10 * i);
  }
}

TEST(Freenect, ContinuesTime_WhenTheTicksWrap) {
  FakeFreenect fake;
  const std::uint32_t start = 0U - kFrame;  // the last frame before the ticks wrap, after 71.6 s
  for (std::uint32_t i = 0; i < 3; ++i) {
    fake.colorAt(start + i * kFrame - 1000, static_cast<std::uint8_t>(i), 0, 0);
    fake.depthAt(start + i * kFrame, 1000);
  }
  const auto source = openFake();
  ASSERT_TRUE(source) << source.error().message();
  const double first = (*source)->next().frame.timestamp_s;
  EXPECT_NEAR(first, 4294967296.0 / 60e6 - 1.0 / 30, 1e-6);
  for (int i = 1; i < 3; ++i) {
    const FrameRead read = (*source)->next();
    ASSERT_EQ(read.status, Status::frame);
    EXPECT_NEAR(read.frame.timestamp_s, first + i / 30.0, 1e-6);
    EXPECT_EQ(read.frame.color.at<cv::Vec3b>(0, 0)[2], i);
  }
}

TEST(Freenect, ContinuesTime_WhenRunningForHours) {
  FreenectClock clock;
  std::uint32_t ticks = 4'000'000'000U;
  const double first = clock.depthSeconds(ticks);
  double last = first;
  for (int i = 0; i < 600; ++i) {  // an image every 30 s
    ticks += 30U * FakeFreenect::kTicksPerSecond;
    last = clock.depthSeconds(ticks);
    EXPECT_NEAR(clock.colorSeconds(ticks - 600'000U), last - 0.01, 1e-6);
  }
  EXPECT_NEAR(last - first, 600 * 30.0, 1e-3);
}

TEST(Freenect, LeavesDepthUnregistered_WhenAColorCameraIsGiven) {
  FakeFreenect fake;
  fake.depthAt(0, 10'000 - 100);  // the first pixel: 10000, too far
  fake.colorAt(0, 1, 2, 3);
  SourceOptions options;
  options.color_registration = ColorRegistration{kinectColorCamera()};
  const auto source = openFake("freenect", options);
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ(fake.asked_depth, FREENECT_DEPTH_MM);
  EXPECT_NEAR((*source)->info().intrinsics.fx, 120 / (2 * 0.1042), 0.1);
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame) << read.error.message();
  ASSERT_TRUE(read.frame.color_camera);
  EXPECT_FLOAT_EQ(read.frame.color_camera->K.fx, 528);
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(0, 0), 0);
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(0, 1), 9900);
}

TEST(Freenect, UsesIntrinsicsAndScale_WhenOptionsAreGiven) {
  FakeFreenect fake;
  fake.depthAt(0, 5000);
  fake.colorAt(0, 1, 2, 3);
  SourceOptions options;
  options.intrinsics = Intrinsics{530, 531, 320, 240, 0, 0};
  options.depth_scale = 5000;
  const auto source = openFake("freenect", options);
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{530, 531, 320, 240, 640, 480}));
  EXPECT_FLOAT_EQ((*source)->next().frame.meters_per_unit, 1.0F / 5000);
  options.intrinsics = Intrinsics{3, 3, 320, 240, 0, 0};
  EXPECT_THAT(refusal("freenect", options), HasSubstr("--intrinsics"));
}

TEST(Freenect, TimesOutAndContinues_WhenTheCameraIsSilent) {
  FakeFreenect fake;
  const auto source = openFake();
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->next().status, Status::timeout);
  EXPECT_EQ(fake.waits, 1);
  fake.events.emplace_back([] { return 0; });    // packets, no complete image
  fake.events.emplace_back([] { return -10; });  // interrupted by a signal
  fake.events.emplace_back([&] { return fake.handOverNothing(), 0; });
  fake.depthAt(0, 1000);
  fake.colorAt(0, 1, 2, 3);
  EXPECT_EQ((*source)->next().status, Status::frame);
}

TEST(Freenect, ReturnsDepthAlone_WhenColorNeverArrives) {
  FakeFreenect fake;
  for (std::uint32_t i = 0; i < 60; ++i) fake.depthAt(i * kFrame, static_cast<std::uint16_t>(1000 + i));
  const auto source = openFake();
  ASSERT_TRUE(source) << source.error().message();
  FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame);
  EXPECT_TRUE(read.frame.color.empty());
  const int first = read.frame.depth.at<std::uint16_t>(1, 1);
  EXPECT_LT(first, 1040);
  read = (*source)->next();
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(1, 1), first + 1);
}

TEST(Freenect, FailsOnceWithTheName_WhenTheCameraIsUnplugged) {
  FakeFreenect fake;
  fake.depthAt(0, 1000);
  fake.colorAt(0, 1, 2, 3);
  fake.events.emplace_back([&fake] {
    fake.log("USB device disappeared, cancelling stream 81 :(\n");
    fake.log("USB camera marked dead, stopping streams\n");
    return -1;
  });
  {
    const auto source = openFake();
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_EQ((*source)->next().status, Status::frame);
    const FrameRead gone = (*source)->next();
    EXPECT_EQ(gone.status, Status::failed);
    EXPECT_EQ(gone.error.message(),
              "Kinect 0 does not answer any more: USB device disappeared, cancelling stream 81. Was the "
              "camera unplugged? Plug it in and open it again.");
  }
  EXPECT_TRUE(fake.isAllClosed());
}

TEST(Freenect, ClosesInOrder_WhenDestroyed) {
  FakeFreenect fake;
  { ASSERT_TRUE(openFake()); }
  EXPECT_THAT(fake.calls,
              ElementsAre("open", "start depth", "start colour", "stop depth", "stop colour", "close"));
  EXPECT_TRUE(fake.isAllClosed());
}

TEST(Freenect, GivesAdvice_WhenThereIsNoCamera) {
  FakeFreenect fake;
  fake.cameras = 0;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("No Kinect v1 was found"), HasSubstr("power supply"),
                               HasSubstr("scantrove devices")));
  fake.cameras = -1;  // libfreenect's own failure to count
  EXPECT_THAT(refusal(), HasSubstr("No Kinect v1 was found"));
  EXPECT_TRUE(fake.calls.empty());
  EXPECT_TRUE(fake.isAllClosed());
}

TEST(Freenect, Fails_WhenTheLibraryCannotStart) {
  FakeFreenect fake;
  fake.init_status = -99;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("libfreenect cannot start"), HasSubstr("-99")));
  EXPECT_FALSE(listFreenectCameras(FakeFreenect::api()));
}

TEST(Freenect, SelectsByIndexOrSerialNumber) {
  FakeFreenect fake;
  fake.cameras = 2;
  { ASSERT_TRUE(openFake("freenect:")); }
  EXPECT_EQ(fake.opened_index, 0);
  { ASSERT_TRUE(openFake("freenect:1")); }
  EXPECT_EQ(fake.opened_index, 1);
  EXPECT_THAT(refusal("freenect:2"), AllOf(HasSubstr("There is no Kinect 2"), HasSubstr("2 are plugged in")));
  const auto source = openFake("freenect:A00362A17284043A");
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().name, "Kinect A00362A17284043A");
  EXPECT_THAT(refusal("freenect:0000000000000000"),
              AllOf(HasSubstr("Kinect 0000000000000000 cannot be opened"), HasSubstr("serial")));
}

TEST(Freenect, NamesTheFirstReason_WhenOpeningFails) {
  FakeFreenect fake;
  fake.open_status = -1;
  fake.open_message = "Could not open camera: LIBUSB_ERROR_ACCESS\n";
  EXPECT_THAT(refusal(), AllOf(HasSubstr("Kinect 0 cannot be opened: Could not open camera: "
                                         "LIBUSB_ERROR_ACCESS. Is another program"),
                               Not(HasSubstr("audio"))));
  EXPECT_TRUE(fake.isAllClosed());
}

TEST(Freenect, ClosesTheCamera_WhenStartingFails) {
  FakeFreenect fake;
  fake.start_color_status = -1;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("Kinect 0 cannot be started"), HasSubstr("USB port")));
  EXPECT_THAT(fake.calls, testing::Contains("stop depth"));
  EXPECT_TRUE(fake.isAllClosed());
}

TEST(Freenect, RefusesTheCamera_WhenItsImagesHaveAnotherSize) {
  FakeFreenect fake;
  const freenect_frame_mode right = fake.depth_mode;
  fake.depth_mode.bytes = 422'400;  // packed
  EXPECT_THAT(refusal(), HasSubstr("640x480"));
  fake.depth_mode = right;
  fake.depth_mode.height = 488;
  EXPECT_THAT(refusal(), HasSubstr("640x480"));
  fake.depth_mode = right;
  fake.depth_mode.is_valid = 0;
  EXPECT_THAT(refusal(), HasSubstr("640x480"));
  fake.depth_mode = right;
  fake.color_mode.width = 1280;
  EXPECT_THAT(refusal(), HasSubstr("640x480"));
  EXPECT_TRUE(fake.isAllClosed());
}

TEST(Freenect, ListsEveryCamera) {
  FakeFreenect fake;
  fake.cameras = 2;
  const auto cameras = listFreenectCameras(FakeFreenect::api());
  ASSERT_TRUE(cameras);
  ASSERT_EQ(cameras->size(), 2U);
  EXPECT_EQ((*cameras)[1].uri, "freenect:1");
  EXPECT_EQ((*cameras)[1].driver, "libfreenect");
  EXPECT_TRUE(isFreenectUri((*cameras)[1].uri));
  EXPECT_TRUE(fake.isAllClosed());
  EXPECT_TRUE(fake.calls.empty());
}

TEST(Freenect, RecognizesSourceNames) {
  EXPECT_TRUE(isFreenectUri("freenect"));
  EXPECT_FALSE(isFreenectUri("freenect2"));
  const auto cameras = listFreenectCameras();
  if (cameras && cameras->empty()) {  // the installed library, without a camera
    for (const char* source : {"freenect", "freenect:", "freenect:0", "camera:freenect:0"}) {
      EXPECT_THAT(openError(source), HasSubstr("No Kinect v1 was found")) << source;
    }
  }
}

}  // namespace
}  // namespace scantrove
#endif
