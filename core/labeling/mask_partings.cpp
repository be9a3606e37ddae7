#include "core/labeling/mask_partings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "core/geometry/camera_depth.h"

namespace scantrove {
namespace {

/// A mask parts a region if each side has this part of its visible pixels, and as many pixels of 640 x 480.
constexpr float kMinSidePart = 0.1F;
constexpr double kMinSide_px = 200;
constexpr std::size_t kMaxCandidates = 8;  // of a region
/// Points of a side: enough to stand for a side of which some are hidden.
constexpr std::size_t kPoints = 16, kMinPoints = 6;
/// Distances from the outline at which points are looked for, best first.
constexpr std::array kInward_px{12, 8, 5, 3, 2, 1};
/// A point is seen where the map has this depth.
constexpr float kSameSurface_m = 0.02F;
/// The part of a side's points that a frame must show.
constexpr float kMinSeen = 0.5F;

enum PartingSide : std::uint8_t { kNeither, kHere, kThere };

/// The sides of a region in a view, by pixel.
std::vector<PartingSide> sidesOf(RegionId region, const PixelMask& mask, const RenderedView& view) {
  std::vector<PartingSide> sides(view.regions.size(), kNeither);
  for (std::size_t pixel = 0; pixel < sides.size(); ++pixel)
    if (view.regions[pixel] == region) sides[pixel] = kThere;
  for (const std::uint32_t pixel : mask)
    if (sides[pixel] == kThere) sides[pixel] = kHere;
  // Estimated surface has no voxels that could be parted.
  for (std::size_t pixel = 0; pixel < view.is_estimated.size(); ++pixel)
    if (view.is_estimated[pixel] != 0) sides[pixel] = kNeither;
  return sides;
}

/// Whether the pixel lies on its side by `distance_px` in eight directions.
bool isInward(int x, int y, int distance_px, const std::vector<PartingSide>& sides, const Intrinsics& K) {
  const PartingSide side = sides[K.indexOf(x, y)];
  for (const int dy : {-distance_px, 0, distance_px}) {
    for (const int dx : {-distance_px, 0, distance_px}) {
      if (!K.isInside(x + dx, y + dy) || sides[K.indexOf(x + dx, y + dy)] != side) return false;
    }
  }
  return true;
}

/// Points of a side that lie far from the outline and are spread over it; empty: it is too narrow.
std::vector<Eigen::Vector3f> pointsOf(PartingSide side, const std::vector<PartingSide>& sides,
                                      const RenderedView& view) {
  for (const int distance_px : kInward_px) {
    std::vector<std::size_t> pixels;
    for (int y = 0; y < view.K.height; ++y) {
      for (int x = 0; x < view.K.width; ++x) {
        const std::size_t pixel = view.K.indexOf(x, y);
        if (sides[pixel] == side && view.vertices_world[pixel].w() > 0 &&
            isInward(x, y, distance_px, sides, view.K))
          pixels.push_back(pixel);
      }
    }
    if (pixels.size() < kMinPoints) continue;
    std::vector<Eigen::Vector3f> points;
    const std::size_t count = std::min(kPoints, pixels.size());
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t pixel = pixels[(2 * i + 1) * pixels.size() / (2 * count)];
      points.emplace_back(view.vertices_world[pixel].head<3>());
    }
    return points;
  }
  return {};
}

/// The pixels at which the view shows points of a region; empty: it shows too few.
PixelMask seenPixels(const std::vector<Eigen::Vector3f>& points_world, RegionId region,
                     const RenderedView& view) {
  const Eigen::Isometry3f T_camera_world = view.T_world_camera.inverse().cast<float>();
  const CameraDepth depth(view.T_world_camera);
  PixelMask pixels;
  for (const Eigen::Vector3f& point : points_world) {
    const Eigen::Vector3f p = T_camera_world * point;
    if (!(p.z() > 0)) continue;
    const float u = std::floor(view.K.fx * p.x() / p.z() + view.K.cx + 0.5F);
    const float v = std::floor(view.K.fy * p.y() / p.z() + view.K.cy + 0.5F);
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(view.K.width) && v < static_cast<float>(view.K.height)))
      continue;
    const std::size_t pixel = view.K.indexOf(static_cast<int>(u), static_cast<int>(v));
    const Eigen::Vector4f& vertex = view.vertices_world[pixel];
    if (view.regions[pixel] == region && vertex.w() > 0 && std::abs(depth(vertex) - p.z()) < kSameSurface_m)
      pixels.push_back(static_cast<std::uint32_t>(pixel));
  }
  const float seen = static_cast<float>(pixels.size()) / static_cast<float>(points_world.size());
  return seen >= kMinSeen ? pixels : PixelMask{};
}

float partInside(const PixelMask& pixels, const PixelMask& mask) {
  const auto inside = std::ranges::count_if(
      pixels, [&](std::uint32_t pixel) { return std::ranges::binary_search(mask, pixel); });
  return static_cast<float>(inside) / static_cast<float>(pixels.size());
}

}  // namespace

void MaskPartings::find(const RenderedView& view, std::span<const PixelMask> masks) {
  const MaskCoverage coverage = coverageOf(view, masks);
  // The mask of each region that parts it into the largest sides.
  struct Best {
    std::size_t mask = 0;
    int smaller_side_px = 0;
  };
  std::vector<Best> best(coverage.regions.size());
  for (std::size_t mask = 0; mask < masks.size(); ++mask) {
    for (const auto& [region, inside_px] : coverage.of_masks[mask]) {
      const int smaller_px = std::min(inside_px, coverage.areas_px[region] - inside_px);
      if (smaller_px > best[region].smaller_side_px) best[region] = {mask, smaller_px};
    }
  }
  const double least_px = kMinSide_px * view.K.pixelScale();
  for (std::size_t region = 0; region < best.size(); ++region) {
    const int smaller_px = best[region].smaller_side_px;
    if (smaller_px < least_px ||
        static_cast<float>(smaller_px) < kMinSidePart * static_cast<float>(coverage.areas_px[region]))
      continue;
    const std::vector<PartingSide> sides = sidesOf(coverage.regions[region], masks[best[region].mask], view);
    MaskParting parting{
        coverage.regions[region], pointsOf(kHere, sides, view), pointsOf(kThere, sides, view), {}};
    if (!parting.here_world.empty() && !parting.there_world.empty()) keep({smaller_px, std::move(parting)});
  }
}

void MaskPartings::keep(Candidate candidate) {
  std::vector<Candidate>& of_region = candidates_[candidate.parting.region];
  of_region.push_back(std::move(candidate));
  std::ranges::stable_sort(of_region, std::greater<>{}, &Candidate::smaller_side_px);
  if (of_region.size() > kMaxCandidates) of_region.pop_back();
}

void MaskPartings::count(const RenderedView& view, std::span<const PixelMask> masks) {
  for (auto& [region, of_region] : candidates_) {
    for (Candidate& candidate : of_region) {
      const PixelMask here = seenPixels(candidate.parting.here_world, region, view);
      const PixelMask there = seenPixels(candidate.parting.there_world, region, view);
      if (here.empty() || there.empty()) continue;
      MaskVote vote;
      for (const PixelMask& mask : masks) vote.add(partInside(here, mask), partInside(there, mask));
      vote.addTo(candidate.parting.votes);
    }
  }
}

std::vector<MaskParting> MaskPartings::best() const {
  std::vector<MaskParting> partings;
  const auto agreement = [](const Candidate& candidate) {
    return candidate.parting.votes.apart - candidate.parting.votes.together;
  };
  for (const auto& [region, of_region] : candidates_)
    partings.push_back(std::ranges::max_element(of_region, {}, agreement)->parting);
  return partings;
}

}  // namespace scantrove
