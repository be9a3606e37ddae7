#pragma once
#include <Eigen/Core>

class vtkActor;
class vtkCamera;
class vtkRenderer;

namespace scantrove {

/// View parameters of the splat shader.
struct SplatView {
  SplatView() = default;
  SplatView(vtkCamera* camera, int height_px);

  Eigen::Vector3f eye = Eigen::Vector3f::Zero(), right = Eigen::Vector3f::UnitX(),
                  up = Eigen::Vector3f::UnitY(), back = Eigen::Vector3f::UnitZ();
  float pixels_per_meter_at_1m = 1;
  float depth_factor = 0;  ///< window depth of what is `w` in front of the eye: constant - depth_factor / w
};

/// How overlapping discs are drawn. `quick`: the disc with the nearer centre covers the other. `exact`: each
/// covers the pixels nearest to its centre, which gives a smooth surface but takes up to twice the time
/// without a graphics card.
enum class SplatOverlap { quick, exact };

/// Lets shaders set the size of points in a renderer's pictures, without which discs are single pixels.
void enableSplats(vtkRenderer* renderer);

/// Makes an actor draw its points as discs in the surface plane of their normals, or facing the viewer
/// without a normal. Changing `overlap` compiles a shader.
void drawAsSplats(vtkActor* actor, SplatOverlap overlap);

/// Sets the diameter of discs in metres and their minimum size in pixels.
void setSplats(vtkActor* actor, const SplatView& view, float diameter_m, float least_px);

}  // namespace scantrove
