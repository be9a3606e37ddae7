#include "core/evaluation/average_precision.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

namespace scantrove {
namespace {

constexpr int kFirstPercent = 50;
constexpr int kLastPercent = 90;
constexpr int kStepPercent = 5;
constexpr int kLoosePercent = 25;

struct Shared {
  std::uint32_t id = 0;  // of the other side
  double iou = 0;
};

struct Prediction {
  double confidence = 0;
  double ignored_share = 0;  // of its points
  std::vector<Shared> instances;
};

/// Overlaps of a scene's predictions and true instances. Small predictions are left out.
struct SceneOverlaps {
  std::map<std::uint32_t, Prediction> predictions;
  std::map<std::uint32_t, std::vector<Shared>> instances;  // those that count, with their predictions
};

SceneOverlaps overlapsIn(const PointInstances& scene, int min_points) {
  std::map<std::uint32_t, int> predicted_points;
  std::map<std::uint32_t, int> true_points;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> shared_points;  // (prediction, instance or void)
  for (std::size_t i = 0; i < std::min(scene.predicted.size(), scene.truth.size()); ++i) {
    const std::uint32_t predicted = scene.predicted[i];
    const std::uint32_t instance = scene.truth[i];
    if (predicted != 0) ++predicted_points[predicted];
    if (instance != 0) ++true_points[instance];
    if (predicted != 0) ++shared_points[{predicted, instance}];
  }
  SceneOverlaps overlaps;
  for (const auto& [id, points] : true_points) {
    if (points >= min_points) overlaps.instances[id] = {};
  }
  for (const auto& [id, points] : predicted_points) {
    if (points < min_points) continue;
    const auto known = scene.confidence.find(id);
    overlaps.predictions[id].confidence = known != scene.confidence.end() ? known->second : points;
  }
  for (const auto& [pair, shared] : shared_points) {
    const auto [id, instance] = pair;
    const auto prediction = overlaps.predictions.find(id);
    if (prediction == overlaps.predictions.end()) continue;
    const int points = predicted_points.at(id);
    const auto counted = overlaps.instances.find(instance);
    if (counted == overlaps.instances.end())
      prediction->second.ignored_share += static_cast<double>(shared) / points;
    if (instance == 0) continue;
    const double iou = static_cast<double>(shared) / (true_points.at(instance) + points - shared);
    prediction->second.instances.push_back({instance, iou});
    if (counted != overlaps.instances.end()) counted->second.push_back({id, iou});
  }
  return overlaps;
}

struct RankedPrediction {
  double confidence = 0;
  bool is_true = false;
};

/// Appends the judged predictions of a scene. A prediction belongs to the first instance that it matches, as
/// in ScanNet's script; from a threshold of 0.5 on it matches at most one.
void judgeScene(const SceneOverlaps& scene, double threshold, std::vector<RankedPrediction>& ranked) {
  std::set<std::uint32_t> used;
  for (const auto& [instance, predictions] : scene.instances) {
    std::optional<double> best;
    for (const Shared& shared : predictions) {
      if (shared.iou <= threshold || used.contains(shared.id)) continue;
      const double confidence = scene.predictions.at(shared.id).confidence;
      if (!best) {
        used.insert(shared.id);
        best = confidence;
        continue;
      }
      ranked.push_back({std::min(*best, confidence), false});
      best = std::max(*best, confidence);
    }
    if (best) ranked.push_back({*best, true});
  }
  for (const auto& [id, prediction] : scene.predictions) {
    const bool is_matched = std::any_of(prediction.instances.begin(), prediction.instances.end(),
                                        [&](const Shared& shared) { return shared.iou > threshold; });
    if (!is_matched && prediction.ignored_share <= threshold)
      ranked.push_back({prediction.confidence, false});
  }
}

struct PrecisionRecall {
  double precision = 1;
  double recall = 0;
};

/// The curve from the most confident predictions on, one point per confidence, after the point of none.
std::vector<PrecisionRecall> curveOf(std::vector<RankedPrediction> ranked, int instances) {
  std::sort(ranked.begin(), ranked.end(),
            [](const RankedPrediction& a, const RankedPrediction& b) { return a.confidence > b.confidence; });
  std::vector<PrecisionRecall> curve{{}};
  int found = 0;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    if (ranked[i].is_true) ++found;
    if (i + 1 < ranked.size() && ranked[i + 1].confidence == ranked[i].confidence) continue;
    curve.push_back({found / static_cast<double>(i + 1), static_cast<double>(found) / instances});
  }
  return curve;
}

/// ScanNet weights a precision by half the difference of the recalls before and after it.
double areaUnder(const std::vector<PrecisionRecall>& curve) {
  double area = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double before = i > 0 ? curve[i - 1].recall : 0;
    const double after = curve[std::min(i + 1, curve.size() - 1)].recall;
    area += curve[i].precision * (after - before) / 2;
  }
  return area;
}

double averagePrecisionAt(int threshold_percent, const std::vector<SceneOverlaps>& scenes, int instances) {
  std::vector<RankedPrediction> ranked;
  for (const SceneOverlaps& scene : scenes) judgeScene(scene, threshold_percent / 100.0, ranked);
  return areaUnder(curveOf(std::move(ranked), instances));
}

}  // namespace

AveragePrecision averagePrecision(std::span<const PointInstances> scenes, int min_points) {
  std::vector<SceneOverlaps> overlaps;
  AveragePrecision result;
  for (const PointInstances& scene : scenes) {
    overlaps.push_back(overlapsIn(scene, min_points));
    result.instances += static_cast<int>(overlaps.back().instances.size());
    result.predictions += static_cast<int>(overlaps.back().predictions.size());
  }
  if (result.instances == 0) return result;
  double sum = 0;
  int thresholds = 0;
  for (int percent = kFirstPercent; percent <= kLastPercent; percent += kStepPercent) {
    sum += averagePrecisionAt(percent, overlaps, result.instances);
    ++thresholds;
  }
  result.ap = sum / thresholds;
  result.ap50 = averagePrecisionAt(kFirstPercent, overlaps, result.instances);
  result.ap25 = averagePrecisionAt(kLoosePercent, overlaps, result.instances);
  return result;
}

}  // namespace scantrove
