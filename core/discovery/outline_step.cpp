#include "core/discovery/outline_step.h"

#include <algorithm>

#include "core/discovery/region_points.h"
#include "core/geometry/surface_step.h"

namespace scantrove {
namespace {

constexpr float kMinStep_m = 0.005F;      // up to 1.2 m; beyond, it grows with the sensor's noise
constexpr float kStepGrowsFrom_m = 1.2F;  // beyond, noise exceeds a voxel

}  // namespace

void OutlineSteps::operator+=(const OutlineSteps& other) {
  open += other.open;
  folded += other.folded;
  smooth += other.smooth;
  ridged += other.ridged;
  hidden += other.hidden;
  cut += other.cut;
  unseen += other.unseen;
}

float OutlineSteps::own() const {
  const int shown = known() - hidden - cut;
  return shown == 0 ? 0 : static_cast<float>(open + folded) / static_cast<float>(shown);
}

float OutlineSteps::hiddenPart() const {
  return known() == 0 ? 0 : static_cast<float>(hidden) / static_cast<float>(known());
}

OutlineEnd OutlineStepJudge::judge(int u, int v, int du, int dv) const {
  const RegionId region = regionAt(u, v);
  if (!isInside(u + kBeyondEdge_px * du, v + kBeyondEdge_px * dv)) return &OutlineSteps::cut;
  const Eigen::Vector4f& here = vertexAt(u, v);
  const Eigen::Vector4f& there = vertexAt(u + kBeyondEdge_px * du, v + kBeyondEdge_px * dv);
  if (!isSurface(here) || !isSurface(there)) return &OutlineSteps::unseen;
  if (regionAt(u + kBeyondEdge_px * du, v + kBeyondEdge_px * dv) == region)
    return &OutlineSteps::unseen;  // a slit
  const float z = depth_(here);
  switch (depthStep(z, depth_(there))) {
    case DepthStep::nearer:
      return &OutlineSteps::hidden;
    case DepthStep::deeper:
      return &OutlineSteps::open;
    case DepthStep::level:
      break;
  }
  return judgeContact(u, v, du, dv, z);
}

OutlineEnd OutlineStepJudge::judgeContact(int u, int v, int du, int dv, float z) const {
  const RegionId inner = regionAt(u, v), outer = regionAt(u + kBeyondEdge_px * du, v + kBeyondEdge_px * dv);
  // As far off the border as both surfaces continue.
  int back = kBendReach_px, on = kBendReach_px + 1;
  while (back > 0 &&
         (!isInside(u - back * du, v - back * dv) || regionAt(u - back * du, v - back * dv) != inner ||
          !isSurface(vertexAt(u - back * du, v - back * dv))))
    --back;
  while (on > kBeyondEdge_px &&
         (!isInside(u + on * du, v + on * dv) || regionAt(u + on * du, v + on * dv) != outer ||
          !isSurface(vertexAt(u + on * du, v + on * dv))))
    --on;
  const std::size_t a = at(u - back * du, v - back * dv), b = at(u + on * du, v + on * dv);
  const Eigen::Vector4f& n_a = input_.view.normals_world[a];
  const Eigen::Vector4f& n_b = input_.view.normals_world[b];
  if (!isSurface(n_a) || !isSurface(n_b)) return &OutlineSteps::unseen;
  const Eigen::Vector3f across = (input_.view.vertices_world[b] - input_.view.vertices_world[a]).head<3>();
  const float bend_rad = bendBetween(n_a, n_b, across);
  if (bend_rad < -kClearBend_rad) return &OutlineSteps::ridged;
  if (bend_rad > kClearBend_rad) return &OutlineSteps::folded;
  // Two surfaces with the same orientation: on one level, or one above the other.
  const float grown = std::max(1.0F, z / kStepGrowsFrom_m);
  const float rise_m = across.dot((n_a + n_b).head<3>()) / 2;
  if (rise_m < -kMinStep_m * grown * grown) return &OutlineSteps::open;
  if (rise_m > kMinStep_m * grown * grown) return &OutlineSteps::hidden;
  return &OutlineSteps::smooth;
}

}  // namespace scantrove
