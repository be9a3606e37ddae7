#include "core/segmentation/support_finder.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

constexpr double kMinPlanePart = 0.08;  // of the image: smaller planes may be faces of objects
constexpr double kMinPlanar = 0.75;     // part of a segment that lies in one plane
constexpr double kBowedPart = 0.1;  // smaller ones do not show the bow of the lens, and would follow objects
constexpr double kKnownPart = 0.5;  // part of a segment in an earlier support: it is a piece of that
constexpr int kStride = 2;          // pixels
constexpr int kBridge_px = 3;       // gaps between pieces of the plane, in strides
constexpr double kMinCarried = 1 / 4000.0;  // of the image: smaller raised parts may be noise
constexpr double kCarriedTouching = 0.7;    // part of a raised part's outline that borders on the plane

class Finder {
 public:
  Finder(const SegmentMap& segments, const Intrinsics& K, const SupportLimits& limits)
      : segments_(segments),
        K_(K),
        limits_(limits),
        size_(segments.width / kStride, segments.height / kStride),
        z_(size_),
        id_(size_),
        height_(size_),
        known_(segments.areas.size(), 0) {
    for (int v = 0; v < size_.height; ++v) {
      for (int u = 0; u < size_.width; ++u) {
        const std::size_t pixel = K.indexOf(kStride * u, kStride * v);
        z_(v, u) = segments.depths_m[pixel];
        id_(v, u) = static_cast<int>(segments.ids[pixel]);
      }
    }
  }

  std::vector<Support> find() {
    std::vector<Support> supports;
    std::vector<std::uint32_t> order(segments_.areas.size());
    std::iota(order.begin(), order.end(), 0U);
    const double least = kMinPlanePart * K_.pixels();
    std::erase_if(order, [&](std::uint32_t id) { return id == 0 || segments_.areas[id] < least; });
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::uint32_t id) { return segments_.areas[id]; });
    for (const std::uint32_t id : order) {
      constexpr int kPixelsOfStride = kStride * kStride;
      if (kPixelsOfStride * known_[id] > kKnownPart * segments_.areas[id]) continue;
      if (const auto surface = planeOf(id)) addSupport(id, *surface, supports);
    }
    return supports;
  }

 private:
  [[nodiscard]] float xOf(int u) const { return (static_cast<float>(kStride * u) - K_.cx) / K_.fx; }
  [[nodiscard]] float yOf(int v) const { return (static_cast<float>(kStride * v) - K_.cy) / K_.fy; }

  [[nodiscard]] std::optional<InverseDepthSurface> planeOf(std::uint32_t id) {
    samples_.clear();
    for (int v = 0; v < size_.height; v += 2) {
      for (int u = 0; u < size_.width; u += 2)
        if (id_(v, u) == static_cast<int>(id) && z_(v, u) > 0) samples_.push_back({xOf(u), yOf(v), z_(v, u)});
    }
    const bool bowed = segments_.areas[id] > kBowedPart * K_.pixels();
    auto surface = InverseDepthSurface::fit(samples_, limits_.flat_m, bowed);
    if (!surface) return std::nullopt;
    const auto planar = std::ranges::count_if(samples_, [&](const InverseDepthSurface::Sample& sample) {
      const float height_m = surface->height(sample.x, sample.y, sample.z_m);
      return std::abs(height_m) < limits_.flat_m * SupportLimits::growth(sample.z_m);
    });
    if (static_cast<double>(planar) < kMinPlanar * static_cast<double>(samples_.size())) return std::nullopt;
    return surface;
  }

  void addSupport(std::uint32_t id, const InverseDepthSurface& surface, std::vector<Support>& supports) {
    cv::Mat1b flat(size_, 0);
    for (int v = 0; v < size_.height; ++v) {
      const float y = yOf(v);
      for (int u = 0; u < size_.width; ++u) {
        const float z = z_(v, u);
        if (!(z > 0)) continue;
        const float height_m = surface.height(xOf(u), y, z);
        height_(v, u) = height_m;
        if (std::abs(height_m) < limits_.flat_m * SupportLimits::growth(z)) flat(v, u) = 255;
      }
    }
    keepPartOf(flat, id);
    for (int v = 0; v < size_.height; ++v)
      for (int u = 0; u < size_.width; ++u)
        if (flat(v, u) != 0) ++known_[static_cast<std::size_t>(id_(v, u))];
    const cv::Mat1b area = outlineOf(flat);
    if (!carries(flat, area)) return;
    Support support{surface, id, {}, {}};
    cv::resize(area, support.area, {segments_.width, segments_.height}, 0, 0, cv::INTER_NEAREST);
    support.box = cv::boundingRect(support.area);
    supports.push_back(std::move(support));
  }

  /// Keeps the component of `flat` that holds most of the segment.
  void keepPartOf(cv::Mat1b& flat, std::uint32_t id) const {
    cv::Mat1b closed;
    cv::morphologyEx(flat, closed, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_RECT, {kBridge_px, kBridge_px}));
    cv::Mat1i components;
    const int count = cv::connectedComponents(closed, components, 4);
    std::vector<int> votes(static_cast<std::size_t>(count), 0);
    for (int v = 0; v < size_.height; ++v) {
      for (int u = 0; u < size_.width; ++u)
        if (flat(v, u) != 0 && id_(v, u) == static_cast<int>(id))
          ++votes[static_cast<std::size_t>(components(v, u))];
    }
    votes[0] = 0;
    const auto main = static_cast<int>(std::ranges::max_element(votes) - votes.begin());
    flat.setTo(0, components != main);
  }

  /// The convex outline of the plane's surface, without what is seen past its edge.
  [[nodiscard]] cv::Mat1b outlineOf(const cv::Mat1b& flat) const {
    cv::Mat1b area(size_, 0);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(flat.clone(), contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    std::vector<cv::Point> points, hull;
    for (const auto& contour : contours) points.insert(points.end(), contour.begin(), contour.end());
    if (points.empty()) return area;
    cv::convexHull(points, hull);
    cv::fillConvexPoly(area, hull, 255);
    for (int v = 0; v < size_.height; ++v) {
      for (int u = 0; u < size_.width; ++u) {
        const float z = z_(v, u);
        if (z > 0 && height_(v, u) < -limits_.behind_m * SupportLimits::growth(z)) area(v, u) = 0;
      }
    }
    return area;
  }

  /// True if some part of the surface rises from the plane and touches it nearly all around.
  [[nodiscard]] bool carries(const cv::Mat1b& flat, const cv::Mat1b& area) const {
    cv::Mat1b raised(size_, 0);
    for (int v = 0; v < size_.height; ++v) {
      for (int u = 0; u < size_.width; ++u) {
        const float z = z_(v, u);
        const bool is_raised = z > 0 && area(v, u) != 0 &&
                               height_(v, u) > limits_.raised_m * SupportLimits::growth(z) &&
                               height_(v, u) < limits_.most_m;
        if (is_raised) raised(v, u) = 255;
      }
    }
    cv::Mat1i parts, stats;
    cv::Mat centroids;
    const int count = cv::connectedComponentsWithStats(raised, parts, stats, centroids, 4);
    std::vector<int> outline(static_cast<std::size_t>(count), 0),
        touching(static_cast<std::size_t>(count), 0);
    constexpr int kLook = 2;  // pixels off, past the mixed ones of an edge
    for (int v = kLook; v < size_.height - kLook; ++v) {
      for (int u = kLook; u < size_.width - kLook; ++u) {
        if (parts(v, u) == 0) continue;
        for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
          if (parts(v + dy, u + dx) == parts(v, u)) continue;
          const auto part = static_cast<std::size_t>(parts(v, u));
          ++outline[part];
          const bool touches = flat(v + dy, u + dx) != 0 || flat(v + kLook * dy, u + kLook * dx) != 0;
          touching[part] += touches || !(z_(v + dy, u + dx) > 0) ? 1 : 0;
        }
      }
    }
    const double least = kMinCarried * size_.area();
    for (int part = 1; part < count; ++part) {
      const auto index = static_cast<std::size_t>(part);
      if (stats(part, cv::CC_STAT_AREA) >= least && touching[index] >= kCarriedTouching * outline[index])
        return true;
    }
    return false;
  }

  const SegmentMap& segments_;
  const Intrinsics& K_;
  const SupportLimits limits_;
  const cv::Size size_;  // in strides, like the images
  cv::Mat1f z_;
  cv::Mat1i id_;
  cv::Mat1f height_;        // above the plane at hand, where there is depth
  std::vector<int> known_;  // pixels of each segment in planes so far, in strides
  std::vector<InverseDepthSurface::Sample> samples_;
};

}  // namespace

std::vector<Support> findSupports(const SegmentMap& segments, const Intrinsics& K,
                                  const SupportLimits& limits) {
  return Finder(segments, K, limits).find();
}

}  // namespace scantrove
