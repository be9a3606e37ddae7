#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// A mask of another program in a rendered view: the indices of its pixels, rising.
using PixelMask = std::vector<std::uint32_t>;

/// The frames whose masks say that two things are one, or two.
struct MaskVotes {
  int together = 0, apart = 0;
  bool operator==(const MaskVotes&) const = default;
};

/// What the masks of one frame say about two sets of pixels.
class MaskVote {
 public:
  /// Adds a mask that covers these parts (0 .. 1) of the sets.
  void add(float part_a, float part_b);
  /// True: a mask holds both sets. False: a mask holds one and leaves the other out. None: neither, or both.
  [[nodiscard]] std::optional<bool> areOne() const;
  void addTo(MaskVotes& votes) const;

 private:
  bool holds_both_ = false, parts_ = false;
};

/// The regions of a view and how much of them each mask covers.
struct MaskCoverage {
  struct Part {
    std::size_t region;  ///< place in `regions`
    int pixels;
  };
  std::vector<RegionId> regions;            ///< in the view, rising
  std::vector<int> areas_px;                ///< of `regions`
  std::vector<std::vector<Part>> of_masks;  ///< by mask; regions rising

  /// The part (0 .. 1) of a region's pixels that a mask covers.
  [[nodiscard]] float part(std::size_t mask, std::size_t region) const;
};
/// `view` has regions; `masks` have its size.
[[nodiscard]] MaskCoverage coverageOf(const RenderedView& view, std::span<const PixelMask> masks);

/// Counts how often the masks of frames hold two touching regions, and how often they part them. One thread.
class MaskEvidence {
 public:
  using Border = std::pair<RegionId, RegionId>;  ///< the smaller number first

  /// Adds a frame: the map from its camera, with vertices and regions, and masks of the view's size. Each
  /// border gets at most one vote. Regions of few pixels, and those that touch only in the image, get none.
  void add(const RenderedView& view, std::span<const PixelMask> masks);

  /// Borders with a vote.
  [[nodiscard]] const std::map<Border, MaskVotes>& borders() const { return borders_; }

 private:
  std::map<Border, MaskVotes> borders_;
};

}  // namespace scantrove
