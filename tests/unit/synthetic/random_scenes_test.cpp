#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <opencv2/core.hpp>

#include "core/synthetic/synthetic_source.h"
#include "core/synthetic/trajectory.h"

namespace scantrove {
namespace {

using Eigen::Vector3d;
using synthetic::kNoHit;
using synthetic::Ray;
using synthetic::SceneRecipe;

constexpr double kRadiansPerDegree = 3.14159265358979 / 180;

struct Kind {
  const char* name;
  SceneRecipe (*make)(std::uint32_t seed);
  int frames;
};
const Kind kRoom{"room", synthetic::makeRandomRoomScene, 300};
const Kind kTabletop{"tabletop", synthetic::makeRandomTabletopScene, 240};
const Kind kHardRoom{"hardRoom", synthetic::makeHardRoomScene, 300};
const Kind kHardTabletop{"hardTabletop", synthetic::makeHardTabletopScene, 240};

/// Every kind of random scene with many seeds.
class RandomSceneTest : public testing::TestWithParam<std::tuple<Kind, std::uint32_t>> {
 protected:
  const Kind kind = std::get<0>(GetParam());
  const std::uint32_t seed = std::get<1>(GetParam());
  const SceneRecipe recipe = kind.make(seed);
};
std::string nameOf(const testing::TestParamInfo<std::tuple<Kind, std::uint32_t>>& test) {
  return std::get<0>(test.param).name + std::to_string(std::get<1>(test.param));
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomSceneTest,
                         testing::Combine(testing::Values(kRoom, kTabletop), testing::Range(1U, 31U)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(HardSeeds, RandomSceneTest,
                         testing::Combine(testing::Values(kHardRoom, kHardTabletop), testing::Range(1U, 9U)),
                         nameOf);

/// Casts vertical rays; skips instances whose boxes they miss.
class PlumbLines {
 public:
  explicit PlumbLines(const SyntheticScene& scene) {
    for (const SyntheticScene::Part& part : scene.parts()) {
      parts_.push_back({part.shape.get(), part.T_world_part.inverse(), part.instance});
    }
    for (const InstanceName& instance : scene.instances()) boxes_.push_back(scene.boundsOf(instance.id));
  }

  /// Vertical distance in metres from `from` (world frame) up (sign 1) or down (-1) to the instance, or to
  /// all others.
  [[nodiscard]] double measure(std::uint16_t instance, bool others, const Vector3d& from, double sign) const {
    double nearest = kNoHit;
    for (const Part& part : parts_) {
      if ((part.instance == instance) == others) continue;
      const Eigen::AlignedBox3d& box = boxes_[part.instance - 1U];
      const Vector3d level(from.x(), from.y(), box.min().z());
      if (!box.contains(level)) continue;
      const Ray ray{part.T_part_world * from, part.T_part_world.linear() * Vector3d(0, 0, sign)};
      nearest = std::min(nearest, part.shape->intersect(ray, nearest).t);
    }
    return nearest;
  }

 private:
  struct Part {
    const synthetic::Shape* shape;
    Eigen::Isometry3d T_part_world;
    std::uint16_t instance;
  };
  std::vector<Part> parts_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< boxes of the instances
};

/// Gap in metres between the lowest points of the instance and their support: 0 if it stands, more if it
/// floats, infinite without support or if both intersect. Upward rays find the lowest points, downward rays
/// the support.
double gapBelow(const PlumbLines& lines, const Eigen::AlignedBox3d& box, std::uint16_t instance) {
  constexpr int kSteps = 40;
  std::vector<Vector3d> underside;
  double lowest = kNoHit;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      Vector3d from = box.min();
      from.x() += box.sizes().x() * (0.001 + 0.998 * i / kSteps);
      from.y() += box.sizes().y() * (0.001 + 0.998 * k / kSteps);
      from.z() -= 0.1;
      const double up = lines.measure(instance, false, from, 1);
      if (up == kNoHit) continue;
      from.z() += up;
      underside.push_back(from);
      lowest = std::min(lowest, from.z());
    }
  }
  double gap = kNoHit;
  for (Vector3d& point : underside) {
    if (point.z() > lowest + 0.0015) continue;
    constexpr double kAbove_m = 0.003;  // rays miss a support above this: both intersect
    point.z() += kAbove_m;
    const double down = lines.measure(instance, true, point, -1);
    gap = std::min(gap, std::abs(down - kAbove_m));
  }
  return gap;
}

TEST_P(RandomSceneTest, EveryObjectHasASupport) {
  const PlumbLines lines(recipe.scene);
  int objects = 0;
  for (const InstanceName& instance : recipe.scene.instances()) {
    if (!instance.is_object) continue;
    ++objects;
    EXPECT_LT(gapBelow(lines, recipe.scene.boundsOf(instance.id), instance.id), 0.0025) << instance.name;
  }
  EXPECT_GE(objects, 8);
}

TEST_P(RandomSceneTest, ObjectsNeverIntersect) {
  // A point is inside another solid if rays from all six axis directions hit it first. No object centre may
  // be.
  const SyntheticScene& scene = recipe.scene;
  for (const SyntheticScene::Part& part : scene.parts()) {
    const Vector3d middle =
        part.T_world_part * Vector3d((part.shape->bounds().low + part.shape->bounds().high) / 2);
    if (!scene.instances()[part.instance - 1U].is_object || part.shape->thickness() == 0) continue;
    for (const SyntheticScene::Part& other : scene.parts()) {
      if (other.instance == part.instance || other.shape->thickness() == 0) continue;
      const Vector3d local = other.T_world_part.inverse() * middle;
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
          const Vector3d direction = sign * Vector3d::Unit(axis);
          inside = inside && other.shape->intersect({local - 20 * direction, direction}, kNoHit).t < 20;
        }
      }
      EXPECT_FALSE(inside) << scene.instances()[part.instance - 1U].name << " in "
                           << scene.instances()[other.instance - 1U].name;
    }
  }
}

TEST_P(RandomSceneTest, CameraMovesAtHandSpeedAwayFromSurfaces) {
  const synthetic::Trajectory trajectory(recipe.path, false, 0);
  double path_m = 0;
  for (int frame = 0; frame + 1 < kind.frames; ++frame) {
    const Eigen::Isometry3d here = trajectory.pose(frame / 30.0);
    const Eigen::Isometry3d step = here.inverse() * trajectory.pose((frame + 1) / 30.0);
    path_m += step.translation().norm();
    ASSERT_LT(step.translation().norm() * 30, 0.35) << "m/s at frame " << frame;
    ASSERT_LT(Eigen::AngleAxisd(step.linear()).angle() * 30, 25 * kRadiansPerDegree)
        << "rad/s at frame " << frame;
    if (frame % 5 != 0) continue;
    for (int i = 0; i < 60; ++i) {  // no surface within 20 cm, so the camera is in free space
      const double z = (i + 0.5) / 30 - 1;
      const double azimuth_rad = 2.4 * i;
      const double level = std::sqrt(1 - z * z);
      const Vector3d direction(level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), z);
      const RayHit hit = recipe.scene.cast(here.translation(), direction);
      ASSERT_GT(hit.distance, 0.2) << "frame " << frame;
    }
  }
  EXPECT_GT(path_m, 0.6);
}

TEST_P(RandomSceneTest, ViewsAreNearAndShowManyInstances) {
  SyntheticOptions options;
  options.recipe = [this] { return kind.make(seed); };
  options.K = options.K.resizedTo(160, 120);
  options.noise = false;
  options.color = false;
  options.stride = 30;
  const auto source = makeSyntheticSource(options);
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ((*source)->info().frame_count, kind.frames / 30);
  for (FrameRead read = (*source)->next(); read.status == FrameRead::Status::frame;
       read = (*source)->next()) {
    const cv::Mat& depth = read.frame.depth;
    const double readings = cv::countNonZero((depth > 400) & (depth < 5000));
    EXPECT_GT(readings, 0.8 * static_cast<double>(depth.total())) << "frame " << read.frame.index;
    const cv::Mat middle = depth(cv::Rect(72, 54, 16, 12));
    EXPECT_GT(cv::mean(middle)[0], 500) << "frame " << read.frame.index;
    EXPECT_LT(cv::mean(middle)[0], 3000) << "frame " << read.frame.index;
    std::map<std::uint16_t, int> seen;
    for (const std::uint16_t id : cv::Mat_<std::uint16_t>(read.frame.instances)) ++seen[id];
    const auto visible =
        std::count_if(seen.begin(), seen.end(), [](const auto& s) { return s.first != 0 && s.second > 40; });
    EXPECT_GE(visible, 5) << "frame " << read.frame.index;
  }
}

TEST(RandomScenes, PlaceEightToTwentyObjectsOnATable) {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const SyntheticScene scene = synthetic::makeRandomTabletopScene(seed).scene;
    const Eigen::AlignedBox3d table = scene.boundsOf(scene.find("table"));
    int objects = 0;
    for (const InstanceName& instance : scene.instances()) {
      const Eigen::AlignedBox3d box = scene.boundsOf(instance.id);
      const Vector3d middle(box.center().x(), box.center().y(), table.center().z());
      objects +=
          instance.is_object && box.min().z() > table.max().z() - 0.001 && table.contains(middle) ? 1 : 0;
    }
    EXPECT_GE(objects, 8) << "seed " << seed;
    EXPECT_LE(objects, 20) << "seed " << seed;
  }
}

TEST(RandomScenes, AreEqualOnly_WhenSeedsAreEqual) {
  SourceOptions options;
  options.frames = 1;
  const auto first = [&](const std::string& scene) {
    auto source = makeSyntheticSource(scene, options);
    EXPECT_TRUE(source) << scene;
    return (*source)->next().frame;
  };
  for (const std::string kind : {"room", "tabletop"}) {
    const RgbdFrame once = first(kind + ":7");
    const RgbdFrame again = first(kind + ":7");
    EXPECT_EQ(cv::countNonZero(once.depth != again.depth), 0);
    EXPECT_EQ(cv::norm(once.color, again.color, cv::NORM_INF), 0);
    EXPECT_TRUE(once.T_world_camera->matrix() == again.T_world_camera->matrix());
    for (const std::string& other : {kind, kind + ":8"}) {
      EXPECT_GT(cv::countNonZero(once.instances != first(other).instances), 50000) << other;
    }
  }
}

TEST(RandomScenes, AcceptWordsAndSeedInAnyOrder) {
  SourceOptions options;
  options.frames = 1;
  const auto first = [&](const std::string& scene) {
    auto source = makeSyntheticSource(scene, options);
    EXPECT_TRUE(source) << scene;
    return (*source)->next().frame.depth;
  };
  const auto same = [](const cv::Mat& a, const cv::Mat& b) { return cv::countNonZero(a != b) == 0; };
  const cv::Mat exact = first("room:7:exact");
  EXPECT_TRUE(same(exact, first("room:exact:7")));
  EXPECT_FALSE(same(exact, first("room:7")));
  const cv::Mat bumpy = first("room:7:uneven:exact");
  EXPECT_TRUE(same(bumpy, first("room:exact:uneven:7")));
  int bumped = 0;
  int far = 0;
  for (int i = 0; i < static_cast<int>(exact.total()); ++i) {
    const int difference = bumpy.ptr<std::uint16_t>()[i] - exact.ptr<std::uint16_t>()[i];
    bumped += difference >= 1 && difference <= 30 ? 1 : 0;
    far += difference < -1 || difference > 30 ? 1 : 0;
  }
  EXPECT_GT(bumped, 200000) << "pixels";
  EXPECT_LT(far, 15000) << "pixels at edges";
}

}  // namespace
}  // namespace scantrove
