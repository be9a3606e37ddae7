#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace scantrove::synthetic {

using Vec3 = Eigen::Vector3d;

/// Points `origin + t * direction`, t > 0. The direction need not have unit length.
struct Ray {
  Vec3 origin;
  Vec3 direction;
  [[nodiscard]] Vec3 at(double t) const { return origin + t * direction; }
};

/// Fast length, for values far from overflow.
template <class Real>
[[nodiscard]] Real lengthOf(Real x, Real y) {
  return std::sqrt(x * x + y * y);
}

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// Hit of a ray on a shape; `part` is the shape-specific index of the surface piece.
struct ShapeHit {
  double t = kNoHit;
  int part = 0;
};

/// Surface data for shading and textures. Shape frame.
struct SurfacePoint {
  Vec3 point;
  Vec3 normal;           ///< exact, unit, out of the material
  Vec3 shading_normal;   ///< smoothed over the facets of a lathe, else `normal`
  float u = 0, v = 0;    ///< metres along the surface
  float ru = 0, rv = 0;  ///< the same, -1..1 over the face
  int face = 0;          ///< box: 0..5 = -x +x -y +y -z +z; else 0
};

/// An axis-aligned box in the shape's frame.
struct Bounds {
  Vec3 low;
  Vec3 high;

  /// The interval of t > 0 inside the box, clipped to `t_max`; empty when first > second.
  [[nodiscard]] std::pair<double, double> crossing(const Ray& ray, double t_max) const {
    double enter = 0;
    double leave = t_max;
    const auto cut = [&](int axis) {
      const double inverse = 1.0 / ray.direction[axis];
      const double a = (low[axis] - ray.origin[axis]) * inverse;
      const double b = (high[axis] - ray.origin[axis]) * inverse;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    };
    cut(0);
    cut(1);
    cut(2);
    return {enter, leave};
  }
};

/// A solid that rays can hit, in its own frame (metres). Immutable; any thread.
class Shape {
 public:
  virtual ~Shape() = default;
  [[nodiscard]] virtual Bounds bounds() const = 0;
  /// The nearest hit with 0 < t < t_max, to 0.1 mm or better.
  [[nodiscard]] virtual ShapeHit intersect(const Ray& ray, double t_max) const = 0;
  [[nodiscard]] virtual SurfacePoint describe(const Vec3& point, int part) const = 0;
  /// Support function along a unit direction: max of `direction` . point, or more. Exact, except for a cut
  /// torus in directions other than its axes.
  [[nodiscard]] virtual double reach(const Vec3& direction) const = 0;
  /// Minimum thickness of the material; 0 if unknown.
  [[nodiscard]] virtual double thickness() const { return 0; }
};

}  // namespace scantrove::synthetic
