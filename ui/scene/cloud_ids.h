#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "ui/scene/splats.h"

class vtkCamera;

namespace scantrove {

/// Fragment and distance of the visible surface in each pixel of a view. Draws the cloud on the CPU with
/// occlusion, so that pointing needs no OpenGL. May have a lower resolution than the drawing. One thread.
class CloudIds {
 public:
  /// A part of the picture, in pixels at its scale.
  struct Part {
    int x = 0, y = 0, width = 0, height = 0;
  };

  CloudIds();

  /// Starts an empty picture. `scale`: its size relative to the drawing of `width_px` x `height_px`.
  void begin(vtkCamera* camera, int width_px, int height_px, float scale);
  /// As above for a part; pixel (0, 0) is the part's corner.
  void begin(vtkCamera* camera, int width_px, int height_px, float scale, const Part& part);

  /// Sets diameter and minimum size in pixels of the discs of the following points.
  void setDisc(float diameter_m, float least_px);
  /// False only if no point of the box can be visible.
  [[nodiscard]] bool maySee(const Eigen::AlignedBox3f& box) const;
  /// Draws a point like the shaders of splats.cpp. `normal`: unit, or zero if unknown.
  void add(const Eigen::Vector3f& point_world, const Eigen::Vector3f& normal, FragmentId fragment);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// By pixel, row by row from the top; none: no surface.
  [[nodiscard]] const std::vector<FragmentId>& fragments() const { return fragments_; }
  [[nodiscard]] FragmentId fragmentAt(int x, int y) const { return fragments_[indexOf(x, y)]; }
  /// Surface point at a pixel; none: no surface.
  [[nodiscard]] std::optional<Eigen::Vector3f> pointAt(int x, int y) const;

 private:
  [[nodiscard]] std::size_t indexOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  /// Pixel of the part for a point in clip coordinates.
  [[nodiscard]] Eigen::Vector2f pixelOf(const Eigen::Vector4f& clip) const;

  int width_ = 0, height_ = 0;
  Eigen::Vector2f picture_px_ = Eigen::Vector2f::Ones();  // the picture's width and height
  Eigen::Vector2f corner_px_ = Eigen::Vector2f::Zero();   // corner of the part
  float scale_ = 1;
  SplatView view_;
  float nearest_m_ = 0;  // nearer points are clipped
  float diameter_m_ = 0, least_px_ = 1;
  Eigen::Matrix4f clip_world_ = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f world_clip_ = Eigen::Matrix4f::Identity();
  std::vector<FragmentId> fragments_;
  std::vector<float> distances_;  // along the view, metres
};

}  // namespace scantrove
