#include "core/synthetic/trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "core/synthetic/hash_random.h"

namespace scantrove::synthetic {
namespace {

using Eigen::Vector3d;

/// A sum of three sines per channel, each within +-1.
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

Trajectory::Trajectory(CameraPath path, bool tremor, std::uint32_t seed)
    : path_(std::move(path)), tremor_(tremor), seed_(seed) {}

Eigen::Isometry3d Trajectory::pose(double time_s) const {
  const Gaze gaze = path_(time_s);
  const Vector3d forward = (gaze.target - gaze.eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << right, forward.cross(right), forward;
  T_world_camera.translation() = gaze.eye;
  if (tremor_) {
    constexpr double kSway_m = 0.003;
    constexpr double kTurn = 0.25 * std::numbers::pi / 180;
    const auto channel = [&](std::uint32_t c) { return shake(time_s, c, seed_); };
    T_world_camera.translate(kSway_m * Vector3d(channel(0), channel(1), 0.6 * channel(2)));
    T_world_camera.rotate(Eigen::AngleAxisd(kTurn * channel(3), Vector3d::UnitX()) *
                          Eigen::AngleAxisd(kTurn * channel(4), Vector3d::UnitY()) *
                          Eigen::AngleAxisd(2 * kTurn * channel(5), Vector3d::UnitZ()));
  }
  return T_world_camera;
}

}  // namespace scantrove::synthetic
