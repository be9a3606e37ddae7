#pragma once
#include <Eigen/Core>
#include <QColor>
#include <vector>

namespace scantrove {

/// Surface points that are marked in all views in one colour.
struct PointMarks {
  QColor color;
  std::vector<Eigen::Vector3f> points_world;  ///< metres
};

}  // namespace scantrove
