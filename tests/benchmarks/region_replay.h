#pragma once
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "core/evaluation/overlap_metrics.h"
#include "core/labeling/greedy_contraction.h"
#include "core/labeling/region_partition.h"
#include "tests/benchmarks/scene_scan.h"

// Scans are kept as the evidence of some of their frames, and their regions made again under other odds.
namespace scantrove::benchmarks {

/// Of two fragments.
struct Border {
  std::uint32_t a = 0, b = 0;  ///< indices of the moment's fragments
  BorderEvidence evidence;
  std::array<float, BorderEvidence::kFeatures> features{};
  std::optional<bool> are_one;  ///< of one thing; none where one of them is not clearly of any
};

/// What a frame showed, and what was known of it.
struct Moment {
  std::vector<FragmentId> fragments;
  std::vector<int> voxels;
  std::vector<Border> borders;
  OverlapTable table;  ///< of fragments, by index + 1, with instances
  double scale = 1;    ///< pixels to those of 640x480
};
using Scene = std::vector<Moment>;

/// What is thought of a border: logarithm of the odds that its sides are one thing.
using Odds = std::function<float(const Border&)>;

/// The true instance of each fragment in view that is clearly of one; 0: none.
inline std::vector<int> instancesOf(const OverlapTable& table, std::size_t fragments) {
  constexpr int kLeastPixels = 20;
  constexpr double kLeastPurity = 0.7;
  std::vector<int> instances(fragments, 0);
  for (const auto& [pair, area] : table.intersection) {
    if (area >= kLeastPixels && area >= kLeastPurity * table.segment_area.at(pair.second))
      instances[static_cast<std::size_t>(pair.second - 1)] = pair.first;
  }
  return instances;
}

inline Moment momentOf(const ScanPipeline& pipeline, const EvidenceGraph& graph, const FrameResult& result,
                       const cv::Mat& truth) {
  Moment moment;
  moment.scale = static_cast<double>(truth.total()) / (640.0 * 480.0);
  std::map<FragmentId, std::uint32_t> index;
  const auto indexOf = [&](FragmentId fragment) {
    const auto [entry, is_new] = index.try_emplace(fragment, static_cast<std::uint32_t>(index.size()));
    if (is_new) {
      moment.fragments.push_back(fragment);
      moment.voxels.push_back(pipeline.voxelsOfFragments()[fragment.value]);
    }
    return entry->second;
  };
  cv::Mat1i labels(truth.size(), 0);
  auto label = labels.begin();
  for (const FragmentId fragment : result.regions.fragments) {
    if (fragment) *label = static_cast<int>(indexOf(fragment)) + 1;
    ++label;
  }
  moment.table = countOverlaps(labels, cv::Mat1i(truth), 1);
  const std::vector<int> instances = instancesOf(moment.table, moment.fragments.size());
  const std::size_t in_view = moment.fragments.size();
  for (std::size_t i = 0; i < in_view; ++i) {
    const FragmentId fragment = moment.fragments[i];
    for (const EvidenceGraph::Link& link : graph.linksOf(fragment)) {
      const auto known = index.find(link.other);
      if (known != index.end() && known->second < i) continue;  // is there
      Border border{static_cast<std::uint32_t>(i), indexOf(link.other), graph.border(link.border), {}, {}};
      border.features = border.evidence.features(moment.voxels[border.a], moment.voxels[border.b]);
      const bool is_known = border.b < in_view && instances[border.a] != 0 && instances[border.b] != 0;
      if (is_known) border.are_one = instances[border.a] == instances[border.b];
      moment.borders.push_back(std::move(border));
    }
  }
  return moment;
}

/// Part of each fragment, one frame after the other, by odds of ours in place of what evidence says itself.
/// Persons and slivers' neighbours are left out of it.
class Replay {
 public:
  explicit Replay(Odds odds) : odds_(std::move(odds)) {}

  [[nodiscard]] std::vector<std::uint32_t> partsOf(const Moment& moment) {
    std::vector<WeightedEdge> edges;
    for (const Border& border : moment.borders) {
      const int voxels_a = moment.voxels[border.a], voxels_b = moment.voxels[border.b];
      if (std::min(voxels_a, voxels_b) < kSliverVoxels) continue;
      const bool are_one = wereOne(moment.fragments[border.a], moment.fragments[border.b]);
      const float bias = are_one ? kHysteresis : -kHysteresis;
      const float change = odds_(border) - border.evidence.logOdds(voxels_a, voxels_b);
      edges.push_back(
          {border.a, border.b, border.evidence.weight(voxels_a, voxels_b, bias + change, are_one)});
    }
    std::vector<std::uint32_t> parts = contractGreedily(moment.fragments.size(), edges);
    for (std::size_t i = 0; i < parts.size(); ++i) before_[moment.fragments[i]] = {moment_, parts[i]};
    ++moment_;
    return parts;
  }

 private:
  static constexpr float kHysteresis = 0.5F;

  [[nodiscard]] bool wereOne(FragmentId a, FragmentId b) const {
    const auto part_a = before_.find(a), part_b = before_.find(b);
    return part_a != before_.end() && part_b != before_.end() && part_a->second == part_b->second;
  }

  Odds odds_;
  std::map<FragmentId, std::pair<int, std::uint32_t>> before_;  // moment, part
  int moment_ = 0;
};

/// Sums over frames, then means.
struct Score {
  double small = 0, small_over_half = 0, large = 0, large_over_half = 0;
  double frames = 0, coverage = 0;
  double pieces = 0;  ///< parts in view that are mostly something else than any one instance

  void add(const Moment& moment, const std::vector<std::uint32_t>& parts) {
    constexpr double kSmall_px = 400, kLarge_px = 15000, kLeast_px = 400;
    OverlapTable table;
    table.instance_area = moment.table.instance_area;
    for (const auto& [fragment, area] : moment.table.segment_area)
      table.segment_area[partAt(parts, fragment)] += area;
    for (const auto& [pair, area] : moment.table.intersection)
      table.intersection[{pair.first, partAt(parts, pair.second)}] += area;
    const SizedCoverage of_small = coverageOfSize(table, kSmall_px * moment.scale, kLarge_px * moment.scale);
    const SizedCoverage of_large = coverageOfSize(table, kLarge_px * moment.scale, HUGE_VAL);
    small += of_small.instances;
    small_over_half += of_small.over_half * of_small.instances;
    large += of_large.instances;
    large_over_half += of_large.over_half * of_large.instances;
    coverage += scantrove::coverage(table).weighted;
    frames += 1;
    std::map<int, double> best;
    for (const auto& [pair, area] : table.intersection) {
      const int all = table.instance_area.at(pair.first) + table.segment_area.at(pair.second) - area;
      best[pair.second] = std::max(best[pair.second], static_cast<double>(area) / all);
    }
    for (const auto& [part, iou] : best) {
      if (iou < 0.5 && table.segment_area.at(part) >= kLeast_px * moment.scale) pieces += 1;
    }
  }
  void operator+=(const Score& other) {
    small += other.small;
    small_over_half += other.small_over_half;
    large += other.large;
    large_over_half += other.large_over_half;
    frames += other.frames;
    coverage += other.coverage;
    pieces += other.pieces;
  }
  /// What is sought. One piece less a frame is worth 0.4 % of the small things.
  [[nodiscard]] double worth() const {
    return 1.6 * small_over_half / small + 0.4 * large_over_half / large + 0.4 * coverage / frames -
           0.006 * pieces / frames;
  }
  void print(const char* name) const {
    std::fprintf(
        stderr, "%-22s small over half %.4f, large %.4f, coverage %.4f, pieces a frame %.2f; worth %.4f\n",
        name, small_over_half / small, large_over_half / large, coverage / frames, pieces / frames, worth());
  }

 private:
  static int partAt(const std::vector<std::uint32_t>& parts, int fragment) {
    return static_cast<int>(parts[static_cast<std::size_t>(fragment - 1)]) + 1;
  }
};

inline Score scoreOf(const Scene& scene, const Odds& odds) {
  Replay replay(odds);
  Score score;
  for (const Moment& moment : scene) score.add(moment, replay.partsOf(moment));
  return score;
}

}  // namespace scantrove::benchmarks
