#include "core/labeling/label_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "core/base/check.h"
#include "core/geometry/surface_step.h"

namespace scantrove {
namespace {

constexpr int kPasses = 2;    // pairs of such pixels need a second one
constexpr int kEqual = 3;     // neighbours of the same fragment that keep a pixel
constexpr int kMajority = 4;  // neighbours of another fragment that replace it

/// The fragment that most neighbours on the pixel's surface have, if these are a majority.
FragmentId majorityAround(const RenderedView& view, const std::vector<FragmentId>& fragments,
                          std::size_t pixel, const std::array<std::ptrdiff_t, 8>& neighbors) {
  const Eigen::Vector4f& here = view.vertices_world[pixel];
  const float z_m = (here.head<3>() - view.T_world_camera.translation().cast<float>()).norm();
  const float reach_m = maxNeighborDistance(z_m, std::min(view.K.fx, view.K.fy));
  FragmentId best;
  int most = 0;
  for (const std::ptrdiff_t a : neighbors) {
    const FragmentId candidate = fragments[pixel + static_cast<std::size_t>(a)];
    if (!candidate || candidate == best) continue;
    int count = 0;
    for (const std::ptrdiff_t b : neighbors) {
      const std::size_t other = pixel + static_cast<std::size_t>(b);
      if (fragments[other] != candidate) continue;
      count += (view.vertices_world[other] - here).squaredNorm() < 2 * reach_m * reach_m ? 1 : 0;
    }
    if (count > most) {
      most = count;
      best = candidate;
    }
  }
  return most >= kMajority ? best : FragmentId{};
}

struct RegionPicture {
  const std::vector<RegionId>& regions;
  int width = 0, height = 0;

  [[nodiscard]] std::size_t at(int u, int v) const {
    const int place = v * width + u;
    return static_cast<std::size_t>(place);
  }

  /// The pixel's own region, or that of most neighbours if fewer than three neighbours have its own.
  [[nodiscard]] RegionId regionAround(int u, int v) const {
    const RegionId own = regions[at(u, v)];
    if (!own) return own;
    if (u > 0 && u + 1 < width && regions[at(u - 1, v)] == own && regions[at(u + 1, v)] == own) return own;
    std::array<RegionId, 8> around;
    std::size_t count = 0;
    for (int y = std::max(0, v - 1); y <= std::min(height - 1, v + 1); ++y) {
      for (int x = std::max(0, u - 1); x <= std::min(width - 1, u + 1); ++x)
        if (x != u || y != v) around[count++] = regions[at(x, y)];
    }
    const std::span<const RegionId> neighbors(around.data(), count);
    const auto countOf = [&](RegionId region) { return std::ranges::count(neighbors, region); };
    return countOf(own) >= kEqual ? own : *std::ranges::max_element(neighbors, {}, countOf);
  }
};

}  // namespace

void removeIsolatedLabels(const RenderedView& view, std::vector<FragmentId>& fragments) {
  SCANTROVE_CHECK(fragments.size() == view.vertices_world.size());
  const auto width = static_cast<std::ptrdiff_t>(view.K.width);
  const std::array<std::ptrdiff_t, 8> neighbors{-width - 1, -width,    -width + 1, -1,
                                                1,          width - 1, width,      width + 1};
  std::vector<std::pair<std::size_t, FragmentId>> changes;
  for (int pass = 0; pass < kPasses; ++pass) {
    changes.clear();
    for (int v = 1; v + 1 < view.K.height; ++v) {
      for (int u = 1; u + 1 < view.K.width; ++u) {
        const std::size_t pixel = view.K.indexOf(u, v);
        const FragmentId fragment = fragments[pixel];
        if (!fragment || (fragments[pixel - 1] == fragment && fragments[pixel + 1] == fragment)) continue;
        const auto equal = std::ranges::count_if(neighbors, [&](std::ptrdiff_t step) {
          return fragments[pixel + static_cast<std::size_t>(step)] == fragment;
        });
        if (equal >= kEqual) continue;
        if (const FragmentId better = majorityAround(view, fragments, pixel, neighbors))
          changes.emplace_back(pixel, better);
      }
    }
    for (const auto& [pixel, fragment] : changes) fragments[pixel] = fragment;
  }
}

void removeIsolatedLabels(int width, std::vector<RegionId>& regions) {
  SCANTROVE_CHECK(width > 0 && regions.size() % static_cast<std::size_t>(width) == 0);
  const RegionPicture picture{regions, width, static_cast<int>(regions.size()) / width};
  std::vector<std::pair<std::size_t, RegionId>> changes;
  for (int pass = 0; pass < kPasses; ++pass) {
    changes.clear();
    for (int v = 0; v < picture.height; ++v) {
      for (int u = 0; u < width; ++u) {
        const RegionId better = picture.regionAround(u, v);
        if (better != regions[picture.at(u, v)]) changes.emplace_back(picture.at(u, v), better);
      }
    }
    for (const auto& [pixel, region] : changes) regions[pixel] = region;
  }
}

}  // namespace scantrove
