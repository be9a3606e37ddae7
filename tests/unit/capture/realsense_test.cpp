// RealSense's series D400 on simulated video nodes, down to the kernel's requests. Not tested with a real
// camera.
#include "core/capture/live/realsense_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/capture/live/video_nodes.h"
#include "core/capture/open_input.h"
#include "tests/support/captured_log.h"
#include "tests/unit/capture/fake_video_system.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Status = FrameRead::Status;

constexpr double kPeriod_s = 1.0 / 30;

std::string depthBytes(int millimeters, const cv::Size& size = {640, 480}) {
  std::string bytes;
  for (int i = 0; i < size.area(); ++i)
    bytes += littleEndianBytes(static_cast<std::uint64_t>(millimeters), 2);
  return bytes;
}

/// YUYV images of one colour.
std::string yuyvBytes(int y, int u, int v, const cv::Size& size = {640, 480}) {
  const std::string pair{static_cast<char>(y), static_cast<char>(u), static_cast<char>(y),
                         static_cast<char>(v)};
  std::string bytes;
  for (int i = 0; i < size.area() / 2; ++i) bytes += pair;
  return bytes;
}

/// A D435 with the nodes of depth, its metadata, infrared and colour.
class D435 {
 public:
  explicit D435(const std::string& product = "0b07", const std::string& serial = "017322071234") {
    computer.plug("2-1", product, serial);
    depth_path = computer.addNode(2, "2-1:1.0");
    const auto metadata_path = computer.addNode(3, "2-1:1.0");
    const auto infrared_path = computer.addNode(4, "2-1:1.0");
    color_path = computer.addNode(10, "2-1:1.3");
    depth().formats = {V4L2_PIX_FMT_Z16};
    depth().tables = {{25, realsenseDepthTable({385, 386, 321, 238}, {424, 425, 423, 241})},
                      {32, RealsenseColorTable().bytes()}};
    system.nodes[metadata_path];
    system.nodes[infrared_path].formats = {V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_UYVY};
    color().formats = {V4L2_PIX_FMT_YUYV};
  }

  [[nodiscard]] PlayedNode& depth() { return system.nodes[depth_path]; }
  [[nodiscard]] PlayedNode& color() { return system.nodes[color_path]; }
  void depthAt(double time_s, int millimeters) {
    depth().images.push_back({depthBytes(millimeters), time_s});
  }
  void colorAt(double time_s, int y) { color().images.push_back({yuyvBytes(y, 128, 128), time_s}); }
  [[nodiscard]] auto open(const std::string& uri = "realsense", const SourceOptions& options = {}) {
    return openRealsenseCamera(system, computer.root(), uri, options);
  }
  [[nodiscard]] std::string refusal(const std::string& uri = "realsense", const SourceOptions& options = {}) {
    const auto source = open(uri, options);
    return source ? "(opened)" : source.error().message();
  }

  UsbCameras computer;
  FakeVideoSystem system;
  std::filesystem::path depth_path, color_path;
};

TEST(Realsense, ReturnsDepthAndColorWithTheirCameras) {
  D435 camera;
  camera.depthAt(7.25, 1500);
  camera.color().images.push_back({yuyvBytes(81, 90, 240), 7.25});  // red
  const CapturedLog log;
  const auto source = camera.open();
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.name, "RealSense D435 017322071234");
  EXPECT_EQ(info.kind, "RealSense camera");
  EXPECT_TRUE(info.is_live);
  EXPECT_EQ(info.intrinsics, (Intrinsics{385, 386, 321, 238, 640, 480}));
  EXPECT_EQ(camera.system.asked_rate, 30U);
  EXPECT_EQ(log.text(), "");

  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame) << read.error.message();
  EXPECT_NEAR(read.frame.timestamp_s, 7.25, 1e-5);
  EXPECT_FLOAT_EQ(read.frame.meters_per_unit, 0.001F);
  ASSERT_EQ(read.frame.depth.type(), CV_16UC1);
  ASSERT_EQ(read.frame.depth.size(), cv::Size(640, 480));
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(479, 639), 1500);
  ASSERT_EQ(read.frame.color.size(), cv::Size(640, 480));
  const cv::Vec3b red = read.frame.color.at<cv::Vec3b>(479, 639);
  EXPECT_NEAR(red[0], 0, 3);
  EXPECT_NEAR(red[1], 0, 3);
  EXPECT_NEAR(red[2], 255, 3);
  ASSERT_TRUE(read.frame.color_camera);
  EXPECT_NEAR(read.frame.color_camera->K.fx, 614.4, 1e-3);
  EXPECT_NEAR(read.frame.color_camera->T_color_depth.translation().x(), 0.015, 1e-6);
}

TEST(Realsense, PairsDepthWithTheColorNearestInTime) {
  D435 camera;
  for (int i = 0; i < 4; ++i) {
    camera.depthAt(1 + i * kPeriod_s, 1000 + i);
    camera.colorAt(1 + i * kPeriod_s + 0.004, 50 + 40 * i);
  }
  const auto source = camera.open();
  ASSERT_TRUE(source) << source.error().message();
  for (int i = 0; i < 4; ++i) {
    const FrameRead read = (*source)->next();
    ASSERT_EQ(read.status, Status::frame) << read.error.message();
    EXPECT_EQ(read.frame.index, i);
    EXPECT_EQ(read.frame.depth.at<std::uint16_t>(1, 1), 1000 + i);
    EXPECT_NEAR(read.frame.color.at<cv::Vec3b>(1, 1)[1], (50 + 40 * i - 16) * 255 / 219, 2);
  }
}

TEST(Realsense, UndistortsColor_WhenItsLensIsDistorted) {
  D435 camera;
  RealsenseColorTable table;
  table.lens = {0.2F, 0, 0, 0, 0};
  camera.depth().tables[32] = table.bytes();
  camera.depthAt(1, 1000);
  std::string image = yuyvBytes(16, 128, 128);
  image.replace(0, 640 * 2 * 40, yuyvBytes(235, 128, 128, {640, 40}));  // the 40 upper rows are white
  camera.color().images.push_back({image, 1});
  const auto source = camera.open();
  ASSERT_TRUE(source) << source.error().message();
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame) << read.error.message();
  // Pixel (324, 39) lies at y = (39 - 235.2) / 614.4 = -0.319 in the distorted image, and at -0.319 (1 + 0.2
  // * 0.319^2) = -0.326 in the pinhole image: row 35. White ends there.
  EXPECT_GT(read.frame.color.at<cv::Vec3b>(33, 324)[1], 200);
  EXPECT_LT(read.frame.color.at<cv::Vec3b>(38, 324)[1], 50);
}

TEST(Realsense, MeasuresInTenthsOfMillimeters_WhenItIsAD405) {
  D435 camera("0b5b");
  camera.depthAt(1, 1500);
  camera.colorAt(1, 100);
  const auto source = camera.open();
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_FLOAT_EQ((*source)->next().frame.meters_per_unit, 0.0001F);
}

TEST(Realsense, UsesIntrinsicsAndScale_WhenOptionsAreGiven) {
  D435 camera;
  camera.depth().tables.clear();
  camera.depthAt(1, 1500);
  SourceOptions options;
  options.intrinsics = Intrinsics{400, 401, 322, 239, 0, 0};
  options.depth_scale = 5000;
  options.color_registration = ColorRegistration{};
  const CapturedLog log;
  const auto source = camera.open("realsense", options);
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{400, 401, 322, 239, 640, 480}));
  camera.colorAt(1, 100);
  const FrameRead read = (*source)->next();
  EXPECT_FLOAT_EQ(read.frame.meters_per_unit, 0.0002F);
  EXPECT_FALSE(read.frame.color.empty());
  EXPECT_FALSE(read.frame.color_camera);
  EXPECT_EQ(log.text(), "");
}

TEST(Realsense, UsesTheUsualIntrinsics_WhenTheCalibrationCannotBeRead) {
  D435 without, damaged;
  without.depth().tables.clear();
  damaged.depth().tables[25][300] = '\x7f';
  for (D435* const camera : {&without, &damaged}) {
    const CapturedLog log;
    const auto source = camera->open();
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{385, 385, 319.5, 239.5, 640, 480}));
    EXPECT_THAT(log.text(),
                AllOf(HasSubstr("RealSense D435 017322071234"), HasSubstr("--intrinsics fx,fy,cx,cy")));
  }
}

TEST(Realsense, GoesOnWithoutColor_WhenThereIsNoneOrItsCameraIsUnknown) {
  D435 without, unknown;
  without.system.nodes.erase(without.color_path);
  unknown.depth().tables.erase(32);
  for (D435* const camera : {&without, &unknown}) {
    camera->depthAt(1, 1000);
    const CapturedLog log;
    const auto source = camera->open();
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_THAT(log.text(), HasSubstr("Going on without colour"));
    const FrameRead read = (*source)->next();
    ASSERT_EQ(read.status, Status::frame) << read.error.message();
    EXPECT_TRUE(read.frame.color.empty());
  }
}

TEST(Realsense, TakesAnotherSize_WhenThereIsNo640x480) {
  D435 camera;
  camera.depth().sizes = {{1280, 720}, {848, 480}};
  camera.depth().images.push_back({depthBytes(900, {848, 480}), 1});
  camera.colorAt(1, 100);
  const auto source = camera.open();
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{424, 425, 423, 241, 848, 480}));
  EXPECT_EQ((*source)->next().frame.depth.size(), cv::Size(848, 480));
}

TEST(Realsense, SkipsAFrame_WhenItsBufferIsShortOrMarked) {
  D435 camera;
  camera.depth().images = {{depthBytes(1000).substr(0, 614398), 1},
                           {depthBytes(1000), 1 + kPeriod_s, V4L2_BUF_FLAG_ERROR},
                           {depthBytes(1002), 1 + 2 * kPeriod_s}};
  for (int i = 0; i < 3; ++i) camera.colorAt(1 + i * kPeriod_s, 100);
  const auto source = camera.open();
  ASSERT_TRUE(source) << source.error().message();
  for (int i = 0; i < 2; ++i) {
    const FrameRead read = (*source)->next();
    EXPECT_EQ(read.status, Status::skipped);
    EXPECT_THAT(read.error.what, HasSubstr("Frame " + std::to_string(i) + " of RealSense D435"));
  }
  const FrameRead good = (*source)->next();
  ASSERT_EQ(good.status, Status::frame);
  EXPECT_EQ(good.frame.depth.at<std::uint16_t>(0, 0), 1002);
}

TEST(Realsense, TimesOutAndContinues_WhenTheCameraIsSilent) {
  D435 camera;
  const auto source = camera.open();
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->next().status, Status::timeout);
  for (int i = 0; i < 20; ++i) {  // more images than buffers
    camera.depthAt(1 + i, 1000 + i);
    camera.colorAt(1 + i, 100);
    const FrameRead read = (*source)->next();
    ASSERT_EQ(read.status, Status::frame);
    EXPECT_EQ(read.frame.depth.at<std::uint16_t>(5, 5), 1000 + i);
  }
}

TEST(Realsense, Fails_WhenItIsUnplugged) {
  D435 camera;
  camera.depthAt(1, 1000);
  camera.colorAt(1, 100);
  camera.depth().error_after_images = ENODEV;
  const auto source = camera.open();
  ASSERT_TRUE(source) << source.error().message();
  Status status = Status::frame;
  FrameRead read;
  for (int i = 0; i < 3 && status == Status::frame; ++i) {
    read = (*source)->next();
    status = read.status;
  }
  EXPECT_EQ(status, Status::failed);
  EXPECT_EQ(read.error.message(),
            "RealSense D435 017322071234 does not answer any more: No such device. Was the camera unplugged? "
            "Plug it in and open it again.");
}

TEST(Realsense, NamesNodeAndReason_WhenItIsBusy) {
  D435 by_format, by_buffers, by_start;
  by_format.depth().format_error = EBUSY;
  by_buffers.color().buffers_error = EBUSY;
  by_start.color().start_error = EBUSY;
  EXPECT_THAT(by_format.refusal(), AllOf(HasSubstr("/dev/video2"), HasSubstr("Another program uses it")));
  EXPECT_THAT(by_buffers.refusal(), AllOf(HasSubstr("/dev/video10"), HasSubstr("Another program uses it")));
  EXPECT_THAT(by_start.refusal(), AllOf(HasSubstr("/dev/video10"), HasSubstr("Another program uses it")));
}

TEST(Realsense, GivesTheRule_WhenPermissionIsMissing) {
  D435 camera;
  for (auto& [path, node] : camera.system.nodes) node.open_error = EACCES;
  std::filesystem::permissions(camera.depth_path, std::filesystem::perms(0600));
  EXPECT_THAT(camera.refusal(), AllOf(HasSubstr("Cannot open /dev/video2"), HasSubstr("Permission denied"),
                                      HasSubstr("SUBSYSTEM==\"video4linux\", ATTRS{idVendor}==\"8086\", "
                                                "ATTRS{idProduct}==\"0b07\""),
                                      HasSubstr("GROUP=\"video\"")));
}

TEST(Realsense, AdvisesAnotherPort_WhenTheBandwidthIsMissing) {
  D435 camera;
  camera.depth().start_error = ENOSPC;
  EXPECT_THAT(camera.refusal(), HasSubstr("USB 3"));
}

TEST(Realsense, Fails_WhenNoNodeHasDepth) {
  D435 camera;
  camera.depth().formats = {V4L2_PIX_FMT_UYVY};
  EXPECT_THAT(camera.refusal(), HasSubstr("offers no depth images (Z16)"));
  EXPECT_EQ(camera.system.open_count, 0);
}

TEST(Realsense, NamesTheDriver_WhenThereAreNoNodes) {
  const UsbCameras computer;
  computer.plug("2-1", "0b07", "1");
  FakeVideoSystem system;
  const auto source = openRealsenseCamera(system, computer.root(), "realsense", {});
  ASSERT_FALSE(source);
  EXPECT_THAT(source.error().message(), HasSubstr("modprobe uvcvideo"));
}

TEST(Realsense, SelectsByIdOrNode) {
  D435 camera;
  EXPECT_EQ(camera.refusal("realsense:017322071234"), "(opened)");
  EXPECT_EQ(camera.refusal("realsense:/dev/video2"), "(opened)");
  EXPECT_THAT(camera.refusal("realsense:/dev/video10"), HasSubstr("at /dev/video10"));
  EXPECT_THAT(camera.refusal("realsense:123"), HasSubstr("No RealSense D4xx is 123."));
  EXPECT_THAT(D435("0b64").refusal(), HasSubstr("No RealSense D4xx was found"));  // an L515
}

TEST(Realsense, ClosesEverything_WhenDestroyed) {
  D435 camera;
  {
    const auto source = camera.open();
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_EQ(camera.system.open_count, 2);
    EXPECT_EQ(camera.system.mapped_count, 8);
  }
  EXPECT_EQ(camera.system.open_count, 0);
  EXPECT_EQ(camera.system.mapped_count, 0);
}

TEST(Realsense, ListsCamerasWithNodes) {
  const D435 camera;
  const UsbCameras& computer = camera.computer;
  computer.plug("2-2", "0ad3", "");
  EXPECT_FALSE(computer.addNode(12, "2-2:1.0").empty());
  computer.plug("2-3", "0b3a", "9");          // without nodes
  computer.plug("2-4", "0825", "7", "046d");  // a web camera
  EXPECT_FALSE(computer.addNode(0, "2-4:1.0").empty());
  const auto cameras = listRealsenseCameras(computer.root());
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].uri, "realsense:017322071234");
  EXPECT_EQ(cameras[0].name, "RealSense D435");
  EXPECT_EQ(cameras[0].vendor, "Intel");
  EXPECT_EQ(cameras[0].driver, "V4L2");
  EXPECT_EQ(cameras[1].uri, "realsense:/dev/video12");
  EXPECT_THAT(listRealsenseCameras(computer.root() / "nowhere"), IsEmpty());
}

TEST(Realsense, RecognizesSourceNames) {
  for (const char* name : {"realsense", "realsense:1", "realsense:/dev/video2"})
    EXPECT_TRUE(isCameraName(name)) << name;
  for (const char* name : {"realsense.bag", "realsenses", "./realsense"})
    EXPECT_FALSE(isCameraName(name)) << name;
}

TEST(VideoNodes, BelongToTheirDevice) {
  const D435 camera;
  UsbDevice device;
  device.port = "2-1";
  std::vector<std::string> names;
  for (const VideoNode& node : videoNodesOf(device, camera.computer.root())) names.push_back(node.name);
  EXPECT_THAT(names, ElementsAre("/dev/video2", "/dev/video3", "/dev/video4", "/dev/video10"));
  EXPECT_EQ(videoNodesOf(device, camera.computer.root()).back().usb_interface, 3);
  device.port = "2-11";
  EXPECT_THAT(videoNodesOf(device, camera.computer.root()), IsEmpty());
}

}  // namespace
}  // namespace scantrove
