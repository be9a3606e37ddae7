#pragma once
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/exchange/region_palette.h"

class vtkRenderer;

namespace scantrove {

/// A horizontal grid of half-metre squares below the scene.
class GroundGrid {
 public:
  explicit GroundGrid(vtkRenderer* renderer);

  /// Places the grid through `center` (world, metres), perpendicular to `up`, with a radius of at least
  /// `radius_m`.
  void place(const Eigen::Vector3f& center, const Eigen::Vector3f& up, float radius_m);
  void setColor(const Rgb& color);
  void setVisible(bool visible);

 private:
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace scantrove
