#pragma once
// What recordings of phones have in common: one pose, one camera, one confidence image.
#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/capture/open_input.h"
#include "tests/support/zip_bytes.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove::test {

inline constexpr int kLidarColumns = 256, kLidarRows = 192;
inline const cv::Size kLidarSize{kLidarColumns, kLidarRows}, kColorSize{64, 48};

/// The pose that all recordings here tell: x of the camera along y of the world, y (ARKit: up) along its z, z
/// (ARKit: backward) along its x; at (1, 2, 3). Row by row.
inline constexpr const char* kArkitRows = "[0, 0, 1, 1,  1, 0, 0, 2,  0, 1, 0, 3,  0, 0, 0, 1]";
inline constexpr const char* kArkitColumns = "[0, 1, 0, 0,  0, 0, 1, 0,  1, 0, 0, 0,  1, 2, 3, 1]";
/// Its quaternion: a turn by 120 degrees about (1, 1, 1).
inline constexpr const char* kArkitQuaternion = "[0.5, 0.5, 0.5, 0.5, 1, 2, 3]";

/// The same with y down and z forward.
inline Eigen::Isometry3d expectedPose() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  pose.translation() = Eigen::Vector3d(1, 2, 3);
  return pose;
}

/// All frames of a recording, which must be usable.
inline std::vector<RgbdFrame> framesOf(const std::filesystem::path& path, const std::string& kind,
                                       const SourceOptions& options = {}) {
  const auto source = openInput(path.string(), options);
  if (!source) {
    ADD_FAILURE() << source.error().message();
    return {};
  }
  EXPECT_EQ((*source)->info().kind, kind);
  EXPECT_EQ((*source)->info().pose_origin, PoseOrigin::device);
  std::vector<RgbdFrame> frames;
  for (FrameRead& read : readAll(**source)) {
    EXPECT_EQ(read.status, FrameRead::Status::frame) << read.error.message();
    frames.push_back(std::move(read.frame));
  }
  return frames;
}

inline void expectPose(const RgbdFrame& frame) {
  ASSERT_TRUE(frame.T_world_camera);
  EXPECT_TRUE(frame.T_world_camera->isApprox(expectedPose(), 1e-6)) << frame.T_world_camera->matrix();
}

/// For depth images of 256 x 192 of a camera of 1500, 1400, 959.5, 719.5 at 1920 x 1440.
inline void expectSensorIntrinsics(const RgbdFrame& frame, float focal_x = 1500) {
  ASSERT_TRUE(frame.intrinsics);
  EXPECT_NEAR(frame.intrinsics->fx, focal_x * 256 / 1920, 1e-3);
  EXPECT_NEAR(frame.intrinsics->fy, 1400.0F * 192 / 1440, 1e-3);
  EXPECT_NEAR(frame.intrinsics->cx, 127.5, 1e-3);
  EXPECT_NEAR(frame.intrinsics->cy, 95.5, 1e-3);
}

inline double middleDepth_m(const RgbdFrame& frame) {
  return frame.depth.at<std::uint16_t>(frame.depth.rows / 2, frame.depth.cols / 2) *
         static_cast<double>(frame.meters_per_unit);
}

/// Confidence of three values in columns 0, 1 and 2, high elsewhere.
inline cv::Mat confidenceImage(int low, int medium, int high) {
  cv::Mat image(kLidarSize, CV_8UC1, cv::Scalar(high));
  image.col(0).setTo(low);
  image.col(1).setTo(medium);
  return image;
}

inline void expectConfidence(const RgbdFrame& frame) {
  ASSERT_EQ(frame.confidence.type(), CV_8UC1);
  EXPECT_EQ(frame.confidence.at<std::uint8_t>(9, 0), kLowConfidence);
  EXPECT_EQ(frame.confidence.at<std::uint8_t>(9, 1), kMediumConfidence);
  EXPECT_EQ(frame.confidence.at<std::uint8_t>(9, 2), kHighConfidence);
}

inline std::string bytesOfMat(const cv::Mat& image) {
  return {reinterpret_cast<const char*>(image.data), image.total() * image.elemSize()};
}

inline constexpr const char* kIntrinsicRows = "[1500, 0, 959.5, 0, 1400, 719.5, 0, 0, 1]";
inline constexpr const char* kIntrinsicColumns = "[1500, 0, 0, 0, 1400, 0, 959.5, 719.5, 1]";

/// An array as numpy.save writes it.
inline std::string numpyBytes(const cv::Mat& image, const std::string& type) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" +
                       std::to_string(image.rows) + ", " + std::to_string(image.cols) + "), }";
  header.resize((10 + header.size() + 1 + 63) / 64 * 64 - 11, ' ');
  return std::string("\x93NUMPY\x01\x00", 8) + littleEndianBytes(header.size() + 1, 2) + header + "\n" +
         bytesOfMat(image);
}

inline std::string rawDeflated(const std::string& bytes) {
  z_stream zlib{};
  deflateInit2(&zlib, Z_BEST_SPEED, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&zlib, bytes.size()), '\0');
  zlib.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  zlib.avail_in = static_cast<uInt>(bytes.size());
  zlib.next_out = reinterpret_cast<Bytef*>(packed.data());
  zlib.avail_out = static_cast<uInt>(packed.size());
  deflate(&zlib, Z_FINISH);
  packed.resize(zlib.total_out);
  deflateEnd(&zlib);
  return packed;
}

}  // namespace scantrove::test
