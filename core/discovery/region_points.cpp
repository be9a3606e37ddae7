#include "core/discovery/region_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

/// Of z, across a pixel and its neighbours: more is a step. A surface has as much at 83 degrees.
constexpr float kStep = 0.06F;
/// A piece with less of the largest one's pixels was spilled.
constexpr int kPartOfLargest = 10;
/// With less of its pixels what is left is not the thing, but the little of it that is not thin.
constexpr int kLeastPart = 2;

/// Of the pixels in `mask` those of its larger pieces, and what does not lie behind these: what is 2 pixels
/// wide or less, or only hangs together across a step in depth, joins nothing.
cv::Mat bodyOf(const cv::Mat& mask, const cv::Mat1f& z_m) {
  cv::Mat nearest, farthest;
  cv::erode(z_m, nearest, {});
  cv::dilate(z_m, farthest, {});
  constexpr unsigned char kUnknown = 255;  // of a piece that is not numbered yet
  cv::Mat1b inside;
  cv::erode(mask, inside, {}, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  inside &= farthest <= (1 + kStep) * nearest;
  // Not by connectedComponents(): it wakes threads for each small image.
  std::vector<int> areas;
  for (int row = 0; row < inside.rows; ++row) {
    for (int column = 0; column < inside.cols; ++column) {
      if (inside(row, column) != kUnknown || areas.size() + 1 == kUnknown) continue;
      const auto piece = static_cast<double>(areas.size() + 1);
      areas.push_back(cv::floodFill(inside, {column, row}, piece, nullptr, {}, {}, 8));
    }
  }
  const int largest = areas.empty() ? 0 : *std::ranges::max_element(areas);
  cv::Mat1b of_piece(1, 256, static_cast<unsigned char>(0));
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (kPartOfLargest * areas[i] >= largest) of_piece(static_cast<int>(i) + 1) = kUnknown;
  }
  cv::LUT(inside, of_piece, inside);
  cv::Mat body;
  cv::dilate(inside, body, {});
  body &= mask;
  if (kLeastPart * cv::countNonZero(body) < cv::countNonZero(mask)) return mask;
  // What is spilled lies behind; a handle does not.
  double farthest_of_body = 0;
  cv::minMaxLoc(z_m, nullptr, &farthest_of_body, nullptr, nullptr, body);
  return body | (mask & (z_m <= farthest_of_body));
}

/// Calls `use` with each pixel of the regions that shows a surface.
template <class Use>
void forEachPixel(const RegionSet& regions, const cv::Rect& box, const DiscoveryInput& input, Use&& use) {
  for (int v = box.y; v < box.br().y; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(input.regions.width);
    for (int u = box.x; u < box.br().x; ++u) {
      const std::size_t pixel = row + static_cast<std::size_t>(u);
      if (!regions.contains(input.regions.regions[pixel])) continue;
      if (isSurface(input.vertices_world[pixel])) use(pixel);
    }
  }
}

/// Calls `use` with each vertex of the regions that is a surface point.
template <class Use>
void forEachPoint(const RegionSet& regions, const cv::Rect& box, const DiscoveryInput& input, Use&& use) {
  forEachPixel(regions, box, input, [&](std::size_t pixel) { use(input.vertices_world[pixel]); });
}

/// z in the camera frame of world points.
class CameraDepth {
 public:
  explicit CameraDepth(const DiscoveryInput& input) {
    const Eigen::Matrix4f T_camera_world = input.T_world_camera.inverse().matrix().cast<float>();
    axis_ = T_camera_world.block<1, 3>(2, 0).transpose();
    offset_ = T_camera_world(2, 3);
  }
  [[nodiscard]] float operator()(const Eigen::Vector4f& vertex) const {
    return axis_.dot(vertex.head<3>()) + offset_;
  }

 private:
  Eigen::Vector3f axis_;
  float offset_;
};

}  // namespace

float visibleArea(const RegionExtent& extent, const DiscoveryInput& input) {
  const CameraDepth depth(input);
  double sum = 0;
  forEachPoint({extent.region}, extent.box_px, input, [&](const Eigen::Vector4f& vertex) {
    const float z = depth(vertex);
    sum += static_cast<double>(z * z);
  });
  return static_cast<float>(sum / (static_cast<double>(input.K.fx) * static_cast<double>(input.K.fy)));
}

float bulgeOf(const RegionSet& regions, const cv::Rect& box_px, const DiscoveryInput& input) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  int points = 0;
  forEachPoint(regions, box_px, input, [&](const Eigen::Vector4f& vertex) {
    sum += vertex.head<3>();
    ++points;
  });
  const Eigen::Vector3f middle = sum / static_cast<float>(std::max(points, 1));
  float outwards = 0, away = 0;
  forEachPixel(regions, box_px, input, [&](std::size_t pixel) {
    if (!isSurface(input.normals_world[pixel])) return;
    const Eigen::Vector3f from_middle = input.vertices_world[pixel].head<3>() - middle;
    outwards += from_middle.dot(input.normals_world[pixel].head<3>());
    away += from_middle.norm();
  });
  return away > 0 ? outwards / away : 0;
}

std::vector<Eigen::Vector4f> pointsOf(const RegionSet& regions, const cv::Rect& box_px,
                                      const DiscoveryInput& input) {
  const CameraDepth depth(input);
  const auto firstOf = [&](int row) {
    return static_cast<std::size_t>(box_px.y + row) * static_cast<std::size_t>(input.regions.width) +
           static_cast<std::size_t>(box_px.x);
  };
  cv::Mat1f z_m(box_px.size(), 0.0F);
  cv::Mat1b mask(box_px.size(), 0);
  for (int row = 0; row < mask.rows; ++row) {
    const RegionId* regions_of_row = input.regions.regions.data() + firstOf(row);
    const Eigen::Vector4f* vertices = input.vertices_world.data() + firstOf(row);
    for (int column = 0; column < mask.cols; ++column) {
      if (!regions.contains(regions_of_row[column]) || !isSurface(vertices[column])) continue;
      z_m(row, column) = depth(vertices[column]);
      mask(row, column) = 255;
    }
  }
  const cv::Mat1b body = bodyOf(mask, z_m);
  std::vector<Eigen::Vector4f> points;
  for (int row = 0; row < body.rows; ++row) {
    const Eigen::Vector4f* vertices = input.vertices_world.data() + firstOf(row);
    for (int column = 0; column < body.cols; ++column) {
      if (body(row, column) != 0) points.push_back(vertices[column]);
    }
  }
  return points;
}

}  // namespace scantrove
