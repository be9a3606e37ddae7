#pragma once
#include <algorithm>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <unordered_map>
#include <vector>

#include "core/pipeline/mapping_pipeline.h"

namespace scantrove::benchmarks {

/// Small instances (SegmentationMetrics::small) that a segment matches (intersection over union above 0.5)
/// and no region does, by cause.
struct SmallLosses {
  int covered = 0;  ///< matched by a segment
  int mixed = 0;    ///< no set of fragments matches the instance
  int joined = 0;   ///< most of the best region is another instance
  int split = 0;    ///< several regions share the instance
  int won = 0;      ///< matched by a region and no segment

  void operator+=(const SmallLosses& other) {
    covered += other.covered;
    mixed += other.mixed;
    joined += other.joined;
    split += other.split;
    won += other.won;
  }
};

/// Counts the losses in one frame. `truth`: CV_16UC1 of the working resolution, 0 = none.
inline SmallLosses countSmallLosses(const FrameResult& frame, const cv::Mat& truth) {
  using Counts = std::unordered_map<std::uint32_t, int>;
  struct Overlaps {
    int area = 0;
    Counts segments, regions, fragments;
  };
  std::unordered_map<std::uint32_t, Overlaps> overlaps_of;
  Counts segments, regions, fragments;
  for (std::size_t i = 0; i < frame.segments.ids.size(); ++i) {
    const auto instance = static_cast<std::uint32_t>(truth.ptr<std::uint16_t>()[i]);
    const std::uint32_t segment = frame.segments.ids[i], region = frame.view.regions[i].value,
                        fragment = frame.view.fragments[i].value;
    if (instance != 0) {
      Overlaps& overlaps = overlaps_of[instance];
      ++overlaps.area;
      ++overlaps.segments[segment];
      ++overlaps.regions[region];
      ++overlaps.fragments[fragment];
    }
    ++segments[segment];
    ++regions[region];
    ++fragments[fragment];
  }
  const double scale = static_cast<double>(truth.total()) / (640.0 * 480.0);
  const auto bestIou = [](const Overlaps& overlaps, const Counts& parts, const Counts& areas) {
    double iou = 0;
    for (const auto& [part, overlap] : parts) {
      if (part != 0)
        iou = std::max(iou, static_cast<double>(overlap) / (overlaps.area + areas.at(part) - overlap));
    }
    return iou;
  };
  SmallLosses losses;
  for (const auto& [instance, overlaps] : overlaps_of) {
    if (overlaps.area < 400 * scale || overlaps.area > 15000 * scale) continue;
    const bool by_segment = bestIou(overlaps, overlaps.segments, segments) > 0.5;
    const bool by_region = bestIou(overlaps, overlaps.regions, regions) > 0.5;
    losses.covered += by_segment ? 1 : 0;
    losses.won += by_region && !by_segment ? 1 : 0;
    if (!by_segment || by_region) continue;
    int inside = 0, fragment_area = 0;
    for (const auto& [fragment, overlap] : overlaps.fragments) {
      if (fragment == 0 || 2 * overlap < fragments.at(fragment)) continue;
      inside += overlap;
      fragment_area += fragments.at(fragment);
    }
    std::uint32_t most = 0;
    for (const auto& [region, overlap] : overlaps.regions) {
      if (region != 0 && (most == 0 || overlap > overlaps.regions.at(most))) most = region;
    }
    if (2 * inside <= overlaps.area + fragment_area - inside) {
      ++losses.mixed;
    } else if (most != 0 && 2 * overlaps.regions.at(most) < regions.at(most)) {
      ++losses.joined;
    } else {
      ++losses.split;
    }
  }
  return losses;
}

}  // namespace scantrove::benchmarks
