#include "core/synthetic/trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "core/synthetic/hash_random.h"

namespace scantrove::synthetic {
namespace {

using Eigen::Vector3d;
constexpr double kDegree = std::numbers::pi / 180;

/// Where the camera is and what its middle looks at.
struct Gaze {
  Vector3d eye = Vector3d::Zero();
  Vector3d target = Vector3d::Zero();
};

/// Uniform cubic B-spline through the neighbourhood of the points, one a `period_s`, forth and back for ever.
Gaze alongSpline(std::span<const Gaze> points, double period_s, double time_s) {
  const double last = static_cast<double>(points.size() - 1);
  double s = std::fmod(time_s / period_s, 2 * last);
  s = s > last ? 2 * last - s : s;
  const auto i = std::min(static_cast<std::ptrdiff_t>(s), std::ssize(points) - 2);
  const double x = s - static_cast<double>(i);
  const double weights[4] = {(1 - x) * (1 - x) * (1 - x) / 6, (3 * x * x * x - 6 * x * x + 4) / 6,
                             (-3 * x * x * x + 3 * x * x + 3 * x + 1) / 6, x * x * x / 6};
  Gaze gaze{Vector3d::Zero(), Vector3d::Zero()};
  for (std::ptrdiff_t k = 0; k < 4; ++k) {
    const Gaze& point =
        points[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i - 1 + k, 0, std::ssize(points) - 1))];
    gaze.eye += weights[k] * point.eye;
    gaze.target += weights[k] * point.target;
  }
  return gaze;
}

Gaze aroundTable(double t) {
  const double azimuth = (-100 + 15.5 * t) * kDegree;
  const double radius = 0.87 + 0.05 * std::sin(0.9 * t);
  const double height = 1.27 + 0.10 * std::sin(0.55 * t + 0.5);
  return {{radius * std::cos(azimuth), radius * std::sin(azimuth), height},
          {0.03 * std::sin(0.7 * t), 0.03 * std::cos(0.5 * t), 0.76}};
}

Gaze aroundBlock(double t) {
  // Straight from the front for half a second, then round to the side, then back again.
  const double turned = 42 * (1 - std::cos(std::clamp(t - 0.5, 0.0, 1e9) * 2 * std::numbers::pi / 15));
  const double azimuth = turned * kDegree;
  return {{0.64 * std::cos(azimuth), 0.64 * std::sin(azimuth), 1.14}, {0, 0, 0.78}};
}

Gaze throughRoom(double t) {
  static const Gaze kWay[] = {
      {{0.62, -0.92, 1.18}, {0.50, 0.30, 0.55}},  {{0.40, -1.12, 1.30}, {0.42, 0.22, 0.46}},
      {{0.02, -1.25, 1.40}, {0.30, 0.12, 0.36}},  {{-0.42, -1.05, 1.44}, {0.16, 0.22, 0.36}},
      {{-0.80, -0.68, 1.44}, {0.02, 0.48, 0.48}}, {{-1.02, -0.22, 1.42}, {-0.16, 0.85, 0.66}},
      {{-1.00, 0.22, 1.38}, {-0.32, 1.22, 0.78}}, {{-0.68, 0.40, 1.33}, {-0.32, 1.36, 0.80}},
      {{-0.26, 0.44, 1.33}, {-0.22, 1.38, 0.80}}, {{0.16, 0.44, 1.36}, {-0.12, 1.38, 0.80}},
      {{0.52, 0.50, 1.38}, {-0.06, 1.36, 0.80}},
  };
  return alongSpline(kWay, 1.33, t);
}

Gaze aroundChair(double t) {
  static const Gaze kWay[] = {
      {{0.10, -1.00, 1.18}, {0.02, 0.25, 0.55}}, {{-0.10, -1.20, 1.30}, {0.0, 0.2, 0.44}},
      {{-0.45, -1.30, 1.40}, {0.0, 0.1, 0.34}},  {{-0.85, -1.10, 1.46}, {0.0, 0.0, 0.28}},
      {{-1.15, -0.75, 1.46}, {0.0, 0.0, 0.28}},
  };
  return alongSpline(kWay, 1.25, t);
}

/// A sum of three sines a channel, each within +-1.
double shake(double time_s, std::uint32_t channel, std::uint32_t seed) {
  double sum = 0;
  for (std::uint32_t wave = 0; wave < 3; ++wave) {
    const std::uint32_t bits = hashBits(channel, wave, 23, seed);
    const double hertz = 0.7 + 1.4 * wave + 0.5 * hashUniform(bits);
    const double phase = 2 * std::numbers::pi * hashUniform(bits * 0x9e3779b9U);
    sum += std::sin(2 * std::numbers::pi * hertz * time_s + phase) / (1.0 + 1.5 * wave);
  }
  return sum / (1 + 1 / 2.5 + 1 / 4.0);
}

}  // namespace

Trajectory::Trajectory(SceneKind scene, bool tremor, std::uint32_t seed)
    : scene_(scene), tremor_(tremor), seed_(seed) {}

Eigen::Isometry3d Trajectory::pose(double time_s) const {
  Gaze gaze;
  switch (scene_) {
    case SceneKind::tabletop:
      gaze = aroundTable(time_s);
      break;
    case SceneKind::room:
      gaze = throughRoom(time_s);
      break;
    case SceneKind::l_block:
      gaze = aroundBlock(time_s);
      break;
    case SceneKind::chair_floor:
      gaze = aroundChair(time_s);
      break;
  }
  const Vector3d forward = (gaze.target - gaze.eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << right, forward.cross(right), forward;
  T_world_camera.translation() = gaze.eye;
  if (tremor_) {
    constexpr double kSway_m = 0.003;
    constexpr double kTurn = 0.25 * kDegree;
    const auto channel = [&](std::uint32_t c) { return shake(time_s, c, seed_); };
    T_world_camera.translate(kSway_m * Vector3d(channel(0), channel(1), 0.6 * channel(2)));
    T_world_camera.rotate(Eigen::AngleAxisd(kTurn * channel(3), Vector3d::UnitX()) *
                          Eigen::AngleAxisd(kTurn * channel(4), Vector3d::UnitY()) *
                          Eigen::AngleAxisd(2 * kTurn * channel(5), Vector3d::UnitZ()));
  }
  return T_world_camera;
}

int defaultFrameCount(SceneKind scene) {
  switch (scene) {
    case SceneKind::tabletop:
      return 300;
    case SceneKind::room:
      return 400;
    default:
      return 150;
  }
}

}  // namespace scantrove::synthetic
