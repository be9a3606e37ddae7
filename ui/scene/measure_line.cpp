#include "ui/scene/measure_line.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>

#include "ui/scene/on_top.h"

namespace scantrove {
MeasureLine::MeasureLine(vtkRenderer* renderer)
    : line_data_(vtkSmartPointer<vtkPolyData>::New()),
      ends_data_(vtkSmartPointer<vtkPolyData>::New()),
      line_(addOnTop(renderer, line_data_)),
      ends_(addOnTop(renderer, ends_data_)) {
  // Point sizes must be set in the shader (see LabelCloudScene).
  ends_->GetShaderProperty()->AddVertexShaderReplacement(
      "//VTK::PositionVC::Impl", true, "//VTK::PositionVC::Impl\n  gl_PointSize = 9.0;\n", false);
  setColor({255, 214, 64});
}

void MeasureLine::show(const std::vector<Eigen::Vector3f>& points) {
  const auto positions = vtkSmartPointer<vtkPoints>::New();
  const auto line = vtkSmartPointer<vtkCellArray>::New();
  const auto ends = vtkSmartPointer<vtkCellArray>::New();
  for (const Eigen::Vector3f& point : points) {
    const vtkIdType index = positions->InsertNextPoint(point.cast<double>().eval().data());
    ends->InsertNextCell({index});
    if (index > 0) line->InsertNextCell({index - 1, index});
  }
  line_data_->SetPoints(positions);
  line_data_->SetLines(line);
  ends_data_->SetPoints(positions);
  ends_data_->SetVerts(ends);
  line_->SetVisibility(points.size() > 1);
  ends_->SetVisibility(!points.empty());
}

void MeasureLine::setColor(const Rgb& color) {
  for (vtkActor* actor : {line_.Get(), ends_.Get()})
    actor->GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

}  // namespace scantrove
