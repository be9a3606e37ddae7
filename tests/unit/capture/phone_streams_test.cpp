// Recordings of phones with streams or archives of frames, and transforms.json.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4.h>

#include <opencv2/imgproc.hpp>

#include "core/capture/open_input.h"
#include "tests/support/tiny_video.h"
#include "tests/unit/capture/phone_files.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;

std::string lz4Block(const std::string& bytes) {
  std::string packed(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(bytes.size()))), '\0');
  packed.resize(static_cast<std::size_t>(LZ4_compress_default(
      bytes.data(), packed.data(), static_cast<int>(bytes.size()), static_cast<int>(packed.size()))));
  return packed;
}

void writeScannetppMetadata(const TemporaryFolder& folder, int frames) {
  std::string json = "{";
  for (int i = 0; i < frames; ++i) {
    json += numbered("\"frame_%06d\": ", i) + R"({"timestamp": 4, "intrinsic": )" + kIntrinsicRows +
            R"(, "aligned_pose": [[0, 0, -1, 1], [1, 0, 0, 2], [0, -1, 0, 3], [0, 0, 0, 1]]})" +
            (i + 1 < frames ? "," : "}");
  }
  folder.write("iphone/pose_intrinsic_imu.json", json);
}

TEST(PhoneStreams, ReadsScannetpp_InAllFormsOfItsDepth) {
  const std::string millimeters = bytesOfMat(tinyDepth(1500, kLidarSize)),
                    metres = bytesOfMat(cv::Mat(kLidarSize, CV_32FC1, cv::Scalar(1.5)));
  const auto sized = [](const std::string& block) { return littleEndianBytes(block.size(), 4) + block; };
  for (const std::string& depth :
       {sized(lz4Block(millimeters)) + sized(lz4Block(millimeters)),
        sized(rawDeflated(metres)) + sized(rawDeflated(metres)), rawDeflated(metres + metres)}) {
    const TemporaryFolder folder;
    writeScannetppMetadata(folder, 2);
    folder.write("iphone/depth.bin", depth);
    writeTinyVideo(folder / "iphone/rgb.mkv", 2, 64, 48);
    const auto frames = framesOf(folder.path(), "ScanNet++ iPhone");
    ASSERT_EQ(frames.size(), 2U);
    for (const RgbdFrame& frame : frames) {
      expectPose(frame);
      expectSensorIntrinsics(frame);
      EXPECT_NEAR(middleDepth_m(frame), 1.5, 1e-6);
      EXPECT_NEAR(frame.color.at<cv::Vec3b>(24, 32)[1], greyOfTinyVideo(frame.index), 3);
    }
  }
}

TEST(PhoneStreams, ReadsMultiscan) {
  const TemporaryFolder folder;
  cv::Mat half;
  cv::Mat(kLidarSize, CV_32FC1, cv::Scalar(1.5)).convertTo(half, CV_16F);
  const std::string confidence = bytesOfMat(confidenceImage(0, 1, 2));
  folder.write("s.depth.zlib", rawDeflated(bytesOfMat(half) + bytesOfMat(half)));
  folder.write("s.confidence.zlib", rawDeflated(confidence + confidence));
  folder.write("s.json", R"({"depth_unit": "m", "streams": [
      {"file_extension": "mp4", "resolution": [1440, 1920]},
      {"file_extension": "depth.zlib", "resolution": [192, 256]}]})");
  const std::string line =
      std::string(R"("transform": )") + kArkitColumns + R"(, "intrinsics": )" + kIntrinsicColumns + "}\n";
  folder.write("s.jsonl", "{\"timestamp\": 1700000000.5, " + line + "{\"timestamp\": 1700000000.6, " + line);
  writeTinyVideo(folder / "s.mp4", 2, 64, 48);
  const auto frames = framesOf(folder.path(), "MultiScan");
  ASSERT_EQ(frames.size(), 2U);
  for (const RgbdFrame& frame : frames) {
    expectPose(frame);
    expectSensorIntrinsics(frame);
    expectConfidence(frame);
    EXPECT_NEAR(middleDepth_m(frame), 1.5, 1e-3);
    EXPECT_NEAR(frame.color.at<cv::Vec3b>(24, 32)[1], greyOfTinyVideo(frame.index), 3);
  }
}

std::string record3dMetadata(const std::string& more) {
  return std::string(R"({"w": 1920, "h": 1440, "fps": 50, "K": )") + kIntrinsicColumns + R"(, "poses": [)" +
         kArkitQuaternion + ", " + kArkitQuaternion + "]" + more + "}";
}

std::string jpegBytes(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes);
  return {bytes.begin(), bytes.end()};
}

TEST(PhoneStreams, ReadsRecord3dArchive) {
  const TemporaryFolder folder;
  cv::Mat metres(kLidarSize, CV_32FC1, cv::Scalar(1.5));
  metres.col(0).setTo(std::numeric_limits<float>::quiet_NaN());
  std::vector<std::pair<std::string, std::string>> files{
      {"metadata",
       record3dMetadata(
           R"(, "perFrameIntrinsicCoeffs": [[1500, 1400, 959.5, 719.5], [1530, 1400, 959.5, 719.5]])")}};
  for (const char* const number : {"0", "1"}) {
    files.emplace_back(std::string("rgbd/") + number + ".depth", storedLzfse(bytesOfMat(metres)));
    files.emplace_back(std::string("rgbd/") + number + ".conf",
                       storedLzfse(bytesOfMat(confidenceImage(0, 1, 2))));
    files.emplace_back(std::string("rgbd/") + number + ".jpg", jpegBytes(tinyColor(40, kColorSize)));
  }
  const auto frames = framesOf(folder.write("scan.r3d", zipBytes(files)), "Record3D");
  ASSERT_EQ(frames.size(), 2U);
  expectPose(frames[1]);
  expectSensorIntrinsics(frames[0]);
  expectSensorIntrinsics(frames[1], 1530);
  expectConfidence(frames[1]);
  EXPECT_NEAR(middleDepth_m(frames[0]), 1.5, 1e-6);
  EXPECT_EQ(frames[0].depth.at<std::uint16_t>(5, 0), 0) << "NaN is no reading";
  EXPECT_NEAR(frames[1].timestamp_s, 0.02, 1e-9);
}

TEST(PhoneStreams, SaysWhy_WhenRecord3dArchiveIsTruncated) {
  const TemporaryFolder folder;
  const std::string archive =
      zipBytes({{"metadata", record3dMetadata("")}, {"rgbd/0.depth", "bvx2 damaged ..."}});
  EXPECT_THAT(openError(folder.write("damaged.r3d", archive)), HasSubstr("rgbd/0.depth"));
  EXPECT_THAT(openError(folder.write("half.r3d", archive.substr(0, archive.size() / 2))),
              HasSubstr("half.r3d"));
}

TEST(PhoneStreams, ReadsRecord3dExport_WithDepthOfTheSameNumber) {
  const TemporaryFolder folder;
  folder.write("metadata.json", record3dMetadata(""));
  // .exr by its name; the content tells that this is a NumPy array.
  folder.write("depth/1.exr", numpyBytes(cv::Mat(kLidarSize, CV_32FC1, cv::Scalar(1.5)), "<f4"));
  writeImage(folder / "rgb/1.jpg", tinyColor(40, kColorSize));
  const auto frames = framesOf(folder.path(), "Record3D");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].index, 1);
  expectPose(frames[0]);
  EXPECT_NEAR(middleDepth_m(frames[0]), 1.5, 1e-6);
}

std::string transforms(const std::string& head, const std::string& depth_key, const std::string& depth_file) {
  return "{" + head + R"("fl_x": 1500, "fl_y": 1400, "cx": 960, "cy": 720, "w": 1920, "h": 1440, "frames": [
      {"file_path": "images/0", ")" +
         depth_key + R"(": ")" + depth_file + R"(",
       "transform_matrix": [[0, 0, 1, 1], [1, 0, 0, 2], [0, 1, 0, 3], [0, 0, 0, 1]]}]})";
}

TEST(PhoneStreams, ReadsTransforms_WithTheUnitOfTheFile) {
  const TemporaryFolder folder;
  writeImage(folder / "images/0.png", tinyColor(7, kColorSize));
  writeImage(folder / "depths/0.png", tinyDepth(3000, kLidarSize));
  folder.write("transforms.json",
               transforms("\"integer_depth_scale\": 0.0005, ", "depth_path", "depths/0.png"));
  const auto frames = framesOf(folder.path(), "transforms.json");
  ASSERT_EQ(frames.size(), 1U);
  expectPose(frames[0]);
  expectSensorIntrinsics(frames[0]);
  EXPECT_NEAR(middleDepth_m(frames[0]), 1.5, 1e-6);
  EXPECT_FALSE(frames[0].color.empty());
}

TEST(PhoneStreams, ReadsTransforms_WithFloatsInFourChannels) {
  const TemporaryFolder folder;
  const cv::Mat metres(kLidarSize, CV_32FC1, cv::Scalar(1.5));
  const cv::Mat rgba(kLidarSize, CV_8UC4, metres.data);
  cv::Mat bgra;
  cv::cvtColor(rgba, bgra, cv::COLOR_RGBA2BGRA);  // as OpenCV writes them
  writeImage(folder / "images/0.depth.png", bgra);
  folder.write("transforms.json",
               transforms("\"depth_integer_scale\": 1, ", "depth_path", "images/0.depth.png"));
  const auto frames = framesOf(folder.path(), "transforms.json");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_NEAR(middleDepth_m(frames[0]), 1.5, 1e-6);
  writeImage(folder / "images/0.depth.png", cv::Mat(kLidarSize, CV_8UC4, cv::Scalar(90, 90, 90, 255)));
  EXPECT_THAT(openError(folder.path()), HasSubstr("picture of depth"));
}

TEST(PhoneStreams, ReadsTransforms_WithArraysOfMetresOrMillimetres) {
  for (const double value : {1.5, 1500.0}) {
    const TemporaryFolder folder;
    folder.write("d.npy", numpyBytes(cv::Mat(kLidarSize, CV_32FC1, cv::Scalar(value)), "<f4"));
    folder.write("transforms.json", transforms("", "depth_file_path", "d.npy"));
    const auto frames = framesOf(folder.path(), "transforms.json");
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_NEAR(middleDepth_m(frames[0]), 1.5, 1e-6) << value;
  }
}

TEST(PhoneStreams, TransformsWithoutTimesLieFartherApartThanFramesOfAVideo) {
  const TemporaryFolder folder;
  const std::string image =
      R"("transform_matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]})";
  std::string json =
      R"({"fl_x": 1500, "fl_y": 1400, "cx": 960, "cy": 720, "w": 1920, "h": 1440, "frames": [)";
  for (const char* const name : {"1.npy", "2.npy"}) {
    folder.write(name, numpyBytes(cv::Mat(kLidarSize, CV_32FC1, cv::Scalar(1.5)), "<f4"));
    json += std::string(R"({"file_path": "none.jpg", "depth_file_path": ")") + name + "\", " + image + ",";
  }
  json.back() = ']';
  folder.write("transforms.json", json + "}");
  const auto frames = framesOf(folder.path(), "transforms.json");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_DOUBLE_EQ(frames[1].timestamp_s - frames[0].timestamp_s, 0.5);
}

TEST(PhoneStreams, IsNoPhone_WhenTransformsNameNoDepth) {
  const TemporaryFolder folder;
  folder.write("transforms.json", R"({"frames": [{"file_path": "images/0.png"}]})");
  EXPECT_THAT(openError(folder.path()), HasSubstr("not a recording in a supported format"));
}

TEST(PhoneStreams, ReadsShotsOfLidarApps) {
  const TemporaryFolder folder;
  folder.write("12.5_depth.tiff", numpyBytes(cv::Mat(kLidarSize, CV_32FC1, cv::Scalar(1.5)), "<f4"));
  writeImage(folder / "12.5_image.jpg", tinyColor(40, kColorSize));
  const auto frames = framesOf(folder.path(), "LiDAR shots");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_NEAR(middleDepth_m(frames[0]), 1.5, 1e-6);
  EXPECT_EQ(frames[0].timestamp_s, 12.5);
  EXPECT_FALSE(frames[0].color.empty());
  EXPECT_FALSE(frames[0].T_world_camera);
}

}  // namespace
}  // namespace scantrove
