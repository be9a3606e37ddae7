#include "ui/scene/cloud_ids.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace scantrove {
namespace {

constexpr float kNearest_m = 0.02F;
constexpr float kLargestPoint_px = 40;  // as in the shader

}  // namespace

void CloudIds::begin(vtkCamera* camera, int width_px, int height_px, float scale) {
  scale_ = scale;
  width_ = std::max(1, static_cast<int>(static_cast<float>(width_px) * scale));
  height_ = std::max(1, static_cast<int>(static_cast<float>(height_px) * scale));
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

void CloudIds::add(const Eigen::Vector3f& point_world, FragmentId fragment, float scale_px,
                   float minimum_px) {
  const Eigen::Vector4f clip = clip_world_ * point_world.homogeneous();
  const float distance = clip.w();
  if (distance < kNearest_m) return;
  const float x = (0.5F + 0.5F * clip.x() / distance) * static_cast<float>(width_);
  const float y = (0.5F - 0.5F * clip.y() / distance) * static_cast<float>(height_);
  const float half = 0.5F * scale_ * std::clamp(scale_px / distance, minimum_px, kLargestPoint_px);
  if (!(x > -half && x < static_cast<float>(width_) + half && y > -half &&
        y < static_cast<float>(height_) + half))
    return;
  // Pixels whose centres it covers, and the one that it lies in.
  const int left = std::max(0, static_cast<int>(x - half + 0.5F));
  const int right = std::min(width_ - 1, std::max(static_cast<int>(x), static_cast<int>(x + half - 0.5F)));
  const int top = std::max(0, static_cast<int>(y - half + 0.5F));
  const int bottom = std::min(height_ - 1, std::max(static_cast<int>(y), static_cast<int>(y + half - 0.5F)));
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      const std::size_t pixel = place(u, v);
      if (distance >= distances_[pixel]) continue;
      distances_[pixel] = distance;
      fragments_[pixel] = fragment;
    }
  }
}

std::optional<Eigen::Vector3f> CloudIds::pointAt(int x, int y) const {
  const std::size_t pixel = place(x, y);
  if (!fragments_[pixel]) return std::nullopt;
  const float w = distances_[pixel];
  // The depth that belongs to this distance: row 2 of a perspective's matrix depends on the distance alone,
  // and two points of the line of sight tell how.
  const Eigen::Vector2f ndc((static_cast<float>(x) + 0.5F) / static_cast<float>(width_) * 2 - 1,
                            1 - (static_cast<float>(y) + 0.5F) / static_cast<float>(height_) * 2);
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
