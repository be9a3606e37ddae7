#include "core/fusion/color_projection.h"

#include <algorithm>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "core/fusion/view_depths.h"

namespace scantrove {
namespace {

/// Depth ratio to the nearest surface in the colour camera from which a surface is hidden. Steep surfaces
/// change less from pixel to pixel.
constexpr float kHidingStep = 1.05F;

cv::Mat evenPlaces(int width, int height) {
  cv::Mat places(height, width, CV_32FC2);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      places.at<cv::Vec2f>(v, u) = {(static_cast<float>(u) + 0.5F) / static_cast<float>(width),
                                    (static_cast<float>(v) + 0.5F) / static_cast<float>(height)};
    }
  }
  return places;
}

/// Points of the camera's frame to (x z, y z, z) with its image from 0 to 1 in x and y.
Eigen::Matrix3f toPlaces(const Intrinsics& K) {
  const auto width = static_cast<float>(K.width);
  const auto height = static_cast<float>(K.height);
  Eigen::Matrix3f matrix;
  matrix << K.fx / width, 0, (K.cx + 0.5F) / width, 0, K.fy / height, (K.cy + 0.5F) / height, 0, 0, 1;
  return matrix;
}

/// The place of a point, clamped so that arithmetic on pixels does not overflow.
cv::Vec2f placeOf(const Eigen::Vector3f& p) {
  if (p.z() < kNearestView_m) return {-1, -1};
  const float per_depth = 1 / p.z();
  return {std::clamp(p.x() * per_depth, -1.0F, 2.0F), std::clamp(p.y() * per_depth, -1.0F, 2.0F)};
}

bool isInside(const cv::Vec2f& place) {
  return place[0] >= 0 && place[0] < 1 && place[1] >= 0 && place[1] < 1;
}

/// `depths_m`: in the colour camera, CV_32FC1, 0 = no surface.
void markHidden(SurfaceInColor& seen, const cv::Mat& depths_m) {
  constexpr float kNothing_m = std::numeric_limits<float>::max();
  const cv::Size size = depths_m.size();
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  cv::Mat nearest(size, CV_32FC1, cv::Scalar(kNothing_m));
  const auto cellOf = [&](const cv::Vec2f& place) -> float& {
    return nearest.at<float>(static_cast<int>(place[1] * height), static_cast<int>(place[0] * width));
  };
  for (int v = 0; v < size.height; ++v) {
    const auto* places = seen.places.ptr<cv::Vec2f>(v);
    const auto* row = depths_m.ptr<float>(v);
    for (int u = 0; u < size.width; ++u) {
      if (row[u] <= 0 || !isInside(places[u])) continue;
      float& cell = cellOf(places[u]);
      cell = std::min(cell, row[u]);
    }
  }
  cv::morphologyEx(nearest, nearest, cv::MORPH_OPEN, {});  // fills cells between a surface's pixels
  cv::parallel_for_({0, size.height}, [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v) {
      const auto* places = seen.places.ptr<cv::Vec2f>(v);
      const auto* row = depths_m.ptr<float>(v);
      auto* hidden = seen.hidden.ptr<std::uint8_t>(v);
      for (int u = 0; u < size.width; ++u) {
        const bool is_seen = isInside(places[u]) && row[u] <= kHidingStep * cellOf(places[u]);
        hidden[u] = is_seen ? 0 : 255;
      }
    }
  });
}

}  // namespace

SurfaceInColor locateInColor(const std::optional<ColorCamera>& camera, const RenderedView& view) {
  const Intrinsics& K = view.K;
  SurfaceInColor seen;
  seen.hidden = cv::Mat::zeros(K.height, K.width, CV_8UC1);
  if (!camera) {
    seen.places = evenPlaces(K.width, K.height);
    return seen;
  }
  const Eigen::Matrix3f to_places = toPlaces(camera->K);
  const Eigen::Isometry3d T_color_world = camera->T_color_depth * view.T_world_camera.inverse();
  Eigen::Matrix4f from_world = Eigen::Matrix4f::Zero();
  from_world.topRows<3>() = to_places * T_color_world.matrix().topRows<3>().cast<float>();
  const Eigen::Matrix3f from_ray = to_places * camera->T_color_depth.linear().cast<float>();
  seen.places.create(K.height, K.width, CV_32FC2);
  cv::Mat depths_m = cv::Mat::zeros(K.height, K.width, CV_32FC1);
  cv::parallel_for_({0, K.height}, [&](const cv::Range& rows) {
    const Eigen::Vector4f* vertex = view.vertices_world.data() + std::ptrdiff_t{rows.start} * K.width;
    for (int v = rows.start; v < rows.end; ++v) {
      auto* places = seen.places.ptr<cv::Vec2f>(v);
      auto* row = depths_m.ptr<float>(v);
      for (int u = 0; u < K.width; ++u, ++vertex) {
        if (vertex->w() > 0) {
          const Eigen::Vector4f p = from_world * *vertex;
          places[u] = placeOf(p.head<3>());
          row[u] = p.z();
        } else {
          places[u] = placeOf(from_ray * K.backProject(static_cast<float>(u), static_cast<float>(v), 1));
        }
      }
    }
  });
  markHidden(seen, depths_m);
  return seen;
}

cv::Mat pixelsOf(const cv::Mat& places, const cv::Size& size) {
  cv::Mat pixels;
  cv::multiply(places, cv::Scalar(size.width, size.height), pixels);
  cv::subtract(pixels, cv::Scalar(0.5, 0.5), pixels);
  return pixels;
}

}  // namespace scantrove
