#pragma once
#include "core/discovery/candidate_finder.h"
#include "core/geometry/camera_depth.h"

namespace scantrove {

/// Counts of pixel steps across a region's outline, by the kind of surface beyond.
struct OutlineSteps {
  int open = 0;    ///< deeper or lower surface: the object ends
  int folded = 0;  ///< touching and rising surface: the object stands on it or leans against it
  int smooth = 0;  ///< the surface continues: a cut across it
  int ridged = 0;  ///< the surface bends away: usually another side of the same object
  int hidden = 0;  ///< nearer surface, which occludes the region
  int cut = 0;     ///< the image ends
  int unseen = 0;  ///< unknown

  void operator+=(const OutlineSteps& other);
  [[nodiscard]] int touching() const { return folded + smooth + ridged; }
  [[nodiscard]] int known() const { return open + touching() + hidden + cut; }
  /// The object's own edge (open or folded) as part of the known steps that are neither hidden nor cut off. 0
  /// if there are none.
  [[nodiscard]] float own() const;
  /// Hidden part of the known steps.
  [[nodiscard]] float hiddenPart() const;
};

/// The counter for a step.
using OutlineEnd = int OutlineSteps::*;

/// Classifies single steps across an outline.
class OutlineStepJudge {
 public:
  /// `input` must outlive this.
  explicit OutlineStepJudge(const DiscoveryInput& input) : input_(input), depth_(input.view.T_world_camera) {}

  /// The step from (u, v) in direction (du, dv), where the next pixel belongs to another region.
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
