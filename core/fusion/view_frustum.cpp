#include "core/fusion/view_frustum.h"

namespace scantrove {

ViewFrustum::ViewFrustum(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K, double min_depth_m,
                         double max_depth_m) {
  // Pixel borders lie half a pixel beyond the centres of the outermost pixels.
  const double left = (-0.5 - K.cx) / K.fx;
  const double right = (K.width - 0.5 - K.cx) / K.fx;
  const double top = (-0.5 - K.cy) / K.fy;
  const double bottom = (K.height - 0.5 - K.cy) / K.fy;
  Eigen::Matrix<double, 6, 4> planes_camera;
  planes_camera << 1, 0, -left, 0,  //
      -1, 0, right, 0,              //
      0, 1, -top, 0,                //
      0, -1, bottom, 0,             //
      0, 0, 1, -min_depth_m,        //
      0, 0, -1, max_depth_m;
  for (int plane = 0; plane < 6; ++plane)
    planes_camera.row(plane) /= planes_camera.row(plane).head<3>().norm();
  planes_world_ = planes_camera * T_world_camera.inverse().matrix();
  for (const double z : {min_depth_m, max_depth_m}) {
    for (const double x : {left, right}) {
      for (const double y : {top, bottom})
        bounds_world_.extend(T_world_camera * Eigen::Vector3d(x * z, y * z, z));
    }
  }
}

double ViewFrustum::smallestDistance(const Eigen::Vector3d& point_world) const {
  return (planes_world_.leftCols<3>() * point_world + planes_world_.col(3)).minCoeff();
}

bool ViewFrustum::intersectsSphere(const Eigen::Vector3d& center_world, double radius_m) const {
  return smallestDistance(center_world) >= -radius_m;
}

bool ViewFrustum::holdsSphere(const Eigen::Vector3d& center_world, double radius_m) const {
  return smallestDistance(center_world) >= radius_m;
}

}  // namespace scantrove
