#include "core/evaluation/overlap_metrics.h"

#include <algorithm>

#include "core/base/check.h"

namespace scantrove {
namespace {

/// For each instance, the best intersection over union with any segment.
std::map<int, double> bestOverlaps(const OverlapTable& table) {
  std::map<int, double> best;
  for (const auto& [instance, area] : table.instance_area) best[instance] = 0;
  for (const auto& [pair, shared] : table.intersection) {
    const auto [instance, segment] = pair;
    const int united = table.instance_area.at(instance) + table.segment_area.at(segment) - shared;
    best[instance] = std::max(best[instance], static_cast<double>(shared) / united);
  }
  return best;
}

}  // namespace

OverlapTable countOverlaps(const cv::Mat1i& segmentation, const cv::Mat1i& truth, int min_instance_px) {
  SCANTROVE_CHECK(segmentation.size() == truth.size());
  OverlapTable table;
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols;) {
      const int segment = segmentation(y, x);
      const int instance = truth(y, x);
      const int from = x;
      while (x < truth.cols && segmentation(y, x) == segment && truth(y, x) == instance) ++x;
      if (segment != 0) table.segment_area[segment] += x - from;
      if (instance != 0) table.instance_area[instance] += x - from;
      if (segment != 0 && instance != 0) table.intersection[{instance, segment}] += x - from;
    }
  }
  std::erase_if(table.instance_area, [&](const auto& entry) { return entry.second < min_instance_px; });
  std::erase_if(table.intersection,
                [&](const auto& e) { return !table.instance_area.contains(e.first.first); });
  return table;
}

Coverage coverage(const OverlapTable& table) {
  if (table.instance_area.empty()) return {};
  const std::map<int, double> best = bestOverlaps(table);
  Coverage result;
  double area_sum = 0;
  for (const auto& [instance, area] : table.instance_area) {
    result.weighted += best.at(instance) * area;
    result.unweighted += best.at(instance) / static_cast<double>(table.instance_area.size());
    area_sum += area;
  }
  result.weighted /= area_sum;
  return result;
}

SizedCoverage coverageOfSize(const OverlapTable& table, double least, double most) {
  SizedCoverage sized;
  for (const auto& [instance, overlap] : bestOverlaps(table)) {
    const int area = table.instance_area.at(instance);
    if (area < least || area > most) continue;
    ++sized.instances;
    sized.coverage += overlap;
    sized.over_half += overlap > 0.5 ? 1 : 0;
  }
  sized.coverage /= std::max(sized.instances, 1);
  sized.over_half /= std::max(sized.instances, 1);
  return sized;
}

int overSegmentedCount(const OverlapTable& table, double share) {
  std::map<int, int> parts;
  for (const auto& [pair, shared] : table.intersection) {
    if (shared >= share * table.instance_area.at(pair.first)) ++parts[pair.first];
  }
  return static_cast<int>(
      std::count_if(parts.begin(), parts.end(), [](const auto& p) { return p.second >= 2; }));
}

int underSegmentedCount(const OverlapTable& table, double share) {
  std::map<int, int> held;
  for (const auto& [pair, shared] : table.intersection) {
    if (shared >= share * table.instance_area.at(pair.first)) ++held[pair.second];
  }
  return static_cast<int>(
      std::count_if(held.begin(), held.end(), [](const auto& h) { return h.second >= 2; }));
}

}  // namespace scantrove
