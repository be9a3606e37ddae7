#include "core/fusion/motion_filter.h"

#include <algorithm>
#include <cmath>

#include "core/fusion/depth_preprocessor.h"
#include "core/fusion/free_space.h"
#include "core/fusion/known_surface.h"
#include "core/fusion/moving_pixels.h"
#include "tests/kernels/fusion/fusion_test_support.h"
#include "tests/kernels/tracking/tracking_test_support.h"

namespace scantrove::test {
namespace {

const Intrinsics kSmall{146, 146, 79.5F, 59.5F, 160, 120};
constexpr float kNoise_m = 0.0015F;

AnalyticScene wall(double z = 2) { return AnalyticScene().plane({0, 0, z}, {0, 0, -1}); }
AnalyticScene wallWithBox(double x = 0) { return wall().box({x - 0.2, -0.2, 1.0}, {x + 0.2, 0.2, 1.3}); }

DepthView viewOf(const AnalyticScene& scene, const Eigen::Isometry3d& T = Eigen::Isometry3d::Identity()) {
  DepthView view{kSmall, T, cv::Mat(kSmall.height, kSmall.width, CV_32FC1)};
  const std::vector<float> depth_m = scene.depth(kSmall, T);
  std::ranges::transform(depth_m, view.z_m.ptr<float>(), [](float z) { return z < 13 ? z : 0.0F; });
  return view;
}

/// Seen for so many views, all from one place.
FreeSpace seen(const AnalyticScene& scene, int views) {
  FreeSpace space(kNoise_m);
  for (int i = 0; i < views; ++i) space.add(viewOf(scene));
  return space;
}

TEST(FreeSpace, AThingThatCameStandsWhereThereWasNothing) {
  const FreeSpace space = seen(wall(), 8);
  const DepthView now = viewOf(wallWithBox());
  const cv::Mat found = space.contradicting(now);
  EXPECT_EQ(cv::countNonZero(found != (now.z_m < 1.5)), 0) << "the box and nothing else";
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(wall()))), 0);
}

TEST(FreeSpace, OneViewMayBeWrong) {
  EXPECT_EQ(cv::countNonZero(seen(wall(), 4).contradicting(viewOf(wallWithBox()))), 0);
  EXPECT_GT(cv::countNonZero(seen(wall(), 5).contradicting(viewOf(wallWithBox()))), 0);
}

TEST(FreeSpace, WhereNothingWasSeenEverythingIsPossible) {
  const FreeSpace blind = seen(AnalyticScene(), 8);
  EXPECT_EQ(cv::countNonZero(blind.contradicting(viewOf(wallWithBox()))), 0) << "no reading is no free space";
  // What a box hid from all views may well have been there.
  const FreeSpace space = seen(wallWithBox(), 8);
  const AnalyticScene behind = wall().box({-0.1, -0.1, 1.5}, {0.1, 0.1, 1.6});
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(behind))), 0);
  // And so may what none of them looked at.
  Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
  aside.translation().x() = 3;
  EXPECT_EQ(cv::countNonZero(seen(wall(), 8).contradicting(viewOf(wallWithBox(3), aside))), 0);
}

TEST(FreeSpace, FromElsewhereTheSameIsSeen) {
  const FreeSpace space = seen(wall(), 8);
  Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
  aside.translate(Eigen::Vector3d(0.3, 0.1, 0.1)).rotate(Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitY()));
  const DepthView now = viewOf(wallWithBox(), aside);
  const cv::Mat found = space.contradicting(now);
  EXPECT_EQ(cv::countNonZero(found != (now.z_m < 1.5)), 0);
}

TEST(FreeSpace, NoiseIsNoMotion) {
  const FreeSpace space = seen(wall(), 8);
  // 6 standard deviations at 2 m are 36 mm, and 50 mm for everything else.
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(wall(1.93)))), 0);
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(wall(1.88)))), kSmall.pixels());
}

TEST(FreeSpace, WhatStaysBelongsThere) {
  FreeSpace space = seen(wall(), 28);
  int views = 0;
  for (; cv::countNonZero(space.contradicting(viewOf(wallWithBox()))) > 0; ++views) {
    ASSERT_LT(views, 40);
    space.add(viewOf(wallWithBox()));
  }
  EXPECT_GT(views, 15) << "a hand that holds still for a moment";
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(wall()))), 0) << "what goes uncovers no new thing";
}

TEST(KnownSurface, SaysHowReadingsStandToTheMap) {
  onEachDevice([](ComputeContext& compute) {
    const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    const KnownSurface known(readView(compute, mapsOf(compute, wall(), kSmall, T)));
    const auto count = [&](const DepthView& view, DepthConsistency standing) {
      return cv::countNonZero(known.consistencies(view, kNoise_m) == static_cast<int>(standing));
    };
    EXPECT_EQ(count(viewOf(wall()), DepthConsistency::fits), kSmall.pixels());
    const DepthView box = viewOf(wallWithBox());
    EXPECT_EQ(count(box, DepthConsistency::before), cv::countNonZero(box.z_m < 1.5));
    EXPECT_EQ(count(viewOf(wall(2.5)), DepthConsistency::behind), kSmall.pixels());
    EXPECT_EQ(count(viewOf(AnalyticScene()), DepthConsistency::none), kSmall.pixels());
    // Turned by as much as half the view, half of it is new.
    const Eigen::Isometry3d aside(Eigen::AngleAxisd(std::atan(79.5 / 146), Eigen::Vector3d::UnitY()));
    EXPECT_NEAR(count(viewOf(wall(), aside), DepthConsistency::unknown), kSmall.pixels() / 2,
                0.03 * kSmall.pixels());
    EXPECT_EQ(cv::countNonZero(KnownSurface().consistencies(box, kNoise_m) !=
                               static_cast<int>(DepthConsistency::unknown)),
              0);
  });
}

/// Images in which somebody stands: a smooth patch of 40 x 60 pixels before a wall.
struct Somebody {
  cv::Mat z_m = cv::Mat(120, 160, CV_32FC1, cv::Scalar(2.5F));
  cv::Mat consistencies = cv::Mat(120, 160, CV_8UC1, cv::Scalar(static_cast<int>(DepthConsistency::fits)));
  cv::Mat intruding = cv::Mat::zeros(120, 160, CV_8UC1);
  cv::Rect body{60, 40, 40, 60};
  Somebody() {
    z_m(body) = 1.0F;
    consistencies(body) = static_cast<int>(DepthConsistency::before);
  }
};

TEST(MovingPixels, SomebodyMovesAsAWhole) {
  Somebody one;
  one.intruding(cv::Rect(60, 40, 6, 60)) = 255;  // his front stands where there was nothing
  const cv::Mat moving = movingPixels(one.intruding, one.consistencies, one.z_m);
  EXPECT_EQ(cv::countNonZero(moving(one.body)), one.body.area());
  EXPECT_EQ(cv::countNonZero(moving), 42 * 62) << "and a pixel around him";
}

TEST(MovingPixels, SpecksAndWhatIsNewAloneDoNotMove) {
  Somebody one;
  EXPECT_EQ(cv::countNonZero(movingPixels(one.intruding, one.consistencies, one.z_m)), 0) << "new, but still";
  one.intruding.at<std::uint8_t>(70, 80) = 255;
  EXPECT_EQ(cv::countNonZero(movingPixels(one.intruding, one.consistencies, one.z_m)), 0);
}

TEST(MovingPixels, WhatTheMapKnowsStaysInIt) {
  Somebody one;
  one.consistencies(one.body) = static_cast<int>(DepthConsistency::fits);
  one.intruding(cv::Rect(60, 40, 6, 60)) = 255;
  const cv::Mat moving = movingPixels(one.intruding, one.consistencies, one.z_m);
  EXPECT_EQ(cv::countNonZero(moving), 8 * 62);
}

TEST(MovingPixels, VacatedIsWhatIsSeenThroughButForEdges) {
  cv::Mat consistencies(120, 160, CV_8UC1, cv::Scalar(static_cast<int>(DepthConsistency::fits)));
  consistencies(cv::Rect(30, 30, 20, 10)) = static_cast<int>(DepthConsistency::behind);
  consistencies(cv::Rect(100, 10, 1, 90)) = static_cast<int>(DepthConsistency::behind);  // along an edge
  const cv::Mat vacated = vacatedPixels(consistencies);
  EXPECT_NEAR(cv::countNonZero(vacated), 18 * 8, 4);
  EXPECT_EQ(cv::countNonZero(vacated(cv::Rect(90, 0, 70, 120))), 0);
}

/// Map and motion filter as a scan runs them, with a camera that knows where it is.
class Watcher {
 public:
  explicit Watcher(ComputeContext& compute)
      : compute_(compute),
        preprocessor_(std::move(DepthPreprocessor::create(compute, kKinect, {}).value())),
        map_(makeMap(compute)),
        filter_(std::move(MotionFilter::create(compute, {}).value())) {}

  void see(const AnalyticScene& scene, int frames = 1,
           const Eigen::Isometry3d& T = Eigen::Isometry3d::Identity()) {
    const RgbdFrame frame = frameOf(scene, kKinect, T);
    for (int i = 0; i < frames; ++i) {
      depth_ = &preprocessor_->process(frame);
      still_ = &filter_->still(*depth_, T, KnownSurface(readView(compute_, surface_)));
      map_->integrate(*still_, T);
      map_->raycast(T, depth_->levels.front().K, surface_);
      filter_->apply(*depth_, map_->bricks(), surface_);
    }
  }

  /// Depth of the middle of the map's surface; 0: there is none.
  [[nodiscard]] float middle_m() { return surfaceAt(120 * 320 + 160).s[2]; }
  [[nodiscard]] cl_float4 surfaceAt(std::size_t pixel) {
    return surface_.vertices_world.read(compute_.queue())[pixel];
  }
  [[nodiscard]] std::vector<cl_float> seen_m() { return depth_->depth_m.read(compute_.queue()); }
  [[nodiscard]] std::vector<cl_float> still_m() { return still_->depth_m.read(compute_.queue()); }
  [[nodiscard]] std::vector<cl_float4> normals() { return surface_.normals_world.read(compute_.queue()); }
  [[nodiscard]] std::vector<cl_float4> settledNormals() {
    return filter_->settled(surface_, map_->bricks()).normals_world.read(compute_.queue());
  }
  [[nodiscard]] const MotionFilter& filter() const { return *filter_; }

 private:
  ComputeContext& compute_;
  std::unique_ptr<DepthPreprocessor> preprocessor_;
  std::unique_ptr<DenseMap> map_;
  std::unique_ptr<MotionFilter> filter_;
  const DepthPyramid* depth_ = nullptr;
  const DepthPyramid* still_ = nullptr;
  SurfaceMaps surface_;
};

TEST(MotionFilter, LeavesOutWhatCameUntilItStays) {
  onEachDevice([](ComputeContext& compute) {
    Watcher watcher(compute);
    watcher.see(wall(), 30);
    EXPECT_TRUE(watcher.filter().moving().empty());
    EXPECT_EQ(watcher.still_m(), watcher.seen_m());
    EXPECT_NEAR(watcher.middle_m(), 2, 0.005);

    watcher.see(wallWithBox());
    const std::vector<cl_float> seen_m = watcher.seen_m();
    const std::vector<cl_float> still_m = watcher.still_m();
    int box = 0, wall_left_out = 0;
    for (std::size_t i = 0; i < seen_m.size(); ++i) {
      if (seen_m[i] < 1.5F) {
        ++box;
        EXPECT_EQ(still_m[i], 0) << i;
      } else if (still_m[i] == 0) {
        ++wall_left_out;
      } else {
        EXPECT_EQ(still_m[i], seen_m[i]);
      }
    }
    EXPECT_GT(box, 30000);
    EXPECT_LT(wall_left_out, 0.15 * box) << "a rim of two pixels of the smaller image";
    EXPECT_EQ(watcher.surfaceAt(120 * 320 + 160).s[3], 0) << "nothing is seen of the wall there";
    EXPECT_EQ(watcher.surfaceAt(20 * 320 + 20).s[3], 1);

    watcher.see(wall());
    EXPECT_NEAR(watcher.middle_m(), 2, 0.005) << "it never was in the map";
    watcher.see(wallWithBox(), 40);
    EXPECT_NEAR(watcher.middle_m(), 1, 0.005) << "it stays";
  });
}

TEST(MotionFilter, WhatIsSeenThroughGoesWithinAFewFrames) {
  onEachDevice([](ComputeContext& compute) {
    Watcher watcher(compute);
    watcher.see(wallWithBox(), 80);
    ASSERT_NEAR(watcher.middle_m(), 1, 0.005);
    watcher.see(wall(), 8);
    EXPECT_NEAR(watcher.middle_m(), 2, 0.01) << "by its weight alone it would stay for 64 frames";
    EXPECT_NEAR(watcher.surfaceAt(20 * 320 + 20).s[2], 2, 0.005);
  });
}

TEST(MotionFilter, OneFrameThatSeesThroughDoesNotUndoASurface) {
  onEachDevice([](ComputeContext& compute) {
    Watcher watcher(compute);
    watcher.see(wallWithBox(), 40);
    watcher.see(wall());
    watcher.see(wallWithBox(), 3);
    EXPECT_NEAR(watcher.middle_m(), 1, 0.005);
  });
}

TEST(MotionFilter, TheCameraIsNotFollowedByWhatHasJustComeIntoView) {
  onEachDevice([](ComputeContext& compute) {
    Watcher watcher(compute);
    watcher.see(wall());
    const auto has = [](const cl_float4& normal) { return normal.s[3] > 0; };
    EXPECT_EQ(watcher.settledNormals().size(), 320U * 240);
    EXPECT_TRUE(std::ranges::all_of(watcher.settledNormals(), has)) << "all is new: there is nothing better";
    watcher.see(wall(), 5);
    const Eigen::Isometry3d aside(Eigen::AngleAxisd(0.08, Eigen::Vector3d::UnitY()));
    watcher.see(wall(), 1, aside);
    const std::vector<cl_float4> settled = watcher.settledNormals();
    const std::vector<cl_float4> all = watcher.normals();
    // The strip that the turn has uncovered: at the right, f tan(0.08) and a little more.
    for (int u = 0; u < 320; ++u) {
      if (u > 285 && u < 300) continue;  // around its border
      const auto i = static_cast<std::size_t>(120 * 320 + u);
      EXPECT_EQ(has(settled[i]), has(all[i]) && u <= 285) << u;
    }
    watcher.see(wall(), 4, aside);
    EXPECT_TRUE(has(watcher.settledNormals()[120 * 320 + 310]));
  });
}

}  // namespace
}  // namespace scantrove::test
