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

/// Free space after `views` views from one pose.
FreeSpace seen(const AnalyticScene& scene, int views) {
  FreeSpace space(kNoise_m);
  for (int i = 0; i < views; ++i) space.add(viewOf(scene));
  return space;
}

TEST(FreeSpace, IsContradicted_ByAnAppearedObject) {
  const FreeSpace space = seen(wall(), 8);
  const DepthView now = viewOf(wallWithBox());
  const cv::Mat found = space.contradicting(now);
  EXPECT_EQ(cv::countNonZero(found != (now.z_m < 1.5)), 0) << "the box and nothing else";
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(wall()))), 0);
}

TEST(FreeSpace, NeedsFiveViews) {
  EXPECT_EQ(cv::countNonZero(seen(wall(), 4).contradicting(viewOf(wallWithBox()))), 0);
  EXPECT_GT(cv::countNonZero(seen(wall(), 5).contradicting(viewOf(wallWithBox()))), 0);
}

TEST(FreeSpace, IsNotContradicted_WhereNothingWasSeen) {
  const FreeSpace no_readings = seen(AnalyticScene(), 8);
  EXPECT_EQ(cv::countNonZero(no_readings.contradicting(viewOf(wallWithBox()))), 0)
      << "missing readings are not free space";
  // Space behind a box was hidden in all views.
  const FreeSpace space = seen(wallWithBox(), 8);
  const AnalyticScene behind = wall().box({-0.1, -0.1, 1.5}, {0.1, 0.1, 1.6});
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(behind))), 0);
  // Space outside all views is unknown, too.
  Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
  aside.translation().x() = 3;
  EXPECT_EQ(cv::countNonZero(seen(wall(), 8).contradicting(viewOf(wallWithBox(3), aside))), 0);
}

TEST(FreeSpace, IsContradicted_FromAnotherPose) {
  const FreeSpace space = seen(wall(), 8);
  Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
  aside.translate(Eigen::Vector3d(0.3, 0.1, 0.1)).rotate(Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitY()));
  const DepthView now = viewOf(wallWithBox(), aside);
  const cv::Mat found = space.contradicting(now);
  EXPECT_EQ(cv::countNonZero(found != (now.z_m < 1.5)), 0);
}

TEST(FreeSpace, ToleratesNoise) {
  const FreeSpace space = seen(wall(), 8);
  // The tolerance at 2 m is 6 standard deviations (36 mm) plus 50 mm.
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(wall(1.93)))), 0);
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(wall(1.88)))), kSmall.pixels());
}

TEST(FreeSpace, AcceptsAnObject_ThatStays) {
  FreeSpace space = seen(wall(), 28);
  int views = 0;
  for (; cv::countNonZero(space.contradicting(viewOf(wallWithBox()))) > 0; ++views) {
    ASSERT_LT(views, 40);
    space.add(viewOf(wallWithBox()));
  }
  EXPECT_GT(views, 15) << "a resting hand must not be accepted";
  EXPECT_EQ(cv::countNonZero(space.contradicting(viewOf(wall()))), 0)
      << "a removed object is no appeared object";
}

TEST(KnownSurface, ComparesReadingsWithTheMap) {
  onEachDevice([](ComputeContext& compute) {
    const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    const KnownSurface known(readView(compute, mapsOf(compute, wall(), kSmall, T)));
    const auto count = [&](const DepthView& view, DepthConsistency expected) {
      return cv::countNonZero(known.consistencies(view, kNoise_m) == static_cast<int>(expected));
    };
    EXPECT_EQ(count(viewOf(wall()), DepthConsistency::fits), kSmall.pixels());
    const DepthView box = viewOf(wallWithBox());
    EXPECT_EQ(count(box, DepthConsistency::before), cv::countNonZero(box.z_m < 1.5));
    EXPECT_EQ(count(viewOf(wall(2.5)), DepthConsistency::behind), kSmall.pixels());
    EXPECT_EQ(count(viewOf(AnalyticScene()), DepthConsistency::none), kSmall.pixels());
    // After a turn of half the field of view, half of the image is unknown.
    const Eigen::Isometry3d aside(Eigen::AngleAxisd(std::atan(79.5 / 146), Eigen::Vector3d::UnitY()));
    EXPECT_NEAR(count(viewOf(wall(), aside), DepthConsistency::unknown), kSmall.pixels() / 2,
                0.03 * kSmall.pixels());
    EXPECT_EQ(cv::countNonZero(KnownSurface().consistencies(box, kNoise_m) !=
                               static_cast<int>(DepthConsistency::unknown)),
              0);
  });
}

/// Images of a person: a smooth patch of 40 x 60 pixels in front of a wall.
struct Person {
  cv::Mat z_m = cv::Mat(120, 160, CV_32FC1, cv::Scalar(2.5F));
  cv::Mat consistencies = cv::Mat(120, 160, CV_8UC1, cv::Scalar(static_cast<int>(DepthConsistency::fits)));
  cv::Mat intruding = cv::Mat::zeros(120, 160, CV_8UC1);
  cv::Rect body{60, 40, 40, 60};
  Person() {
    z_m(body) = 1.0F;
    consistencies(body) = static_cast<int>(DepthConsistency::before);
  }
};

TEST(MovingPixels, CoverThePerson_WhenAPartIntrudes) {
  Person person;
  person.intruding(cv::Rect(60, 40, 6, 60)) = 255;  // the front is in former free space
  const cv::Mat moving = movingPixels(person.intruding, person.consistencies, person.z_m);
  EXPECT_EQ(cv::countNonZero(moving(person.body)), person.body.area());
  EXPECT_EQ(cv::countNonZero(moving), 42 * 62) << "with a border of one pixel";
}

TEST(MovingPixels, AreEmpty_WithoutIntrusionOrWithASinglePixel) {
  Person person;
  EXPECT_EQ(cv::countNonZero(movingPixels(person.intruding, person.consistencies, person.z_m)), 0)
      << "new, but still";
  person.intruding.at<std::uint8_t>(70, 80) = 255;
  EXPECT_EQ(cv::countNonZero(movingPixels(person.intruding, person.consistencies, person.z_m)), 0);
}

TEST(MovingPixels, CoverOnlyTheIntrusion_WhenTheMapKnowsTheRest) {
  Person person;
  person.consistencies(person.body) = static_cast<int>(DepthConsistency::fits);
  person.intruding(cv::Rect(60, 40, 6, 60)) = 255;
  const cv::Mat moving = movingPixels(person.intruding, person.consistencies, person.z_m);
  EXPECT_EQ(cv::countNonZero(moving), 8 * 62);
}

TEST(VacatedPixels, AreSeenThrough_ExceptAlongEdges) {
  cv::Mat consistencies(120, 160, CV_8UC1, cv::Scalar(static_cast<int>(DepthConsistency::fits)));
  consistencies(cv::Rect(30, 30, 20, 10)) = static_cast<int>(DepthConsistency::behind);
  consistencies(cv::Rect(100, 10, 1, 90)) = static_cast<int>(DepthConsistency::behind);  // along an edge
  const cv::Mat vacated = vacatedPixels(consistencies);
  EXPECT_NEAR(cv::countNonZero(vacated), 18 * 8, 4);
  EXPECT_EQ(cv::countNonZero(vacated(cv::Rect(90, 0, 70, 120))), 0);
}

/// Runs map and motion filter as a scan does, with known poses.
class MotionRig {
 public:
  explicit MotionRig(ComputeContext& compute)
      : compute_(compute),
        preprocessor_(std::move(DepthPreprocessor::create(compute, kKinect, {}).value())),
        map_(makeMap(compute)),
        filter_(std::move(MotionFilter::create(compute, {}).value())) {}

  void show(const AnalyticScene& scene, int frames = 1,
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

  /// Depth of the map's surface at the image centre; 0 if none.
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

TEST(MotionFilter, OmitsAnAppearedObject_UntilItStays) {
  onEachDevice([](ComputeContext& compute) {
    MotionRig rig(compute);
    rig.show(wall(), 30);
    EXPECT_TRUE(rig.filter().moving().empty());
    EXPECT_EQ(rig.still_m(), rig.seen_m());
    EXPECT_NEAR(rig.middle_m(), 2, 0.005);

    rig.show(wallWithBox());
    const std::vector<cl_float> seen_m = rig.seen_m();
    const std::vector<cl_float> still_m = rig.still_m();
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
    EXPECT_LT(wall_left_out, 0.15 * box) << "a border of two pixels of the smaller image";
    EXPECT_EQ(rig.surfaceAt(120 * 320 + 160).s[3], 0) << "the wall is hidden there";
    EXPECT_EQ(rig.surfaceAt(20 * 320 + 20).s[3], 1);

    rig.show(wall());
    EXPECT_NEAR(rig.middle_m(), 2, 0.005) << "the box was never in the map";
    rig.show(wallWithBox(), 40);
    EXPECT_NEAR(rig.middle_m(), 1, 0.005) << "the box stays";
  });
}

TEST(MotionFilter, RemovesSurface_WhenSeenThroughForSomeFrames) {
  onEachDevice([](ComputeContext& compute) {
    MotionRig rig(compute);
    rig.show(wallWithBox(), 80);
    ASSERT_NEAR(rig.middle_m(), 1, 0.005);
    rig.show(wall(), 8);
    EXPECT_NEAR(rig.middle_m(), 2, 0.01) << "its weight alone would keep it for 64 frames";
    EXPECT_NEAR(rig.surfaceAt(20 * 320 + 20).s[2], 2, 0.005);
  });
}

TEST(MotionFilter, KeepsSurface_WhenSeenThroughOnce) {
  onEachDevice([](ComputeContext& compute) {
    MotionRig rig(compute);
    rig.show(wallWithBox(), 40);
    rig.show(wall());
    rig.show(wallWithBox(), 3);
    EXPECT_NEAR(rig.middle_m(), 1, 0.005);
  });
}

TEST(MotionFilter, SettledNormalsExcludeNewSurface) {
  onEachDevice([](ComputeContext& compute) {
    MotionRig rig(compute);
    rig.show(wall());
    const auto has = [](const cl_float4& normal) { return normal.s[3] > 0; };
    EXPECT_EQ(rig.settledNormals().size(), 320U * 240);
    EXPECT_TRUE(std::ranges::all_of(rig.settledNormals(), has)) << "if all surface is new, all is used";
    rig.show(wall(), 5);
    const Eigen::Isometry3d aside(Eigen::AngleAxisd(0.08, Eigen::Vector3d::UnitY()));
    rig.show(wall(), 1, aside);
    const std::vector<cl_float4> settled = rig.settledNormals();
    const std::vector<cl_float4> all = rig.normals();
    // The turn uncovers a strip of slightly more than f tan(0.08) at the right.
    for (int u = 0; u < 320; ++u) {
      if (u > 285 && u < 300) continue;  // near the border of the strip
      const auto i = static_cast<std::size_t>(120 * 320 + u);
      EXPECT_EQ(has(settled[i]), has(all[i]) && u <= 285) << u;
    }
    rig.show(wall(), 4, aside);
    EXPECT_TRUE(has(rig.settledNormals()[120 * 320 + 310]));
  });
}

}  // namespace
}  // namespace scantrove::test
