#pragma once
#include <Eigen/Core>

class vtkActor;
class vtkCamera;

namespace scantrove {

/// From where splats are seen, as their shader wants it.
struct SplatView {
  SplatView() = default;
  SplatView(vtkCamera* camera, int height_px);

  Eigen::Vector3f eye = Eigen::Vector3f::Zero(), right = Eigen::Vector3f::UnitX(),
                  up = Eigen::Vector3f::UnitY(), back = Eigen::Vector3f::UnitZ();
  float pixels_per_meter_at_1m = 1;
  float depth_factor = 0;  ///< window depth of what is `w` in front of the eye: constant - depth_factor / w
};

/// How discs that overlap share what they cover. `quick`: the one whose centre is nearer to the viewer shows
/// whole. `exact`: each shows where its centre is the nearest, so that colours meet halfway and the surface
/// is smooth; takes up to twice the time without a graphics card.
enum class SplatOverlap { quick, exact };

/// Makes an actor draw its points (which have normals) as discs that lie in the surface: round from the
/// front, narrow from aside. Without normal: a disc towards the viewer. Costs something when it is another
/// than before.
void drawAsSplats(vtkActor* actor, SplatOverlap overlap);

/// Edge of a disc in metres, and the pixels that it has at least.
void setSplats(vtkActor* actor, const SplatView& view, float diameter_m, float least_px);

}  // namespace scantrove
