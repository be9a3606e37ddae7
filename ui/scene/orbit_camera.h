#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

class vtkCamera;

namespace scantrove {

/// A viewpoint that orbits a target with a fixed "up". Metres, world frame. Uses VTK only in applyTo().
class OrbitCamera {
 public:
  /// Sets up and changes the view as little as possible.
  void setUp(const Eigen::Vector3f& up);
  [[nodiscard]] const Eigen::Vector3f& up() const { return up_; }

  /// Turns around the target, in radians: `yaw` around up, `pitch` over the top (stops short of the poles).
  void orbit(float yaw, float pitch);
  /// Moves the target in the image plane, in fractions of the view's height.
  void pan(float right, float up);
  /// Multiplies the distance.
  void zoom(float factor);

  /// Turns to look along `direction`, limited near the poles; the target stays.
  void lookAlong(const Eigen::Vector3f& direction);
  /// Shows all of `box` from the current direction.
  void fit(const Eigen::AlignedBox3f& box, float aspect);
  /// Looks from `eye` to `target`.
  void lookAt(const Eigen::Vector3f& eye, const Eigen::Vector3f& target);
  /// Moves by a fraction (0..1) towards that viewpoint.
  void approach(const Eigen::Vector3f& eye, const Eigen::Vector3f& target, float fraction);

  [[nodiscard]] Eigen::Vector3f eye() const { return target_ - distance_ * forward_; }
  [[nodiscard]] const Eigen::Vector3f& target() const { return target_; }
  [[nodiscard]] float distance() const { return distance_; }
  [[nodiscard]] const Eigen::Vector3f& forward() const { return forward_; }

  /// Direction (unit) of the ray through a position of the picture: x to the right, y up, each -1..1 from
  /// edge to edge.
  [[nodiscard]] Eigen::Vector3f rayAt(float x, float y, float aspect) const;
  /// Position of a point in the picture, as in rayAt(); none behind the eye.
  [[nodiscard]] std::optional<Eigen::Vector2f> positionOf(const Eigen::Vector3f& point, float aspect) const;
  /// Angle between neighbouring pixels in the middle of a picture of this height.
  [[nodiscard]] static float radiansPerPixel(int height_px);

  /// Sets position, focal point, up, and a clipping range that includes `scene`.
  void applyTo(vtkCamera* camera, const Eigen::AlignedBox3f& scene) const;

 private:
  Eigen::Vector3f up_ = -Eigen::Vector3f::UnitY();
  Eigen::Vector3f target_ = Eigen::Vector3f(0, 0, 1.5F);
  Eigen::Vector3f forward_ = Eigen::Vector3f(0.25F, 0.45F, 0.86F).normalized();
  float distance_ = 3;
};

}  // namespace scantrove
