#include "ui/scene/sensor_track.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <array>

#include "ui/common/tracking_color.h"

namespace scantrove {
namespace {

constexpr float kFrustumDepth_m = 0.22F;

void setColor(vtkActor* actor, const Rgb& color) {
  actor->GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

vtkSmartPointer<vtkPoints> makePoints(const std::vector<Eigen::Vector3f>& positions) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3f& p = positions[i];
    points->SetPoint(static_cast<vtkIdType>(i), static_cast<double>(p.x()), static_cast<double>(p.y()),
                     static_cast<double>(p.z()));
  }
  return points;
}

}  // namespace

SensorTrack::SensorTrack(vtkRenderer* renderer)
    : edges_(addPart(renderer, 2)), faces_(addPart(renderer, 1)), path_(addPart(renderer, 2)) {
  faces_.actor->GetProperty()->SetOpacity(0.22);
  setTrailColor({236, 238, 241});
}

SensorTrack::Part SensorTrack::addPart(vtkRenderer* renderer, float line_width) {
  Part part{vtkSmartPointer<vtkPolyData>::New(), vtkSmartPointer<vtkActor>::New()};
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(part.data);
  part.actor->SetMapper(mapper);
  part.actor->GetProperty()->LightingOff();
  part.actor->GetProperty()->SetLineWidth(line_width);
  part.actor->PickableOff();
  part.actor->VisibilityOff();
  renderer->AddActor(part.actor);
  return part;
}

void SensorTrack::clear() {
  for (const Part* part : {&edges_, &faces_, &path_}) part->actor->VisibilityOff();
  trail_.reset();
  bounds_.setEmpty();
}

void SensorTrack::setTrailColor(const Rgb& color) { setColor(path_.actor, color); }

void SensorTrack::setPose(const PoseEstimate& pose, const Intrinsics& K) {
  if (K.width <= 0 || !(K.fx > 0)) return;
  const Eigen::Isometry3f T_world_camera = pose.T_world_camera.cast<float>();
  const auto right = static_cast<float>(K.width);
  const auto bottom = static_cast<float>(K.height);
  std::vector<Eigen::Vector3f> corners{T_world_camera.translation()};
  for (const auto& [u, v] :
       std::array<std::array<float, 2>, 4>{{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}}}) {
    corners.push_back(T_world_camera * K.backProject(u, v, kFrustumDepth_m));
  }
  // A small triangle above the image's upper edge marks up.
  corners.push_back(T_world_camera * K.backProject(right * 0.5F, -0.22F * bottom, kFrustumDepth_m));
  bounds_.extend(corners[0]);

  const auto points = makePoints(corners);
  const auto lines = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& [a, b] : std::array<std::array<vtkIdType, 2>, 10>{
           {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {5, 2}}}) {
    lines->InsertNextCell({a, b});
  }
  const auto triangles = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& [a, b, c] :
       std::array<std::array<vtkIdType, 3>, 4>{{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}}) {
    triangles->InsertNextCell({a, b, c});
  }
  edges_.data->SetPoints(points);
  edges_.data->SetLines(lines);
  faces_.data->SetPoints(points);
  faces_.data->SetPolys(triangles);
  for (const Part* part : {&edges_, &faces_}) {
    setColor(part->actor, trackingColor(pose.state));
    part->actor->VisibilityOn();
  }
}

void SensorTrack::setTrail(const Trail& trail) {
  if (trail == trail_ || trail == nullptr || trail->size() < 2) return;
  trail_ = trail;
  const auto line = vtkSmartPointer<vtkCellArray>::New();
  line->InsertNextCell(static_cast<int>(trail->size()));
  for (std::size_t i = 0; i < trail->size(); ++i) {
    line->InsertCellPoint(static_cast<vtkIdType>(i));
    bounds_.extend((*trail)[i]);
  }
  path_.data->SetPoints(makePoints(*trail));
  path_.data->SetLines(line);
  path_.actor->VisibilityOn();
}

}  // namespace scantrove
