#pragma once
#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/fusion/rendered_view.h"
#include "core/labeling/mask_evidence.h"

namespace scantrove {

/// A way to part a region, as the outline of a mask shows it in one frame.
struct MaskParting {
  RegionId region;
  std::vector<Eigen::Vector3f> here_world;   ///< on the surface, inside the mask; metres
  std::vector<Eigen::Vector3f> there_world;  ///< on the surface, outside
  MaskVotes votes;
};

/// Finds regions that masks part, in two passes over the same frames: find() proposes, count() counts the
/// frames that agree. A parting is a set of points on both sides, so that it compares frames whose masks have
/// other outlines, and parts fragments, too. One thread.
class MaskPartings {
 public:
  /// First pass. `view`: the map from the frame's camera, with vertices and regions; `masks` have its size.
  void find(const RenderedView& view, std::span<const PixelMask> masks);
  /// Second pass, after all frames of the first.
  void count(const RenderedView& view, std::span<const PixelMask> masks);

  /// The parting of each region with most agreement, by region.
  [[nodiscard]] std::vector<MaskParting> best() const;

 private:
  struct Candidate {
    int smaller_side_px = 0;
    MaskParting parting;
  };
  void keep(Candidate candidate);

  std::map<RegionId, std::vector<Candidate>> candidates_;  // those with the largest smaller side
};

}  // namespace scantrove
