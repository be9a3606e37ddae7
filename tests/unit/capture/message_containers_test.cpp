// Recordings of ROS messages, written here after the documented layouts.
#include "tests/support/captured_log.h"
#include "tests/unit/capture/container_fixture.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

void expectRegisteredFrames(const std::filesystem::path& file, const std::string& kind,
                            std::size_t count = 5) {
  SCOPED_TRACE(file.filename().string());
  const auto source = openInput(file.string(), {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().kind, kind);
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{50, 51, 23.25F, 17.5F, 48, 36}));
  EXPECT_EQ((*source)->info().frame_count, static_cast<int>(count));
  const std::vector<RgbdFrame> frames = readAllFrames(file);
  ASSERT_EQ(frames.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const int number = static_cast<int>(i);
    EXPECT_EQ(frames[i].index, number);
    EXPECT_TRUE(areEqual(frames[i].depth, containerDepth(number))) << i;
    EXPECT_TRUE(areEqual(frames[i].color, containerColor(number))) << i;
    EXPECT_FALSE(frames[i].color_camera);
    EXPECT_EQ(frames[i].meters_per_unit, 0.001F);
    EXPECT_NEAR(frames[i].timestamp_s, 1.7e9 + 0.033333333 * number, 1e-5);
  }
}

TEST(RosBag, GivesEveryBit_InEachCompression) {
  const TemporaryFolder folder;
  for (const char* compression : {"none", "lz4", "bz2"}) {
    const auto file =
        folder.write(std::string(compression) + ".bag", bagBytes(registeredFrames(false), compression));
    expectRegisteredFrames(file, "ROS bag");
  }
}

TEST(RosBag, OpensWithAWarning_WhenTheRecorderWasKilled) {
  const TemporaryFolder folder;
  const CapturedLog log;
  expectRegisteredFrames(folder.write("a.bag", bagBytes(registeredFrames(false), "lz4", 4, false)),
                         "ROS bag");
  EXPECT_THAT(log.text(), HasSubstr("not complete"));
}

TEST(RosBag, IsRecognizedByItsBytes_WhateverItsName) {
  const TemporaryFolder folder;
  expectRegisteredFrames(folder.write("recording.dat", bagBytes(registeredFrames(false))), "ROS bag");
}

TEST(RosBag, IsRefused_WhenOfAnotherVersion) {
  const TemporaryFolder folder;
  EXPECT_THAT(openContainerError(folder.write("old.bag", "#ROSBAG V1.2\n....")),
              AllOf(HasSubstr("old.bag"), HasSubstr("version"), HasSubstr("rosbag fix")));
}

TEST(Rosbag2Database, GivesEveryBit_WithAndWithoutCompression) {
  const TemporaryFolder folder;
  for (const char* compression : {"", "zstd"}) {
    writeRosbag2(folder / "a.db3", registeredFrames(true), compression);
    expectRegisteredFrames(folder / "a.db3", "ROS 2 bag");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.db3-wal"));
}

TEST(Rosbag2Database, OpensByItsFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "bag");
  folder.write("bag/metadata.yaml", "rosbag2_bagfile_information:\n");
  writeRosbag2(folder / "bag" / "bag_0.db3", registeredFrames(true));
  expectRegisteredFrames(folder / "bag", "ROS 2 bag");
  writeRosbag2(folder / "bag" / "bag_1.db3", registeredFrames(true));
  EXPECT_THAT(openContainerError(folder / "bag"), AllOf(HasSubstr("several files"), HasSubstr("bag_0.db3")));
}

TEST(Rosbag2Database, IsRefused_WhenAnotherDatabase) {
  const TemporaryFolder folder;
  sqlite3* database = nullptr;
  sqlite3_open((folder / "other.db3").c_str(), &database);
  sqlite3_exec(database, "CREATE TABLE a(b)", nullptr, nullptr, nullptr);
  sqlite3_close(database);
  EXPECT_THAT(openContainerError(folder / "other.db3"), AllOf(HasSubstr("other.db3"), HasSubstr("rosbag2")));
}

TEST(McapFile, GivesEveryBit_InEachLayout) {
  const TemporaryFolder folder;
  std::vector<McapLayout> layouts(7);
  layouts[1].compression = "lz4";
  layouts[2].compression = "zstd";
  layouts[3].has_index = false;
  layouts[4].per_chunk = 0;
  layouts[5].encoding = "ros1";
  layouts[6] = {"zstd", 3, true, false, "cdr"};
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    const bool is_cdr = layouts[i].encoding == "cdr";
    const auto file =
        folder.write("layout" + std::to_string(i) + ".mcap", mcapBytes(registeredFrames(is_cdr), layouts[i]));
    expectRegisteredFrames(file, "MCAP");
  }
}

TEST(MessageRecording, TakesAPartOfTheFrames_WhenAsked) {
  const TemporaryFolder folder;
  SourceOptions options;
  options.start = 1;
  options.stride = 2;
  const auto frames = readAllFrames(folder.write("a.bag", bagBytes(registeredFrames(false))), options);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_TRUE(areEqual(frames[0].depth, containerDepth(1)));
  EXPECT_TRUE(areEqual(frames[1].color, containerColor(3)));
}

TEST(MessageRecording, ReadsEachEncodingOfDepth) {
  const TemporaryFolder folder;
  const cv::Mat depth = containerDepth(0);
  cv::Mat meters, swapped = depth.clone();
  depth.convertTo(meters, CV_32FC1, 0.001);
  meters.at<float>(0, 0) = NAN;
  for (auto& value : cv::Mat_<std::uint16_t>(swapped))
    value = static_cast<std::uint16_t>(value << 8 | value >> 8);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", depth, png);
  const std::string png_bytes(png.begin(), png.end()), header(12, '\0');
  const std::string size = raw(std::int32_t{48}) + raw(std::int32_t{36});
  const std::string image = "sensor_msgs/Image", compressed = "sensor_msgs/CompressedImage";
  const std::vector<std::pair<std::string, std::string>> messages{
      {image, rosImage(true, 7, "o", "16UC1", depth)},
      {image, rosImage(true, 7, "o", "mono16", depth)},
      {image, rosImage(true, 7, "o", "16UC1", swapped, true)},
      {image, rosImage(true, 7, "o", "32FC1", meters)},
      {compressed, rosCompressedImage(true, 7, "o", "16UC1; compressedDepth", header + png_bytes)},
      {compressed, rosCompressedImage(true, 7, "o", "16UC1; compressedDepth png", png_bytes)},
      {compressed,
       rosCompressedImage(true, 7, "o", "16UC1; compressedDepth rvl", header + size + rvlBytes(depth))}};
  for (std::size_t i = 0; i < messages.size(); ++i) {
    SCOPED_TRACE(i);
    const auto& [type, data] = messages[i];
    writeRosbag2(folder / "a.db3", {{"/depth/image", type, 9, data},
                                    {"/depth/camera_info", "sensor_msgs/CameraInfo", 9,
                                     rosCameraInfo(true, {48, 36}, kTestCamera)}});
    const auto frames = readAllFrames(folder / "a.db3");
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_TRUE(frames[0].color.empty());
    cv::Mat millimeters;
    frames[0].depth.convertTo(millimeters, CV_16UC1, static_cast<double>(frames[0].meters_per_unit) * 1000);
    if (type == image && i == 3) {  // in quarters of a millimetre; NaN is no reading
      EXPECT_EQ(millimeters.at<std::uint16_t>(0, 0), 0);
      millimeters.at<std::uint16_t>(0, 0) = depth.at<std::uint16_t>(0, 0);
    }
    EXPECT_TRUE(areEqual(millimeters, depth));
  }
}

TEST(MessageRecording, ReadsInverseDepth_WhenCompressedFromMeters) {
  // z = a / (value - b), as compressed_depth_image_transport documents its 32FC1.
  const TemporaryFolder folder;
  const float a = 2000, b = -10;
  cv::Mat values(36, 48, CV_16UC1, cv::Scalar(990));
  values.at<std::uint16_t>(0, 0) = 0;
  std::vector<std::uint8_t> png;
  cv::imencode(".png", values, png);
  const std::string data = raw(std::int32_t{1}) + raw(a) + raw(b) + std::string(png.begin(), png.end());
  writeRosbag2(folder / "a.db3", {{"/depth/image/compressedDepth", "sensor_msgs/CompressedImage", 9,
                                   rosCompressedImage(true, 7, "o", "32FC1; compressedDepth", data)},
                                  {"/depth/camera_info", "sensor_msgs/CameraInfo", 9,
                                   rosCameraInfo(true, {48, 36}, kTestCamera)}});
  const auto frames = readAllFrames(folder / "a.db3");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].depth.at<std::uint16_t>(0, 0), 0);
  EXPECT_NEAR(frames[0].depth.at<std::uint16_t>(5, 5) * static_cast<double>(frames[0].meters_per_unit), 2.0,
              1e-4);
}

TEST(MessageRecording, FindsTheColorCamera_ByTheTransforms) {
  const TemporaryFolder folder;
  ContainerMessages messages;
  messages.push_back(
      {"/tf_static", "tf2_msgs/TFMessage", 1, rosTransforms(true, "base", "depth", {0.1, 0, 0, 0, 0, 0, 1})});
  messages.push_back({"/tf_static", "tf2_msgs/TFMessage", 1,
                      rosTransforms(true, "base", "color", {0.125, 0, 0, 0, 0, 0, 1})});
  messages.push_back(
      {"/c/depth/camera_info", "sensor_msgs/CameraInfo", 1, rosCameraInfo(true, {48, 36}, kTestCamera)});
  messages.push_back(
      {"/c/rgb/camera_info", "sensor_msgs/CameraInfo", 1, rosCameraInfo(true, {64, 36}, {60, 60, 31, 17})});
  messages.push_back(
      {"/c/depth/image", "sensor_msgs/Image", 2, rosImage(true, 5, "depth", "16UC1", containerDepth(0))});
  messages.push_back({"/c/rgb/image", "sensor_msgs/Image", 3,
                      rosImage(true, 5, "color", "bgr8", containerColor(0, {64, 36}))});
  writeRosbag2(folder / "a.db3", messages);
  const auto frames = readAllFrames(folder / "a.db3");
  ASSERT_EQ(frames.size(), 1U);
  ASSERT_TRUE(frames[0].color_camera);
  EXPECT_EQ(frames[0].color_camera->K, (Intrinsics{60, 60, 31, 17, 64, 36}));
  // A point at the depth camera's centre lies 25 mm to the left of the colour camera.
  const Eigen::Vector3d center = frames[0].color_camera->T_color_depth * Eigen::Vector3d::Zero();
  EXPECT_LT((center - Eigen::Vector3d(-0.025, 0, 0)).norm(), 1e-9);
}

TEST(MessageRecording, ListsTheTopics_WhenThereAreSeveral) {
  const TemporaryFolder folder;
  ContainerMessages messages = registeredFrames(true, 2);
  ContainerMessages other = messages;
  for (ContainerMessage& message : other) message.topic.replace(0, 7, "/second");
  messages.insert(messages.end(), other.begin(), other.end());
  writeRosbag2(folder / "two.db3", messages);
  EXPECT_THAT(openContainerError(folder / "two.db3"),
              AllOf(HasSubstr("/camera/depth/image_raw"), HasSubstr("/second/depth/image_raw"),
                    HasSubstr("--depth-topic")));
  SourceOptions options;
  options.depth_topic = "/second/depth/image_raw";
  EXPECT_EQ(readAllFrames(folder / "two.db3", options).size(), 2U);
  options.color_topic = "/none";
  EXPECT_THAT(openContainerError(folder / "two.db3", options),
              AllOf(HasSubstr("/none"), HasSubstr("--color-topic"), HasSubstr("/second/color/image_raw")));
}

TEST(MessageRecording, PrefersRegisteredDepth_AndCountsCompressedImagesOnce) {
  const TemporaryFolder folder;
  ContainerMessages messages = registeredFrames(true, 2);
  const ContainerMessage depth = messages[1];
  messages.push_back({"/camera/depth/image_raw/compressedDepth", "sensor_msgs/CompressedImage", depth.time_ns,
                      rosCompressedImage(true, 1, "optical", "16UC1; compressedDepth", "?")});
  writeRosbag2(folder / "a.db3", messages);
  EXPECT_EQ(readAllFrames(folder / "a.db3").size(), 2U);
  messages.push_back({"/camera/aligned_depth_to_color/image_raw", "sensor_msgs/Image", depth.time_ns,
                      rosImage(true, kFirstStamp_ns, "optical", "16UC1", containerDepth(9))});
  messages.push_back({"/camera/color/camera_info", "sensor_msgs/CameraInfo", depth.time_ns,
                      rosCameraInfo(true, {48, 36}, kTestCamera)});
  writeRosbag2(folder / "a.db3", messages);
  const auto frames = readAllFrames(folder / "a.db3");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_TRUE(areEqual(frames[0].depth, containerDepth(9)));
}

TEST(MessageRecording, SaysWhatIsMissing_WhenThereIsNoDepthOrCamera) {
  const TemporaryFolder folder;
  ContainerMessages messages = registeredFrames(false, 1);
  const ContainerMessages color_only{messages[2]};
  EXPECT_THAT(openContainerError(folder.write("color.bag", bagBytes(color_only))),
              AllOf(HasSubstr("no depth images"), HasSubstr("/camera/color/image_raw")));
  messages.erase(messages.begin());
  const auto file = folder.write("camera.bag", bagBytes(messages));
  EXPECT_THAT(openContainerError(file), AllOf(HasSubstr("camera.bag"), HasSubstr("--intrinsics")));
  SourceOptions options;
  options.intrinsics = Intrinsics{50, 50, 24, 18, 0, 0};
  EXPECT_EQ(readAllFrames(file, options).size(), 1U);
}

TEST(RealsenseRecording, TakesUnitCameraAndPlaceFromTexts) {
  // The layout of RealSense's SDK since 2026: std_msgs/String of KEY=VALUE;...
  const TemporaryFolder folder;
  const std::string depth = "/device_0/sensor_0/Depth_0", color = "/device_0/sensor_1/Color_0";
  const auto text = [](const std::string& value) { return RosBytes(true).text(value).message(); };
  const std::string camera =
      "width=48;height=36;fx=50;ppx=23.5;fy=51;ppy=17.5;model=Brown Conrady;coeffs=0,0,0,0,0";
  // 90 degrees about z, column by column: x of depth is y of colour.
  const std::string turned = "rotation=0,1,0,-1,0,0,0,0,1;translation=0.015,0,0";
  ContainerMessages messages{
      {depth + "/camera_info", "std_msgs/String", 0, text(camera)},
      {color + "/camera_info", "std_msgs/String", 0, text(camera)},
      {depth + "/image/data", "sensor_msgs/Image", 10,
       rosImage(true, 10, "Depth", "mono16", containerDepth(0))},
      {depth + "/image/metadata", "std_msgs/String", 10,
       text("Frame number=1;depth_units=0.000250;Exposure=3;")},
      {depth + "/tf/ref_0", "std_msgs/String", 0, text("rotation=1,0,0,0,1,0,0,0,1;translation=0,0,0")},
      {color + "/image/data", "sensor_msgs/Image", 11,
       rosImage(true, 11, "Color", "rgb8", containerColor(0))},
      {color + "/tf/ref_0", "std_msgs/String", 0, text(turned)}};
  for (const char* compression : {"", "zstd"}) {
    writeRosbag2(folder / "rs.db3", messages, compression);
    const auto frames = readAllFrames(folder / "rs.db3");
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].meters_per_unit, 0.00025F);
    EXPECT_TRUE(areEqual(frames[0].depth, containerDepth(0)));
    cv::Mat rgb;
    cv::cvtColor(containerColor(0), rgb, cv::COLOR_BGR2RGB);
    EXPECT_TRUE(areEqual(frames[0].color, rgb));
    ASSERT_TRUE(frames[0].color_camera);
    const Eigen::Vector3d seen = frames[0].color_camera->T_color_depth * Eigen::Vector3d(1, 0, 2);
    EXPECT_LT((seen - Eigen::Vector3d(0.015, 1, 2)).norm(), 1e-6);
  }
}

TEST(OpenInput, NamesTheMakersTool_WhenOnlyThatReadsTheFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(openContainerError(folder.write("a.svo", "SVO")), HasSubstr("ZED_SVO_Export"));
  EXPECT_THAT(openContainerError(folder.write("a.svo2", mcapBytes(registeredFrames(true)))),
              HasSubstr("ZED_SVO_Export"));
  EXPECT_THAT(openContainerError(folder.write("a.xef", "EVENTS1")), HasSubstr("iai_kinect2"));
  EXPECT_THAT(openContainerError(folder.write("a.mp4", std::string("\0\0\0\x18", 4) + "ftypisom....")),
              HasSubstr("DepthAI"));
  EXPECT_THAT(openContainerError(folder.write("a.db3.zstd", compressedBy("zstd", "SQLite"))),
              HasSubstr("zstd -d"));
}

}  // namespace
}  // namespace scantrove
