#include "core/labeling/label_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>

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

}  // namespace scantrove
