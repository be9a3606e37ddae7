// Depth images of all types in a folder of numbered images, and the proposal of a depth scale.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/capture/depth_file.h"
#include "core/capture/depth_plausibility.h"
#include "tests/support/captured_log.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Status = FrameRead::Status;

constexpr Intrinsics kDepthTestCamera{60, 60, 32, 24, 0, 0};

/// An array of 48 x 64 elements as NumPy saves it (format version 1.0).
std::string npy(const std::string& type, const std::string& element) {
  std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (48, 64), }";
  header.resize((header.size() + 10 + 63) / 64 * 64 - 10 - 1, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xFF);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  for (int i = 0; i < 48 * 64; ++i) bytes += element;
  return bytes;
}

template <class T>
std::string bytesOfValue(T value, bool is_big_endian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return is_big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// A 16-bit PGM: big endian by the standard.
std::string pgm(int value) {
  std::string bytes = "P5\n64 48\n65535\n";
  for (int i = 0; i < 48 * 64; ++i) {
    bytes += static_cast<char>(value >> 8);
    bytes += static_cast<char>(value & 0xFF);
  }
  return bytes;
}

/// The first frame's depth in metres at the middle of its image.
double firstDepth_m(const TemporaryFolder& folder, SourceOptions options = {}) {
  options.intrinsics = kDepthTestCamera;
  const auto source = openSource(folder.path().string(), options);
  if (!source) {
    ADD_FAILURE() << source.error().message();
    return 0;
  }
  const FrameRead read = (*source)->next();
  EXPECT_EQ(read.status, Status::frame) << read.error.message();
  if (read.status != Status::frame) return 0;
  EXPECT_EQ(read.frame.depth.type(), CV_16UC1);
  return read.frame.depth.at<std::uint16_t>(24, 32) * static_cast<double>(read.frame.meters_per_unit);
}

TEST(DepthTypes, SixteenBitsAreMillimeters) {
  for (const auto& [name, bytes] : {std::pair("depth/0.pgm", pgm(1234)),
                                    {"depth/0.npy", npy("<u2", bytesOfValue(std::uint16_t{1234}))},
                                    {"depth/0.npy", npy(">u2", bytesOfValue(std::uint16_t{1234}, true))}}) {
    const TemporaryFolder folder;
    folder.write(name, bytes);
    EXPECT_NEAR(firstDepth_m(folder), 1.234, 1e-6) << name;
  }
}

TEST(DepthTypes, FloatsAreMeters) {
  for (const auto& bytes : {npy("<f4", bytesOfValue(1.5F)), npy(">f4", bytesOfValue(1.5F, true)),
                            npy("<f8", bytesOfValue(1.5)), npy("<f2", std::string("\x00\x3E", 2))}) {
    const TemporaryFolder folder;
    folder.write("depth/0.npy", bytes);
    EXPECT_NEAR(firstDepth_m(folder), 1.5, 1e-6);
  }
  const TemporaryFolder folder;
  writeImage(folder / "depth/0.tiff", cv::Mat(48, 64, CV_32FC1, cv::Scalar(2.25)));
  EXPECT_NEAR(firstDepth_m(folder), 2.25, 1e-6);
}

TEST(DepthTypes, NoReadingIsZero) {
  const TemporaryFolder folder;
  for (const float value : {NAN, INFINITY, -1.0F, 100.0F}) {
    folder.write("depth/0.npy", npy("<f4", bytesOfValue(value)));
    EXPECT_EQ(firstDepth_m(folder), 0) << value;
  }
  folder.write("depth/0.npy", npy("<u2", bytesOfValue(std::uint16_t{65535})));
  EXPECT_EQ(firstDepth_m(folder), 0);
}

TEST(DepthTypes, DepthScaleAppliesToFloats) {
  const TemporaryFolder folder;
  folder.write("depth/0.npy", npy("<f4", bytesOfValue(1750.0F)));
  SourceOptions options;
  options.depth_scale = 1000;
  EXPECT_NEAR(firstDepth_m(folder, options), 1.75, 1e-6);
}

TEST(DepthTypes, CameraFilesScaleOnlySixteenBits) {
  const TemporaryFolder folder;
  folder.write("depth/0.npy", npy("<f4", bytesOfValue(1.5F)));
  folder.write("intrinsic.json", R"({"width": 64, "height": 48, "depth_scale": 4000,
    "intrinsic_matrix": [60, 0, 0, 0, 60, 0, 31, 23, 1]})");
  EXPECT_NEAR(firstDepth_m(folder), 1.5, 1e-6);
}

TEST(DepthTypes, IgnoresPreviewsBesideArrays) {
  const TemporaryFolder folder;
  folder.write("depth/0.npy", npy("<f4", bytesOfValue(1.5F)));
  writeImage(folder / "depth/0.png", tinyColor(7));
  EXPECT_NEAR(firstDepth_m(folder), 1.5, 1e-6);
}

TEST(DepthTypes, SkipsAFrame_WhenItsTypeDiffersFromTheFirst) {
  const TemporaryFolder folder;
  writeImage(folder / "depth/0.tiff", cv::Mat(48, 64, CV_32FC1, cv::Scalar(2)));
  writeImage(folder / "depth/1.png", tinyDepth(2000));
  SourceOptions options;
  options.intrinsics = kDepthTestCamera;
  const auto source = openSource(folder.path().string(), options);
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->next().status, Status::frame);
  const FrameRead read = (*source)->next();
  EXPECT_EQ(read.status, Status::skipped);
  EXPECT_THAT(read.error.what, HasSubstr("16-bit"));
}

TEST(DepthTypes, NamesTheFile_WhenItCannotBeRead) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& bytes) {
    const auto depth = readAnyDepth(folder.write("d.npy", bytes));
    return depth ? "(read)" : depth.error().message();
  };
  EXPECT_THAT(error(""), HasSubstr("d.npy"));
  EXPECT_THAT(error("\x93NUMPY"), HasSubstr("d.npy"));
  EXPECT_THAT(error(npy("<f4", bytesOfValue(1.0F)).substr(0, 500)), HasSubstr("truncated"));
  EXPECT_THAT(error(npy("|u1", "x")), HasSubstr("8-bit"));
  EXPECT_THAT(error(npy("<c8", bytesOfValue(1.0))), HasSubstr("<c8"));
}

struct ScaleCase {
  int depth;
  double scale;
  std::optional<double> proposed;
};

TEST(DepthPlausibility, ProposesAUsualScale_WhenTheMedianIsNotThatOfARoom) {
  for (const ScaleCase& c : {ScaleCase{18000, 1000, 10000},
                             {9000, 1000, 5000},
                             {1800, 10000, 1000},
                             {65534, 1, 10000},
                             {2, 1000, 1}}) {
    const auto judged = judgeDepth(tinyDepth(c.depth), c.scale);
    ASSERT_TRUE(judged) << c.depth;
    EXPECT_EQ(judged->proposed_units_per_meter, c.proposed) << c.depth;
    EXPECT_NEAR(judged->median_m, c.depth / c.scale, 1e-9);
    EXPECT_NEAR(judged->proposedMedian_m(), c.depth / *c.proposed, 1e-9);
  }
  EXPECT_FALSE(judgeDepth(tinyDepth(1800), 1000));
  EXPECT_FALSE(judgeDepth(tinyDepth(0), 1000)) << "no readings";
}

TEST(DepthPlausibility, ProposesMillimeters_WhenFloatsAreThousands) {
  const TemporaryFolder folder;
  folder.write("depth/0.npy", npy("<f4", bytesOfValue(1750.0F)));
  SourceOptions options;
  options.intrinsics = kDepthTestCamera;
  const CapturedLog log;
  const auto source = openSource(folder.path().string(), options);
  ASSERT_TRUE(source) << source.error().message();
  const auto& implausible = (*source)->info().implausible_depth;
  ASSERT_TRUE(implausible);
  EXPECT_EQ(implausible->proposed_units_per_meter, 1000);
  EXPECT_THAT(log.text(),
              HasSubstr("1000 units per metre would make the median 1.8 m: give --depth-scale 1000."));
}

TEST(DepthPlausibility, SaysNothing_WhenTheScaleFits) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 1);
  SourceOptions options;
  options.intrinsics = kDepthTestCamera;
  const CapturedLog log;
  const auto source = openSource(folder.path().string(), options);
  ASSERT_TRUE(source);
  EXPECT_FALSE((*source)->info().implausible_depth);
  EXPECT_THAT(log.text(), IsEmpty());
}

TEST(DepthPlausibility, NamesTheOption_WhenNoUsualScaleFits) {
  ImplausibleDepth implausible;
  implausible.units_per_meter = 1000;
  implausible.median_m = 1e-9;
  const std::string text = describe(implausible, "recording").message();
  EXPECT_THAT(text, HasSubstr("--depth-scale"));
  EXPECT_THAT(text, Not(HasSubstr("would make")));
}

}  // namespace
}  // namespace scantrove
