#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

namespace scantrove {

/// A plane in one camera's image, as inverse depth over the ray coordinates x = (u - cx) / fx and y. A plane
/// is linear there. Quadratic terms take up the slight bow that lens distortion gives to a plane.
class InverseDepthSurface {
 public:
  /// Coefficients of 1, x, y, x^2, xy, y^2; 1/m.
  using Coefficients = Eigen::Matrix<double, 6, 1>;

  explicit InverseDepthSurface(const Coefficients& coefficients);

  struct Sample {
    float x = 0, y = 0;  ///< ray coordinates
    float z_m = 0;       ///< > 0
  };
  /// Robust least squares: readings farther than `tolerance_m` times max(1, z) from the surface have no
  /// influence. `bowed` fits the quadratic terms too. None: too few readings lie near one surface.
  [[nodiscard]] static std::optional<InverseDepthSurface> fit(std::span<const Sample> samples,
                                                              float tolerance_m, bool bowed);

  /// Inverse depth on the ray; <= 0: the surface is behind the camera.
  [[nodiscard]] float inverseDepth(float x, float y) const;
  /// Distance of a point at depth `z_m` on the ray from the plane, metres, > 0 towards the camera.
  [[nodiscard]] float height(float x, float y, float z_m) const;
  /// Depth of the point on the ray that is `height_m` above the surface.
  [[nodiscard]] float depthAt(float x, float y, float height_m) const;
  /// Of the plane, in the camera's frame, towards the camera.
  [[nodiscard]] const Eigen::Vector3f& normal() const { return normal_; }

 private:
  Eigen::Matrix<float, 6, 1> c_;
  Eigen::Vector3f normal_;
};

}  // namespace scantrove
