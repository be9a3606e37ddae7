#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove {

using FaceCorners = std::array<std::uint32_t, 3>;

/// Texture coordinates of the corners of a face, 0 .. 1, from the left and the upper edge of the image.
using FaceTexture = std::array<Eigen::Vector2f, 3>;

/// A surface that gets a texture.
struct TextureSurface {
  std::vector<Eigen::Vector3f> positions_m;         ///< vertices, world
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< of the vertices: red, green, blue; zeros: unknown
  std::vector<FaceCorners> faces;                   ///< counter-clockwise, seen from outside
};

/// A camera whose image shows a part of the surface.
struct TextureView {
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

/// A view by its number; kNoView: no view shows the face.
using ViewNumber = std::uint16_t;
inline constexpr ViewNumber kNoView = 0xFFFF;

/// Projects points of the surface into a view's image, resized by `scale`.
class ViewProjection {
 public:
  explicit ViewProjection(const TextureView& view, double scale = 1)
      : T_camera_world_(view.T_world_camera.inverse().cast<float>()), K_(scaled(view.K, scale)) {}

  /// The camera of the resized image.
  [[nodiscard]] const Intrinsics& intrinsics() const { return K_; }
  [[nodiscard]] Eigen::Vector3f inCamera(const Eigen::Vector3f& p_world) const {
    return T_camera_world_ * p_world;
  }
  /// The pixel of a point in front of the camera, in the camera's frame.
  [[nodiscard]] Eigen::Vector2f pixel(const Eigen::Vector3f& p) const {
    return {K_.fx * p.x() / p.z() + K_.cx, K_.fy * p.y() / p.z() + K_.cy};
  }
  [[nodiscard]] Eigen::Vector2f pixelOf(const Eigen::Vector3f& p_world) const {
    return pixel(inCamera(p_world));
  }

  /// `K` for an image resized by `scale`, at least one pixel wide and high.
  [[nodiscard]] static Intrinsics scaled(const Intrinsics& K, double scale) {
    const auto resized = [scale](int length) {
      return length * scale < 1 ? 1 : static_cast<int>(std::lround(length * scale));
    };
    return K.resizedTo(resized(K.width), resized(K.height));
  }

 private:
  Eigen::Isometry3f T_camera_world_;
  Intrinsics K_;
};

}  // namespace scantrove
