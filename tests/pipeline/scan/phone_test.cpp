// Recordings as telephones make them: a focal length that changes, depth with confidence, colour for few
// frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/session/open_session.h"
#include "core/session/session_scan.h"
#include "tests/support/scan_runner.h"
#include "tests/support/synthetic_scan.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

constexpr Intrinsics kDepth{212, 212, 127.5F, 95.5F, 256, 192};

/// Frames of the table top, with exact depth.
std::vector<RgbdFrame> framesOf(const synthetic::PhoneCamera& phone, int frames) {
  SyntheticOptions options;
  options.K = kDepth;
  options.frames = frames;
  options.noise = false;
  options.phone = phone;
  const auto source = makeSyntheticSource(options);
  EXPECT_TRUE(source) << source.error().message();
  std::vector<RgbdFrame> list;
  for (int i = 0; i < frames; ++i) list.push_back((*source)->next().frame);
  return list;
}

/// Differences in metres, ascending, between the map that the frames make at their true poses and the exact
/// depth of `last`.
std::vector<float> errorsOfMap(const std::vector<RgbdFrame>& frames, const RgbdFrame& last) {
  const auto compute = ComputeContext::create({}).value();
  const auto pipeline = MappingPipeline::create(*compute, {kDepth, MappingParams{}, PoseUse::given}).value();
  for (const RgbdFrame& frame : frames) EXPECT_TRUE(pipeline->processFrame(frame));
  const auto view = pipeline->readout().renderView(*last.T_world_camera, last.intrinsics.value_or(kDepth));
  EXPECT_TRUE(view);
  const cv::Mat z_m = view->depth().z_m;
  std::vector<float> errors;
  for (int v = 0; v < z_m.rows; ++v) {
    for (int u = 0; u < z_m.cols; ++u) {
      const float exact_m = 0.001F * static_cast<float>(last.depth.at<std::uint16_t>(v, u));
      const float map_m = z_m.at<float>(v, u);
      if (exact_m > 0 && map_m > 0) errors.push_back(std::abs(map_m - exact_m));
    }
  }
  std::ranges::sort(errors);
  return errors;
}

TEST(Phone, MapFitsTheScene_OnlyWithTheCameraOfEachFrame) {
  const std::vector<RgbdFrame> frames = framesOf({.breathing = 0.025}, 60);
  std::vector<RgbdFrame> with_one_camera = frames;
  for (RgbdFrame& frame : with_one_camera) frame.intrinsics.reset();
  // A quarter of a swing after its middle the focal length is farthest off.
  const RgbdFrame& last = frames[30];
  ASSERT_NEAR(last.intrinsics->fx, 212 * 1.025, 0.1);
  const std::vector<float> own = errorsOfMap(frames, last);
  const std::vector<float> one = errorsOfMap(with_one_camera, last);
  ASSERT_GT(own.size(), 30'000U);
  ASSERT_GT(one.size(), 30'000U);
  EXPECT_LT(own[own.size() / 2], 0.004F) << "less than a voxel";
  EXPECT_LT(own[own.size() * 9 / 10], one[one.size() * 9 / 10]);
}

TEST(Phone, MapHasNoSurfaceWhereConfidenceIsLow) {
  const std::vector<RgbdFrame> frames = framesOf({.has_confidence = true}, 20);
  std::vector<RgbdFrame> trusted = frames;
  for (RgbdFrame& frame : trusted) frame.confidence.release();
  const RgbdFrame exact = framesOf({}, 20).back();
  const auto wrongPart = [&](const std::vector<RgbdFrame>& of) {
    const std::vector<float> errors = errorsOfMap(of, exact);
    const auto wrong = std::ranges::count_if(errors, [](float error) { return error > 0.03F; });
    return static_cast<double>(wrong) / static_cast<double>(errors.size());
  };
  const double with_confidence = wrongPart(frames), without = wrongPart(trusted);
  EXPECT_GT(without, 0.005) << "wrong readings make wrong surface";
  EXPECT_LT(with_confidence, without / 2);
}

TEST(Phone, IsTracked_WithColorForEveryThirdFrame) {
  SyntheticOptions options;
  options.K = kDepth;
  options.color_width = 640;
  options.frames = 60;
  options.phone = {.breathing = 0.025, .colored = 1, .cycle = 3};
  SyntheticScan scan(options);
  scan.run();
  const auto usable =
      std::ranges::count_if(scan.frames, [](const auto& frame) { return frame.pose.usable(); });
  EXPECT_GE(usable, 57);
  EXPECT_LT(scan.trajectoryError(), 0.03);
}

TEST(Phone, IsTracked_WhenItIsHeldUpright) {
  SyntheticOptions options;
  options.K = {212, 212, 95.5F, 127.5F, 192, 256};
  options.color_width = 480;
  options.frames = 30;
  SyntheticScan scan(options);
  scan.run();
  ASSERT_EQ(scan.frames.size(), 30U);
  EXPECT_EQ(scan.frames.back().regions.size(), cv::Size(192, 256));
  EXPECT_TRUE(std::ranges::all_of(scan.frames, [](const auto& frame) { return frame.pose.usable(); }));
  EXPECT_LT(scan.trajectoryError(), 0.03);
}

/// A scan of the demo ":phone" on disk.
class PhoneSessionTest : public testing::Test {
 protected:
  static constexpr int kFrames = 45;

  void SetUp() override {
    ScanRequest request;
    request.source = "demo:tabletop:phone";
    request.source_options.frames = kFrames;
    request.output_folder = folder_ / "scan";
    request.database = (folder_ / "catalogue.sqlite").string();
    const ScanEnding ending = runScan(request);
    ASSERT_TRUE(ending.report) << ending.error;
    EXPECT_GE(ending.report->frames.tracked, kFrames - 5);
    auto session = OpenSession::open(folder_ / "scan");
    ASSERT_TRUE(session) << session.error().message();
    session_ = std::move(*session);
  }

  const QtMainThread qt_;
  TemporaryFolder folder_;
  std::unique_ptr<OpenSession> session_;
};

TEST_F(PhoneSessionTest, StoresTheCameraOfEachFrame) {
  const synthetic::PhoneCamera phone{.breathing = 0.025};
  ASSERT_EQ(session_->frames().size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(session_->setup().K, kDepth);
  EXPECT_TRUE(session_->damages().empty());
  for (const SavedFrame& frame : session_->frames())
    EXPECT_EQ(frame.intrinsics, phone.intrinsicsAt(frame.time_s, kDepth)) << frame.number;
}

TEST_F(PhoneSessionTest, KeyFramesHaveColor_AndExportsTheirOwnCamera) {
  SessionScan scan(*session_);
  const auto frames = scan.keyFrames(true);
  ASSERT_TRUE(frames) << frames.error().message();
  ASSERT_GE(frames->size(), 2U);
  for (const KeyFrameInfo& frame : *frames) {
    EXPECT_EQ(frame.index % 3, 0) << "the others have no colour";
    EXPECT_FALSE(frame.color_file.empty());
    const SavedFrame& saved = session_->frames().at(static_cast<std::size_t>(frame.index));
    EXPECT_EQ(frame.K_depth, saved.intrinsics);
    EXPECT_EQ(frame.K_color, saved.intrinsics->resizedTo(960, 720));
    const auto depth = scan.depth(frame.index);
    ASSERT_TRUE(depth) << depth.error().message();
    EXPECT_GT(cv::countNonZero(*depth == 0), 100) << "readings of low confidence are not stored";
  }
}

// The surface at a pixel, which the map shows to the frame's own camera.
TEST_F(PhoneSessionTest, PixelsOfFramesMeanSurface_OfTheirOwnCamera) {
  const auto usable = std::ranges::find_if(session_->frames(), [](const SavedFrame& frame) {
    return frame.number >= 25 && frame.isUsable();  // the focal length is far from that of the scan
  });
  ASSERT_NE(usable, session_->frames().end());
  int found = 0;
  for (int y = 16; y < 192; y += 32) {
    for (int x = 16; x < 256; x += 32) {
      const auto at = session_->at(usable->source_index, x, y);
      if (!at) continue;
      ++found;
      const Eigen::Vector3f p = usable->T_world_camera.inverse().cast<float>() * at->point_world;
      EXPECT_NEAR(usable->intrinsics->fx * p.x() / p.z() + usable->intrinsics->cx, x, 0.01);
      EXPECT_NEAR(usable->intrinsics->fy * p.y() / p.z() + usable->intrinsics->cy, y, 0.01);
    }
  }
  EXPECT_GT(found, 20);
}

TEST_F(PhoneSessionTest, IsResumed_WithTheSameRecording) {
  session_.reset();
  ScanRequest request;
  request.source = "demo:tabletop:phone";
  request.source_options.start = kFrames;
  request.source_options.frames = 12;
  request.output_folder = folder_ / "scan";
  request.database = (folder_ / "catalogue.sqlite").string();
  request.resume = true;
  const ScanEnding ending = runScan(request);
  ASSERT_TRUE(ending.report) << ending.error;
  const auto session = OpenSession::open(folder_ / "scan");
  ASSERT_TRUE(session) << session.error().message();
  ASSERT_EQ((*session)->frames().size(), static_cast<std::size_t>(kFrames + 12));
  EXPECT_TRUE((*session)->frames().back().intrinsics);
  EXPECT_GE(std::ranges::count_if((*session)->frames(), &SavedFrame::isUsable), kFrames + 4);
}

}  // namespace
}  // namespace scantrove::test
