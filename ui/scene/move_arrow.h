#pragma once
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/exchange/region_palette.h"

class vtkRenderer;

namespace scantrove {

/// An arrow around an object from the camera to its next viewpoint, drawn on top of everything.
class MoveArrow {
 public:
  explicit MoveArrow(vtkRenderer* renderer);

  /// Shows the shorter arc around `up` from `center + from` to `center + to`. Its distance changes evenly
  /// between both lengths. Neither direction may be parallel to `up`.
  void show(const Eigen::Vector3f& center, const Eigen::Vector3f& up, const Eigen::Vector3f& from,
            const Eigen::Vector3f& to);
  void hide();
  void setColor(const Rgb& color);
  /// Empty while hidden.
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }

 private:
  vtkSmartPointer<vtkPolyData> shaft_data_, head_data_;
  vtkSmartPointer<vtkActor> shaft_, head_;
  Eigen::AlignedBox3f bounds_;
};

}  // namespace scantrove
