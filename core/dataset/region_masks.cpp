#include "core/dataset/region_masks.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/dataset/color_outlines.h"

namespace scantrove {
namespace {

/// Maximum difference of measured depth and map on one surface: errors of half-centimetre voxels and poses,
/// and the noise of structured light, which grows with the square of the distance.
constexpr float kMapNoise_m = 0.01F;
constexpr float kSensorNoisePerMeter = 0.003F;
/// A steep surface may differ by this many pixels of its slope, up to a maximum.
constexpr float kSlope_px = 1.5F;
constexpr float kMaxSlope_m = 0.03F;
/// Maximum bias of a region's depth: a structured-light camera's grows with the distance.
constexpr float kMaxBias_m = 0.01F, kMaxBiasPerMeter = 0.015F;
constexpr std::size_t kMinBiasPixels = 30;
/// Maximum size of a hole without depth, as a part of the region around it, and the least part of the hole
/// that has no reading: through the handle of a mug the camera sees what is behind.
constexpr float kMaxHole = 0.5F, kMinUnknown = 0.7F;
/// Maximum error of the map's outlines: one and a half voxels, and the pose.
constexpr float kOutlineError_m = 0.02F;
constexpr int kMaxOutlineError_px = 16;
/// The map's resolution along an outline.
constexpr float kMapDetail_m = 0.006F;
constexpr int kMaxDetail_px = 6;
/// Maximum distance of the readings on both sides of an edge.
constexpr int kMixedReach_px = 3;
/// Pieces of fewer pixels, or smaller than the squared resolution of the map, are noise.
constexpr int kMinComponent_px = 8;

struct Offset {
  int x, y;
  float distance;
};

/// Nearest first, without the pixel itself.
std::vector<Offset> offsetsWithin(int radius) {
  std::vector<Offset> offsets;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const float distance = std::hypot(static_cast<float>(x), static_cast<float>(y));
      if (distance > 0 && distance <= static_cast<float>(radius)) offsets.push_back({x, y, distance});
    }
  }
  std::sort(offsets.begin(), offsets.end(), [](const Offset& a, const Offset& b) {
    return std::tie(a.distance, a.y, a.x) < std::tie(b.distance, b.y, b.x);
  });
  return offsets;
}

int pixelsOf(float length_m, float z_m, float focal_px, int most) {
  return std::clamp(static_cast<int>(std::lround(focal_px * length_m / std::max(z_m, 0.1F))), 1, most);
}

/// Tolerance between the map's depth and a measurement of the same surface, by pixel; CV_32FC1.
cv::Mat tolerances(const cv::Mat& depth_m) {
  cv::Mat result(depth_m.size(), CV_32FC1);
  const auto at = [&](int x, int y) {
    return depth_m.at<float>(std::clamp(y, 0, depth_m.rows - 1), std::clamp(x, 0, depth_m.cols - 1));
  };
  for (int y = 0; y < depth_m.rows; ++y) {
    for (int x = 0; x < depth_m.cols; ++x) {
      const float z = at(x, y);
      // The smaller of the two steps belongs to the surface, even beside an edge.
      const float slope = std::min(std::abs(at(x + 1, y) - z), std::abs(at(x - 1, y) - z)) +
                          std::min(std::abs(at(x, y + 1) - z), std::abs(at(x, y - 1) - z));
      result.at<float>(y, x) =
          kMapNoise_m + kSensorNoisePerMeter * z * z + std::min(kSlope_px * slope, kMaxSlope_m);
    }
  }
  return result;
}

class OutlineRefiner {
 public:
  OutlineRefiner(const ViewOfMap& map, const MeasuredView& measured, float focal_px)
      : map_(map),
        color_(measured.color),
        focal_px_(focal_px),
        tolerance_m_(tolerances(map.depth_m)),
        search_(offsetsWithin(kMaxOutlineError_px)),
        depth_m_(measured.depth_m.clone()),
        map_depth_m_(map.depth_m.clone()),
        regions_(map.regions.clone()) {}

  cv::Mat run() {
    removeBias();
    alignToDepth();
    alignToColor();
    dropSmallComponents();
    fillHoles();
    return regions_;
  }

 private:
  [[nodiscard]] bool agrees(int x, int y, float z) const {
    const float map_z = map_depth_m_.at<float>(y, x);
    return map_z > 0 && std::abs(map_z - z) <= tolerance_m_.at<float>(y, x);
  }
  [[nodiscard]] bool isInside(int x, int y) const {
    return x >= 0 && y >= 0 && x < regions_.cols && y < regions_.rows;
  }

  /// A camera's depth differs from the map by more than noise over a whole region: distances are biased, and
  /// the map is fused from nearer views. The median difference of a region belongs to it.
  void removeBias() {
    struct Differences {
      std::vector<float> small;  // those that may be a bias
      int all = 0;
    };
    std::unordered_map<int, Differences> by_region;
    for (int y = 0; y < regions_.rows; ++y) {
      for (int x = 0; x < regions_.cols; ++x) {
        const float z = depth_m_.at<float>(y, x), map_z = map_depth_m_.at<float>(y, x);
        if (!(z > 0) || !(map_z > 0)) continue;
        Differences& here = by_region[regions_.at<int>(y, x)];
        ++here.all;
        if (std::abs(z - map_z) <= kMaxBias_m + kMaxBiasPerMeter * map_z) here.small.push_back(z - map_z);
      }
    }
    std::unordered_map<int, float> bias_m;
    for (auto& [region, differences] : by_region) {
      std::vector<float>& small = differences.small;
      // Where most of a region differs by more, something else hides it.
      if (small.size() < kMinBiasPixels || 2 * static_cast<int>(small.size()) < differences.all) continue;
      const auto middle = small.begin() + static_cast<std::ptrdiff_t>(small.size() / 2);
      std::nth_element(small.begin(), middle, small.end());
      bias_m[region] = *middle;
    }
    for (int y = 0; y < regions_.rows; ++y) {
      for (int x = 0; x < regions_.cols; ++x) {
        float& map_z = map_depth_m_.at<float>(y, x);
        const auto found = map_z > 0 ? bias_m.find(regions_.at<int>(y, x)) : bias_m.end();
        if (found != bias_m.end()) map_z += found->second;
      }
    }
  }

  void alignToDepth() {
    std::vector<cv::Point> mixed;
    for (int y = 0; y < regions_.rows; ++y) {
      for (int x = 0; x < regions_.cols; ++x) {
        const float z = depth_m_.at<float>(y, x);
        if (!(z > 0) || agrees(x, y, z)) continue;
        const std::optional<int> region = nearestOfDepth(x, y, z);
        if (!region && isMixed(x, y, z)) {
          mixed.emplace_back(x, y);
        } else {
          regions_.at<int>(y, x) = region.value_or(0);
        }
      }
    }
    for (const cv::Point& point : mixed) depth_m_.at<float>(point) = 0;  // mixed depths are no readings
  }

  [[nodiscard]] std::optional<int> nearestOfDepth(int x, int y, float z) const {
    const auto radius = static_cast<float>(pixelsOf(kOutlineError_m, z, focal_px_, kMaxOutlineError_px));
    for (const Offset& offset : search_) {
      if (offset.distance > radius) break;
      const int u = x + offset.x, v = y + offset.y;
      if (isInside(u, v) && agrees(u, v, z)) return map_.regions.at<int>(v, u);
    }
    return std::nullopt;
  }

  /// Whether a reading mixes the depths in front of and behind an edge, as many cameras report there.
  [[nodiscard]] bool isMixed(int x, int y, float z) const {
    bool is_before = false, is_behind = false;
    for (int v = y - kMixedReach_px; v <= y + kMixedReach_px; ++v) {
      for (int u = x - kMixedReach_px; u <= x + kMixedReach_px; ++u) {
        if (!isInside(u, v)) continue;
        const float other = depth_m_.at<float>(v, u);
        is_before = is_before || (other > 0 && other < z - kMapNoise_m);
        is_behind = is_behind || other > z + kMapNoise_m;
      }
    }
    return is_before && is_behind;
  }

  [[nodiscard]] float depthAt(int x, int y) const {
    const float z = depth_m_.at<float>(y, x);
    return z > 0 ? z : map_.depth_m.at<float>(y, x);
  }

  void alignToColor() {
    if (color_.empty()) return;
    const cv::Mat unmeasured = depth_m_ <= 0;
    cv::Mat z_m = depth_m_.clone();
    map_.depth_m.copyTo(z_m, unmeasured);
    regions_ = followColorEdges(regions_, {color_, z_m, unmeasured, focal_px_});
  }

  /// Small pieces take the region around most of them.
  void dropSmallComponents() {
    cv::Mat visited = cv::Mat::zeros(regions_.size(), CV_8UC1);
    std::vector<cv::Point> piece;
    for (int y = 0; y < regions_.rows; ++y) {
      for (int x = 0; x < regions_.cols; ++x) {
        if (visited.at<std::uint8_t>(y, x) != 0) continue;
        const int around = collectPiece({x, y}, visited, piece);
        const int detail = pixelsOf(kMapDetail_m, depthAt(x, y), focal_px_, kMaxDetail_px);
        if (static_cast<int>(piece.size()) >= std::max(kMinComponent_px, detail * detail)) continue;
        for (const cv::Point& p : piece) regions_.at<int>(p) = around;
      }
    }
  }

  /// Where neither camera nor map has depth, as on a dark screen, what a region surrounds belongs to it.
  void fillHoles() {
    std::unordered_map<int, int> pixels;
    for (int y = 0; y < regions_.rows; ++y) {
      for (int x = 0; x < regions_.cols; ++x) ++pixels[regions_.at<int>(y, x)];
    }
    cv::Mat visited = regions_ != 0;
    std::vector<cv::Point> hole;
    for (int y = 0; y < regions_.rows; ++y) {
      for (int x = 0; x < regions_.cols; ++x) {
        if (visited.at<std::uint8_t>(y, x) != 0) continue;
        const int around = collectPiece({x, y}, visited, hole);
        if (!isFilled(hole, around, pixels[around])) continue;
        for (const cv::Point& p : hole) regions_.at<int>(p) = around;
      }
    }
  }

  /// `hole`: connected pixels without a region; `region`: most of them border on it; it has `pixels`.
  [[nodiscard]] bool isFilled(const std::vector<cv::Point>& hole, int region, int pixels) const {
    if (region == 0 || static_cast<float>(hole.size()) > kMaxHole * static_cast<float>(pixels)) return false;
    std::size_t unknown = 0;
    for (const cv::Point& p : hole) {
      if (p.x == 0 || p.y == 0 || p.x + 1 == regions_.cols || p.y + 1 == regions_.rows) return false;
      for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const int next = regions_.at<int>(p + step);
        if (next != 0 && next != region) return false;
      }
      if (!(depth_m_.at<float>(p) > 0)) ++unknown;
    }
    return static_cast<float>(unknown) >= kMinUnknown * static_cast<float>(hole.size());
  }

  /// All connected pixels of `start`'s region, and the region that borders on most of them (its own if
  /// there is none).
  [[nodiscard]] int collectPiece(const cv::Point& start, cv::Mat& visited,
                                 std::vector<cv::Point>& piece) const {
    const int region = regions_.at<int>(start);
    std::unordered_map<int, int> borders;
    piece.assign(1, start);
    visited.at<std::uint8_t>(start) = 255;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point next = piece[i] + step;
        if (!isInside(next.x, next.y)) continue;
        if (regions_.at<int>(next) != region) {
          ++borders[regions_.at<int>(next)];
        } else if (visited.at<std::uint8_t>(next) == 0) {
          visited.at<std::uint8_t>(next) = 255;
          piece.push_back(next);
        }
      }
    }
    const auto most = std::max_element(borders.begin(), borders.end(), [](const auto& a, const auto& b) {
      return std::pair(a.second, -a.first) < std::pair(b.second, -b.first);
    });
    return most == borders.end() ? region : most->first;
  }

  const ViewOfMap& map_;
  const cv::Mat& color_;
  float focal_px_;
  cv::Mat tolerance_m_;
  std::vector<Offset> search_;
  cv::Mat depth_m_;      // measured
  cv::Mat map_depth_m_;  // with each region's bias
  cv::Mat regions_;
};

}  // namespace

cv::Mat refineRegions(const ViewOfMap& map, const MeasuredView& measured, float focal_px) {
  SCANTROVE_CHECK(map.regions.type() == CV_32SC1 && map.depth_m.type() == CV_32FC1 &&
                  map.regions.size() == map.depth_m.size() && measured.depth_m.type() == CV_32FC1 &&
                  measured.depth_m.size() == map.regions.size());
  SCANTROVE_CHECK(measured.color.empty() ||
                  (measured.color.type() == CV_8UC3 && measured.color.size() == map.regions.size()));
  return OutlineRefiner(map, measured, focal_px).run();
}

}  // namespace scantrove
