#pragma once
#include "core/discovery/candidate_finder.h"
#include "core/geometry/camera_depth.h"

namespace scantrove {

/// Steps from pixels of a region across its outline, by what lies beyond.
struct OutlineSteps {
  int open = 0;    ///< the surface beyond lies deeper or lower: here the thing ends
  int folded = 0;  ///< it touches and rises: the thing stands on it or leans against it
  int smooth = 0;  ///< it goes on as it was: a cut across a surface
  int ridged = 0;  ///< it bends away: another side of the same thing, as a rule
  int hidden = 0;  ///< it is nearer and hides what the thing is like there
  int cut = 0;     ///< the image ends
  int unseen = 0;  ///< nothing is known there: says neither

  void operator+=(const OutlineSteps& other);
  [[nodiscard]] int touching() const { return folded + smooth + ridged; }
  [[nodiscard]] int known() const { return open + touching() + hidden + cut; }
  /// Part of what is known, and neither hidden nor cut off, that is the thing's own edge: open, or a fold. 0
  /// where that is nothing.
  [[nodiscard]] float own() const;
  /// Part of what is known that lies behind something nearer.
  [[nodiscard]] float hiddenPart() const;
};

/// What a step is counted as.
using OutlineEnd = int OutlineSteps::*;

/// Says how a region ends at one step.
class OutlineStepJudge {
 public:
  /// `input` must outlive this.
  explicit OutlineStepJudge(const DiscoveryInput& input) : input_(input), depth_(input.view.T_world_camera) {}

  /// From (u, v) in direction (du, dv), where the next pixel is another region's.
  [[nodiscard]] OutlineEnd judge(int u, int v, int du, int dv) const;

 private:
  [[nodiscard]] OutlineEnd judgeContact(int u, int v, int du, int dv, float z) const;
  [[nodiscard]] bool isInside(int u, int v) const { return input_.view.K.isInside(u, v); }
  [[nodiscard]] std::size_t at(int u, int v) const { return input_.view.K.indexOf(u, v); }
  [[nodiscard]] RegionId regionAt(int u, int v) const { return input_.regions[at(u, v)]; }
  [[nodiscard]] const Eigen::Vector4f& vertexAt(int u, int v) const {
    return input_.view.vertices_world[at(u, v)];
  }

  const DiscoveryInput& input_;
  CameraDepth depth_;
};

}  // namespace scantrove
