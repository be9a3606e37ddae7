#pragma once
#include <Eigen/Core>
#include <QColor>
#include <vector>

namespace scantrove {

/// Places on the surface that are marked in all views, in one colour.
struct PlaceMarks {
  QColor color;
  std::vector<Eigen::Vector3f> places_world;  ///< metres
};

}  // namespace scantrove
