#include "core/discovery/oriented_box.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <pcl/common/centroid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#pragma GCC diagnostic pop

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace scantrove {
namespace {

constexpr std::size_t kMaxPoints = 4096;  // evenly chosen; more do not change the box
constexpr double kStrayFraction = 0.01;   // at each end: mixed readings at edges

/// Length of the range from 1 % to 99 % of the values; reorders them.
float robustExtent(std::vector<float>& values) {
  const auto stray = static_cast<std::ptrdiff_t>(kStrayFraction * static_cast<double>(values.size()));
  const auto low = values.begin() + stray, high = values.end() - 1 - stray;
  std::nth_element(values.begin(), low, values.end());
  const float smallest = *low;  // the next selection moves it
  std::nth_element(low, high, values.end());
  return *high - smallest;
}

OrientedBox fitOnce(const pcl::PointCloud<pcl::PointXYZ>& cloud) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  pcl::computeMeanAndCovarianceMatrix(cloud, covariance, mean);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  const Eigen::Matrix3f axes = eigen.eigenvectors().rowwise().reverse().cast<float>();  // longest first
  OrientedBox box;
  box.mean = mean.head<3>().cast<float>();
  box.axes = axes;
  const double largest = eigen.eigenvalues()[2], smallest = std::max(eigen.eigenvalues()[0], 0.0);
  box.thickness_ratio = largest > 0 ? static_cast<float>(std::sqrt(smallest / largest)) : 0;
  std::vector<float> along(cloud.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(cloud, along.begin(), [&](const pcl::PointXYZ& p) {
      return axes.col(axis).dot(p.getVector3fMap() - box.mean);
    });
    box.size_m[axis] = robustExtent(along);
  }
  return box;
}

/// Removes points farther than a box length from the mean, which would turn the axes.
pcl::PointCloud<pcl::PointXYZ> withoutStray(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                                            const OrientedBox& box) {
  pcl::PointCloud<pcl::PointXYZ> near;
  near.reserve(cloud.size());
  const float reach = box.size_m.norm();
  for (const pcl::PointXYZ& p : cloud) {
    if ((p.getVector3fMap() - box.mean).norm() <= reach) near.push_back(p);
  }
  return near;
}

}  // namespace

OrientedBox fitOrientedBox(std::span<const Eigen::Vector4f> points) {
  if (points.size() < 3) return {};
  const std::size_t step = (points.size() + kMaxPoints - 1) / kMaxPoints;
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.reserve(points.size() / step + 1);
  for (std::size_t i = 0; i < points.size(); i += step) {
    cloud.emplace_back(points[i].x(), points[i].y(), points[i].z());
  }
  OrientedBox box = fitOnce(cloud);
  const pcl::PointCloud<pcl::PointXYZ> near = withoutStray(cloud, box);
  if (near.size() >= 3 && near.size() < cloud.size()) box = fitOnce(near);
  std::sort(box.size_m.data(), box.size_m.data() + 3, std::greater<>());
  return box;
}

}  // namespace scantrove
