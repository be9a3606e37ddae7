#include "ui/scene/ground_grid.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {
constexpr float kStep_m = 0.5F;
constexpr int kMaxSteps = 20;
}  // namespace

GroundGrid::GroundGrid(vtkRenderer* renderer)
    : data_(vtkSmartPointer<vtkPolyData>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(data_);
  actor_->SetMapper(mapper);
  actor_->GetProperty()->LightingOff();
  actor_->GetProperty()->SetLineWidth(1);
  actor_->PickableOff();
  renderer->AddActor(actor_);
  place({0, 1, 1.5F}, -Eigen::Vector3f::UnitY(), 2);
}

void GroundGrid::place(const Eigen::Vector3f& center, const Eigen::Vector3f& up, float radius_m) {
  const int steps = std::clamp(static_cast<int>(std::ceil(radius_m / kStep_m)), 2, kMaxSteps);
  const Eigen::Vector3f side = up.cross(Eigen::Vector3f::UnitZ()).norm() > 0.1F
                                   ? Eigen::Vector3f(up.cross(Eigen::Vector3f::UnitZ()).normalized())
                                   : up.unitOrthogonal();
  const Eigen::Vector3f ahead = side.cross(up);
  const float reach = static_cast<float>(steps) * kStep_m;
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto lines = vtkSmartPointer<vtkCellArray>::New();
  const auto line = [&](const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    const vtkIdType a = points->InsertNextPoint(from.cast<double>().eval().data());
    const vtkIdType b = points->InsertNextPoint(to.cast<double>().eval().data());
    lines->InsertNextCell({a, b});
  };
  for (int i = -steps; i <= steps; ++i) {
    const float offset = static_cast<float>(i) * kStep_m;
    line(center + offset * side - reach * ahead, center + offset * side + reach * ahead);
    line(center + offset * ahead - reach * side, center + offset * ahead + reach * side);
  }
  data_->SetPoints(points);
  data_->SetLines(lines);
}

void GroundGrid::setColor(const Rgb& color) {
  actor_->GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

void GroundGrid::setVisible(bool visible) { actor_->SetVisibility(visible); }

}  // namespace scantrove
