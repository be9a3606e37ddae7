#include "core/tracking/landmark_pose.h"

#include <opencv2/calib3d.hpp>

#include "core/tracking/feature_matching.h"

namespace scantrove {
namespace {

constexpr float kReprojection_px = 3.0F;  // accuracy of features at ORB's coarser scales
// RANSAC ends earlier when it has the best pose with this confidence.
constexpr int kTries = 300;
constexpr double kConfidence = 0.999;
constexpr int kMinInliers = 12;  // three times the number that determines a pose

Eigen::Isometry3d toIsometry(const cv::Mat& rotation, const cv::Mat& translation) {
  const Eigen::Vector3d turn(rotation.at<double>(0), rotation.at<double>(1), rotation.at<double>(2));
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0) T.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  T.translation() << translation.at<double>(0), translation.at<double>(1), translation.at<double>(2);
  return T;
}

}  // namespace

std::optional<LandmarkPose> locate(const ColorView& view, const Landmarks& landmarks,
                                   const std::optional<Eigen::Isometry3d>& about) {
  if (static_cast<int>(view.pixels.size()) < kMinInliers ||
      static_cast<int>(landmarks.points_world.size()) < kMinInliers)
    return std::nullopt;
  std::vector<cv::Point3f> points;
  std::vector<cv::Point2f> pixels;
  for (const FeatureMatch& match :
       about ? matchNear(view, landmarks, *about) : matchAll(view.descriptors, landmarks)) {
    points.push_back(landmarks.points_world[static_cast<std::size_t>(match.landmark)]);
    pixels.push_back(view.pixels[static_cast<std::size_t>(match.feature)]);
  }
  if (static_cast<int>(points.size()) < kMinInliers) return std::nullopt;

  const cv::Matx33d K(static_cast<double>(view.K.fx), 0, static_cast<double>(view.K.cx), 0,
                      static_cast<double>(view.K.fy), static_cast<double>(view.K.cy), 0, 0, 1);
  cv::Mat rotation, translation;
  std::vector<int> inliers;
  if (!cv::solvePnPRansac(points, pixels, K, cv::noArray(), rotation, translation, false, kTries,
                          kReprojection_px, kConfidence, inliers, cv::SOLVEPNP_AP3P) ||
      static_cast<int>(inliers.size()) < kMinInliers)
    return std::nullopt;
  std::vector<cv::Point3f> good_points;
  std::vector<cv::Point2f> good_pixels;
  LandmarkPose pose;
  pose.seen.K = view.K;
  pose.seen.T_color_depth = view.T_color_depth;
  for (const int i : inliers) {
    const cv::Point2f pixel = pixels[static_cast<std::size_t>(i)];
    good_points.push_back(points[static_cast<std::size_t>(i)]);
    good_pixels.push_back(pixel);
    const cv::Point3f& point = good_points.back();
    pose.seen.points_world.push_back(Eigen::Vector3f(point.x, point.y, point.z).cast<double>());
    pose.seen.pixels.push_back(Eigen::Vector2f(pixel.x, pixel.y).cast<double>());
  }
  cv::solvePnPRefineLM(good_points, good_pixels, K, cv::noArray(), rotation, translation);
  const Eigen::Isometry3d T_color_world = toIsometry(rotation, translation);
  if (!T_color_world.matrix().allFinite()) return std::nullopt;
  pose.T_world_camera = T_color_world.inverse() * view.T_color_depth;
  return pose;
}

}  // namespace scantrove
