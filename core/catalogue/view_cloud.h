#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

/// A point of an object's surface.
struct ViewPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< world of the views' session, metres
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< unit, towards the camera; zero: unknown
  std::array<std::uint8_t, 3> rgb{};
};

/// What the views of one session show of an object, as points.
struct ViewCloud {
  std::int64_t session = 0;
  int views = 0;                  ///< that it is made of
  float spacing_m = 0;            ///< about the distance of neighbouring points
  std::vector<ViewPoint> points;  ///< empty: no view has depth, colour and a known camera
};

/// Points per side of the object's longest side, about: enough for a picture of 400 pixels.
inline constexpr int kCloudSteps = 160;

/// Back-projects colour and depth inside the masks. Only the views of one session share a world, so it takes
/// those of the session with most usable views (of equal ones, the newest). Points nearer to each other than
/// the spacing become one; those far from the others in depth (the background behind an edge) are left out.
/// `cameras`: CatalogueSessions::cameras().
[[nodiscard]] ViewCloud cloudOfViews(std::span<const ObjectView> views,
                                     const std::map<std::int64_t, Intrinsics>& cameras);

}  // namespace scantrove
