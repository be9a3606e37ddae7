#pragma once
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <vector>

#include "core/exchange/region_palette.h"

class vtkRenderer;

namespace scantrove {

/// A line between measured surface points, drawn on top of everything.
class MeasureLine {
 public:
  explicit MeasureLine(vtkRenderer* renderer);

  /// Shows a line through these points; empty: nothing.
  void show(const std::vector<Eigen::Vector3f>& points);
  void setColor(const Rgb& color);

 private:
  vtkSmartPointer<vtkPolyData> line_data_, ends_data_;
  vtkSmartPointer<vtkActor> line_, ends_;
};

}  // namespace scantrove
