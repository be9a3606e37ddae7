#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/discovery/candidate_finder.h"
#include "core/discovery/region_census.h"
#include "core/discovery/region_set.h"

namespace scantrove {

/// Offsets to a pixel's four neighbours.
inline constexpr std::array<std::array<int, 2>, 4> kFourNeighbors{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// The pixels of some regions in an image.
class SetPixels {
 public:
  /// `box_px` holds all of them. `regions` and `input` must outlive this.
  SetPixels(const RegionSet& regions, const cv::Rect& box_px, const DiscoveryInput& input)
      : regions_(regions), box_px_(box_px), input_(input) {}

  [[nodiscard]] bool isInside(int u, int v) const { return input_.view.K.isInside(u, v); }
  [[nodiscard]] std::size_t at(int u, int v) const { return input_.view.K.indexOf(u, v); }
  /// False outside the image.
  [[nodiscard]] bool contains(int u, int v) const {
    if (!isInside(u, v)) return false;
    const RegionId region = input_.regions[at(u, v)];
    return region && regions_.contains(region);
  }
  /// Each pixel, row by row.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (int v = box_px_.y; v < box_px_.br().y; ++v) {
      for (int u = box_px_.x; u < box_px_.br().x; ++u) {
        if (contains(u, v)) visit(u, v);
      }
    }
  }

 private:
  const RegionSet& regions_;
  cv::Rect box_px_;
  const DiscoveryInput& input_;
};

/// Normalised pixel coordinates along the regions' longer axis (x) and across it (y). The origin is their
/// centroid; 1 is the largest distance of a pixel on that axis, at least 1 pixel.
class SetAxes {
 public:
  /// `extent`: of all the regions together.
  SetAxes(const SetPixels& pixels, const RegionExtent& extent)
      : middle_(static_cast<float>(extent.centroidU()), static_cast<float>(extent.centroidV())),
        longer_(static_cast<float>(std::cos(extent.orientation())),
                static_cast<float>(std::sin(extent.orientation()))) {
    pixels.forEach([&](int u, int v) { half_ = half_.cwiseMax(turned(u, v).cwiseAbs()); });
  }

  /// Direction of the longer axis.
  [[nodiscard]] const Eigen::Vector2f& longer() const { return longer_; }
  [[nodiscard]] Eigen::Vector2f operator()(int u, int v) const { return turned(u, v).cwiseQuotient(half_); }

 private:
  [[nodiscard]] Eigen::Vector2f turned(int u, int v) const {
    const Eigen::Vector2f from_middle = Eigen::Vector2i(u, v).cast<float>() - middle_;
    return {longer_.dot(from_middle), longer_.x() * from_middle.y() - longer_.y() * from_middle.x()};
  }
  Eigen::Vector2f middle_, longer_;
  Eigen::Vector2f half_ = Eigen::Vector2f::Ones();
};

}  // namespace scantrove
