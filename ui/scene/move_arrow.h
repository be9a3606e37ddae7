#pragma once
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/exchange/region_palette.h"

class vtkRenderer;

namespace scantrove {

/// An arrow around a thing, from where the camera is to where it should look from next, seen through
/// everything.
class MoveArrow {
 public:
  explicit MoveArrow(vtkRenderer* renderer);

  /// Level around `up` from the direction `from` to the direction `to` (both from `centre`, of any length,
  /// neither along `up`), the short way, at a distance that changes from that of `from` to that of `to`.
  void show(const Eigen::Vector3f& center, const Eigen::Vector3f& up, const Eigen::Vector3f& from,
            const Eigen::Vector3f& to);
  void hide();
  void setColor(const Rgb& color);
  /// Empty while it is hidden.
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }

 private:
  vtkSmartPointer<vtkPolyData> shaft_data_, head_data_;
  vtkSmartPointer<vtkActor> shaft_, head_;
  Eigen::AlignedBox3f bounds_;
};

}  // namespace scantrove
