#include "core/tracking/feature_matching.h"

#include <algorithm>
#include <limits>

#include "core/tracking/descriptor_bits.h"
#include "core/tracking/landmark_term.h"

namespace scantrove {
namespace {

constexpr int kFarthestBits = 64;  // of 256 that may differ between descriptors of the same point
/// Largest distance between a landmark and its predicted pixel, as part of the image's width.
constexpr float kReach = 0.08F;
constexpr int kNobody = -1;

/// The most similar partner so far; the first of equals.
struct Best {
  int partner = kNobody;
  int bits = std::numeric_limits<int>::max();

  void meet(int other, int different_bits) {
    if (different_bits >= bits) return;
    bits = different_bits;
    partner = other;
  }
};

/// Collects compared pairs and finds mutual best matches.
class Matching {
 public:
  Matching(std::size_t features, std::size_t landmarks) : of_feature_(features), of_landmark_(landmarks) {}

  void compare(std::size_t feature, std::size_t landmark, int different_bits) {
    of_feature_[feature].meet(static_cast<int>(landmark), different_bits);
    of_landmark_[landmark].meet(static_cast<int>(feature), different_bits);
  }

  [[nodiscard]] std::vector<FeatureMatch> mutual() const {
    std::vector<FeatureMatch> matches;
    for (std::size_t feature = 0; feature < of_feature_.size(); ++feature) {
      const Best& best = of_feature_[feature];
      if (best.partner == kNobody || best.bits > kFarthestBits) continue;
      if (of_landmark_[static_cast<std::size_t>(best.partner)].partner == static_cast<int>(feature))
        matches.push_back({static_cast<int>(feature), best.partner, best.bits});
    }
    return matches;
  }

 private:
  std::vector<Best> of_feature_, of_landmark_;
};

/// The features of an image in square cells as wide as the reach.
class FeatureGrid {
 public:
  FeatureGrid(const ColorView& view, float reach_px)
      : reach_px_(reach_px),
        columns_(static_cast<int>(static_cast<float>(view.K.width) / reach_px) + 1),
        rows_(static_cast<int>(static_cast<float>(view.K.height) / reach_px) + 1),
        cells_(static_cast<std::size_t>(columns_ * rows_)) {
    for (std::size_t i = 0; i < view.pixels.size(); ++i)
      cells_[cellAt(columnOf(view.pixels[i].x), rowOf(view.pixels[i].y))].push_back(i);
  }

  /// Calls `give` with all features that may be in reach of `pixel`, which may be outside the image.
  template <class Give>
  void around(const cv::Point2f& pixel, Give&& give) const {
    for (int row = rowOf(pixel.y - reach_px_); row <= rowOf(pixel.y + reach_px_); ++row) {
      for (int column = columnOf(pixel.x - reach_px_); column <= columnOf(pixel.x + reach_px_); ++column) {
        for (const std::size_t feature : cells_[cellAt(column, row)]) give(feature);
      }
    }
  }

 private:
  [[nodiscard]] int placeOf(float px, int count) const {
    return static_cast<int>(std::clamp(px / reach_px_, 0.0F, static_cast<float>(count - 1)));
  }
  [[nodiscard]] int columnOf(float x) const { return placeOf(x, columns_); }
  [[nodiscard]] int rowOf(float y) const { return placeOf(y, rows_); }
  [[nodiscard]] std::size_t cellAt(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  float reach_px_;
  int columns_, rows_;
  std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace

std::vector<FeatureMatch> matchAll(const cv::Mat& features, const Landmarks& landmarks) {
  const std::vector<Descriptor> seen = descriptorsOf(features), known = descriptorsOf(landmarks.descriptors);
  Matching matching(seen.size(), known.size());
  std::vector<int> bits(known.size());
  for (std::size_t feature = 0; feature < seen.size(); ++feature) {
    countDifferentBits(seen[feature], known, bits);
    for (std::size_t landmark = 0; landmark < known.size(); ++landmark)
      matching.compare(feature, landmark, bits[landmark]);
  }
  return matching.mutual();
}

std::vector<FeatureMatch> matchNear(const ColorView& view, const Landmarks& landmarks,
                                    const Eigen::Isometry3d& T_world_depth) {
  const float reach_px = kReach * static_cast<float>(view.K.width);
  if (!(reach_px > 0)) return {};
  const std::vector<Descriptor> seen = descriptorsOf(view.descriptors),
                                known = descriptorsOf(landmarks.descriptors);
  Matching matching(seen.size(), known.size());
  const FeatureGrid grid(view, reach_px);
  const Eigen::Isometry3f T_color_world = (view.T_color_depth * T_world_depth.inverse()).cast<float>();
  std::vector<std::size_t> near;
  std::vector<Descriptor> of_near;
  std::vector<int> bits;
  for (std::size_t landmark = 0; landmark < known.size(); ++landmark) {
    const cv::Point3f& point = landmarks.points_world[landmark];
    const Eigen::Vector3f p = T_color_world * Eigen::Vector3f(point.x, point.y, point.z);
    if (!(p.z() > kNearestLandmark_m)) continue;
    const cv::Point2f expected(view.K.fx * p.x() / p.z() + view.K.cx, view.K.fy * p.y() / p.z() + view.K.cy);
    near.clear();
    of_near.clear();
    grid.around(expected, [&](std::size_t feature) {
      const cv::Point2f apart = view.pixels[feature] - expected;
      if (apart.dot(apart) > reach_px * reach_px) return;
      near.push_back(feature);
      of_near.push_back(seen[feature]);
    });
    bits.resize(near.size());
    countDifferentBits(known[landmark], of_near, bits);
    for (std::size_t i = 0; i < near.size(); ++i) matching.compare(near[i], landmark, bits[i]);
  }
  return matching.mutual();
}

}  // namespace scantrove
