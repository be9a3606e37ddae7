#include "core/pipeline/standing_plane.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace scantrove {
namespace {

constexpr double kAround_m = 0.3;     // points farther from the seed do not count
constexpr double kNearSeed_m = 0.12;  // they count less from there on: standard deviation
constexpr double kInPlane_m = 0.006;  // at up to 1 m; the noise of depth grows with its square
constexpr double kFarBelow_m = 0.05;
constexpr std::size_t kMostPoints = 2000;
constexpr std::size_t kFewestPoints = 60;
constexpr int kTriples = 500;
constexpr int kRefinements = 3;
constexpr double kLeastTriangle_m2 = 4e-4;   // twice the area of three points: smaller ones tell no plane
constexpr double kLeastPart = 0.12;          // of the weight of all points
constexpr double kLeastHalfWidth_m = 0.045;  // narrower planes are faces of the object
// The plane faces up in the image, or straight to a camera that looks down.
constexpr double kFacesUp = 0.25;
constexpr double kFacesCamera = 0.95, kFacesDown = 0.05;

struct WeighedPoint {
  Eigen::Vector3d at;
  double weight = 0;
  double tolerance_m = 0;
};

std::vector<WeighedPoint> pointsAround(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& seed) {
  std::vector<WeighedPoint> around;
  for (const Eigen::Vector3d& point : points) {
    const double distance_m = (point - seed).norm();
    if (distance_m > kAround_m) continue;
    const double relative = distance_m / kNearSeed_m;
    around.push_back(
        {point, std::exp(-0.5 * relative * relative), kInPlane_m * std::max(1.0, point.z() * point.z())});
  }
  const std::size_t step = around.size() / kMostPoints + 1;
  std::vector<WeighedPoint> fewer;
  for (std::size_t i = 0; i < around.size(); i += step) fewer.push_back(around[i]);
  return fewer;
}

bool mayCarry(const Eigen::Vector3d& normal) {
  const bool faces_camera = -normal.z() >= kFacesCamera && normal.y() <= kFacesDown;
  return -normal.y() >= kFacesUp || faces_camera;
}

StandingPlane facingCamera(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
  const double offset_m = normal.dot(point);
  return offset_m < 0 ? StandingPlane{normal, offset_m} : StandingPlane{-normal, -offset_m};
}

double weightInside(const StandingPlane& plane, const std::vector<WeighedPoint>& points) {
  double inside = 0;
  for (const WeighedPoint& point : points) {
    if (std::abs(plane.heightOf(point.at)) < point.tolerance_m) inside += point.weight;
  }
  return inside;
}

double scoreOf(const StandingPlane& plane, const std::vector<WeighedPoint>& points) {
  double score = weightInside(plane, points);
  for (const WeighedPoint& point : points) {
    if (plane.heightOf(point.at) < -kFarBelow_m) score -= point.weight;
  }
  return score;
}

struct PlaneFit {
  StandingPlane plane;
  double half_width_m = 0;  ///< standard deviation of its points along its shorter side
};

/// The plane through the points of `plane` by least squares.
PlaneFit refined(const StandingPlane& plane, const std::vector<WeighedPoint>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double weight = 0;
  std::vector<const WeighedPoint*> inside;
  for (const WeighedPoint& point : points) {
    if (!(std::abs(plane.heightOf(point.at)) < point.tolerance_m)) continue;
    inside.push_back(&point);
    mean += point.weight * point.at;
    weight += point.weight;
  }
  if (inside.size() < 3) return {plane, 0};
  mean /= weight;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const WeighedPoint* point : inside) {
    const Eigen::Vector3d off = point->at - mean;
    spread += point->weight * off * off.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  return {facingCamera(solver.eigenvectors().col(0), mean),
          std::sqrt(std::max(0.0, solver.eigenvalues()[1] / weight))};
}

}  // namespace

std::optional<StandingPlane> findStandingPlane(std::span<const Eigen::Vector3d> points,
                                               const Eigen::Vector3d& seed) {
  const std::vector<WeighedPoint> around = pointsAround(points, seed);
  if (around.size() < kFewestPoints) return std::nullopt;
  std::minstd_rand random(1);
  const auto draw = [&]() -> const Eigen::Vector3d& { return around[random() % around.size()].at; };
  std::optional<StandingPlane> best;
  double best_score = 0;
  for (int i = 0; i < kTriples; ++i) {
    const Eigen::Vector3d &a = draw(), &b = draw(), &c = draw();
    const Eigen::Vector3d across = (b - a).cross(c - a);
    const double area_m2 = across.norm();
    if (area_m2 < kLeastTriangle_m2) continue;
    const StandingPlane plane = facingCamera(across / area_m2, a);
    if (!mayCarry(plane.normal)) continue;
    const double score = scoreOf(plane, around);
    if (score <= best_score) continue;
    best_score = score;
    best = plane;
  }
  if (!best) return std::nullopt;
  PlaneFit fit{*best, 0};
  for (int i = 0; i < kRefinements; ++i) fit = refined(fit.plane, around);
  double all = 0;
  for (const WeighedPoint& point : around) all += point.weight;
  const bool is_wide = fit.half_width_m >= kLeastHalfWidth_m;
  if (!is_wide || !mayCarry(fit.plane.normal) || weightInside(fit.plane, around) < kLeastPart * all)
    return std::nullopt;
  return fit.plane;
}

}  // namespace scantrove
