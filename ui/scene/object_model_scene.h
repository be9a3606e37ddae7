#pragma once
#include <vtkActor.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <span>

#include "core/catalogue/view_cloud.h"
#include "core/exchange/region_palette.h"
#include "ui/scene/orbit_camera.h"

namespace scantrove {

/// One object as coloured points in one renderer, with a viewpoint that orbits it. Does not use Qt. One
/// thread, that of the OpenGL context.
class ObjectModelScene {
 public:
  ObjectModelScene();

  [[nodiscard]] vtkRenderer* renderer() { return renderer_; }
  /// `spacing_m`: about the distance of neighbouring points; `up`: unit, in their world.
  void setPoints(std::span<const ViewPoint> points, float spacing_m, const Eigen::Vector3f& up);
  void clear() { setPoints({}, 1, -Eigen::Vector3f::UnitY()); }
  void setBackground(const Rgb& top, const Rgb& bottom);
  [[nodiscard]] std::size_t pointCount() const { return point_count_; }
  [[nodiscard]] OrbitCamera& viewpoint() { return viewpoint_; }
  /// Shows all of it from the current direction.
  void fit(float aspect);
  /// Call right before rendering into a viewport of this size.
  void prepare(int width_px, int height_px);

 private:
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkOpenGLPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
  OrbitCamera viewpoint_;
  Eigen::AlignedBox3f box_;
  std::size_t point_count_ = 0;
  float spacing_m_ = 1;
};

}  // namespace scantrove
