#pragma once
#include <Eigen/Geometry>

#include "core/picture/picture_surface.h"

namespace scantrove {

/// A pinhole camera of a picture: z forward, y down; the centre of pixel (x, y) lies at (x, y).
struct PictureCamera {
  Eigen::Isometry3f T_camera_world = Eigen::Isometry3f::Identity();
  float focal_px = 1;
  int width = 0, height = 0;

  [[nodiscard]] float centerX() const { return static_cast<float>(width - 1) / 2; }
  [[nodiscard]] float centerY() const { return static_cast<float>(height - 1) / 2; }
};

/// Cameras on a sphere around a surface, all at the distance from which it fits into the picture.
class TurntableCamera {
 public:
  /// `up_world` and `front_world`: unit vectors; the camera stands towards `front_world` at azimuth 0.
  TurntableCamera(const PictureSurface& surface, const Eigen::Vector3f& up_world,
                  const Eigen::Vector3f& front_world, int width, int height);

  /// Positive azimuths go counter-clockwise, seen from above; elevations are within -90 .. 90.
  [[nodiscard]] PictureCamera at(double azimuth_deg, double elevation_deg) const;

 private:
  Eigen::Vector3f up_, front_, left_;  // orthonormal
  Eigen::Vector3f center_ = Eigen::Vector3f::Zero();
  float distance_m_ = 1, focal_px_ = 1;
  int width_, height_;
};

}  // namespace scantrove
