#pragma once
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/exchange/region_palette.h"

class vtkRenderer;

namespace scantrove {

/// A grid of half-metre squares beneath the scene, for a sense of scale and of what is level.
class GroundGrid {
 public:
  explicit GroundGrid(vtkRenderer* renderer);

  /// Lays the grid through `centre` (world, metres), across `up`, at least `radius_m` around.
  void place(const Eigen::Vector3f& center, const Eigen::Vector3f& up, float radius_m);
  void setColor(const Rgb& color);
  void setVisible(bool visible);

 private:
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace scantrove
