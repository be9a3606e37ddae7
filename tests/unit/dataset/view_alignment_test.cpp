#include "core/dataset/view_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace scantrove::test {
namespace {

constexpr Intrinsics kCamera{260, 260, 159.5F, 119.5F, 320, 240};

/// A floor, a wall and balls that are not alike, seen from the origin along +z.
struct Room {
  bool has_balls = true;
  bool has_wall = true;
  bool has_hand = false;

  /// Distance along the unit ray from `origin`; infinite: nothing.
  [[nodiscard]] double cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) const {
    double nearest = std::numeric_limits<double>::infinity();
    const auto take = [&](double t) {
      if (t > 0 && t < nearest) nearest = t;
    };
    take((0.5 - origin.y()) / ray.y());                // floor, y points down
    if (has_wall) take((2.0 - origin.z()) / ray.z());  // wall
    const auto ball = [&](const Eigen::Vector3d& center, double radius) {
      const Eigen::Vector3d to = center - origin;
      const double along = to.dot(ray);
      const double off = radius * radius - (to.squaredNorm() - along * along);
      if (off > 0) take(along - std::sqrt(off));
    };
    if (has_balls) {
      ball({-0.35, 0.3, 1.4}, 0.2);
      ball({0.4, 0.2, 1.6}, 0.3);
      ball({0.05, 0.42, 1.1}, 0.1);
    }
    if (has_hand) ball({0.1, 0.1, 0.7}, 0.12);
    return nearest;
  }

  [[nodiscard]] cv::Mat seenFrom(const Eigen::Isometry3d& T_world_camera) const {
    cv::Mat depth_m = cv::Mat::zeros(kCamera.height, kCamera.width, CV_32FC1);
    for (int v = 0; v < kCamera.height; ++v) {
      for (int u = 0; u < kCamera.width; ++u) {
        const Eigen::Vector3d through =
            kCamera.backProject(static_cast<float>(u), static_cast<float>(v), 1).cast<double>();
        const double t = cast(T_world_camera.translation(), T_world_camera.linear() * through.normalized());
        if (std::isfinite(t)) depth_m.at<float>(v, u) = static_cast<float>(t / through.norm());
      }
    }
    return depth_m;
  }
};

Eigen::Isometry3d moved(const Eigen::Vector3d& by_m, double turn_deg) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = by_m;
  T.linear() = Eigen::AngleAxisd(turn_deg * std::numbers::pi / 180, Eigen::Vector3d(0.3, 1, 0.2).normalized())
                   .matrix();
  return T;
}

double degreesOf(const Eigen::Isometry3d& T) {
  return Eigen::AngleAxisd(T.linear()).angle() * 180 / std::numbers::pi;
}

TEST(ViewAlignment, FindsTheErrorOfAPose) {
  const Room room;
  const cv::Mat map_m = room.seenFrom(Eigen::Isometry3d::Identity());
  for (const Eigen::Vector3d& shift : {Eigen::Vector3d(0.02, 0, 0), Eigen::Vector3d(-0.01, 0.015, 0.02)}) {
    const Eigen::Isometry3d truth = moved(shift, 0.8);
    const auto found = alignToMap(room.seenFrom(truth), map_m, kCamera);
    ASSERT_TRUE(found);
    const Eigen::Isometry3d error = truth.inverse() * *found;
    // A tenth of the error, most of it the weight of the pose as it was.
    EXPECT_LT(error.translation().norm(), 0.1 * shift.norm() + 0.001);
    EXPECT_LT(degreesOf(error), 0.1);
  }
}

TEST(ViewAlignment, LeavesOutWhatTheMapDoesNotHave) {
  Room room;
  const cv::Mat map_m = room.seenFrom(Eigen::Isometry3d::Identity());
  room.has_hand = true;
  const Eigen::Isometry3d truth = moved({0.02, 0.01, 0}, 0.5);
  const auto found = alignToMap(room.seenFrom(truth), map_m, kCamera);
  ASSERT_TRUE(found);
  EXPECT_LT((truth.inverse() * *found).translation().norm(), 0.004);
}

TEST(ViewAlignment, KeepsAPoseThatFits) {
  const Room room;
  const cv::Mat map_m = room.seenFrom(Eigen::Isometry3d::Identity());
  EXPECT_FALSE(alignToMap(map_m, map_m, kCamera));
}

TEST(ViewAlignment, DoesNotSlideAlongAFloor) {
  Room room{.has_balls = false, .has_wall = false};
  const cv::Mat map_m = room.seenFrom(Eigen::Isometry3d::Identity());
  // Two centimetres up, and along the floor, which no depth shows.
  const auto found = alignToMap(room.seenFrom(moved({0.02, -0.02, 0}, 0)), map_m, kCamera);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->translation().y(), -0.02, 0.003);
  EXPECT_NEAR(found->translation().x(), 0, 0.003);
}

TEST(ViewAlignment, KeepsThePose_WhereTooLittleIsSeen) {
  const Room room;
  const cv::Mat map_m = room.seenFrom(Eigen::Isometry3d::Identity());
  cv::Mat measured_m = room.seenFrom(moved({0.02, 0, 0}, 0));
  measured_m.rowRange(3, measured_m.rows).setTo(0);
  EXPECT_FALSE(alignToMap(measured_m, map_m, kCamera));
}

}  // namespace
}  // namespace scantrove::test
