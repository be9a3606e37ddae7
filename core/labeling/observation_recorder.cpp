#include "core/labeling/observation_recorder.h"

#include <algorithm>
#include <utility>

namespace scantrove {

void ObservationRecorder::record(const RenderedView& view, RegionTable& table) {
  const Intrinsics& K = view.K;
  constexpr int kStep = 2;  // pixels, both ways
  seen_.resize(table.regions().size());
  in_view_.clear();
  for (int y = 0; y < K.height; y += kStep) {
    for (int x = 0; x < K.width; x += kStep) {
      const std::size_t at = K.indexOf(x, y);
      const FragmentId fragment = view.fragments[at];
      if (!fragment || !(view.vertices_world[at].w() > 0)) continue;
      Seen& seen = seen_[fragment.value];
      if (seen.points++ == 0) in_view_.push_back(fragment);
      seen.sum += view.vertices_world[at].head<3>();
    }
  }
  const int least_points = std::max(K.width * K.height / kMinPart, kMinPixels) / (kStep * kStep);
  const Eigen::Vector3f camera = view.T_world_camera.translation().cast<float>();
  regions_.clear();
  for (const FragmentId fragment : in_view_) {
    const Seen seen = std::exchange(seen_[fragment.value], Seen{});
    Seen& region = regions_[table.regionOf(fragment)];
    region.sum += seen.sum;
    region.points += seen.points;
  }
  for (const FragmentId fragment : in_view_) {
    const Seen& region = regions_.at(table.regionOf(fragment));
    if (region.points >= least_points)
      table.addViewDirection(fragment, camera - region.sum / static_cast<float>(region.points));
  }
}

}  // namespace scantrove
