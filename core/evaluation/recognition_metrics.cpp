#include "core/evaluation/recognition_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace scantrove {
namespace {

double shareOf(std::ptrdiff_t count, std::span<const RecognitionTrial> trials) {
  return trials.empty() ? 0 : static_cast<double>(count) / static_cast<double>(trials.size());
}

/// The largest limit below which at most `most` of the distances lie.
float limitOf(std::vector<float> distances, std::size_t most) {
  if (distances.size() <= most) return std::numeric_limits<float>::infinity();
  const auto last = distances.begin() + static_cast<std::ptrdiff_t>(most);
  std::ranges::nth_element(distances, last);
  return *last;
}

}  // namespace

double nearestRight(std::span<const RecognitionTrial> trials) {
  return shareOf(std::ranges::count_if(trials, &RecognitionTrial::is_right), trials);
}

RecognitionRates ratesAt(std::span<const RecognitionTrial> trials, float limit) {
  const auto share = [&](auto&& is_counted) {
    return shareOf(std::ranges::count_if(trials, is_counted), trials);
  };
  return {share([=](const RecognitionTrial& trial) { return trial.is_right && trial.distance < limit; }),
          share([=](const RecognitionTrial& trial) { return !trial.is_right && trial.distance < limit; }),
          share([=](const RecognitionTrial& trial) { return trial.distance_without < limit; })};
}

float limitFor(std::span<const RecognitionTrial> trials, double most_false) {
  const auto most = static_cast<std::size_t>(std::floor(most_false * static_cast<double>(trials.size())));
  std::vector<float> wrong, unknown;
  for (const RecognitionTrial& trial : trials) {
    if (!trial.is_right) wrong.push_back(trial.distance);
    unknown.push_back(trial.distance_without);
  }
  return std::min(limitOf(std::move(wrong), most), limitOf(std::move(unknown), most));
}

}  // namespace scantrove
