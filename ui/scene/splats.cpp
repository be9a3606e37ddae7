#include "ui/scene/splats.h"

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>
#include <vtk_glew.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace scantrove {
namespace {

// splat.xy: slope of the disc's plane towards the viewer, to the right and down. splat.z: window depth of a
// radius. splat.w: squared radius of the disc, in radii.
constexpr const char* kVertexOutputs =
    "//VTK::Normal::Dec\n"
    "in vec3 normalMC;\n"
    "flat out vec4 splat;\n";
constexpr const char* kVertexCode =
    "//VTK::PositionVC::Impl\n"
    "  float splat_px = clamp(splat_px_at_1m / gl_Position.w, splat_least_px, 64.0);\n"
    "  gl_PointSize = splat_px;\n"
    "  vec3 to_eye = splat_eye - vertexMC.xyz;\n"
    "  float facing = dot(normalMC, to_eye) / max(1e-6, dot(splat_back, to_eye));\n"
    // Limits the slope, or surfaces seen at a grazing angle would have gaps.
    "  facing = facing < 0.0 ? min(facing, -0.3) : max(facing, 0.3);\n"
    "  float radius_m = 0.5 * splat_px * gl_Position.w * splat_metre_per_px;\n"
    "  splat = vec4(-dot(normalMC, splat_right) / facing, dot(normalMC, splat_up) / facing,\n"
    "               -splat_depth_factor * radius_m / (gl_Position.w * gl_Position.w),\n"
    // Small discs need their corners to close gaps.
    "               splat_px < 3.5 ? 8.0 : 1.0);\n";
constexpr const char* kFragmentInputs =
    "//VTK::Normal::Dec\n"
    "flat in vec4 splat;\n";
constexpr const char* kFragmentCode =
    "  vec2 from_middle = 2.0 * gl_PointCoord - 1.0;\n"
    "  float nearer = dot(splat.xy, from_middle);\n"
    "  float square = dot(from_middle, from_middle) + nearer * nearer;\n"
    "  if (square > splat.w) discard;\n";
constexpr const char* kExactDepth = "  gl_FragDepth = gl_FragCoord.z + splat.z * (nearer - 0.4 * square);\n";

void enableProgramPointSize(vtkObject* /*caller*/, unsigned long /*event*/, void* /*client*/,
                            void* /*data*/) {
  glEnable(GL_PROGRAM_POINT_SIZE);
}

Eigen::Vector3f floats(const double* v) { return Eigen::Vector3d(v[0], v[1], v[2]).cast<float>(); }

}  // namespace

SplatView::SplatView(vtkCamera* camera, int height_px)
    : eye(floats(camera->GetPosition())), back(-floats(camera->GetDirectionOfProjection())) {
  right = floats(camera->GetViewUp()).cross(back).normalized();
  up = back.cross(right);
  const double half_angle = camera->GetViewAngle() * 3.14159265358979 / 360;
  pixels_per_meter_at_1m = static_cast<float>(height_px / 2.0 / std::tan(half_angle));
  const double* range = camera->GetClippingRange();
  depth_factor = static_cast<float>(range[0] * range[1] / (range[1] - range[0]));
}

void enableSplats(vtkRenderer* renderer) {
  const auto command = vtkSmartPointer<vtkCallbackCommand>::New();
  command->SetCallback(enableProgramPointSize);
  renderer->AddObserver(vtkCommand::StartEvent, command);
}

void drawAsSplats(vtkActor* actor, SplatOverlap overlap) {
  vtkShaderProperty* shader = actor->GetShaderProperty();
  shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true, kVertexOutputs, false);
  shader->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true, kVertexCode, false);
  shader->AddFragmentShaderReplacement("//VTK::Normal::Dec", true, kFragmentInputs, false);
  // These replace earlier replacements. Shaders that write depth are slow.
  const std::string exact = overlap == SplatOverlap::exact ? kExactDepth : "";
  shader->AddFragmentShaderReplacement("//VTK::Depth::Impl", true, kFragmentCode + exact, false);
}

void setSplats(vtkActor* actor, const SplatView& view, float diameter_m, float least_px) {
  vtkUniforms* uniforms = actor->GetShaderProperty()->GetVertexCustomUniforms();
  uniforms->SetUniformf("splat_px_at_1m", view.pixels_per_meter_at_1m * diameter_m);
  uniforms->SetUniformf("splat_least_px", least_px);
  uniforms->SetUniformf("splat_metre_per_px", 1 / view.pixels_per_meter_at_1m);
  uniforms->SetUniformf("splat_depth_factor", view.depth_factor);
  uniforms->SetUniform3f("splat_eye", view.eye.data());
  uniforms->SetUniform3f("splat_right", view.right.data());
  uniforms->SetUniform3f("splat_up", view.up.data());
  uniforms->SetUniform3f("splat_back", view.back.data());
}

}  // namespace scantrove
