#include "ui/scene/cloud_ids.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace scantrove {
namespace {

// The same values as in the shaders.
constexpr float kLargestPoint_px = 64;
constexpr float kMinFacing = 0.3F;
constexpr float kSmall_px = 3.5F;

constexpr float kNear_m = 0.05F;  ///< nearer boxes may be anywhere in the view

}  // namespace

CloudIds::CloudIds() = default;

void CloudIds::begin(vtkCamera* camera, int width_px, int height_px, float scale) {
  const auto scaled = [scale](int px) {
    return std::max(1, static_cast<int>(static_cast<float>(px) * scale));
  };
  begin(camera, width_px, height_px, scale, {0, 0, scaled(width_px), scaled(height_px)});
}

void CloudIds::begin(vtkCamera* camera, int width_px, int height_px, float scale, const Part& part) {
  scale_ = scale;
  width_ = part.width;
  height_ = part.height;
  picture_px_ = (scale * Eigen::Vector2i(width_px, height_px).cast<float>()).array().floor().max(1);
  corner_px_ = Eigen::Vector2i(part.x, part.y).cast<float>();
  view_ = SplatView(camera, height_px);
  nearest_m_ = static_cast<float>(camera->GetClippingRange()[0]);
  const double aspect = static_cast<double>(width_px) / std::max(1, height_px);
  const vtkMatrix4x4* matrix = camera->GetCompositeProjectionTransformMatrix(aspect, -1, 1);
  Eigen::Matrix4d clip_world;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) clip_world(row, column) = matrix->GetElement(row, column);
  }
  clip_world_ = clip_world.cast<float>();
  world_clip_ = clip_world.inverse().cast<float>();
  const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  fragments_.assign(pixels, FragmentId{});
  distances_.assign(pixels, std::numeric_limits<float>::max());
}

void CloudIds::setDisc(float diameter_m, float least_px) {
  diameter_m_ = diameter_m;
  least_px_ = least_px;
}

Eigen::Vector2f CloudIds::pixelOf(const Eigen::Vector4f& clip) const {
  const Eigen::Vector2f fraction(0.5F + 0.5F * clip.x() / clip.w(), 0.5F - 0.5F * clip.y() / clip.w());
  return fraction.cwiseProduct(picture_px_) - corner_px_;
}

bool CloudIds::maySee(const Eigen::AlignedBox3f& box) const {
  if (box.isEmpty()) return false;
  const float radius_m = 0.5F * box.diagonal().norm();
  const Eigen::Vector4f clip = clip_world_ * box.center().homogeneous();
  const float nearest_m = clip.w() - radius_m;
  if (clip.w() + radius_m < nearest_m_) return false;
  if (nearest_m < kNear_m) return true;
  const float around_px =
      scale_ * (view_.pixels_per_meter_at_1m * radius_m / nearest_m + kLargestPoint_px / 2);
  const Eigen::Vector2f middle = pixelOf(clip);
  return middle.x() > -around_px && middle.x() < static_cast<float>(width_) + around_px &&
         middle.y() > -around_px && middle.y() < static_cast<float>(height_) + around_px;
}

void CloudIds::add(const Eigen::Vector3f& point_world, const Eigen::Vector3f& normal, FragmentId fragment) {
  const Eigen::Vector4f clip = clip_world_ * point_world.homogeneous();
  const float distance = clip.w();
  if (distance < nearest_m_) return;
  const Eigen::Vector2f pixel_position = pixelOf(clip);
  const float x = pixel_position.x(), y = pixel_position.y();
  const float drawn_px =
      std::clamp(view_.pixels_per_meter_at_1m * diameter_m_ / distance, least_px_, kLargestPoint_px);
  const float half = 0.5F * scale_ * drawn_px;
  if (!(x > -half && x < static_cast<float>(width_) + half && y > -half &&
        y < static_cast<float>(height_) + half))
    return;
  // The disc's plane, as in the vertex shader.
  const Eigen::Vector3f to_eye = view_.eye - point_world;
  float facing = normal.dot(to_eye) / std::max(1e-6F, view_.back.dot(to_eye));
  facing = facing < 0 ? std::min(facing, -kMinFacing) : std::max(facing, kMinFacing);
  const float right = -normal.dot(view_.right) / facing, down = normal.dot(view_.up) / facing;
  const float end = drawn_px < kSmall_px ? 8.0F : 1.0F;
  const float radius_m = 0.5F * drawn_px * distance / view_.pixels_per_meter_at_1m;
  // Pixels whose centres the disc may cover, and the pixel of its centre.
  const int own_x = static_cast<int>(x), own_y = static_cast<int>(y);
  const int first_x = std::max(0, static_cast<int>(std::ceil(x - half - 0.5F)));
  const int last_x = std::min(width_ - 1, std::max(own_x, static_cast<int>(std::floor(x + half - 0.5F))));
  const int first_y = std::max(0, static_cast<int>(std::ceil(y - half - 0.5F)));
  const int last_y = std::min(height_ - 1, std::max(own_y, static_cast<int>(std::floor(y + half - 0.5F))));
  for (int v = first_y; v <= last_y; ++v) {
    for (int u = first_x; u <= last_x; ++u) {
      const float dx = (static_cast<float>(u) + 0.5F - x) / half;
      const float dy = (static_cast<float>(v) + 0.5F - y) / half;
      const float nearer = right * dx + down * dy;
      const float square = dx * dx + dy * dy + nearer * nearer;
      const bool is_own = u == own_x && v == own_y;
      if (square > end && !is_own) continue;
      const float at = is_own && square > end ? distance : distance - radius_m * (nearer - 0.4F * square);
      const std::size_t pixel = indexOf(u, v);
      if (at >= distances_[pixel]) continue;
      distances_[pixel] = at;
      fragments_[pixel] = fragment;
    }
  }
}

std::optional<Eigen::Vector3f> CloudIds::pointAt(int x, int y) const {
  const std::size_t pixel = indexOf(x, y);
  if (!fragments_[pixel]) return std::nullopt;
  const float w = distances_[pixel];
  // Interpolates along the line of sight between two points of known distance.
  const Eigen::Vector2f in_picture = corner_px_ + Eigen::Vector2i(x, y).cast<float>();
  const Eigen::Vector2f fraction = (in_picture.array() + 0.5F).matrix().cwiseQuotient(picture_px_);
  const Eigen::Vector2f ndc(fraction.x() * 2 - 1, 1 - fraction.y() * 2);
  const auto onRay = [&](float depth) {
    const Eigen::Vector4f world = world_clip_ * Eigen::Vector4f(ndc.x(), ndc.y(), depth, 1);
    return Eigen::Vector3f(world.head<3>() / world.w());
  };
  const Eigen::Vector3f front = onRay(-1), back = onRay(0.9F);
  const float w_front = (clip_world_ * front.homogeneous()).w();
  const float w_back = (clip_world_ * back.homogeneous()).w();
  return front + (w - w_front) / (w_back - w_front) * (back - front);
}

}  // namespace scantrove
