#include "core/evaluation/catalogue_metrics.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/capture/intrinsics.h"
#include "core/evaluation/label_grid.h"

namespace scantrove {
namespace {

constexpr double kCompleteOverlap = 0.6;
constexpr double kBackgroundShare = 0.5;
constexpr double kPartShare = 0.75;
constexpr double kNamedShare = 0.15;
constexpr double kCompleteViews = 0.8;
constexpr double kVisible_px = 400;
constexpr int kVisibleFrames = 30;
constexpr double kSmallest_m = 0.05;
constexpr double kLargest_m = 0.60;

struct MaskOverlaps {
  int mask_area = 0;
  std::map<int, int> shared;  // pixels of the mask by instance, 0 = not annotated
};

MaskOverlaps overlapsOf(const cv::Mat& mask, const cv::Rect& box, const cv::Mat1i& truth) {
  cv::Mat fitted = mask;
  if (mask.size() != box.size()) cv::resize(mask, fitted, box.size(), 0, 0, cv::INTER_NEAREST);
  MaskOverlaps overlaps;
  for (int y = 0; y < box.height; ++y) {
    for (int x = 0; x < box.width; ++x) {
      const cv::Point there(box.x + x, box.y + y);
      if (fitted.at<std::uint8_t>(y, x) == 0 || !there.inside({0, 0, truth.cols, truth.rows})) continue;
      ++overlaps.mask_area;
      ++overlaps.shared[truth(there)];
    }
  }
  return overlaps;
}

/// Instances above the minimum share, largest first.
std::vector<int> namedInstances(const MaskOverlaps& overlaps) {
  std::vector<std::pair<int, int>> by_share;
  for (const auto& [instance, pixels] : overlaps.shared) {
    if (instance != 0 && pixels >= kNamedShare * overlaps.mask_area) by_share.emplace_back(-pixels, instance);
  }
  std::sort(by_share.begin(), by_share.end());
  std::vector<int> instances;
  instances.reserve(by_share.size());
  for (const auto& [pixels, instance] : by_share) instances.push_back(instance);
  return instances;
}

}  // namespace

ViewJudgment judgeView(const cv::Mat& mask, const cv::Rect& box, const cv::Mat& truth,
                       const std::set<int>& objects) {
  if (mask.empty() || box.empty()) return {};
  const cv::Mat1i instances = toLabelGrid(truth);
  const MaskOverlaps overlaps = overlapsOf(mask, box, instances);
  int main_object = 0;
  int main_pixels = 0;
  int object_pixels = 0;
  for (const auto& [instance, pixels] : overlaps.shared) {
    if (!objects.contains(instance)) continue;
    object_pixels += pixels;
    if (pixels > main_pixels) {
      main_object = instance;
      main_pixels = pixels;
    }
  }
  cv::Mat visible;
  cv::compare(instances, main_object, visible, cv::CMP_EQ);
  const int united = overlaps.mask_area + cv::countNonZero(visible) - main_pixels;
  if (main_pixels > kCompleteOverlap * united) return {CatalogueVerdict::complete, {main_object}};
  if (overlaps.mask_area - object_pixels >= kBackgroundShare * overlaps.mask_area) {
    return {CatalogueVerdict::background, namedInstances(overlaps)};
  }
  if (main_pixels >= kPartShare * overlaps.mask_area) return {CatalogueVerdict::part, {main_object}};
  return {CatalogueVerdict::merger, namedInstances(overlaps)};
}

EntryJudgment judgeEntry(std::span<const ViewJudgment> views) {
  using Kind = std::pair<CatalogueVerdict, std::vector<int>>;
  std::map<Kind, int> counts;
  for (const ViewJudgment& view : views) ++counts[{view.verdict, view.instances}];
  EntryJudgment entry;
  entry.views = static_cast<int>(views.size());
  int most_others = 0;
  Kind others;
  Kind complete;
  for (const auto& [kind, count] : counts) {
    if (kind.first == CatalogueVerdict::complete && count > entry.complete_views) {
      entry.complete_views = count;
      complete = kind;
    } else if (kind.first != CatalogueVerdict::complete && count > most_others) {
      most_others = count;
      others = kind;
    }
  }
  const bool is_complete = entry.views > 0 && entry.complete_views >= kCompleteViews * entry.views;
  if (!is_complete && most_others == 0 && entry.views > 0) {  // complete views, but of different objects
    for (const auto& [kind, count] : counts) others.second.push_back(kind.second.front());
    others.first = CatalogueVerdict::merger;
  }
  if (entry.views > 0) std::tie(entry.verdict, entry.instances) = is_complete ? complete : others;
  return entry;
}

bool shouldBeFound(const TrueObject& object) {
  return object.frames >= kVisibleFrames && object.extent_m >= kSmallest_m && object.extent_m <= kLargest_m;
}

bool wasSeenEntirely(const TrueObject& object) {
  return shouldBeFound(object) && object.entire_frames >= kVisibleFrames;
}

void countVisible(const cv::Mat& truth, std::map<int, TrueObject>& objects) {
  const cv::Mat1i instances = toLabelGrid(truth);
  const double enough = kVisible_px * static_cast<double>(instances.total()) / kReferencePixels;
  struct Extent {
    int pixels = 0;
    bool is_cut = false;
  };
  std::map<int, Extent> extents;
  for (int y = 0; y < instances.rows; ++y) {
    for (int x = 0; x < instances.cols;) {
      const int from = x;
      const int instance = instances(y, x);
      while (x < instances.cols && instances(y, x) == instance) ++x;
      Extent& extent = extents[instance];
      extent.pixels += x - from;
      extent.is_cut = extent.is_cut || y == 0 || y == instances.rows - 1 || from == 0 || x == instances.cols;
    }
  }
  for (const auto& [instance, extent] : extents) {
    const auto object = objects.find(instance);
    if (object == objects.end() || extent.pixels < enough) continue;
    ++object->second.frames;
    if (!extent.is_cut) ++object->second.entire_frames;
  }
}

CatalogueMetrics evaluateCatalogue(std::span<const EntryJudgment> entries,
                                   const std::map<int, TrueObject>& objects) {
  CatalogueMetrics metrics;
  std::set<int> found;
  for (const EntryJudgment& entry : entries) {
    ++metrics.entries;
    if (entry.verdict != CatalogueVerdict::complete) continue;
    ++metrics.complete;
    if (!found.insert(entry.instances.front()).second) ++metrics.duplicates;
  }
  double found_entirely = 0;
  for (const auto& [instance, object] : objects) {
    if (!shouldBeFound(object)) continue;
    ++metrics.expected;
    if (!found.contains(instance)) metrics.missing.push_back(instance);
    if (!wasSeenEntirely(object)) continue;
    ++metrics.seen_entirely;
    if (found.contains(instance)) ++found_entirely;
  }
  metrics.purity = metrics.entries > 0 ? static_cast<double>(metrics.complete) / metrics.entries : 0;
  const double missing = static_cast<double>(metrics.missing.size());
  metrics.completeness = metrics.expected > 0 ? 1 - missing / metrics.expected : 0;
  metrics.completeness_of_entire = metrics.seen_entirely > 0 ? found_entirely / metrics.seen_entirely : 0;
  return metrics;
}

}  // namespace scantrove
