#include "core/catalogue/match_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/base/check.h"

namespace scantrove {
namespace {

// Chosen on crops of 41 household things (HOTS: 3 views each, queries from other scenes), and checked on one
// half of the things with the limit of the other: with 1 % false names 0.44 of the crops are named, with
// thumbnails alone 0.32. A logistic fit gives the histogram 1.3 to 2.4 times the weight of the shape; three
// times is best at few false names. The sum keeps the scale of the thumbnails alone, on which the limits of
// recognition were measured.
constexpr float kShape = 0.5F, kColors = 1.5F;

/// Sizes of one thing in two photographs differ by 0.12 (median), and by up to 0.5 in nine of ten; in scans
/// by less than 0.3. What goes far beyond that contradicts any appearance.
constexpr float kSize = 0.2F, kOtherSize = 2, kSizeOfNoise = 0.9F;
/// Thinner sides are mostly noise.
constexpr float kThinnest_m = 0.03F;

/// Part of the mean over the three nearest views in an object's distance. With 1 % false names it names 0.38
/// of the crops; the nearest view alone names 0.31.
constexpr float kMeanOfViews = 0.2F;
constexpr std::size_t kNearestViews = 3;

/// The usual distance of the five nearest other objects: their median among 41 things.
constexpr float kUsualOther = 1;
constexpr std::size_t kRunnersUp = 5;
/// Duplicates of one object in the catalogue do not make it unrecognisable.
constexpr float kLeastOther = 0.1F;
/// Distance of unrelated pictures. More is due to the size.
constexpr float kFarthestOther = 2;

/// Mean of the smallest `most` values, which it sorts.
float meanOfSmallest(std::vector<float>& values, std::size_t most) {
  const std::size_t count = std::min(values.size(), most);
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(count);
  std::partial_sort(values.begin(), end, values.end());
  return std::accumulate(values.begin(), end, 0.0F) / static_cast<float>(count);
}

float logRatio(float a_m, float b_m) { return std::abs(std::log(a_m / b_m)); }

}  // namespace

float sizeDifference(const Eigen::Vector3f& a_m, const Eigen::Vector3f& b_m) {
  if (!(a_m.norm() > 0) || !(b_m.norm() > 0)) return 0;
  float sides = 0;
  for (int i = 0; i < 3; ++i)
    sides += logRatio(std::max(a_m[i], kThinnest_m), std::max(b_m[i], kThinnest_m)) / 3;
  return (logRatio(a_m.norm(), b_m.norm()) + sides) / 2;
}

float thumbnailDistance(const ViewDifference& difference) { return difference.shape + difference.mean_color; }

float matchDistance(const ViewDifference& difference) {
  float distance = difference.colors ? kShape * difference.shape + kColors * *difference.colors
                                     : thumbnailDistance(difference);
  // A network is trained on other things than these, so it counts as much as all the rest.
  if (difference.network) distance = (distance + *difference.network) / 2;
  return distance + kSize * difference.size + kOtherSize * std::max(difference.size - kSizeOfNoise, 0.0F);
}

MatchWeights matchWeights(bool has_colors) {
  return {has_colors ? kShape : 1, has_colors ? kColors : 0, kSize, kOtherSize, kSizeOfNoise};
}

float objectDistance(std::vector<float> views) {
  SCANTROVE_CHECK(!views.empty());
  const float mean = meanOfSmallest(views, kNearestViews);  // sorts them
  return (1 - kMeanOfViews) * views.front() + kMeanOfViews * mean;
}

float relativeDistance(float distance, std::vector<float> others, int objects) {
  const int missing = std::max(kObjectsToCompare - std::max(objects, 1), 0);
  others.insert(others.end(), static_cast<std::size_t>(missing), kUsualOther);
  if (others.empty()) return distance;
  for (float& other : others) other = std::min(other, kFarthestOther);
  return distance / std::sqrt(std::max(meanOfSmallest(others, kRunnersUp), kLeastOther) / kUsualOther);
}

}  // namespace scantrove
