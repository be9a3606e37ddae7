#include "core/labeling/fragment_splitter.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace scantrove {
namespace {

constexpr float kMinShare = 0.002F;      // of the fragment's visible part, for each side
constexpr float kMinSide = 1.0F / 1500;  // of the image: 51 pixels of 320 x 240
constexpr int kMemory = 30;              // frames without observation until a side is dropped
constexpr float kSamePlace = 0.35F;      // centres agree within this part of the side's extent ...
constexpr float kSameArea = 0.5F;        // ... and areas within this ratio

/// Without this, fragments of a recording in a loop grow from 877 to 993 between its second and twelfth pass,
/// nearly all through splits. With it they grow from 817 to 854, mostly in the third pass.
constexpr int kFewFrames = 200;            // beyond this, for each kFramesPerObservation more frames ...
constexpr int kFramesPerObservation = 20;  // ... one more observation must agree ...
constexpr int kMaxFrames = 1000;           // ... up to this limit, because the scene may change

struct Side {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float area_m2 = 0;
  int pixels = 0;
};

}  // namespace

int FragmentSplitter::observationsNeeded(int frames_seen) {
  return kObservations + std::max(0, std::min(frames_seen, kMaxFrames) - kFewFrames) / kFramesPerObservation;
}

void FragmentSplitter::forget(FragmentId fragment) {
  pending_.erase(fragment);
  if (fragment.value < frames_seen_.size()) frames_seen_[fragment.value] = 0;
}

std::vector<FragmentSplitter::Split> FragmentSplitter::find(const MergeInput& input,
                                                            const OverlapGraph<FragmentId>& overlaps,
                                                            std::span<const FragmentId> owner) {
  agePending();
  // Sides: segments that hold enough of the fragment that they belong to.
  const float least_px = kMinSide * static_cast<float>(input.view.K.pixels());
  std::vector<bool> is_side(owner.size(), false);
  std::map<FragmentId, int> sides_of;
  for (const auto& edge : overlaps.edges) {
    if (owner[edge.segment] != overlaps.patches[edge.patch]) continue;
    if (static_cast<float>(edge.overlap_px) < least_px || !overlaps.covers(edge, kMinShare)) continue;
    is_side[edge.segment] = true;
    ++sides_of[owner[edge.segment]];
  }
  for (const auto& [fragment, sides] : sides_of) {
    if (frames_seen_.size() <= fragment.value) frames_seen_.resize(fragment.value + std::size_t{1});
    frames_seen_[fragment.value] = std::min(frames_seen_[fragment.value] + 1, kMaxFrames);
  }
  if (std::ranges::all_of(sides_of, [](const auto& entry) { return entry.second < 2; })) return {};
  for (std::size_t segment = 0; segment < owner.size(); ++segment)
    is_side[segment] = is_side[segment] && sides_of[owner[segment]] >= 2;

  std::vector<FragmentId> parts(input.view.fragments.size());
  std::vector<Side> sides(owner.size());
  const float pixel_area = 1 / (input.view.K.fx * input.view.K.fy);
  for (std::size_t pixel = 0; pixel < parts.size(); ++pixel) {
    const std::uint32_t segment = input.segments.ids[pixel];
    if (!is_side[segment] || input.view.fragments[pixel] != owner[segment]) continue;
    if (!input.view.is_estimated.empty() && input.view.is_estimated[pixel] != 0) continue;
    parts[pixel] = FragmentId{segment};
    Side& side = sides[segment];
    side.sum += input.view.vertices_world[pixel].head<3>();
    side.area_m2 += pixel_area * input.segments.depths_m[pixel] * input.segments.depths_m[pixel];
    ++side.pixels;
  }
  std::vector<Split> splits;
  std::set<FragmentId> split_now;   // one split per fragment and frame
  std::set<std::uint32_t> counted;  // one observation per side and frame
  for (const FragmentContact& contact : findContacts(input, parts)) {
    const FragmentId fragment = owner[contact.a.value];
    if (fragment != owner[contact.b.value] || split_now.contains(fragment)) continue;
    const std::uint32_t smaller =
        sides[contact.a.value].pixels < sides[contact.b.value].pixels ? contact.a.value : contact.b.value;
    if (!counted.insert(smaller).second) continue;
    const Side& side = sides[smaller];
    if (!isConfirmed(fragment, side.sum / static_cast<float>(side.pixels), side.area_m2)) continue;
    splits.push_back({fragment, smaller, contact});
    split_now.insert(fragment);
  }
  return splits;
}

bool FragmentSplitter::isConfirmed(FragmentId fragment, const Eigen::Vector3f& center_world, float area_m2) {
  std::vector<Pending>& known = pending_[fragment];
  const int needed = observationsNeeded(frames_seen_[fragment.value]);
  const float extent_m = std::sqrt(area_m2);
  for (Pending& pending : known) {
    const bool same_place = (pending.center_world - center_world).norm() < kSamePlace * extent_m;
    const bool same_size =
        std::min(pending.area_m2, area_m2) > kSameArea * std::max(pending.area_m2, area_m2);
    if (!same_place || !same_size) continue;
    pending = {center_world, area_m2, pending.observations + 1, 0};
    if (pending.observations < needed) return false;
    std::erase_if(known, [needed](const Pending& p) { return p.observations >= needed; });
    return true;
  }
  known.push_back({center_world, area_m2, 1, 0});
  return false;
}

void FragmentSplitter::agePending() {
  for (auto& [fragment, known] : pending_) {
    std::erase_if(known, [](Pending& pending) { return ++pending.age > kMemory; });
  }
  std::erase_if(pending_, [](const auto& entry) { return entry.second.empty(); });
}

}  // namespace scantrove
