#pragma once
#include <vector>

#include "core/synthetic/shape.h"

namespace scantrove::synthetic {

/// A solid of revolution: the polyline of (radius, z) points rotated around the z axis. Order the profile
/// with the material on its left (from the bottom's centre outwards, up, and back in). Every piece is a cone
/// or a disc with exact intersections. Shading normals are smoothed where neighbouring pieces bend by less
/// than 50 degrees.
class Lathe final : public Shape {
 public:
  using Profile = std::vector<Eigen::Vector2d>;

  explicit Lathe(const Profile& profile);
  [[nodiscard]] Bounds bounds() const override;
  [[nodiscard]] ShapeHit intersect(const Ray& ray, double t_max) const override;
  [[nodiscard]] SurfacePoint describe(const Vec3& point, int part) const override;
  [[nodiscard]] double reach(const Vec3& direction) const override;

 private:
  struct Piece {
    Eigen::Vector2d from, to;                        // (radius, z)
    Eigen::Vector2d normal, normal_from, normal_to;  // in the (radius, z) half plane
    double arc;                                      // length of the profile before this piece
    double slope;                                    // d radius / d z, where not flat
    double z_low, z_high;
    bool flat;
  };
  std::vector<Piece> pieces_;
  double radius_ = 0, z_low_ = 0, z_high_ = 0, length_ = 0;
};

/// Appends an arc of `steps` chords to a profile: centre (radius, z), angles in degrees from the +radius axis
/// towards +z.
void appendArc(Lathe::Profile& profile, Eigen::Vector2d center, double radius, double from_deg, double to_deg,
               int steps);

/// A closed can from z = 0 to `height` with rounded rims.
[[nodiscard]] Lathe::Profile canProfile(double bottom_radius, double top_radius, double height,
                                        double rim = 0.002);

/// A hollow vessel: the given outer wall from the foot up, walls of `wall` metres, rounded rim.
[[nodiscard]] Lathe::Profile vesselProfile(const Lathe::Profile& outer, double wall);

/// A smooth curve through the given (radius, z) points (Catmull-Rom), `steps` chords for each span.
[[nodiscard]] Lathe::Profile smoothProfile(const Lathe::Profile& knots, int steps);

}  // namespace scantrove::synthetic
