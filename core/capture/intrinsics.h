#pragma once
#include <Eigen/Core>
#include <cstddef>

namespace scantrove {

/// Parameters and thresholds in pixels refer to images of 640 x 480 and scale with the image's pixel count.
inline constexpr double kReferencePixels = 640.0 * 480.0;

/// A pinhole camera without distortion. Pixel centres lie at integer coordinates:
/// a point (x, y, z) of the camera frame (x right, y down, z forward, metres) is seen at
/// u = fx x / z + cx, v = fy y / z + cy, in pixel (floor(u + 0.5), floor(v + 0.5)).
struct Intrinsics {
  float fx = 0, fy = 0, cx = 0, cy = 0;
  int width = 0, height = 0;

  [[nodiscard]] int pixels() const { return width * height; }
  /// Pixels per pixel of a reference image.
  [[nodiscard]] double pixelScale() const { return static_cast<double>(pixels()) / kReferencePixels; }
  [[nodiscard]] bool isInside(int u, int v) const { return u >= 0 && v >= 0 && u < width && v < height; }
  /// Row-major index of pixel (u, v).
  [[nodiscard]] std::size_t indexOf(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }

  /// The camera scaled to images of `new_width` x `new_height`.
  [[nodiscard]] Intrinsics resizedTo(int new_width, int new_height) const {
    const float sx = static_cast<float>(new_width) / static_cast<float>(width);
    const float sy = static_cast<float>(new_height) / static_cast<float>(height);
    return {fx * sx, fy * sy, (cx + 0.5F) * sx - 0.5F, (cy + 0.5F) * sy - 0.5F, new_width, new_height};
  }

  [[nodiscard]] Eigen::Vector3f backProject(float u, float v, float z) const {
    return {(u - cx) * z / fx, (v - cy) * z / fy, z};
  }

  bool operator==(const Intrinsics&) const = default;
};

}  // namespace scantrove
