#include "ui/scene/move_arrow.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "ui/scene/on_top.h"

namespace scantrove {
namespace {

constexpr int kSteps = 32;         // of the arc
constexpr int kHeadSides = 16;     // of the cone
constexpr float kHeadPart = 0.1F;  // length of the head, as a fraction of the distance to the centre

/// Points of the arc from `from` to `to`; see MoveArrow::show.
std::vector<Eigen::Vector3f> arc(const Eigen::Vector3f& center, const Eigen::Vector3f& up,
                                 const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  const auto level = [&](const Eigen::Vector3f& v) -> Eigen::Vector3f { return v - v.dot(up) * up; };
  const Eigen::Vector3f ahead = level(from).normalized();
  const float turn = std::atan2(up.dot(ahead.cross(level(to))), ahead.dot(level(to)));
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i <= kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    const float around = std::lerp(level(from).norm(), level(to).norm(), t);
    const float height = std::lerp(from.dot(up), to.dot(up), t);
    points.emplace_back(center + around * (Eigen::AngleAxisf(t * turn, up) * ahead) + height * up);
  }
  return points;
}

vtkIdType add(vtkPoints* points, const Eigen::Vector3f& point) {
  return points->InsertNextPoint(point.cast<double>().eval().data());
}

}  // namespace

MoveArrow::MoveArrow(vtkRenderer* renderer)
    : shaft_data_(vtkSmartPointer<vtkPolyData>::New()),
      head_data_(vtkSmartPointer<vtkPolyData>::New()),
      shaft_(addOnTop(renderer, shaft_data_)),
      head_(addOnTop(renderer, head_data_)) {
  shaft_->GetProperty()->SetLineWidth(4);
  setColor({255, 176, 32});
}

void MoveArrow::show(const Eigen::Vector3f& center, const Eigen::Vector3f& up, const Eigen::Vector3f& from,
                     const Eigen::Vector3f& to) {
  const std::vector<Eigen::Vector3f> path = arc(center, up, from, to);
  const auto shaft_points = vtkSmartPointer<vtkPoints>::New();
  const auto shaft = vtkSmartPointer<vtkCellArray>::New();
  shaft->InsertNextCell(static_cast<int>(path.size()));
  bounds_.setEmpty();
  for (const Eigen::Vector3f& point : path) {
    shaft->InsertCellPoint(add(shaft_points, point));
    bounds_.extend(point);
  }
  const Eigen::Vector3f ahead = (path.back() - path[path.size() - 2]).normalized();
  const float length = kHeadPart * to.norm();
  const auto head_points = vtkSmartPointer<vtkPoints>::New();
  const auto head = vtkSmartPointer<vtkCellArray>::New();
  const vtkIdType tip = add(head_points, path.back() + length * ahead);
  const Eigen::Vector3f side = ahead.unitOrthogonal();
  for (int i = 0; i < kHeadSides; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kHeadSides;
    add(head_points, path.back() + 0.4F * length * (Eigen::AngleAxisf(angle, ahead) * side));
    head->InsertNextCell({tip, tip + 1 + i, tip + 1 + (i + 1) % kHeadSides});
  }
  bounds_.extend(Eigen::Vector3f(path.back() + length * ahead));
  shaft_data_->SetPoints(shaft_points);
  shaft_data_->SetLines(shaft);
  head_data_->SetPoints(head_points);
  head_data_->SetPolys(head);
  shaft_->VisibilityOn();
  head_->VisibilityOn();
}

void MoveArrow::hide() {
  shaft_->VisibilityOff();
  head_->VisibilityOff();
  bounds_.setEmpty();
}

void MoveArrow::setColor(const Rgb& color) {
  for (vtkActor* actor : {shaft_.Get(), head_.Get()})
    actor->GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

}  // namespace scantrove
