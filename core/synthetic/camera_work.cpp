#include "core/synthetic/camera_work.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <numbers>

#include "core/synthetic/view_caster.h"

namespace scantrove::synthetic {
namespace {

constexpr double kSpeed = 0.30;                          // m/s
constexpr double kTurn = 20.0 / 180 * std::numbers::pi;  // rad/s
constexpr double kClearance_m = 0.3;
constexpr double kSweepClearance_m = 0.2;
constexpr double kNearOnAverage = 0.12;  // share of the image

bool isFree(const Layout& layout, const Vec3& eye, double clearance_m) {
  return std::all_of(layout.filled().begin(), layout.filled().end(), [&](const Layout::Filled& filled) {
    return distance(eye, filled.volume) > clearance_m;
  });
}

/// View statistics of a 640 x 480 camera from 48 x 36 rays.
struct ViewSummary {
  double readings = 0;  ///< share of the image with depth
  double too_near = 0;  ///< share nearer than 0.55 m
  double near = 0;      ///< share nearer than 0.9 m
  double middle_m = 0;  ///< depth at the image centre, 0 = none
  double spread = 0;    ///< smallest mean squared cosine between the normals and any direction
  std::ptrdiff_t things = 0;
};

ViewSummary summarize(const SyntheticScene& scene, const Eigen::Isometry3d& T_world_camera) {
  View view;
  view.T_world_view = T_world_camera;
  view.width = 48;
  view.height = 36;
  view.fx = view.fy = 525.0 * view.width / 640;
  view.cx = (view.width - 1) / 2.0;
  view.cy = (view.height - 1) / 2.0;
  const ViewCaster caster(scene, view);
  const double rays = view.width * view.height;
  ViewSummary summary;
  std::map<std::uint16_t, int> seen;
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  std::vector<double> middle;
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const ViewCaster::Hit hit = caster.cast(u, v);
      if (!hit || hit.z > 4.5) continue;
      const SyntheticScene::Part& part = scene.parts()[static_cast<std::size_t>(hit.part)];
      summary.readings += 1 / rays;
      summary.too_near += hit.z < 0.55 ? 1 / rays : 0;
      summary.near += hit.z < 0.9 ? 1 / rays : 0;
      ++seen[part.instance];
      const Vec3 n =
          part.T_world_part.linear() * part.shape->describe(caster.localPoint(hit, u, v), hit.piece).normal;
      normals += n * n.transpose();
      if (std::abs(u - view.cx) < 5 && std::abs(v - view.cy) < 5) middle.push_back(hit.z);
    }
  }
  summary.things = std::count_if(seen.begin(), seen.end(), [&](const auto& s) { return s.second >= 6; });
  if (middle.size() >= 50) {
    std::nth_element(middle.begin(), middle.begin() + 25, middle.end());
    summary.middle_m = middle[25];
  }
  if (summary.readings > 0) {
    normals /= summary.readings * rays;
    summary.spread =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(normals, Eigen::EigenvaluesOnly).eigenvalues()[0];
  }
  return summary;
}

bool showsEnough(const ViewSummary& seen) {
  return seen.readings >= 0.85 && seen.too_near <= 0.02 && seen.things >= 7 && seen.middle_m > 0.6 &&
         seen.middle_m < 2.5 && seen.spread > 0.04;
}

}  // namespace

CameraPath alongAtHandsPace(std::vector<Gaze> points) {
  // With both end points doubled, the spline rests where it reverses.
  points.insert(points.begin(), points.front());
  points.push_back(points.back());
  const auto path = [points](double period_s) {
    return [points, period_s](double time_s) { return alongSpline(points, period_s, time_s); };
  };
  const Trajectory once(path(1), false, 0);
  constexpr double kStep_s = 0.02;
  double slowest = 0;
  for (double t = 0; t < static_cast<double>(points.size()) - 1; t += kStep_s) {
    const Eigen::Isometry3d step = once.pose(t).inverse() * once.pose(t + kStep_s);
    slowest = std::max({slowest, step.translation().norm() / kStep_s / kSpeed,
                        Eigen::AngleAxisd(step.linear()).angle() / kStep_s / kTurn});
  }
  return path(std::max(slowest, 0.1));
}

bool passesNear(const Layout& layout, const CameraPath& path, double seconds) {
  const Trajectory trajectory(path, false, 0);
  for (double t = 0; t < seconds; t += 0.1) {
    if (!isFree(layout, path(t).eye, kSweepClearance_m)) return false;
  }
  double near = 0;
  int views = 0;
  for (double t = 0; t < seconds; t += 0.25) {
    const ViewSummary seen = summarize(layout.scene, trajectory.pose(t));
    if (seen.readings < 0.6 || seen.too_near > 0.5 || seen.spread < 0.012) return false;
    near += seen.near;
    ++views;
  }
  return near > kNearOnAverage * views;
}

int countBadViews(const Layout& layout, const CameraPath& path, double seconds, int enough) {
  const Trajectory trajectory(path, false, 0);
  int bad = 0;
  for (double t = 0; t < seconds && bad < enough; t += 0.1) {
    if (!isFree(layout, path(t).eye, kClearance_m)) ++bad;
  }
  for (double t = 0; t < seconds && bad < enough; t += 0.5) {
    if (!showsEnough(summarize(layout.scene, trajectory.pose(t)))) ++bad;
  }
  return bad;
}

}  // namespace scantrove::synthetic
