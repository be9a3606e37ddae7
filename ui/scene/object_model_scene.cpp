#include "ui/scene/object_model_scene.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdint>

#include "ui/scene/brick_shading.h"
#include "ui/scene/splats.h"

namespace scantrove {
namespace {

constexpr float kDiscWidth = 2.2F;  ///< of the spacing: closes gaps between points of several views
constexpr float kLeastDisc_px = 1.6F;
constexpr float kUnshaded = 0.85F;   ///< light on a point without normal
constexpr float kSmallest_m = 0.1F;  ///< OrbitCamera::fit shows smaller things as if they were so large

std::uint8_t lit(std::uint8_t channel, float light) {
  return static_cast<std::uint8_t>(std::clamp(static_cast<float>(channel) * light, 0.0F, 255.0F));
}

}  // namespace

ObjectModelScene::ObjectModelScene()
    : renderer_(vtkSmartPointer<vtkRenderer>::New()),
      mapper_(vtkSmartPointer<vtkOpenGLPolyDataMapper>::New()),
      actor_(vtkSmartPointer<vtkActor>::New()) {
  mapper_->SetScalarModeToUsePointData();
  mapper_->SetColorModeToDirectScalars();
  // The shader of the discs reads positions as they are.
  mapper_->SetVBOShiftScaleMethod(0);
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->LightingOff();
  actor_->GetProperty()->SetPointSize(3);
  actor_->PickableOff();
  enableSplats(renderer_);
  drawAsSplats(actor_, SplatOverlap::exact);
  // A first picture may be drawn before prepare(); the shader needs all its values then, too.
  setSplats(actor_, SplatView(renderer_->GetActiveCamera(), 1), kSmallest_m, kLeastDisc_px);
  renderer_->AddActor(actor_);
  renderer_->GradientBackgroundOn();
  clear();
}

void ObjectModelScene::setPoints(std::span<const ViewPoint> points, float spacing_m,
                                 const Eigen::Vector3f& up) {
  const auto positions = vtkSmartPointer<vtkPoints>::New();
  const auto normals = vtkSmartPointer<vtkFloatArray>::New();
  const auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  const auto vertices = vtkSmartPointer<vtkCellArray>::New();
  normals->SetNumberOfComponents(3);
  colors->SetNumberOfComponents(3);
  if (!points.empty()) vertices->InsertNextCell(static_cast<int>(points.size()));  // one cell holds all
  box_.setEmpty();
  for (const ViewPoint& point : points) {
    vertices->InsertCellPoint(
        positions->InsertNextPoint(point.position.x(), point.position.y(), point.position.z()));
    normals->InsertNextTuple3(point.normal.x(), point.normal.y(), point.normal.z());
    const float light = point.normal.isZero() ? kUnshaded : lightOn(point.normal);
    colors->InsertNextTuple3(lit(point.rgb[0], light), lit(point.rgb[1], light), lit(point.rgb[2], light));
    box_.extend(point.position);
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(positions);
  data->SetVerts(vertices);
  data->GetPointData()->SetNormals(normals);
  data->GetPointData()->SetScalars(colors);
  mapper_->SetInputData(data);
  actor_->SetVisibility(!points.empty());
  point_count_ = points.size();
  spacing_m_ = spacing_m;
  viewpoint_.setUp(up);
}

void ObjectModelScene::setBackground(const Rgb& top, const Rgb& bottom) {
  renderer_->SetBackground2(top[0] / 255.0, top[1] / 255.0, top[2] / 255.0);
  renderer_->SetBackground(bottom[0] / 255.0, bottom[1] / 255.0, bottom[2] / 255.0);
}

void ObjectModelScene::fit(float aspect) {
  if (box_.isEmpty()) return;
  viewpoint_.fit(box_, aspect);
  const float radius_m = 0.5F * box_.diagonal().norm();
  if (radius_m < kSmallest_m) viewpoint_.zoom(std::max(radius_m, spacing_m_) / kSmallest_m);
}

void ObjectModelScene::prepare(int width_px, int height_px) {
  viewpoint_.applyTo(renderer_->GetActiveCamera(), box_);
  if (width_px > 0 && height_px > 0)
    setSplats(actor_, SplatView(renderer_->GetActiveCamera(), height_px), kDiscWidth * spacing_m_,
              kLeastDisc_px);
}

}  // namespace scantrove
