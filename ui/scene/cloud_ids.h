#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "ui/scene/splats.h"

class vtkCamera;

namespace scantrove {

/// Which fragment a view of the label cloud shows in each pixel, and how far it is: what is drawn, drawn once
/// more on the CPU, so that pointing needs no drawing and knows what hides what. May be coarser than the
/// drawing. One thread.
class CloudIds {
 public:
  CloudIds();

  /// Nothing is shown yet. `scale`: pixels of this a pixel of the drawing, which is `width_px` x `height_px`.
  void begin(vtkCamera* camera, int width_px, int height_px, float scale);

  /// Of the points that follow: the diameter of their discs, which have so many pixels at least.
  void setDisc(float diameter_m, float least_px);
  /// A point as the shaders of splats.cpp draw it. `normal`: unit, or zero where it is not known.
  void add(const Eigen::Vector3f& point_world, const Eigen::Vector3f& normal, FragmentId fragment);

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
  SplatView view_;
  float nearest_m_ = 0;  // what is nearer is cut away
  float diameter_m_ = 0, least_px_ = 1;
  Eigen::Matrix4f clip_world_ = Eigen::Matrix4f::Identity();
  Eigen::Matrix4f world_clip_ = Eigen::Matrix4f::Identity();
  std::vector<FragmentId> fragments_;
  std::vector<float> distances_;  // along the view, metres
};

}  // namespace scantrove
