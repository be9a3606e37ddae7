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

/// Which fragment a view of the label cloud shows in each pixel, and how far it is: what is drawn, drawn once
/// more on the CPU, so that pointing needs no drawing and knows what hides what. May be coarser than the
/// drawing. One thread.
class CloudIds {
 public:
  /// A part of the picture, in pixels of it at its scale.
  struct Part {
    int x = 0, y = 0, width = 0, height = 0;
  };

  CloudIds();

  /// Nothing is shown yet. `scale`: pixels of this a pixel of the drawing, which is `width_px` x `height_px`.
  void begin(vtkCamera* camera, int width_px, int height_px, float scale);
  /// As above, of a part alone: pixel (0, 0) is the part's first.
  void begin(vtkCamera* camera, int width_px, int height_px, float scale, const Part& part);

  /// Of the points that follow: the diameter of their discs, which have so many pixels at least.
  void setDisc(float diameter_m, float least_px);
  /// False only where no point of the box would show.
  [[nodiscard]] bool maySee(const Eigen::AlignedBox3f& box) const;
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

  /// Where a point of the world lies in the part, pixels; `clip`: its place in clip coordinates.
  [[nodiscard]] Eigen::Vector2f pixelOf(const Eigen::Vector4f& clip) const;

  int width_ = 0, height_ = 0;
  Eigen::Vector2f whole_px_ = Eigen::Vector2f::Ones();   // the picture's width and height
  Eigen::Vector2f corner_px_ = Eigen::Vector2f::Zero();  // where the part begins
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
