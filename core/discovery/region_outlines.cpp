#include "core/discovery/region_outlines.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/discovery/camera_depth.h"
#include "core/discovery/region_points.h"

namespace scantrove {
namespace {

constexpr int kBeyond_px = 2;     // pixels at an edge may lie between two surfaces: look past the first
constexpr int kBendReach_px = 3;  // normals are compared so far to either side
constexpr float kGrowsFrom_m = 1.5F;
constexpr float kClearBend_rad = 0.35F;  // 20 degrees
constexpr float kLeastStep_m = 0.005F;   // up to 1.2 m; beyond it grows as the sensor's noise does
constexpr float kStepGrowsFrom_m = 1.2F;

/// What a step is counted as.
using End = int OutlineSteps::*;

/// Says how a region ends at one step.
class StepJudge {
 public:
  StepJudge(const DiscoveryInput& input, const DiscoveryParams& params)
      : input_(input), params_(params), depth_(input.T_world_camera) {}

  /// From (u, v) in direction (du, dv), where the next pixel is another region's.
  [[nodiscard]] End judge(int u, int v, int du, int dv) const {
    const RegionId region = regionAt(u, v);
    if (!isInside(u + kBeyond_px * du, v + kBeyond_px * dv)) return &OutlineSteps::cut;
    const Eigen::Vector4f& here = vertexAt(u, v);
    const Eigen::Vector4f& there = vertexAt(u + kBeyond_px * du, v + kBeyond_px * dv);
    if (!isSurface(here) || !isSurface(there)) return &OutlineSteps::unseen;
    if (regionAt(u + kBeyond_px * du, v + kBeyond_px * dv) == region) return &OutlineSteps::unseen;  // a slit
    const float z = depth_(here), z_beyond = depth_(there);
    const float hides_from_m = params_.hiding_step_m * std::max(1.0F, z / kGrowsFrom_m);
    if (z_beyond < z - hides_from_m) return &OutlineSteps::hidden;
    if (z_beyond > z + hides_from_m) return &OutlineSteps::open;
    return judgeContact(u, v, du, dv, z);
  }

 private:
  [[nodiscard]] End judgeContact(int u, int v, int du, int dv, float z) const {
    const RegionId inner = regionAt(u, v), outer = regionAt(u + kBeyond_px * du, v + kBeyond_px * dv);
    // As far off the border as both go on.
    int back = kBendReach_px, on = kBendReach_px + 1;
    while (back > 0 &&
           (!isInside(u - back * du, v - back * dv) || regionAt(u - back * du, v - back * dv) != inner ||
            !isSurface(vertexAt(u - back * du, v - back * dv))))
      --back;
    while (on > kBeyond_px &&
           (!isInside(u + on * du, v + on * dv) || regionAt(u + on * du, v + on * dv) != outer ||
            !isSurface(vertexAt(u + on * du, v + on * dv))))
      --on;
    const std::size_t a = at(u - back * du, v - back * dv), b = at(u + on * du, v + on * dv);
    const Eigen::Vector4f& n_a = input_.normals_world[a];
    const Eigen::Vector4f& n_b = input_.normals_world[b];
    if (!isSurface(n_a) || !isSurface(n_b)) return &OutlineSteps::unseen;
    const Eigen::Vector3f across = (input_.vertices_world[b] - input_.vertices_world[a]).head<3>();
    const Eigen::Vector3f turn = (n_b - n_a).head<3>();
    const float angle = 2 * std::asin(std::min(1.0F, turn.norm() / 2));
    if (angle > kClearBend_rad) return across.dot(turn) > 0 ? &OutlineSteps::ridged : &OutlineSteps::folded;
    // Two surfaces that face one way: on one level, or one above the other.
    const float grown = std::max(1.0F, z / kStepGrowsFrom_m);
    const float rise_m = across.dot((n_a + n_b).head<3>()) / 2;
    if (rise_m < -kLeastStep_m * grown * grown) return &OutlineSteps::open;
    if (rise_m > kLeastStep_m * grown * grown) return &OutlineSteps::hidden;
    return &OutlineSteps::smooth;
  }

  [[nodiscard]] bool isInside(int u, int v) const {
    return u >= 0 && v >= 0 && u < input_.regions.width && v < input_.regions.height;
  }
  [[nodiscard]] std::size_t at(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(input_.regions.width) +
           static_cast<std::size_t>(u);
  }
  [[nodiscard]] RegionId regionAt(int u, int v) const { return input_.regions.regions[at(u, v)]; }
  [[nodiscard]] const Eigen::Vector4f& vertexAt(int u, int v) const {
    return input_.vertices_world[at(u, v)];
  }

  const DiscoveryInput& input_;
  const DiscoveryParams& params_;
  CameraDepth depth_;
};

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

template <class Visit>
void RegionOutlines::forEachBeyond(const RegionSet& regions, const Visit& visit) const {
  for (const RegionId region : regions) {
    const auto outline = outlines_.find(region);
    if (outline == outlines_.end()) continue;
    for (const Beyond& beyond : outline->second) {
      if (!regions.contains(beyond.region)) visit(beyond);
    }
  }
}

RegionOutlines::RegionOutlines(const DiscoveryInput& input, const DiscoveryParams& params) {
  const int width = input.regions.width, height = input.regions.height;
  SCANTROVE_CHECK(input.vertices_world.size() == input.regions.regions.size());
  SCANTROVE_CHECK(input.normals_world.size() == input.regions.regions.size());
  const StepJudge judge(input, params);
  RegionId last;
  std::vector<Beyond>* of_last = nullptr;
  const auto add = [&](RegionId from, RegionId to, End end) {
    if (!from) return;
    if (of_last == nullptr || from != last) of_last = &outlines_[from];
    last = from;
    std::vector<Beyond>& outline = *of_last;
    auto beyond = std::ranges::find(outline, to, &Beyond::region);
    if (beyond == outline.end()) beyond = outline.insert(outline.end(), {to, {}});
    ++(beyond->steps.*end);
  };
  const std::vector<RegionId>& regions = input.regions.regions;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const std::size_t here =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
      const RegionId region = regions[here];
      if (u == 0 || u + 1 == width) add(region, {}, &OutlineSteps::cut);
      if (v == 0 || v + 1 == height) add(region, {}, &OutlineSteps::cut);
      if (u + 1 < width && regions[here + 1] != region) {
        add(region, regions[here + 1], judge.judge(u, v, 1, 0));
        add(regions[here + 1], region, judge.judge(u + 1, v, -1, 0));
      }
      const std::size_t below = here + static_cast<std::size_t>(width);
      if (v + 1 < height && regions[below] != region) {
        add(region, regions[below], judge.judge(u, v, 0, 1));
        add(regions[below], region, judge.judge(u, v + 1, 0, -1));
      }
    }
  }
}

OutlineSteps RegionOutlines::of(const RegionSet& regions) const {
  OutlineSteps all;
  forEachBeyond(regions, [&all](const Beyond& beyond) { all += beyond.steps; });
  return all;
}

std::map<RegionId, OutlineSteps> RegionOutlines::beyond(const RegionSet& regions) const {
  std::map<RegionId, OutlineSteps> all;
  forEachBeyond(regions, [&all](const Beyond& beyond) { all[beyond.region] += beyond.steps; });
  return all;
}

OutlineSteps RegionOutlines::between(RegionId a, RegionId b) const {
  const auto outline = outlines_.find(a);
  if (outline == outlines_.end()) return {};
  const auto beyond = std::ranges::find(outline->second, b, &Beyond::region);
  return beyond == outline->second.end() ? OutlineSteps{} : beyond->steps;
}

std::vector<RegionId> RegionOutlines::metBy(RegionId region, int least_steps) const {
  std::vector<RegionId> met;
  const auto outline = outlines_.find(region);
  if (outline == outlines_.end()) return met;
  for (const Beyond& beyond : outline->second) {
    if (beyond.region && beyond.steps.known() >= least_steps) met.push_back(beyond.region);
  }
  std::ranges::sort(met);
  return met;
}

}  // namespace scantrove
