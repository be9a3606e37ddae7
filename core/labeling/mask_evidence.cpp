#include "core/labeling/mask_evidence.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/geometry/camera_depth.h"
#include "core/geometry/surface_step.h"

namespace scantrove {
namespace {

/// A mask holds what it covers by kHeld and leaves out what it covers by kLeftOut: outlines of masks and
/// of the map differ by some pixels.
constexpr float kHeld = 0.7F, kLeftOut = 0.3F;
/// Regions with fewer visible pixels say nothing, of 640 x 480.
constexpr double kMinVisible_px = 120;
/// Contacts of fewer pixel pairs say nothing.
constexpr int kMinContact_px = 4;
/// Pixels without a region along an outline are bridged.
constexpr int kMaxGap_px = 2;

/// Pixel pairs across each border at which the surfaces touch.
class RegionContacts {
 public:
  explicit RegionContacts(const RenderedView& view)
      : view_(view), depth_(view.T_world_camera), focal_px_(std::min(view.K.fx, view.K.fy)) {
    for (int y = 0; y < view.K.height; ++y) {
      for (int x = 0; x < view.K.width; ++x) {
        if (!view.regions[view.K.indexOf(x, y)]) continue;
        cross(x, y, 1, 0);
        cross(x, y, 0, 1);
      }
    }
  }
  [[nodiscard]] const std::map<MaskEvidence::Border, int>& pixels() const { return pixels_; }

 private:
  void cross(int x, int y, int dx, int dy) {
    const std::size_t here = view_.K.indexOf(x, y);
    for (int step = 1; step <= kMaxGap_px + 1; ++step) {
      if (!view_.K.isInside(x + step * dx, y + step * dy)) return;
      const std::size_t there = view_.K.indexOf(x + step * dx, y + step * dy);
      if (!view_.regions[there]) continue;
      if (view_.regions[there] != view_.regions[here] && touch(here, there, step))
        ++pixels_[std::minmax(view_.regions[here], view_.regions[there])];
      return;
    }
  }

  [[nodiscard]] bool touch(std::size_t here, std::size_t there, int step) const {
    const Eigen::Vector4f& from = view_.vertices_world[here];
    const Eigen::Vector4f& to = view_.vertices_world[there];
    if (!(from.w() > 0) || !(to.w() > 0)) return false;
    const float reach_m = maxNeighborDistance(depth_(from), focal_px_) * static_cast<float>(step);
    return (to - from).squaredNorm() < reach_m * reach_m;
  }

  const RenderedView& view_;
  CameraDepth depth_;
  float focal_px_;
  std::map<MaskEvidence::Border, int> pixels_;
};

}  // namespace

void MaskVote::add(float part_a, float part_b) {
  const auto [less, more] = std::minmax(part_a, part_b);
  if (less >= kHeld) {
    holds_both_ = true;
  } else if (more >= kHeld && less <= kLeftOut) {
    parts_ = true;
  }
}

std::optional<bool> MaskVote::areOne() const {
  return holds_both_ == parts_ ? std::nullopt : std::optional(holds_both_);
}

void MaskVote::addTo(MaskVotes& votes) const {
  if (const std::optional<bool> are_one = areOne()) ++(*are_one ? votes.together : votes.apart);
}

float MaskCoverage::part(std::size_t mask, std::size_t region) const {
  const std::vector<Part>& parts = of_masks[mask];
  const auto found = std::ranges::lower_bound(parts, region, {}, &Part::region);
  if (found == parts.end() || found->region != region) return 0;
  return static_cast<float>(found->pixels) / static_cast<float>(areas_px[region]);
}

MaskCoverage coverageOf(const RenderedView& view, std::span<const PixelMask> masks) {
  SCANTROVE_CHECK(view.regions.size() == static_cast<std::size_t>(view.K.pixels()));
  std::map<RegionId, int> areas_px;
  for (const RegionId region : view.regions)
    if (region) ++areas_px[region];
  MaskCoverage coverage;
  for (const auto& [region, area_px] : areas_px) {
    coverage.regions.push_back(region);
    coverage.areas_px.push_back(area_px);
  }
  for (const PixelMask& mask : masks) {
    std::map<RegionId, int> covered;
    for (const std::uint32_t pixel : mask)
      if (view.regions[pixel]) ++covered[view.regions[pixel]];
    std::vector<MaskCoverage::Part>& parts = coverage.of_masks.emplace_back();
    for (const auto& [region, pixels] : covered) {
      const auto place = std::ranges::lower_bound(coverage.regions, region);
      parts.push_back({static_cast<std::size_t>(place - coverage.regions.begin()), pixels});
    }
  }
  return coverage;
}

void MaskEvidence::add(const RenderedView& view, std::span<const PixelMask> masks) {
  const MaskCoverage coverage = coverageOf(view, masks);
  const auto least_px = static_cast<int>(std::ceil(kMinVisible_px * view.K.pixelScale()));
  const auto placeOf = [&](RegionId region) {
    return static_cast<std::size_t>(std::ranges::lower_bound(coverage.regions, region) -
                                    coverage.regions.begin());
  };
  const RegionContacts contacts(view);
  for (const auto& [border, pixels] : contacts.pixels()) {
    const std::size_t a = placeOf(border.first), b = placeOf(border.second);
    if (pixels < kMinContact_px || std::min(coverage.areas_px[a], coverage.areas_px[b]) < least_px) continue;
    MaskVote vote;
    for (std::size_t mask = 0; mask < masks.size(); ++mask)
      vote.add(coverage.part(mask, a), coverage.part(mask, b));
    if (vote.areOne()) vote.addTo(borders_[border]);
  }
}

}  // namespace scantrove
