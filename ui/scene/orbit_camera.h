#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

class vtkCamera;

namespace scantrove {

/// A viewpoint that circles a target with "up" kept upright. Metres, world frame. Knows nothing of VTK but
/// how to write itself into a vtkCamera.
class OrbitCamera {
 public:
  /// Keeps the present view as well as it can.
  void setUp(const Eigen::Vector3f& up);
  [[nodiscard]] const Eigen::Vector3f& up() const { return up_; }

  /// Turns around the target, in radians: `yaw` around up, `pitch` over the top (stops short of the poles).
  void orbit(float yaw, float pitch);
  /// Moves the target in the image plane, in fractions of the view's height.
  void pan(float right, float up);
  /// Multiplies the distance.
  void zoom(float factor);

  /// Turns to look along `direction`, as near to the poles as it goes; the target stays.
  void lookAlong(const Eigen::Vector3f& direction);
  /// Looks at all of `box` from the present direction.
  void fit(const Eigen::AlignedBox3f& box, float aspect);
  /// Looks from `eye` to `target`.
  void lookAt(const Eigen::Vector3f& eye, const Eigen::Vector3f& target);
  /// Moves a fraction (0..1) of the way from here to that viewpoint.
  void approach(const Eigen::Vector3f& eye, const Eigen::Vector3f& target, float fraction);

  [[nodiscard]] Eigen::Vector3f eye() const { return target_ - distance_ * forward_; }
  [[nodiscard]] const Eigen::Vector3f& target() const { return target_; }
  [[nodiscard]] float distance() const { return distance_; }
  [[nodiscard]] const Eigen::Vector3f& forward() const { return forward_; }

  /// The direction (unit) in which a place of the picture lies: x to the right, y up, each -1..1 from edge to
  /// edge.
  [[nodiscard]] Eigen::Vector3f rayAt(float x, float y, float aspect) const;
  /// Where in the picture a point is seen; none behind the eye.
  [[nodiscard]] std::optional<Eigen::Vector2f> placeOf(const Eigen::Vector3f& point, float aspect) const;
  /// Radians between neighbouring pixels in the middle of a picture of that height.
  [[nodiscard]] static float radiansPerPixel(int height_px);

  /// Position, focal point, up, and a clipping range that holds `scene`.
  void applyTo(vtkCamera* camera, const Eigen::AlignedBox3f& scene) const;

 private:
  Eigen::Vector3f up_ = -Eigen::Vector3f::UnitY();
  Eigen::Vector3f target_ = Eigen::Vector3f(0, 0, 1.5F);
  Eigen::Vector3f forward_ = Eigen::Vector3f(0.25F, 0.45F, 0.86F).normalized();
  float distance_ = 3;
};

}  // namespace scantrove
