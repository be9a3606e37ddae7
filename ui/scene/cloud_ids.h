#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/ids.h"

class vtkCamera;

namespace scantrove {

/// Which fragment a view of the label cloud shows in each pixel, and how far it is: what is drawn, drawn once
/// more on the CPU, so that pointing needs no drawing and knows what hides what. May be coarser than the
/// drawing. One thread.
class CloudIds {
 public:
  /// Nothing is shown yet. `scale`: pixels of this a pixel of the drawing, which is `width_px` x `height_px`.
  void begin(vtkCamera* camera, int width_px, int height_px, float scale);

  /// A point as the vertex shader of CloudChunk draws it: a square as wide as `scale_px` over its distance in
  /// metres, `minimum_px` at least; in pixels of the drawing.
  void add(const Eigen::Vector3f& point_world, FragmentId fragment, float scale_px, float minimum_px);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Row by row, from the top; none: nothing is there.
  [[nodiscard]] const std::vector<FragmentId>& fragments() const { return fragments_; }
  [[nodiscard]] FragmentId fragmentAt(int x, int y) const { return fragments_[place(x, y)]; }
  /// The surface there; none: there is none.
  [[nodiscard]] std::optional<Eigen::Vector3f> pointAt(int x, int y) const;

 private:
  [[nodiscard]] std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_ = 0, height_ = 0;
  float scale_ = 1;
  Eigen::Matrix4f clip_world_ = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f world_clip_ = Eigen::Matrix4f::Identity();
  std::vector<FragmentId> fragments_;
  std::vector<float> distances_;  // along the view, metres
};

}  // namespace scantrove
