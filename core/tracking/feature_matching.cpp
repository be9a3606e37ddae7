#include "core/tracking/feature_matching.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kFarthestBits = 64;  // of 256 that may differ between descriptors of one point
constexpr int kDescriptorBytes = 32;
/// How far, in parts of the image's width, a landmark may be seen from where the guess has it.
constexpr float kReach = 0.08F;
constexpr int kNobody = -1;

using Descriptor = std::array<std::uint64_t, kDescriptorBytes / sizeof(std::uint64_t)>;

std::vector<Descriptor> descriptorsOf(const cv::Mat& rows) {
  SCANTROVE_CHECK(rows.type() == CV_8UC1 && (rows.rows == 0 || rows.cols == kDescriptorBytes));
  std::vector<Descriptor> descriptors(static_cast<std::size_t>(rows.rows));
  for (int i = 0; i < rows.rows; ++i)
    std::memcpy(descriptors[static_cast<std::size_t>(i)].data(), rows.ptr(i), kDescriptorBytes);
  return descriptors;
}

int differentBits(const Descriptor& a, const Descriptor& b) {
  int bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i) bits += std::popcount(a[i] ^ b[i]);
  return bits;
}

/// The best partner that one has met; the first of equals.
struct Best {
  int partner = kNobody;
  int bits = std::numeric_limits<int>::max();

  void meet(int other, int different_bits) {
    if (different_bits >= bits) return;
    bits = different_bits;
    partner = other;
  }
};

class Matching {
 public:
  Matching(const ColorView& view, const Landmarks& landmarks)
      : features_(descriptorsOf(view.descriptors)),
        landmarks_(descriptorsOf(landmarks.descriptors)),
        of_feature_(features_.size()),
        of_landmark_(landmarks_.size()) {}

  [[nodiscard]] int features() const { return static_cast<int>(features_.size()); }
  [[nodiscard]] int landmarks() const { return static_cast<int>(landmarks_.size()); }

  void compare(int feature, int landmark) {
    const auto f = static_cast<std::size_t>(feature), l = static_cast<std::size_t>(landmark);
    const int bits = differentBits(features_[f], landmarks_[l]);
    of_feature_[f].meet(landmark, bits);
    of_landmark_[l].meet(feature, bits);
  }

  [[nodiscard]] std::vector<FeatureMatch> mutual() const {
    std::vector<FeatureMatch> matches;
    for (int feature = 0; feature < features(); ++feature) {
      const Best& best = of_feature_[static_cast<std::size_t>(feature)];
      if (best.partner == kNobody || best.bits > kFarthestBits) continue;
      if (of_landmark_[static_cast<std::size_t>(best.partner)].partner == feature)
        matches.push_back({feature, best.partner});
    }
    return matches;
  }

 private:
  std::vector<Descriptor> features_, landmarks_;
  std::vector<Best> of_feature_, of_landmark_;
};

/// The features of an image by square cells as wide as the reach.
class FeatureGrid {
 public:
  FeatureGrid(const ColorView& view, float reach_px)
      : reach_px_(reach_px),
        columns_(static_cast<int>(static_cast<float>(view.K.width) / reach_px) + 1),
        rows_(static_cast<int>(static_cast<float>(view.K.height) / reach_px) + 1),
        cells_(static_cast<std::size_t>(columns_ * rows_)) {
    for (std::size_t i = 0; i < view.pixels.size(); ++i)
      cells_[cellAt(columnOf(view.pixels[i].x), rowOf(view.pixels[i].y))].push_back(static_cast<int>(i));
  }

  /// Gives all features that may be in reach of `pixel`, which lies anywhere.
  template <class Give>
  void around(const cv::Point2f& pixel, Give&& give) const {
    for (int row = rowOf(pixel.y - reach_px_); row <= rowOf(pixel.y + reach_px_); ++row) {
      for (int column = columnOf(pixel.x - reach_px_); column <= columnOf(pixel.x + reach_px_); ++column) {
        for (const int feature : cells_[cellAt(column, row)]) give(feature);
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
  std::vector<std::vector<int>> cells_;
};

}  // namespace

std::vector<FeatureMatch> matchAll(const ColorView& view, const Landmarks& landmarks) {
  std::vector<cv::DMatch> found;
  if (view.descriptors.empty() || landmarks.descriptors.empty()) return {};
  cv::BFMatcher(cv::NORM_HAMMING, true).match(view.descriptors, landmarks.descriptors, found);
  std::vector<FeatureMatch> matches;
  for (const cv::DMatch& match : found) {
    if (match.distance <= kFarthestBits) matches.push_back({match.queryIdx, match.trainIdx});
  }
  return matches;
}

std::vector<FeatureMatch> matchNear(const ColorView& view, const Landmarks& landmarks,
                                    const Eigen::Isometry3d& T_world_depth) {
  const float reach_px = kReach * static_cast<float>(view.K.width);
  if (!(reach_px > 0)) return {};
  Matching matching(view, landmarks);
  const FeatureGrid grid(view, reach_px);
  const Eigen::Isometry3f T_color_world = (view.T_color_depth * T_world_depth.inverse()).cast<float>();
  for (int landmark = 0; landmark < matching.landmarks(); ++landmark) {
    const cv::Point3f& point = landmarks.points_world[static_cast<std::size_t>(landmark)];
    const Eigen::Vector3f p = T_color_world * Eigen::Vector3f(point.x, point.y, point.z);
    if (!(p.z() > 0.1F)) continue;
    const cv::Point2f expected(view.K.fx * p.x() / p.z() + view.K.cx, view.K.fy * p.y() / p.z() + view.K.cy);
    grid.around(expected, [&](int feature) {
      const cv::Point2f apart = view.pixels[static_cast<std::size_t>(feature)] - expected;
      if (apart.dot(apart) <= reach_px * reach_px) matching.compare(feature, landmark);
    });
  }
  return matching.mutual();
}

}  // namespace scantrove
